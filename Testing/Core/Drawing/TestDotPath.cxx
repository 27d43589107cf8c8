// SPDX-License-Identifier: BSD-3-Clause
// Short paths through dots: each dot once, near the least length, and in reasonable time.
#include "Core/Drawing/DotPath.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace RectifiedTransport
{
namespace
{

double lengthOf(const std::vector<Point<2>>& points, const std::vector<std::int64_t>& path)
{
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i)
  {
    const Point<2>& a = points[static_cast<std::size_t>(path[i - 1])];
    const Point<2>& b = points[static_cast<std::size_t>(path[i])];
    length += std::hypot(a[0] - b[0], a[1] - b[1]);
  }
  return length;
}

std::vector<std::int64_t> requirePath(const std::vector<Point<2>>& points)
{
  std::vector<std::int64_t> path = shortPath(points);
  std::vector<std::int64_t> sorted = path;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(path.size(), points.size());
  for (std::size_t i = 0; i < sorted.size(); ++i)
  {
    EXPECT_EQ(sorted[i], static_cast<std::int64_t>(i));
  }
  return path;
}

std::vector<Point<2>> randomPoints(std::size_t count, double power)
{
  std::mt19937_64 random(count);
  std::uniform_real_distribution<double> between(0.0, 1.0);
  std::vector<Point<2>> points(count);
  for (Point<2>& point : points)
  {
    point = { std::pow(between(random), power), std::pow(between(random), power) };
  }
  return points;
}

// The least tour of n random points in a unit square is about .7124 sqrt(n) (1 + .33 / n) long
// (Johnson, McGeoch and Rothberg 1996).
TEST(DotPath, IsNearTheLeastOne)
{
  for (const std::size_t count : { 1000u, 5000u })
  {
    const std::vector<Point<2>> points = randomPoints(count, 1.0);
    EXPECT_LT(
      lengthOf(points, requirePath(points)), 1.12 * 0.7124 * std::sqrt(static_cast<double>(count)));
  }
}

TEST(DotPath, FollowsALine)
{
  std::vector<Point<2>> points;
  for (int i = 0; i < 101; ++i)
  {
    points.push_back({ static_cast<double>(i * 37 % 101), 5.0 });
  }
  EXPECT_EQ(lengthOf(points, requirePath(points)), 100.0);
}

// Also where most points are crowded, or at one place.
TEST(DotPath, TakesAnyPoints)
{
  const std::vector<Point<2>> crowded = randomPoints(4000, 40.0);
  EXPECT_LT(lengthOf(crowded, requirePath(crowded)), 10.0);
  std::vector<Point<2>> same(3000, { 1.0, 2.0 });
  EXPECT_EQ(lengthOf(same, requirePath(same)), 0.0);
  same.push_back({ 2.0, 2.0 });
  EXPECT_EQ(lengthOf(same, requirePath(same)), 1.0);
  for (std::size_t count = 0; count < 9; ++count)
  {
    requirePath(randomPoints(count, 1.0));
  }
}

} // namespace
} // namespace RectifiedTransport
