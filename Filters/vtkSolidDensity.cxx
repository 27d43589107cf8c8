// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSolidDensity.h"

#include "Bridge/Flow/FlowSettings.h"
#include "Bridge/Image/GridText.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Image/SolidGrid.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/InputBlock.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Run/PropertyCheck.h"
#include "Bridge/Solid/ClosedSurface.h"

#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <sstream>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkSolidDensity);

namespace
{
using namespace RectifiedTransport;

const char* const AssociationTexts[] = { "Points", "Cells" };
constexpr int MaximumSupersampling = 16;

vtkSmartPointer<vtkDoubleArray> cover(
  const TriangleSurface& surface, const GridSize<3>& cells, int supersampling, Progress& progress)
{
  const std::string grid = describeSize<3>(cells) + " cells (see Resolution)";
  const double count = numberOfCells<3>(cells);
  requireMemory("a density of " + grid, count * sizeof(double));
  auto density = newArray<vtkDoubleArray>("Density", 1, static_cast<vtkIdType>(count));
  progress.BeginStage(1.0);
  const CoverageReport report = withMemory("the surface's " +
      std::to_string(surface.NumberOfTriangles) + " triangles in the layers of " + grid,
    static_cast<double>(surface.NumberOfTriangles) * sizeof(vtkIdType), [&]() {
      return coverSolid(surface, cells, supersampling, density->GetPointer(0), progress.Stage());
    });
  if (report.OpenLines > 0)
  {
    throw Failure("The input surface leaves " + std::to_string(report.OpenLines) +
      " lines open; it must be closed");
  }
  return density;
}
} // namespace

//------------------------------------------------------------------------------
vtkSolidDensity::vtkSolidDensity()
  : Resolution(64)
  , Supersampling(2)
  , Padding(0.05)
  , Association(POINTS)
  , Threading(0)
{
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(1);
}

//------------------------------------------------------------------------------
vtkSolidDensity::~vtkSolidDensity() = default;

//------------------------------------------------------------------------------
const char* vtkSolidDensity::GetAssociationAsString()
{
  return choiceText(AssociationTexts, this->Association);
}

//------------------------------------------------------------------------------
const char* vtkSolidDensity::GetThreadingAsString()
{
  return FlowSettings::OfThreading(this->Threading).ThreadingText();
}

//------------------------------------------------------------------------------
vtkImageData* vtkSolidDensity::GetOutput()
{
  return vtkImageData::SafeDownCast(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
int vtkSolidDensity::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkSolidDensity::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkImageData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkSolidDensity::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->UpdateInputBeforeData(0, inputVector, outputVector);
  vtkPolyData* surface = vtkPolyData::GetData(inputVector[0]);
  const bool onPoints = this->Association == POINTS;
  ImageGrid grid = ImageGrid().WithValuesOn(onPoints);
  if (surface && surface->GetNumberOfPoints() > 0)
  {
    const ImageGrid cells = solidGrid(polygonBounds(surface), this->Resolution, this->Padding);
    grid = onPoints ? cells.AtCellCentres() : cells;
  }
  announceDensity(grid, outputVector->GetInformationObject(0));
  return 1;
}

//------------------------------------------------------------------------------
int vtkSolidDensity::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  requireThat(this->Supersampling >= 1 && this->Supersampling <= MaximumSupersampling,
    "Supersampling", this->Supersampling, "from 1 to 16");
  requireChoice("Association", this->Association, AssociationTexts);
  std::unique_ptr<Executor> executor = FlowSettings::OfThreading(this->Threading).MakeExecutor();
  requireSolidGrid(this->Resolution, this->Padding);

  // All is in the first piece, whatever pieces a consumer asks for.
  if (vtkGuardedAlgorithm::IsLaterPiece(request, outputVector))
  {
    return 1;
  }
  vtkImageData* output = vtkImageData::GetData(outputVector, 0);
  auto* input = requireBlock<vtkPolyData>(vtkDataObject::GetData(inputVector[0]), "The input",
    "a vtkPolyData, as Extract Surface makes one of it");
  if (!input || input->GetNumberOfPoints() == 0)
  {
    return 1;
  }
  AlgorithmProgress progress(this, std::move(executor));
  ClosedSurface surface(input, progress, 0.4);
  const ImageGrid cells = solidGrid(polygonBounds(input), this->Resolution, this->Padding);
  const TriangleSurface triangles = surface.InCells(cells, progress, 0.5);
  const vtkSmartPointer<vtkDoubleArray> density =
    cover(triangles, cells.Size<3>(), this->Supersampling, progress);

  const bool onPoints = this->Association == POINTS;
  const ImageGrid grid = onPoints ? cells.AtCellCentres() : cells;
  applyGrid(grid, output);
  announceGrid(grid, outputVector->GetInformationObject(0)); // it may have changed with time
  output->GetAttributes(onPoints ? vtkDataObject::POINT : vtkDataObject::CELL)->SetScalars(density);
  return 1;
}

//------------------------------------------------------------------------------
void vtkSolidDensity::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "Supersampling: " << this->Supersampling << "\n";
  os << indent << "Padding: " << this->Padding << "\n";
  os << indent << "Association: " << this->GetAssociationAsString() << "\n";
  os << indent << "Threading: " << this->GetThreadingAsString() << "\n";
}
VTK_ABI_NAMESPACE_END
