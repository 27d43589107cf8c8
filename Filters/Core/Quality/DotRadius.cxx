// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Quality/DotRadius.h"

#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Quality/NearestNeighbours.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// The quantile of nearest-neighbour distances: this share of points has a nearer neighbour. In a
// stippled photograph, the area of the dots is then about three quarters of the ink, and black
// areas do not merge.
constexpr double DenseShare = 0.2;

// A sample of this size determines the quantile well.
constexpr std::int64_t SampleSize = std::int64_t{ 1 } << 16;

std::vector<double> sampleOf(const double* distances, std::int64_t count, std::int64_t step)
{
  std::vector<double> sample;
  for (std::int64_t i = 0; i < count; i += step)
  {
    if (distances[i] > 0.0 && std::isfinite(distances[i]))
    {
      sample.push_back(distances[i]);
    }
  }
  return sample;
}

} // namespace

double radiusOfDots(ConstPointSpan<3> points, const Context& context)
{
  LargeBuffer<double> distances(points.size());
  nearestDistances(points, distances.data(), context);
  const std::vector<std::int64_t> counts = gatherValues(*context.Group, points.size());
  const std::int64_t count = std::accumulate(counts.begin(), counts.end(), std::int64_t{ 0 });
  const std::int64_t step = std::max<std::int64_t>(1, count / SampleSize);
  std::vector<double> all;
  for (const Bytes& bytes :
    context.Group->Gather(toBytes(sampleOf(distances.data(), points.size(), step))))
  {
    const std::vector<double> sample = fromBytes<double>(bytes);
    all.insert(all.end(), sample.begin(), sample.end());
  }
  if (all.empty())
  {
    return 0.0;
  }
  const auto dense =
    all.begin() + static_cast<std::ptrdiff_t>(DenseShare * static_cast<double>(all.size()));
  std::nth_element(all.begin(), dense, all.end());
  // Dots of half the distance touch.
  return 0.5 * *dense;
}

} // namespace RectifiedTransport
