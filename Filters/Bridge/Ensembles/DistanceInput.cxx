// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ensembles/DistanceInput.h"

#include "Bridge/Density/DensityMass.h"
#include "Bridge/Density/InputDensity.h"
#include "Bridge/Density/WholeValues.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/Progress.h"

namespace RectifiedTransport::Bridge
{

namespace
{

template <int D>
DistanceInput read(InputDensity& density, Progress& progress)
{
  DistanceInput input;
  input.Reading = density.HowRead();
  input.Grid = density.Grid();
  input.Values = wholeValues<D>(density, "Density", progress);
  density.ReleaseGathered();
  const GridSize<D> size = input.Grid.Size<D>();
  input.Mass =
    requireMass(density, DensityArray<D, double>(input.Values->GetPointer(0), size), progress);
  input.Identity.AddArray(input.Values);
  input.Identity.Hash(progress);
  return input;
}

} // namespace

DistanceInput readDistanceInput(InputDensity& density, Progress& progress)
{
  return dispatchDimension(density.Grid().Dimension(), read<1>, read<2>, read<3>)(
    density, progress);
}

} // namespace RectifiedTransport::Bridge
