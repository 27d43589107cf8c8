// SPDX-License-Identifier: BSD-3-Clause
// Solved optimal maps and points to move by them.
#ifndef RectifiedTransport_MapPoints_h
#define RectifiedTransport_MapPoints_h

#include "TestDensities.h"
#include "TestDimensions.h"
#include "TestFlow.h"

#include "Core/OptimalMap/OptimalMap.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace RectifiedTransport
{

template <int Dimension>
using MapPoints = std::vector<Point<Dimension>>;

template <int Dimension>
OptimalMap<Dimension> solvedMap(const TestDensity<Dimension>& density,
  const Point<Dimension>& sides = evenPoint<Dimension>(1.0), const Context& context = Context(),
  const OptimalMapOptions& options = {})
{
  const auto values = density.Source();
  OptimalMap<Dimension> map(values, sides, options, context);
  map.Solve(context);
  return map;
}

template <int Dimension>
OptimalMap<Dimension> solvedPair(const TestDensity<Dimension>& source,
  const TestDensity<Dimension>& target, const OptimalMapOptions& options = {})
{
  const auto from = source.Source();
  const auto to = target.Source();
  const Point<Dimension> sides = evenPoint<Dimension>(1.0);
  OptimalMap<Dimension> map({ DensitySource<Dimension>(source.Size, from), {}, sides },
    { DensitySource<Dimension>(target.Size, to), {}, sides }, options);
  map.Solve();
  return map;
}

// Points at the centres of a lattice, in index space.
template <int Dimension>
Points<Dimension> latticePoints(const GridSize<Dimension>& size, std::int64_t side)
{
  Points<Dimension> points;
  const GridSize<Dimension> lattice = evenSize<Dimension>(side);
  for (std::int64_t i = 0; i < cellCount<Dimension>(lattice); ++i)
  {
    const GridSize<Dimension> cell = cellAt<Dimension>(i, lattice);
    Point<Dimension> point;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      point[axis] = (static_cast<double>(cell[axis]) + 0.5) * static_cast<double>(size[axis]) /
        static_cast<double>(side);
    }
    points.push_back(point);
  }
  return points;
}

// In a unit box.
template <int Dimension>
double meanSquare(
  const Points<Dimension>& a, const Points<Dimension>& b, const GridSize<Dimension>& size)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double way = (a[i][axis] - b[i][axis]) / static_cast<double>(size[axis]);
      sum += way * way;
    }
  }
  return sum / static_cast<double>(a.size());
}

template <int Dimension>
bool haveSameBits(const Points<Dimension>& a, const Points<Dimension>& b)
{
  return a.size() == b.size() &&
    std::memcmp(a.data(), b.data(), a.size() * sizeof(Point<Dimension>)) == 0;
}

template <int Dimension>
TestDensity<Dimension> ballAt(const GridSize<Dimension>& size, const Point<Dimension>& centre)
{
  return sampleDensity<Dimension>(size, [&](const Point<Dimension>& p) {
    double square = 0.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      square += (p[axis] - centre[axis]) * (p[axis] - centre[axis]);
    }
    return square < 0.02 ? 1.0 + p[0] - centre[0] : 0.0;
  });
}

template <int Dimension>
std::int64_t sideFor()
{
  return Dimension == 1 ? 200 : Dimension == 2 ? 64 : 24;
}

} // namespace RectifiedTransport

#endif
