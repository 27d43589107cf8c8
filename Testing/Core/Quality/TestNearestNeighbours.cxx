// SPDX-License-Identifier: BSD-3-Clause
// Distances of nearest neighbours, against a search through all pairs.
#include "Core/Quality/NearestNeighbours.h"

#include "TestFlow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace RectifiedTransport
{
namespace
{

std::vector<double> distancesOf(
  const Points<3>& points, const Executor& executor = SerialExecutor())
{
  std::vector<double> distances(points.size());
  nearestDistances(points, distances.data(), executor);
  return distances;
}

void expectSearched(const Points<3>& points)
{
  const std::vector<double> found = distancesOf(points);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < points.size(); ++j)
    {
      double squared = 0.0;
      for (int r = 0; r < 3; ++r)
      {
        squared += (points[j][r] - points[i][r]) * (points[j][r] - points[i][r]);
      }
      least = i == j ? least : std::min(least, squared);
    }
    ASSERT_EQ(found[i], std::sqrt(least)) << i;
  }
}

TEST(NearestNeighbours, Random)
{
  expectSearched(randomPoints<3>({ 10, 20, 5 }, 1500));
}

TEST(NearestNeighbours, InAPlaneOnALineAndInClusters)
{
  Points<3> points = randomPoints<3>({ 10, 20, 5 }, 1200);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    Point<3>& point = points[i];
    point[2] = i < 400 ? 1.0 : point[2];
    point[1] = i < 200 ? 2.0 : point[1];
    if (i >= 800)
    {
      const double cluster = static_cast<double>(i % 3);
      point = { cluster + 1e-9 * point[0], 1e-9 * point[1], 0.0 };
    }
  }
  expectSearched(points);
}

TEST(NearestNeighbours, SamePlaces)
{
  Points<3> points(300, Point<3>{ 1.0, 2.0, 3.0 });
  points.push_back({ 4.0, 2.0, 3.0 });
  for (int i = 0; i < 200; ++i)
  {
    points.push_back({ static_cast<double>(i % 7), 0.0, 0.0 });
  }
  expectSearched(points);
  // All in one place is no more work.
  const Points<3> zeros(333333, Point<3>{});
  std::vector<double> distances(zeros.size());
  nearestDistances(zeros, distances.data(), SerialExecutor());
  EXPECT_EQ(*std::max_element(distances.begin(), distances.end()), 0.0);
}

// Where most points lie on the lowest face of their box a pivot between them has nothing below it.
// They must be divided all the same: a search through all pairs of so many does not end.
TEST(NearestNeighbours, MostOnTheLowestFace)
{
  constexpr std::size_t onFace = 600000;
  Points<3> points = randomPoints<3>({ 10, 1, 1 }, 620000);
  for (std::size_t i = 0; i < onFace; ++i)
  {
    points[i][0] = 0.0;
  }
  const std::vector<double> found = distancesOf(points);
  // A disc as large as 30 points' share of the face is empty with a chance of e^-30.
  EXPECT_LT(*std::max_element(found.begin(), found.begin() + onFace),
    std::sqrt(30.0 * 4.0 / 3.14 / static_cast<double>(onFace)));
  points.resize(1000);
  points.insert(points.end(), 100, Point<3>{ 5.0, 0.5, 0.5 });
  expectSearched(points);
}

TEST(NearestNeighbours, OneAndTwo)
{
  EXPECT_EQ(distancesOf({ { 1.0, 2.0, 3.0 } })[0], std::numeric_limits<double>::infinity());
  EXPECT_EQ(distancesOf({ { 1.0, 2.0, 3.0 }, { 1.0, 2.0, 8.0 } })[0], 5.0);
}

TEST(NearestNeighbours, ExecutorsAndContext)
{
  const Points<3> points = randomPoints<3>({ 10, 20, 5 }, 100000);
  EXPECT_EQ(distancesOf(points), distancesOf(points, OpenMPExecutor()));
  std::vector<double> distances(points.size());
  std::vector<double> reported;
  const OpenMPExecutor threads;
  Context context(threads, [&](double fraction) { reported.push_back(fraction); });
  nearestDistances(points, distances.data(), context);
  EXPECT_GT(reported.size(), 3u);
  EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end()));
  EXPECT_LT(reported.front(), 0.02); // the first halvings of the tree report, too
  EXPECT_EQ(reported.back(), 1.0);
  context.IsCancelled = []() { return true; };
  EXPECT_THROW(nearestDistances(points, distances.data(), context), Cancelled);
}

} // namespace
} // namespace RectifiedTransport
