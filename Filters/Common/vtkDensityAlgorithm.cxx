// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDensityAlgorithm.h"

#include "Bridge/Blocks/OptionalArray.h"
#include "Bridge/Cells/DensityInput.h"
#include "Bridge/Data/DefaultArray.h"
#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Plan/FlowCache.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/Inputs/InputExtents.h"
#include "Bridge/Run/Settings/MissingData.h"
#include "Core/Geometry/Boxes/GridResolution.h"
#include "Core/Messages/PropertyCheck.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"

#include <map>
#include <string>

VTK_ABI_NAMESPACE_BEGIN

using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;

namespace
{
const char* const NegativeValuesTexts[] = { "Error", "Clamp" };
} // namespace

struct vtkDensityAlgorithm::vtkInternals
{
  FlowCache Cache;
  std::map<int, DensityInput> Inputs; // by their numbers
};

//------------------------------------------------------------------------------
vtkDensityAlgorithm::vtkDensityAlgorithm(int densityPort)
  : ValidRange{ -Unbounded, Unbounded }
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
  return choiceText(NegativeValuesTexts, this->NegativeValues);
}

//------------------------------------------------------------------------------
const char* vtkDensityAlgorithm::GetNaNValuesAsString()
{
  return choiceText(NaNValuesTexts, this->NaNValues);
}

//------------------------------------------------------------------------------
vtkMTimeType vtkDensityAlgorithm::GetTableBuildTime()
{
  return this->Internals->Cache.BuildTime();
}

//------------------------------------------------------------------------------
int vtkDensityAlgorithm::IsInputAroundSolid()
{
  return isAroundSolid(this->GetInputDataObject(this->DensityPort, 0)) ? 1 : 0;
}

//------------------------------------------------------------------------------
FlowCache& vtkDensityAlgorithm::GetFlowCache()
{
  return this->Internals->Cache;
}

//------------------------------------------------------------------------------
void vtkDensityAlgorithm::AddDensityPort(PortPolicyType policy, PortInputsType inputs)
{
  // Without the composite the executive would execute the filter once for each block.
  this->AddInputPort(policy, { "vtkDataSet", "vtkCompositeDataSet", "vtkHyperTreeGrid" }, inputs);
}

//------------------------------------------------------------------------------
std::unique_ptr<InputDensity> vtkDensityAlgorithm::ReadDensity(
  vtkInformationVector** inputVector, RectifiedTransport::Progress& progress)
{
  return this->ReadDensity(vtkDataObject::GetData(inputVector[this->DensityPort], 0), progress);
}

//------------------------------------------------------------------------------
std::unique_ptr<InputDensity> vtkDensityAlgorithm::ReadDensity(
  vtkDataObject* input, RectifiedTransport::Progress& progress, int arrayIndex, int number)
{
  const DensityChoice choice = this->GetDensityChoice(arrayIndex);
  return this->Internals->Inputs[number].Read(choice, input, progress);
}

//------------------------------------------------------------------------------
// Checks the properties of reading. The choice is valid while this filter lives: it calls the
// filter's methods when blocks are read.
DensityChoice vtkDensityAlgorithm::GetDensityChoice(int arrayIndex)
{
  requireChoice("NegativeValues", this->NegativeValues, NegativeValuesTexts);
  requireResolution("DensityResolution", this->DensityResolution);
  vtkInformation* array = this->GetInputArrayInformation(arrayIndex);
  const char* name = array->Get(vtkDataObject::FIELD_NAME());
  DensityChoice choice{};
  choice.Rules.Component = this->Component;
  choice.Rules.Invert = this->InvertDensity != 0;
  choice.Rules.ClampNegative = this->NegativeValues == NEGATIVE_VALUES_CLAMP;
  choice.Rules.Missing = missingValues(this->NaNValues, this->ValidRange);
  choice.Rules.Empty = emptyRule(this->EmptyCells, this->EmptyValue);
  choice.Resolution = this->DensityResolution;
  choice.Association = array->Get(vtkDataObject::FIELD_ASSOCIATION());
  choice.ArrayName = name ? name : "";
  choice.FindArray = [this, arrayIndex](vtkDataSet* data, int& association) {
    return this->FindDensityArray(data, arrayIndex, association);
  };
  choice.Warn = [this](const std::string& text) { this->WarnOnFirstRank(text); };
  return choice;
}

//------------------------------------------------------------------------------
// VTK's default is the active scalars, which may be ids or flags: without a name these are not
// taken, and defaultArray looks for another array. An array that is chosen by its name is taken as
// it is.
vtkAbstractArray* vtkDensityAlgorithm::FindDensityArray(
  vtkDataSet* data, int arrayIndex, int& association)
{
  vtkInformation* choice = this->GetInputArrayInformation(arrayIndex);
  association = choice->Get(vtkDataObject::FIELD_ASSOCIATION());
  if (!isArrayAssociation(association))
  {
    return nullptr; // GetInputAbstractArrayToProcess would report another error
  }
  const char* name = choice->Get(vtkDataObject::FIELD_NAME());
  vtkAbstractArray* chosen = this->GetInputAbstractArrayToProcess(arrayIndex, data, association);
  const bool isNamed = name && *name;
  const bool isDefault = !isNamed && chosen &&
    isIds(data->GetAttributes(association == vtkDataObject::FIELD_ASSOCIATION_CELLS
              ? vtkDataObject::CELL
              : vtkDataObject::POINT),
      chosen);
  return isNamed || (chosen && !isDefault) ? chosen : defaultArray(data, association);
}

//------------------------------------------------------------------------------
ImageGrid vtkDensityAlgorithm::AnnouncedDensityGrid(
  vtkInformation* inputInformation, int arrayIndex, int number)
{
  vtkDataObject* data = vtkDataObject::GetData(inputInformation);
  // Where ranks have data of several types, all of them read these.
  if (onAllRanks(this->GetRanks(), !data || vtkImageData::SafeDownCast(data)))
  {
    return announcedGrid(inputInformation, this->IsDensityOnPoints(inputInformation, arrayIndex));
  }
  return this->FindDensityGrid(data, arrayIndex, number);
}

//------------------------------------------------------------------------------
ImageGrid vtkDensityAlgorithm::FindDensityGrid(vtkDataObject* data, int arrayIndex, int number)
{
  AlgorithmProgress progress(this, this->Threading, this->GetRanks());
  requireExtents(data, "input"); // as a run checks those of all inputs
  DensityChoice choice = this->GetDensityChoice(arrayIndex);
  choice.Warn = [](const std::string&) {}; // the run that follows gives the warnings
  // No share of it, as the run that follows begins at 0.
  Stages stages(progress, { { "grid", 0.0 }, { "run", 1.0 } });
  const auto density = this->Internals->Inputs[number].Read(choice, data, stages["grid"]);
  return density ? density->Grid() : ImageGrid();
}

//------------------------------------------------------------------------------
// Data that are there tell the association. Without them the announced scalars do, points before
// cells as in POINTS_THEN_CELLS; without any, the values count as point data.
bool vtkDensityAlgorithm::IsDensityOnPoints(vtkInformation* inputInformation, int arrayIndex)
{
  int association =
    this->GetInputArrayInformation(arrayIndex)->Get(vtkDataObject::FIELD_ASSOCIATION());
  vtkImageData* image = vtkImageData::GetData(inputInformation);
  if (image && isReadable(image->GetExtent()) && image->GetNumberOfPoints() > 0)
  {
    this->FindDensityArray(image, arrayIndex, association);
  }
  if (association == vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS)
  {
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
  os << indent << "NaNValues: " << this->GetNaNValuesAsString() << "\n";
  os << indent << "ValidRange: " << this->ValidRange[0] << " " << this->ValidRange[1] << "\n";
  os << indent << "DensityResolution: " << this->DensityResolution << "\n";
  os << indent << "DensityPort: " << this->DensityPort << "\n";
  os << indent << "TableBuildTime: " << this->GetTableBuildTime() << "\n";
}
VTK_ABI_NAMESPACE_END
