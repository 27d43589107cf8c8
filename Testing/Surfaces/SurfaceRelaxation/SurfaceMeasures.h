// SPDX-License-Identifier: BSD-3-Clause
// How evenly points are spread over a surface: distances of nearest points, and counts in patches.
#ifndef RectifiedTransport_SurfaceMeasures_h
#define RectifiedTransport_SurfaceMeasures_h

#include "Core/Geometry/Vectors.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Surfaces/Mesh/PlaceOnTriangle.h"
#include "Surfaces/Mesh/TriangleSurface.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

using Points3 = std::vector<Point<3>>;

// A density at a place of a triangle.
using DensityAt = std::function<double(std::int64_t triangle, const Point<3>& x)>;

inline Point<3> cornerOf(const TriangleSurface& surface, std::int64_t triangle, std::int64_t i)
{
  const double* x = surface.Points[surface.Triangles[3 * triangle + i]];
  return { x[0], x[1], x[2] };
}

inline double areaOf(const TriangleSurface& surface, std::int64_t triangle)
{
  Point<3> side[2];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double origin = cornerOf(surface, triangle, 0)[axis];
    side[0][axis] = cornerOf(surface, triangle, 1)[axis] - origin;
    side[1][axis] = cornerOf(surface, triangle, 2)[axis] - origin;
  }
  double squared = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::size_t y = (axis + 1) % 3;
    const std::size_t z = (axis + 2) % 3;
    const double normal = side[0][y] * side[1][z] - side[0][z] * side[1][y];
    squared += normal * normal;
  }
  return 0.5 * std::sqrt(squared);
}

inline double areaOf(const TriangleSurface& surface)
{
  double area = 0.0;
  for (std::int64_t t = 0; t < surface.NumberOfTriangles; ++t)
  {
    area += areaOf(surface, t);
  }
  return area;
}

inline Point<3> positionOf(const TriangleSurface& surface, const PlaceOnTriangle& place)
{
  Point<3> x{ 0.0, 0.0, 0.0 };
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Point<3> corner = cornerOf(surface, place.Triangle, static_cast<std::int64_t>(i));
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      x[axis] += place.Weights[i] * corner[axis];
    }
  }
  return x;
}

inline Points3 positionsOf(
  const TriangleSurface& surface, const LargeBuffer<PlaceOnTriangle>& places)
{
  Points3 points;
  for (std::int64_t i = 0; i < places.size(); ++i)
  {
    points.push_back(positionOf(surface, places.data()[i]));
  }
  return points;
}

// A k-d tree of halves, in place: the middle of a range is its root.
class NearestPoints
{
public:
  explicit NearestPoints(const Points3& points)
    : Points(points)
    , Order(points.size())
    , Axes(points.size())
  {
    std::iota(this->Order.begin(), this->Order.end(), std::size_t{ 0 });
    this->Build(0, points.size());
  }

  struct Found
  {
    std::size_t Point;
    double Squared;
  };
  // The nearest point, except one.
  Found Nearest(const Point<3>& x, std::size_t except = static_cast<std::size_t>(-1)) const
  {
    Found best{ 0, std::numeric_limits<double>::infinity() };
    this->Search(0, this->Order.size(), x, except, best);
    return best;
  }

private:
  void Build(std::size_t first, std::size_t last)
  {
    if (last - first < 2)
    {
      return;
    }
    Point<3> low = this->Points[this->Order[first]];
    Point<3> high = low;
    for (std::size_t i = first; i < last; ++i)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        low[axis] = std::min(low[axis], this->Points[this->Order[i]][axis]);
        high[axis] = std::max(high[axis], this->Points[this->Order[i]][axis]);
      }
    }
    std::size_t longest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis)
    {
      longest = high[axis] - low[axis] > high[longest] - low[longest] ? axis : longest;
    }
    const std::size_t middle = first + (last - first) / 2;
    const auto at = [this](std::size_t i) {
      return this->Order.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::nth_element(at(first), at(middle), at(last), [&](std::size_t a, std::size_t b) {
      return this->Points[a][longest] < this->Points[b][longest];
    });
    this->Axes[middle] = longest;
    this->Build(first, middle);
    this->Build(middle + 1, last);
  }

  void Search(
    std::size_t first, std::size_t last, const Point<3>& x, std::size_t except, Found& best) const
  {
    if (first == last)
    {
      return;
    }
    const std::size_t middle = first + (last - first) / 2;
    const std::size_t point = this->Order[middle];
    const double squared = squaredDistance(x, this->Points[point]);
    if (point != except && squared < best.Squared)
    {
      best = { point, squared };
    }
    const double side = x[this->Axes[middle]] - this->Points[point][this->Axes[middle]];
    const bool isLow = side < 0.0;
    this->Search(isLow ? first : middle + 1, isLow ? middle : last, x, except, best);
    if (side * side < best.Squared)
    {
      this->Search(isLow ? middle + 1 : first, isLow ? last : middle, x, except, best);
    }
  }

  const Points3& Points;
  std::vector<std::size_t> Order;
  std::vector<std::size_t> Axes;
};

struct Spacing
{
  double Mean;
  double Least;
};

// The distances of nearest points, in those of the densest lattice. `densities` are those at the
// points, times the number of all points by the mass of all; `counts` tells which points count.
template <class Counts>
Spacing spacingOf(const Points3& points, const std::vector<double>& densities, const Counts& counts)
{
  const NearestPoints tree(points);
  Spacing spacing{ 0.0, std::numeric_limits<double>::infinity() };
  double number = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (counts(i))
    {
      const double most = std::sqrt(2.0 / (std::sqrt(3.0) * densities[i]));
      const double relative = std::sqrt(tree.Nearest(points[i], i).Squared) / most;
      spacing.Mean += relative;
      spacing.Least = std::min(spacing.Least, relative);
      number += 1.0;
    }
  }
  spacing.Mean /= number;
  return spacing;
}

inline Spacing spacingOf(const TriangleSurface& surface, const Points3& points)
{
  const double density = static_cast<double>(points.size()) / areaOf(surface);
  return spacingOf(
    points, std::vector<double>(points.size(), density), [](std::size_t) { return true; });
}

// A point of a surface with the mass that it stands for.
struct MassPoint
{
  Point<3> X;
  double Mass;
};

// Triangles as the middles of congruent parts, about `count` in all, with their masses, which add
// up to 1.
inline std::vector<MassPoint> massPoints(
  const TriangleSurface& surface, double count,
  const DensityAt& density = [](std::int64_t, const Point<3>&) { return 1.0; })
{
  const double fine = areaOf(surface) / count;
  std::vector<MassPoint> points;
  double total = 0.0;
  for (std::int64_t t = 0; t < surface.NumberOfTriangles; ++t)
  {
    const double area = areaOf(surface, t);
    const auto parts = std::max<std::int64_t>(1, std::llround(std::ceil(std::sqrt(area / fine))));
    const double side = static_cast<double>(parts);
    for (std::int64_t i = 0; i < parts; ++i)
    {
      for (std::int64_t j = 0; i + j < parts; ++j)
      {
        for (int turned = 0; turned < (i + j + 1 < parts ? 2 : 1); ++turned)
        {
          const double b = (static_cast<double>(i) + (1 + turned) / 3.0) / side;
          const double c = (static_cast<double>(j) + (1 + turned) / 3.0) / side;
          const Point<3> x = positionOf(surface, { t, { 1.0 - b - c, b, c } });
          const double mass = area / (side * side) * density(t, x);
          points.push_back({ x, mass });
          total += mass;
        }
      }
    }
  }
  for (MassPoint& point : points)
  {
    point.Mass /= total;
  }
  return points;
}

// The relative L2 error of the numbers of points in patches with the mass of 64 points each: cells
// of centres that Lloyd's method has spread. A hexagonal lattice has 0.024, independent points
// 0.125.
inline double patchError(const std::vector<MassPoint>& masses, const Points3& points)
{
  const std::size_t patches = std::max<std::size_t>(8, points.size() / 64);
  std::mt19937_64 random(7);
  std::vector<double> sums;
  double sum = 0.0;
  for (const MassPoint& mass : masses)
  {
    sums.push_back(sum += mass.Mass);
  }
  Points3 samples;
  std::uniform_real_distribution<double> unit(0.0, sum);
  for (std::size_t i = 0; i < 64 * patches; ++i)
  {
    const auto at = std::lower_bound(sums.begin(), sums.end(), unit(random)) - sums.begin();
    samples.push_back(masses[std::min(static_cast<std::size_t>(at), masses.size() - 1)].X);
  }
  Points3 centres(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(patches));
  for (int iteration = 0; iteration < 10; ++iteration)
  {
    const NearestPoints tree(centres);
    std::vector<std::pair<Point<3>, double>> means(patches, { { 0.0, 0.0, 0.0 }, 0.0 });
    for (const Point<3>& sample : samples)
    {
      auto& [mean, number] = means[tree.Nearest(sample).Point];
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        mean[axis] += sample[axis];
      }
      number += 1.0;
    }
    for (std::size_t i = 0; i < patches; ++i)
    {
      for (std::size_t axis = 0; axis < 3 && means[i].second > 0.0; ++axis)
      {
        centres[i][axis] = means[i].first[axis] / means[i].second;
      }
    }
  }
  const NearestPoints tree(centres);
  std::vector<double> expected(patches, 0.0);
  std::vector<double> found(patches, 0.0);
  for (const MassPoint& mass : masses)
  {
    expected[tree.Nearest(mass.X).Point] += mass.Mass * static_cast<double>(points.size());
  }
  for (const Point<3>& point : points)
  {
    found[tree.Nearest(point).Point] += 1.0;
  }
  double error = 0.0;
  double norm = 0.0;
  for (std::size_t i = 0; i < patches; ++i)
  {
    error += (found[i] - expected[i]) * (found[i] - expected[i]);
    norm += expected[i] * expected[i];
  }
  return std::sqrt(error / norm);
}

} // namespace RectifiedTransport

#endif
