// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/DensityMass.h"

#include "Bridge/Density/InputDensity.h"
#include "Core/Parallel/Reduction.h"
#include "Core/Tables/DensityInspection.h"

#include <cmath>
#include <vector>

namespace RectifiedTransport
{

namespace
{

DensitySummary summaryOf(const InputDensity& density, Progress& progress)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
  const auto readChunk = [&](std::int64_t first, std::int64_t last) {
    std::vector<double> values(static_cast<std::size_t>(last - first));
    density.Values()->Read(first, last - first, values.data());
    return summarize(values.data(), last - first, first);
  };
  const auto join = [](DensitySummary all, const DensitySummary& chunk) {
    merge(chunk, all);
    return all;
  };
  return reduceChunks(
    progress, density.Grid().NumberOfCells(), grain, DensitySummary(), readChunk, join);
}

} // namespace

double massOf(InputDensity& density, Progress& progress)
{
  UnusualValues values = density.Unusual();
  values.Found = summaryOf(density, progress);
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

} // namespace RectifiedTransport
