// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/DensityMass.h"

#include "Bridge/Density/InputDensity.h"
#include "Core/Tables/DensityInspection.h"

#include <cmath>

namespace RectifiedTransport::Bridge
{

namespace
{

// Of values with this summary.
double massOf(InputDensity& density, UnusualValues values, Progress& progress)
{
  const double sum = values.Found.Total;
  DensitySummary found;
  found.Total = sum * density.Grid().CellMeasure();
  if (sum > 0.0 && std::isfinite(sum) && (!(found.Total > 0.0) || std::isinf(found.Total)))
  {
    density.ThrowInvalid(found);
  }
  if (std::isfinite(sum))
  {
    density.TellUnusual(values, progress);
  }
  return found.Total;
}

} // namespace

double massOf(InputDensity& density, Progress& progress)
{
  UnusualValues values = density.Unusual();
  values.Found = summarize(*density.Values(), density.Grid().NumberOfCells(), progress);
  return massOf(density, values, progress);
}

double requireMass(InputDensity& density, const DensityValues& gathered, Progress& progress)
{
  UnusualValues values = density.Unusual();
  values.Found = summarize(gathered, density.Grid().NumberOfCells(), progress);
  try
  {
    requireDensity(values.Found);
  }
  catch (const InvalidDensity& invalid)
  {
    density.ThrowInvalid(invalid.Summary());
  }
  return massOf(density, values, progress);
}

} // namespace RectifiedTransport::Bridge
