// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMassSplatter.h"

#include "Bridge/Flow/FlowSettings.h"
#include "Bridge/Image/GridText.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Points/PointInput.h"
#include "Bridge/Points/PointMasses.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/FieldValue.h"
#include "Bridge/Run/InputBlock.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Run/PropertyCheck.h"
#include "Bridge/Splat/MassSplat.h"
#include "Bridge/Splat/SplatSettings.h"

#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <algorithm>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkMassSplatter);

namespace
{
using namespace RectifiedTransport;

const char* const AssociationTexts[] = { "Points", "Cells" };

void requireDimensions(const int dimensions[3])
{
  if (*std::min_element(dimensions, dimensions + 3) < 1)
  {
    throw Failure("Dimensions is " + std::to_string(dimensions[0]) + " " +
      std::to_string(dimensions[1]) + " " + std::to_string(dimensions[2]) +
      "; it must be at least 1 along every axis");
  }
}
} // namespace

//------------------------------------------------------------------------------
vtkMassSplatter::vtkMassSplatter()
  : Dimensions{ 128, 128, 128 }
  , Association(POINTS)
  , Kernel(CLOUD_IN_CELL)
  , Radius(1.0)
  , Boundary(RENORMALIZE)
  , DivideByVolume(true)
  , Threading(0)
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(1);
  this->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "");
}

//------------------------------------------------------------------------------
vtkMassSplatter::~vtkMassSplatter() = default;

//------------------------------------------------------------------------------
SplatSettings vtkMassSplatter::GetSplatSettings()
{
  return { this->Kernel, this->Radius, this->Boundary };
}

//------------------------------------------------------------------------------
const char* vtkMassSplatter::GetAssociationAsString()
{
  return choiceText(AssociationTexts, this->Association);
}

//------------------------------------------------------------------------------
const char* vtkMassSplatter::GetKernelAsString()
{
  return this->GetSplatSettings().KernelText();
}

//------------------------------------------------------------------------------
const char* vtkMassSplatter::GetBoundaryAsString()
{
  return this->GetSplatSettings().BoundaryText();
}

//------------------------------------------------------------------------------
const char* vtkMassSplatter::GetThreadingAsString()
{
  return FlowSettings::OfThreading(this->Threading).ThreadingText();
}

//------------------------------------------------------------------------------
void vtkMassSplatter::SetReferenceConnection(vtkAlgorithmOutput* reference)
{
  this->SetInputConnection(1, reference);
}

//------------------------------------------------------------------------------
void vtkMassSplatter::SetReferenceData(vtkDataObject* reference)
{
  this->SetInputData(1, reference);
}

//------------------------------------------------------------------------------
vtkImageData* vtkMassSplatter::GetOutput()
{
  return vtkImageData::SafeDownCast(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
int vtkMassSplatter::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
    return 1;
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkMassSplatter::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkImageData");
  return 1;
}

//------------------------------------------------------------------------------
ImageGrid vtkMassSplatter::CellsAround(vtkPointSet* points)
{
  double bounds[6];
  findBounds(points, bounds);
  const ImageGrid box = gridOfBox(bounds);
  int dimensions[3];
  for (std::size_t a = 0; a < 3; ++a)
  {
    dimensions[a] = box.IsAxis(a) ? this->Dimensions[a] : 1;
  }
  return gridWithValues(box, dimensions, "Dimensions");
}

//------------------------------------------------------------------------------
int vtkMassSplatter::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const bool onPoints = this->Association == POINTS;
  ImageGrid grid = ImageGrid().WithValuesOn(onPoints);
  if (inputVector[1]->GetNumberOfInformationObjects() > 0)
  {
    grid = announcedGrid(inputVector[1]->GetInformationObject(0), onPoints);
  }
  else
  {
    this->UpdateInputBeforeData(0, inputVector, outputVector);
    vtkPointSet* points = vtkPointSet::GetData(inputVector[0]);
    requireDimensions(this->Dimensions);
    if (points && points->GetNumberOfPoints() > 0)
    {
      const ImageGrid cells = this->CellsAround(points);
      grid = onPoints ? cells.AtCellCentres() : cells;
    }
  }
  announceDensity(grid, outputVector->GetInformationObject(0));
  return 1;
}

//------------------------------------------------------------------------------
vtkDataArray* vtkMassSplatter::FindMasses(vtkPointSet* points)
{
  vtkInformation* choice = this->GetInputArrayInformation(0);
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

//------------------------------------------------------------------------------
int vtkMassSplatter::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  requireDimensions(this->Dimensions);
  requireChoice("Association", this->Association, AssociationTexts);
  const SplatOptions options = this->GetSplatSettings().Options();
  std::unique_ptr<Executor> executor = FlowSettings::OfThreading(this->Threading).MakeExecutor();

  // All is in the first piece, whatever pieces a consumer asks for.
  vtkInformation* information = outputVector->GetInformationObject(0);
  if (vtkGuardedAlgorithm::IsLaterPiece(request, outputVector))
  {
    return 1;
  }
  vtkPointSet* input = pointSetOf(inputVector[0]);
  auto* reference = requireBlock<vtkImageData>(
    vtkDataObject::GetData(inputVector[1]), "The Reference", "a vtkImageData");
  const vtkIdType count = input ? input->GetNumberOfPoints() : 0;
  if (!input || (reference ? reference->GetNumberOfPoints() == 0 : count == 0))
  {
    return 1;
  }

  AlgorithmProgress progress(this, std::move(executor));
  PointMasses masses;
  if (count > 0)
  {
    vtkDataArray* array = this->FindMasses(input);
    progress.BeginStage(0.1);
    visitPoints(input, "input point set", progress, [](std::int64_t, const double*) {});
    progress.BeginStage(0.2);
    masses = PointMasses(input, array, progress);
  }
  vtkImageData* output = vtkImageData::GetData(outputVector);
  const bool onPoints = this->Association == POINTS;
  const ImageGrid cells = reference ? gridOf(reference, onPoints) : this->CellsAround(input);
  if (cells.Dimension() == 0)
  {
    throw Failure(reference
        ? "The Reference has one point along every axis; it needs at least one axis of two points "
          "or more"
        : "The input's points are all at one place, about which there is no box; connect an image "
          "as the Reference, or points that differ");
  }
  if (!reference)
  {
    const std::array<int, 3> along = cells.NumberOfValues();
    const GridSize<3> size{ along[0], along[1], along[2] };
    requireMemory("the array Density of " + describeSize<3>(size) + " values (see Dimensions)",
      numberOfCells<3>(size) * sizeof(double));
  }
  requireCells(cells);
  const SplatTarget target{ cells, options, this->DivideByVolume != 0 };
  requireFiniteDensity(masses.TotalSize(), target, "The points' masses",
    this->DivideByVolume ? "the cells larger, or switch DivideByVolume off"
                         : "so that the sum of their sizes is a double");
  const ImageGrid grid = onPoints && !reference ? cells.AtCellCentres() : cells;
  applyGrid(grid, output);
  announceGrid(grid, information); // without a Reference it is not known before the data

  const auto density = newArray<vtkDoubleArray>("Density", 1, cells.NumberOfCells());
  const double* noPoints = nullptr;
  progress.BeginStage(0.95);
  const std::int64_t outside = count > 0
    ? splatPoints(input->GetPoints()->GetData(), masses.Values(), 1.0, target, progress, density)
    : splatPoints(noPoints, 0, 1.0, target, progress, density);
  progress.BeginStage(1.0);
  const double total = options.Boundary == SplatBoundary::Renormalize
    ? masses.Total()
    : splatMassIn(density, target, progress);
  output->GetAttributes(onPoints ? vtkDataObject::POINT : vtkDataObject::CELL)->SetScalars(density);
  addFieldValue(output, "TotalMass", total);
  if (outside > 0)
  {
    vtkWarningMacro(<< outside << " of " << count
                    << (outside == 1 ? " points is outside the domain; its mass "
                                     : " points are outside the domain; their mass ")
                    << (options.Boundary == SplatBoundary::Renormalize
                           ? "went to the nearest points of its border"
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
  this->GetSplatSettings().Print(os, indent);
  os << indent << "DivideByVolume: " << (this->DivideByVolume ? "On" : "Off") << "\n";
  os << indent << "Threading: " << this->GetThreadingAsString() << "\n";
}
VTK_ABI_NAMESPACE_END
