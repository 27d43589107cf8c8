// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMassSplatter.h"

#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Data/PointInput.h"
#include "Bridge/Data/PointMasses.h"
#include "Bridge/Ranks/DistributedPoints.h"
#include "Bridge/Ranks/MassSplatter.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/Inputs/InputBlock.h"
#include "Bridge/Run/Settings/AssociationSettings.h"
#include "Bridge/Run/Settings/SplatSettings.h"
#include "Core/Messages/PartText.h"
#include "Core/Messages/PropertyCheck.h"

#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkMassSplatter);

namespace
{
using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;

// The enumeration of the class indexes this.
const char* const BoundaryTexts[] = { "Renormalize", "Drop" };

// RequestInformation checks Dimensions, too: it makes a grid of them before RequestData does.
void requireDimensions(const int dimensions[3])
{
  const int* end = dimensions + 3;
  if (*std::min_element(dimensions, end) < 1 &&
    std::any_of(dimensions, end, [](int values) { return values != 0; }))
  {
    throw Failure("Dimensions is " + std::to_string(dimensions[0]) + " " +
      std::to_string(dimensions[1]) + " " + std::to_string(dimensions[2]) +
      "; it must be at least 1 along every axis, or 0 0 0");
  }
}

// Kernel and Boundary are not set.
MassSplatter splatterOf(vtkMassSplatter& filter)
{
  MassSplatter splatter{};
  std::copy_n(filter.GetDimensions(), 3, splatter.Dimensions.begin());
  splatter.OnPoints = isOnPoints(filter.GetAssociation());
  splatter.DivideByVolume = filter.GetDivideByVolume() != 0;
  return splatter;
}

// The mass array that SetInputArrayToProcess(0, ...) chooses, by its name or as an active
// attribute. It is nullptr without a choice: points then weigh 1 each. The result may be a new
// array, made of text that holds numbers, so that the caller shares its ownership.
vtkSmartPointer<vtkDataArray> chosenMasses(vtkInformation* choice, vtkPointSet* points)
{
  const int association = choice->Get(vtkDataObject::FIELD_ASSOCIATION());
  if (association != vtkDataObject::FIELD_ASSOCIATION_POINTS)
  {
    throw Failure("The field association of the mass array is " + std::to_string(association) +
      "; it must be 0 (points)");
  }
  const char* name = choice->Get(vtkDataObject::FIELD_NAME());
  if (!name && choice->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE()))
  {
    return findMasses(points, choice->Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE()));
  }
  return findMasses(points, std::string(name ? name : ""));
}
} // namespace

//------------------------------------------------------------------------------
vtkMassSplatter::vtkMassSplatter()
{
  this->AddInputPort(PORT_PARTITIONED_POINTS, { "vtkPointSet" });
  this->AddInputPort(PORT_PARTITIONED_DENSITY, { "vtkImageData" }, PORT_OPTIONAL_INPUT);
  this->AddOutputPort("vtkImageData");
  this->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "");
}

//------------------------------------------------------------------------------
const char* vtkMassSplatter::GetAssociationAsString()
{
  return choiceText(AssociationTexts, this->Association);
}

//------------------------------------------------------------------------------
const char* vtkMassSplatter::GetKernelAsString()
{
  return choiceText(KernelTexts, this->Kernel);
}

//------------------------------------------------------------------------------
const char* vtkMassSplatter::GetBoundaryAsString()
{
  return choiceText(BoundaryTexts, this->Boundary);
}

//------------------------------------------------------------------------------
// Announces the image before the data. The grid of a Reference is announced by its producer; a grid
// on the points' bounds needs the points, so that their producer is updated here, on all ranks,
// whose bounds are joined. Without points there is no grid, and the image is empty.
int vtkMassSplatter::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const MassSplatter splatter = splatterOf(*this);
  ImageGrid grid = ImageGrid().WithValuesOn(splatter.OnPoints);
  if (inputVector[1]->GetNumberOfInformationObjects() > 0)
  {
    grid = announcedGrid(inputVector[1]->GetInformationObject(0), splatter.OnPoints);
  }
  else
  {
    double bounds[6];
    const Ranks& ranks = this->UpdateInputOnRanks(0, inputVector, outputVector);
    vtkPointSet* points = vtkPointSet::GetData(inputVector[0]);
    findBounds(points, ranks, bounds);
    requireDimensions(this->Dimensions);
    // Their number counts for automatic Dimensions alone.
    const bool isAutomatic = splatter.Dimensions == std::array<int, 3>{};
    const std::int64_t count = isAutomatic
      ? DistributedPoints(points, vtkDataSetAttributes::DUPLICATEPOINT, ranks).All()
      : 0;
    if (bounds[0] <= bounds[1])
    {
      grid = splatter.GridAround(bounds, count);
    }
  }
  announceSubExtents(outputVector->GetInformationObject(0));
  announceDensity(grid, outputVector->GetInformationObject(0));
  return 1;
}

//------------------------------------------------------------------------------
int vtkMassSplatter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  requireDimensions(this->Dimensions);
  MassSplatter splatter = splatterOf(*this);
  requireChoice("Boundary", this->Boundary, BoundaryTexts);
  splatter.Splat = splatOptions(this->Kernel, this->Radius);
  splatter.Splat.Boundary = static_cast<SplatBoundary>(this->Boundary);
  // Ranks share the work: each one reads its own points and reference, and writes its part of the
  // image.
  AlgorithmProgress progress(this, this->Threading, this->GetRanks());

  vtkPointSet* input = pointSetOf(inputVector[0]);
  auto* reference = requireBlock<vtkImageData>(
    vtkDataObject::GetData(inputVector[1]), "The Reference", "a vtkImageData");
  // A rank without points may lack the array as well: this is no error.
  const vtkSmartPointer<vtkDataArray> masses = input && input->GetNumberOfPoints() > 0
    ? chosenMasses(this->GetInputArrayInformation(0), input)
    : nullptr;
  vtkImageData* output = vtkImageData::GetData(outputVector);
  vtkInformation* outputInformation = outputVector->GetInformationObject(0);
  // The connection decides, not its data: a rank may have no part of the Reference and has to take
  // part in the same exchanges as the others.
  const bool hasReference = inputVector[1]->GetNumberOfInformationObjects() > 0;
  const MassSplatter::Report report =
    splatter.Run(input, masses, { hasReference, reference, outputInformation }, progress, output);
  // Without a Reference the extent may not be known before the data.
  if (!report.Grid.IsEmpty())
  {
    announceGrid(report.Grid, outputInformation);
  }
  if (isWorthWarning(report.Outside, report.Points))
  {
    this->WarnOnFirstRank(std::to_string(report.Outside) + " of " + std::to_string(report.Points) +
      (report.Outside == 1 ? " points is outside the domain; its mass "
                           : " points are outside the domain; their mass ") +
      (this->Boundary == RENORMALIZE ? "went to the nearest points of its border"
                                     : "was left out"));
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkMassSplatter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Dimensions: " << this->Dimensions[0] << " " << this->Dimensions[1] << " "
     << this->Dimensions[2] << "\n";
  os << indent << "Association: " << this->GetAssociationAsString() << "\n";
  os << indent << "Kernel: " << this->GetKernelAsString() << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "Boundary: " << this->GetBoundaryAsString() << "\n";
  os << indent << "DivideByVolume: " << (this->DivideByVolume ? "On" : "Off") << "\n";
}
VTK_ABI_NAMESPACE_END
