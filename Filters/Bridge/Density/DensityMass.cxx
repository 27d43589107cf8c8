// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/DensityMass.h"

#include "Bridge/Density/DensityImage.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/Reduction.h"

#include <cmath>
#include <functional>
#include <vector>

namespace RectifiedTransport
{

namespace
{

template <int D>
double sumOf(const DensityImage& density, Progress& progress)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
  const DensitySource<D> source = density.Source<D>();
  const auto sumOfChunk = [&](std::int64_t first, std::int64_t last) {
    std::vector<double> values(static_cast<std::size_t>(last - first));
    source.Values.Read(first, last - first, values.data());
    double sum = 0.0;
    for (const double value : values)
    {
      sum += value;
    }
    return sum;
  };
  return reduceChunks(
    progress, density.Grid().NumberOfCells(), grain, 0.0, sumOfChunk, std::plus<>());
}

} // namespace

double massOf(const DensityImage& density, Progress& progress)
{
  const double sum =
    dispatchDimension(density.Grid().Dimension(), sumOf<1>, sumOf<2>, sumOf<3>)(density, progress);
  DensitySummary found;
  found.Total = sum * density.Grid().CellMeasure();
  if (sum > 0.0 && std::isfinite(sum) && (!(found.Total > 0.0) || std::isinf(found.Total)))
  {
    density.ThrowInvalid(found);
  }
  return found.Total;
}

} // namespace RectifiedTransport
