// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Triangles/SolidDensity.h"

#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Data/PointInput.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Boxes/GridResolution.h"
#include "Core/Geometry/Boxes/SolidGrid.h"
#include "Core/Geometry/Distributed/TupleBoxes.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Solid/SolidCoverage.h"

#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkPolyData.h"

#include <string>

namespace RectifiedTransport::Bridge
{

namespace
{

vtkSmartPointer<vtkDoubleArray> cover(const SolidSurface& surface, bool isOpen,
  const GridSize<3>& cells, const LatticePart<3>& part, const SolidDensity& options,
  Progress& progress)
{
  const int supersampling = options.Supersampling;
  const std::string grid =
    describeSize<3>(part.Cells) + " cells (see " + options.ResolutionName + ")";
  const double count = numberOfCells<3>(part.Cells);
  requireMemory({ "a density of " + grid, count * sizeof(double) });
  auto density = newArray<vtkDoubleArray>("Density", 1, static_cast<vtkIdType>(count));
  const CoverageReport report =
    withMemory({ "the surface's " + std::to_string(surface.Triangles.NumberOfTriangles) +
                   " triangles in the layers of " + grid,
                 static_cast<double>(surface.Triangles.NumberOfTriangles) * sizeof(vtkIdType) },
      [&]() {
        if (isOpen)
        {
          coverPartOfOpenSolid(
            surface.Triangles, cells, part, supersampling, density->GetPointer(0), progress);
          return CoverageReport{};
        }
        return coverPartOfSolid(
          surface, cells, part, supersampling, density->GetPointer(0), progress);
      });
  if (report.OpenLines > 0)
  {
    fail("The input surface leaves ", report.OpenLines, " lines open; it must be closed");
  }
  return density;
}

} // namespace

ImageGrid SolidDensity::GridAround(vtkPolyData* surface, const Ranks& ranks) const
{
  std::array<double, 6> bounds{ 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };
  const bool hasPoints = surface && surface->GetNumberOfPoints() > 0;
  if (hasPoints)
  {
    bounds = polygonBounds(surface);
  }
  bounds = boundsOfAll(ranks, bounds);
  if (onAllRanks(ranks, !hasPoints))
  {
    return ImageGrid().WithValuesOn(this->OnPoints);
  }
  const ImageGrid cells = solidGrid(bounds, this->Resolution, this->Padding);
  return this->OnPoints ? cells.AtCellCentres() : cells;
}

SolidDensityReport SolidDensity::Run(vtkPolyData* surface,
  const std::function<Extent(const ImageGrid&)>& chooseExtent, Progress& progress,
  vtkImageData* output) const
{
  Stages stages(progress, { { "surface", 4 }, { "orientation", 1 }, { "coverage", 5 } });
  const auto closed =
    std::make_shared<ClosedSurface>(surface, this->MayBeOpen, this->OpenAdvice, stages["surface"]);
  const ImageGrid cells = solidGrid(closed->Bounds(), this->Resolution, this->Padding);
  const ImageGrid grid = this->OnPoints ? cells.AtCellCentres() : cells;
  const Extent wanted = chooseExtent(grid);
  const SolidSurface triangles = closed->InCells(cells, stages["orientation"]);
  const int owner = this->OnPoints ? vtkDataObject::POINT : vtkDataObject::CELL;
  // The values are those of cells, or of the points at their centres.
  const auto part = latticePartOf<3>(tuplesOf(wanted, owner, grid.Extent()), cells);
  const vtkSmartPointer<vtkDoubleArray> density =
    cover(triangles, closed->IsOpen(), cells.Size<3>(), part, *this, stages["coverage"]);
  applyGrid(grid, output);
  Extent extent = wanted; // VTK takes no constant one
  output->SetExtent(extent.data());
  output->GetAttributes(owner)->SetScalars(density);
  return { grid, closed->RepairWarning(), closed };
}

} // namespace RectifiedTransport::Bridge
