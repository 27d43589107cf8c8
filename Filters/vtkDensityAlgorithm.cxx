// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDensityAlgorithm.h"

#include "Bridge/Density/DensityImage.h"
#include "Bridge/Density/FlowCache.h"
#include "Bridge/Image/DefaultArray.h"
#include "Bridge/Run/ArrayList.h"
#include "Bridge/Run/InputBlock.h"
#include "Bridge/Run/PropertyCheck.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPointData.h"

#include <string>

VTK_ABI_NAMESPACE_BEGIN

namespace
{
const char* const NegativeValuesTexts[] = { "Error", "Clamp" };

bool isAssociation(int association)
{
  return association == vtkDataObject::FIELD_ASSOCIATION_POINTS ||
    association == vtkDataObject::FIELD_ASSOCIATION_CELLS ||
    association == vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS;
}
} // namespace

struct vtkDensityAlgorithm::vtkInternals
{
  RectifiedTransport::FlowCache Cache;
};

//------------------------------------------------------------------------------
vtkDensityAlgorithm::vtkDensityAlgorithm(int densityPort)
  : Component(-1)
  , InvertDensity(false)
  , NegativeValues(NEGATIVE_VALUES_ERROR)
  , DensityPort(densityPort)
  , Internals(new vtkInternals)
{
  this->SetInputArrayToProcess(0, densityPort, 0,
    vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, vtkDataSetAttributes::SCALARS);
}

//------------------------------------------------------------------------------
vtkDensityAlgorithm::~vtkDensityAlgorithm() = default;

//------------------------------------------------------------------------------
const char* vtkDensityAlgorithm::GetNegativeValuesAsString()
{
  return RectifiedTransport::choiceText(NegativeValuesTexts, this->NegativeValues);
}

//------------------------------------------------------------------------------
vtkMTimeType vtkDensityAlgorithm::GetTableBuildTime()
{
  return this->Internals->Cache.BuildTime();
}

//------------------------------------------------------------------------------
RectifiedTransport::FlowCache& vtkDensityAlgorithm::GetFlowCache()
{
  return this->Internals->Cache;
}

//------------------------------------------------------------------------------
std::unique_ptr<RectifiedTransport::DensityImage> vtkDensityAlgorithm::ReadDensity(
  vtkInformationVector** inputVector)
{
  return this->ReadDensity(vtkDataObject::GetData(inputVector[this->DensityPort], 0));
}

//------------------------------------------------------------------------------
std::unique_ptr<RectifiedTransport::DensityImage> vtkDensityAlgorithm::ReadDensity(
  vtkDataObject* input, int arrayIndex)
{
  RectifiedTransport::requireChoice("NegativeValues", this->NegativeValues, NegativeValuesTexts);
  auto* image = RectifiedTransport::requireBlock<vtkImageData>(
    input, "The density", "a vtkImageData, as Resample To Image makes one of it");
  if (!image || image->GetNumberOfPoints() == 0)
  {
    return nullptr;
  }
  vtkInformation* choice = this->GetInputArrayInformation(arrayIndex);
  int association = choice->Get(vtkDataObject::FIELD_ASSOCIATION());
  if (!isAssociation(association))
  {
    throw RectifiedTransport::Failure("The field association of the density array is " +
      std::to_string(association) + "; it must be 0 (points), 1 (cells) or 3 (points, then cells)");
  }
  const char* name = choice->Get(vtkDataObject::FIELD_NAME());
  vtkAbstractArray* chosen = this->FindDensityArray(image, arrayIndex, association);
  vtkDataArray* array = vtkDataArray::SafeDownCast(chosen);
  if (!array)
  {
    throw RectifiedTransport::Failure(
      (chosen ? "The density array '" + std::string(name ? name : "") + "' is not numeric"
          : name && *name ? "The input image has no density array '" + std::string(name) + "'"
                          : std::string("The input image has no active scalars for a density")) +
      "; it has " + RectifiedTransport::listArrays(image->GetPointData(), "point") + " and " +
      RectifiedTransport::listArrays(image->GetCellData(), "cell"));
  }
  RectifiedTransport::DensityRules rules;
  rules.Component = this->Component;
  rules.Invert = this->InvertDensity != 0;
  rules.ClampNegative = this->NegativeValues == NEGATIVE_VALUES_CLAMP;
  return std::make_unique<RectifiedTransport::DensityImage>(
    image, array, association == vtkDataObject::FIELD_ASSOCIATION_POINTS, rules);
}

//------------------------------------------------------------------------------
vtkAbstractArray* vtkDensityAlgorithm::FindDensityArray(
  vtkImageData* image, int arrayIndex, int& association)
{
  vtkInformation* choice = this->GetInputArrayInformation(arrayIndex);
  association = choice->Get(vtkDataObject::FIELD_ASSOCIATION());
  if (!isAssociation(association))
  {
    return nullptr; // GetInputAbstractArrayToProcess would report another error
  }
  const char* name = choice->Get(vtkDataObject::FIELD_NAME());
  vtkAbstractArray* chosen = this->GetInputAbstractArrayToProcess(arrayIndex, image, association);
  return chosen || (name && *name) ? chosen : RectifiedTransport::defaultArray(image, association);
}

//------------------------------------------------------------------------------
bool vtkDensityAlgorithm::IsDensityOnPoints(vtkInformation* inputInformation, int arrayIndex)
{
  int association =
    this->GetInputArrayInformation(arrayIndex)->Get(vtkDataObject::FIELD_ASSOCIATION());
  vtkImageData* image = vtkImageData::GetData(inputInformation);
  if (image && image->GetNumberOfPoints() > 0)
  {
    this->FindDensityArray(image, arrayIndex, association);
  }
  if (association == vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS)
  {
    using RectifiedTransport::announcesScalars;
    return announcesScalars(inputInformation, vtkDataObject::FIELD_ASSOCIATION_POINTS) ||
      !announcesScalars(inputInformation, vtkDataObject::FIELD_ASSOCIATION_CELLS);
  }
  return association == vtkDataObject::FIELD_ASSOCIATION_POINTS;
}

//------------------------------------------------------------------------------
void vtkDensityAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Component: " << this->Component << "\n";
  os << indent << "InvertDensity: " << (this->InvertDensity ? "On" : "Off") << "\n";
  os << indent << "NegativeValues: " << this->GetNegativeValuesAsString() << "\n";
  os << indent << "DensityPort: " << this->DensityPort << "\n";
  os << indent << "TableBuildTime: " << this->GetTableBuildTime() << "\n";
}
VTK_ABI_NAMESPACE_END
