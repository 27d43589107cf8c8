// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/DensityOnGrid.h"

#include "Bridge/Density/InputDensity.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/PlacedCells.h"

namespace RectifiedTransport::Bridge
{

namespace
{

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
