// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Solid/SolidDensity.h"

#include "Bridge/Image/GridText.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Image/SolidGrid.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Solid/ClosedSurface.h"
#include "Core/Solid/SolidCoverage.h"

#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkPolyData.h"

#include <string>

namespace RectifiedTransport
{

namespace
{

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

ImageGrid SolidDensity::GridAround(vtkPolyData* surface) const
{
  const ImageGrid cells = solidGrid(polygonBounds(surface), this->Resolution, this->Padding);
  return this->OnPoints ? cells.AtCellCentres() : cells;
}

void SolidDensity::Run(vtkPolyData* surface, Progress& progress, vtkImageData* output) const
{
  ClosedSurface closed(surface, progress, 0.4);
  const ImageGrid cells = solidGrid(polygonBounds(surface), this->Resolution, this->Padding);
  const TriangleSurface triangles = closed.InCells(cells, progress, 0.5);
  const vtkSmartPointer<vtkDoubleArray> density =
    cover(triangles, cells.Size<3>(), this->Supersampling, progress);
  applyGrid(this->OnPoints ? cells.AtCellCentres() : cells, output);
  output->GetAttributes(this->OnPoints ? vtkDataObject::POINT : vtkDataObject::CELL)
    ->SetScalars(density);
}

} // namespace RectifiedTransport
