// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Distance/DistanceInput.h"

#include "Bridge/Density/DensityMass.h"
#include "Bridge/Density/InputDensity.h"
#include "Bridge/Run/Fingerprint.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <memory>

namespace RectifiedTransport
{

namespace
{

template <int D>
DistanceInput read(InputDensity& density, Progress& progress)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
  density.Prepare(FlowTables::Whole, progress);
  const std::shared_ptr<const DensityValues> whole = density.Source<D>().Whole();
  DistanceInput input;
  input.Grid = density.Grid();
  const std::int64_t cells = input.Grid.NumberOfCells();
  input.Values = newArray<vtkDoubleArray>("Density", 1, cells);
  double* values = input.Values->GetPointer(0);
  progress.For(cells, grain, [&](std::int64_t first, std::int64_t last) {
    whole->Read(first, last - first, values + first);
  });
  density.ReleaseGathered();
  const GridSize<D> size = input.Grid.Size<D>();
  input.Mass = requireMass(density, DensityArray<D, double>(values, size), progress);
  input.Key.Hash = fingerprint({ input.Values }, progress);
  std::copy(size.begin(), size.end(), input.Key.Cells.begin());
  return input;
}

} // namespace

DistanceInput readDistanceInput(InputDensity& density, Progress& progress)
{
  return dispatchDimension(density.Grid().Dimension(), read<1>, read<2>, read<3>)(
    density, progress);
}

} // namespace RectifiedTransport
