// SPDX-License-Identifier: BSD-3-Clause
// What the tests of power diagrams share: convex polygons and their moments, computed another way.
#ifndef RectifiedTransport_TestPowerCells_h
#define RectifiedTransport_TestPowerCells_h

#include "Core/Parallel/Progress.h"
#include "Core/PowerCells/EqualMassPartition.h"
#include "Core/PowerCells/PowerDiagram.h"
#include "Core/PowerCells/RowMoments.h"

#include "TestFlow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{

inline RowMoments makeRows(const TestDensity<2>& density, const Point<2>& scale = { 1.0, 1.0 },
  double total = 1.0, const Context& context = Context())
{
  Progress progress(context);
  return RowMoments(density.Source(), scale, total, progress);
}

inline Points<2> cornersOf(const PowerDiagram::Cell& cell)
{
  Points<2> corners;
  for (std::int64_t k = 0; k < cell.Count; ++k)
  {
    corners.push_back(cell[k].X);
  }
  return corners;
}

inline PolygonMoments rowMomentsOf(const RowMoments& rows, const Points<2>& polygon)
{
  const GridSize<2> origin = rows.CellAt(polygon[0]);
  PolygonMoments moments;
  for (std::size_t k = 0; k < polygon.size(); ++k)
  {
    rows.AddSide(polygon[k], polygon[(k + 1) % polygon.size()], origin, moments);
  }
  return moments.Translated(rows.CornerOf(origin));
}

// Of the density 1, as a fan of triangles: exact by the midpoints of their sides.
inline PolygonMoments fanMoments(const Points<2>& polygon)
{
  PolygonMoments moments;
  for (std::size_t k = 2; k < polygon.size(); ++k)
  {
    const Point<2>& a = polygon[0];
    const Point<2>& b = polygon[k - 1];
    const Point<2>& c = polygon[k];
    const double area = ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2.0;
    const Points<2> middles = { { (a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0 },
      { (b[0] + c[0]) / 2.0, (b[1] + c[1]) / 2.0 }, { (c[0] + a[0]) / 2.0, (c[1] + a[1]) / 2.0 } };
    moments.Mass += area;
    for (const Point<2>& x : middles)
    {
      moments.First[0] += area / 3.0 * x[0];
      moments.First[1] += area / 3.0 * x[1];
      moments.Second += area / 3.0 * (x[0] * x[0] + x[1] * x[1]);
    }
  }
  return moments;
}

// The part of a convex polygon where normal . x <= limit.
inline Points<2> clipped(const Points<2>& polygon, const Point<2>& normal, double limit)
{
  Points<2> kept;
  const auto excess = [&](
                        const Point<2>& x) { return normal[0] * x[0] + normal[1] * x[1] - limit; };
  for (std::size_t k = 0; k < polygon.size(); ++k)
  {
    const Point<2>& a = polygon[k];
    const Point<2>& b = polygon[(k + 1) % polygon.size()];
    const double ea = excess(a);
    const double eb = excess(b);
    if (ea <= 0.0)
    {
      kept.push_back(a);
    }
    if ((ea < 0.0 && eb > 0.0) || (ea > 0.0 && eb < 0.0))
    {
      const double t = ea / (ea - eb);
      kept.push_back({ a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]) });
    }
  }
  return kept;
}

// The moments of a density over a convex polygon, cell by cell of its grid.
inline PolygonMoments clippedMoments(
  const TestDensity<2>& density, const Point<2>& scale, double total, const Points<2>& polygon)
{
  double all = 0.0;
  for (const double value : density.Values)
  {
    all += value;
  }
  PolygonMoments moments;
  for (std::size_t i = 0; i < density.Values.size(); ++i)
  {
    const auto cell = cellAt<2>(static_cast<std::int64_t>(i), density.Size);
    const double x = static_cast<double>(cell[0]);
    const double y = static_cast<double>(cell[1]);
    Points<2> part = clipped(polygon, { 1.0, 0.0 }, (x + 1.0) * scale[0]);
    part = clipped(part, { -1.0, 0.0 }, -x * scale[0]);
    part = clipped(part, { 0.0, 1.0 }, (y + 1.0) * scale[1]);
    part = clipped(part, { 0.0, -1.0 }, -y * scale[1]);
    const PolygonMoments found = fanMoments(part);
    const double weight = density.Values[i] * total / all / (scale[0] * scale[1]);
    moments.Mass += weight * found.Mass;
    moments.First[0] += weight * found.First[0];
    moments.First[1] += weight * found.First[1];
    moments.Second += weight * found.Second;
  }
  return moments;
}

// The same by the cells of the grid from `first` on, as many as `size`, relative to their corner:
// polygons there keep their digits, however large the grid is.
inline PolygonMoments windowMoments(const TestDensity<2>& density, const Point<2>& scale,
  double total, const GridSize<2>& first, const GridSize<2>& size, Points<2> polygon)
{
  TestDensity<2> window = uniformDensity<2>(size);
  long double inside = 0.0;
  long double all = 0.0;
  for (std::size_t i = 0; i < window.Values.size(); ++i)
  {
    const auto cell = cellAt<2>(static_cast<std::int64_t>(i), size);
    window.Values[i] =
      density.Values[cellIndex<2>({ first[0] + cell[0], first[1] + cell[1] }, density.Size)];
    inside += window.Values[i];
  }
  for (const double value : density.Values)
  {
    all += value;
  }
  for (Point<2>& corner : polygon)
  {
    corner[0] -= static_cast<double>(first[0]) * scale[0];
    corner[1] -= static_cast<double>(first[1]) * scale[1];
  }
  return clippedMoments(window, scale, static_cast<double>(total * inside / all), polygon);
}

inline void expectMoments(
  const PolygonMoments& found, const PolygonMoments& expected, double tolerance)
{
  EXPECT_NEAR(found.Mass, expected.Mass, tolerance);
  EXPECT_NEAR(found.First[0], expected.First[0], tolerance);
  EXPECT_NEAR(found.First[1], expected.First[1], tolerance);
  EXPECT_NEAR(found.Second, expected.Second, tolerance);
}

// The integral of |x - site|^2 over what has these moments.
inline double costOf(const PolygonMoments& moments, const Point<2>& site)
{
  return moments.Second - 2.0 * (site[0] * moments.First[0] + site[1] * moments.First[1]) +
    (site[0] * site[0] + site[1] * site[1]) * moments.Mass;
}

inline Points<2> scaled(Points<2> points, const Point<2>& scale)
{
  for (Point<2>& point : points)
  {
    point = { point[0] * scale[0], point[1] * scale[1] };
  }
  return points;
}

// As of a photograph: a dim ground, soft and small bright spots.
inline TestDensity<2> spots(const GridSize<2>& size)
{
  return sampleDensity<2>(size, [](const Point<2>& p) {
    const auto spot = [&p](double x, double y, double s) {
      return std::exp(-((p[0] - x) * (p[0] - x) + (p[1] - y) * (p[1] - y)) / (2.0 * s * s));
    };
    return 0.01 + 0.4 * spot(0.3, 0.35, 0.2) + spot(0.7, 0.6, 0.08) + 3.0 * spot(0.55, 0.2, 0.02) +
      0.8 * spot(0.2, 0.8, 0.05);
  });
}

inline bool solve(
  EqualMassPartition& partition, const Points<2>& sites, const Context& context = Context())
{
  Progress progress(context);
  return partition.Solve(sites, progress);
}

inline EqualMassPartition makePartition(const TestDensity<2>& density, std::size_t sites,
  const Point<2>& scale = { 1.0, 1.0 }, const Context& context = Context())
{
  const auto count = static_cast<std::int64_t>(sites);
  return { makeRows(density, scale, static_cast<double>(count), context), count };
}

inline EqualMassPartition solved(const TestDensity<2>& density, const Points<2>& sites,
  const Point<2>& scale = { 1.0, 1.0 }, const Context& context = Context())
{
  EqualMassPartition partition = makePartition(density, sites.size(), scale, context);
  EXPECT_TRUE(solve(partition, sites, context));
  return partition;
}

} // namespace RectifiedTransport

#endif
