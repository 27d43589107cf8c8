// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Points/SeedInput.h"

#include "Bridge/Points/GhostFlags.h"
#include "Bridge/Points/PointInput.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace RectifiedTransport::Bridge
{

namespace
{

// Writes the nearest point of the domain, in index and in physical space. Returns whether the point
// was moved.
template <int D>
bool placeSeed(const ImageGrid& grid, const double* x, double* index, double* seed)
{
  grid.ToIndex<D>(x, index);
  const bool inside = grid.ClampToDomain<D>(index);
  grid.ToPhysical<D>(index, seed);
  const double distance = std::hypot(x[0] - seed[0], x[1] - seed[1], x[2] - seed[2]);
  const double rounding =
    1e-12 * (grid.Diagonal() + std::abs(x[0]) + std::abs(x[1]) + std::abs(x[2]));
  if (inside && distance <= rounding)
  {
    std::copy_n(x, 3, seed);
  }
  return distance > grid.BorderTolerance();
}

} // namespace

template <int D>
std::int64_t readSeeds(vtkPointSet* points, const CountedPoints& counted, const std::string& what,
  const ImageGrid& grid, Progress& progress, PointSpan<D> indexSeeds, PointSpan<3> physicalSeeds)
{
  std::atomic<std::int64_t> moved{ 0 };
  const auto place = [&](const double* x, std::int64_t number, double* seed) {
    if (placeSeed<D>(grid, x, indexSeeds[number], seed))
    {
      ++moved;
    }
  };
  if (counted.Count() == points->GetNumberOfPoints())
  {
    visitPoints(points, what, progress,
      [&](std::int64_t i, const double* x) { place(x, i, physicalSeeds[i]); });
    return moved;
  }
  visitPoints(points, what, progress,
    [&](std::int64_t i, const double* x) { std::copy_n(x, 3, physicalSeeds[i]); });
  constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
  progress.For(counted.Count(), grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t number = first; number < last; ++number)
    {
      double* seed = physicalSeeds[counted.Point(number)];
      const double x[3] = { seed[0], seed[1], seed[2] };
      place(x, number, seed);
    }
  });
  return moved;
}

template std::int64_t readSeeds<1>(vtkPointSet*, const CountedPoints&, const std::string&,
  const ImageGrid&, Progress&, PointSpan<1>, PointSpan<3>);
template std::int64_t readSeeds<2>(vtkPointSet*, const CountedPoints&, const std::string&,
  const ImageGrid&, Progress&, PointSpan<2>, PointSpan<3>);
template std::int64_t readSeeds<3>(vtkPointSet*, const CountedPoints&, const std::string&,
  const ImageGrid&, Progress&, PointSpan<3>, PointSpan<3>);

} // namespace RectifiedTransport::Bridge
