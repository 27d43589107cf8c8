// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/DensityOnGrid.h"

#include "Bridge/Density/InputDensity.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Boxes/CommonGrid.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/CellMeans.h"

namespace RectifiedTransport::Bridge
{

namespace
{

template <int D>
PlacedCells<D> placeCells(const ImageGrid& grid, const ImageGrid& own)
{
  PlacedCells<D> placed{ own.Size<D>(), {}, {} };
  placed.Sides.fill(1.0);
  if (haveSameCells(grid, own))
  {
    return placed;
  }
  double ends[2][D];
  for (int end = 0; end < 2; ++end)
  {
    double index[D];
    for (int axis = 0; axis < D; ++axis)
    {
      index[axis] = end == 0 ? 0.0 : static_cast<double>(placed.Size[axis]);
    }
    double x[3];
    own.ToPhysical<D>(index, x);
    grid.ToIndex<D>(x, ends[end]);
  }
  for (int axis = 0; axis < D; ++axis)
  {
    placed.Low[axis] = ends[0][axis];
    placed.Sides[axis] = (ends[1][axis] - ends[0][axis]) / static_cast<double>(placed.Size[axis]);
  }
  return placed;
}

template <int D>
void write(const ImageGrid& grid, InputDensity& density, const TupleBox& wanted, Progress& progress,
  double* values)
{
  density.Prepare(FlowTables::Tiled, progress);
  withMemory(
    { "the density on the output's grid", 8.0 * static_cast<double>(wanted.Count()) }, [&]() {
      const CellMeans<D> means(
        placeCells<D>(grid, density.Grid()), grid.Size<D>(), latticePartOf<D>(wanted, grid));
      const auto part = density.Source<D>().Part(means.Low(), means.High());
      means.Write(*part, progress, values);
    });
  density.ReleaseGathered();
}

} // namespace

void writeDensityOn(const ImageGrid& grid, InputDensity& density, const TupleBox& wanted,
  Progress& progress, double* values)
{
  dispatchDimension(grid.Dimension(), write<1>, write<2>, write<3>)(
    grid, density, wanted, progress, values);
}

} // namespace RectifiedTransport::Bridge
