// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/DensityMass.h"

#include "Bridge/Density/InputDensity.h"
#include "Core/Parallel/Reduction.h"
#include "Core/Tables/DensityInspection.h"

#include <cmath>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

DensitySummary summaryOf(const DensityValues& given, std::int64_t count, Progress& progress)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
  const auto readChunk = [&](std::int64_t first, std::int64_t last) {
    std::vector<double> values(static_cast<std::size_t>(last - first));
    given.Read(first, last - first, values.data());
    return summarize(values.data(), last - first, first);
  };
  const auto join = [](DensitySummary all, const DensitySummary& chunk) {
    merge(chunk, all);
    return all;
  };
  return reduceChunks(progress, count, grain, DensitySummary(), readChunk, join);
}

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
  values.Found = summaryOf(*density.Values(), density.Grid().NumberOfCells(), progress);
  return massOf(density, values, progress);
}

double requireMass(InputDensity& density, const DensityValues& gathered, Progress& progress)
{
  UnusualValues values = density.Unusual();
  values.Found = summaryOf(gathered, density.Grid().NumberOfCells(), progress);
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
