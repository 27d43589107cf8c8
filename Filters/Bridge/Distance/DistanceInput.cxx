// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Distance/DistanceInput.h"

#include "Bridge/Density/InputDensity.h"
#include "Bridge/Density/PlainDensity.h"
#include "Core/Parallel/Progress.h"

namespace RectifiedTransport::Bridge
{

DistanceInput readDistanceInput(InputDensity& density, Progress& progress)
{
  DistanceInput input;
  input.Reading = density.HowRead();
  input.Grid = density.Grid();
  input.Values = wholeValues(density, "Density", progress);
  density.ReleaseGathered();
  const DensityArray<1, double> values(input.Values->GetPointer(0), { input.Grid.NumberOfCells() });
  input.Mass = requireMass(density, values, progress);
  input.Identity.AddArray(input.Values);
  input.Identity.Hash(progress);
  return input;
}

} // namespace RectifiedTransport::Bridge
