// SPDX-License-Identifier: BSD-3-Clause
// Masses of triangles on a grid: against areas of triangles below lines, and each other.
#include "RecordingContext.h"
#include "Surfaces/Parameterization/MassRaster.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace RectifiedTransport
{
namespace
{

const SerialExecutor serial;

struct Triangles
{
  std::vector<Point<2>> Positions; // three a triangle
  std::vector<double> Masses;

  void Add(const Point<2>& a, const Point<2>& b, const Point<2>& c, double mass = 1.0)
  {
    this->Positions.insert(this->Positions.end(), { a, b, c });
    this->Masses.push_back(mass);
  }
};

std::vector<double> rasterized(
  const Triangles& triangles, const GridSize<2>& size, const Context& context = serial)
{
  std::vector<std::int64_t> corners(triangles.Positions.size());
  std::iota(corners.begin(), corners.end(), 0);
  std::vector<double> masses(static_cast<std::size_t>(size[0] * size[1]), -1.0);
  rasterizeMass({ triangles.Positions, corners.data(), triangles.Masses.data(),
                  static_cast<std::int64_t>(triangles.Masses.size()) },
    size, masses.data(), context);
  return masses;
}

double sum(const std::vector<double>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0);
}

void expectNear(const std::vector<double>& a, const std::vector<double>& b, double tolerance)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    ASSERT_NEAR(a[i], b[i], tolerance) << "cell " << i;
  }
}

// Twice the area by the longest side.
double widthOf(const Point<2>& a, const Point<2>& b, const Point<2>& c)
{
  const double longest = std::max({ std::hypot(b[0] - a[0], b[1] - a[1]),
    std::hypot(c[0] - a[0], c[1] - a[1]), std::hypot(c[0] - b[0], c[1] - b[1]) });
  return std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / longest;
}

// Triangles of all sizes, from that below a cell to the whole square; some corners are on lines of
// a grid or on the square's sides.
Triangles randomTriangles(int count, std::uint64_t seed, double lines, double smallest = 1e-6)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> number(0.0, 1.0);
  Triangles triangles;
  while (static_cast<int>(triangles.Masses.size()) < count)
  {
    const Point<2> centre{ number(random), number(random) };
    const double size = std::pow(smallest, number(random));
    Point<2> corners[3];
    for (Point<2>& corner : corners)
    {
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        corner[axis] = std::clamp(centre[axis] + size * (2.0 * number(random) - 1.0), 0.0, 1.0);
        corner[axis] = random() % 4 == 0 ? std::round(corner[axis] * lines) / lines : corner[axis];
      }
    }
    if (widthOf(corners[0], corners[1], corners[2]) > 1e-7)
    {
      triangles.Add(corners[0], corners[1], corners[2], number(random));
    }
  }
  return triangles;
}

// The part of a triangle where a coordinate is below x.
double partBelow(const Triangles& triangles, std::size_t t, std::size_t axis, double x)
{
  std::array<double, 3> sorted;
  for (std::size_t i = 0; i < 3; ++i)
  {
    sorted[i] = triangles.Positions[3 * t + i][axis];
  }
  std::sort(sorted.begin(), sorted.end());
  const auto [low, middle, high] = sorted;
  if (x <= low || x >= high)
  {
    return x <= low ? 0.0 : 1.0;
  }
  return x < middle ? (x - low) * (x - low) / ((middle - low) * (high - low))
                    : 1.0 - (high - x) * (high - x) / ((high - middle) * (high - low));
}

TEST(MassRaster, FewCells)
{
  Triangles lower;
  lower.Add({ 0, 0 }, { 1, 0 }, { 0, 1 }, 8.0);
  EXPECT_EQ(rasterized(lower, { 1, 1 }), (std::vector<double>{ 8 }));
  EXPECT_EQ(rasterized(lower, { 2, 2 }), (std::vector<double>{ 4, 2, 2, 0 }));
  EXPECT_EQ(rasterized(lower, { 2, 1 }), (std::vector<double>{ 6, 2 }));
  EXPECT_EQ(rasterized(lower, { 4, 1 }), (std::vector<double>{ 3.5, 2.5, 1.5, 0.5 }));
  Triangles half; // of one cell of four
  half.Add({ 0.5, 0 }, { 1, 0 }, { 1, 0.5 });
  EXPECT_EQ(rasterized(half, { 2, 2 }), (std::vector<double>{ 0, 1, 0, 0 }));
  EXPECT_EQ(rasterized(half, { 4, 2 }), (std::vector<double>{ 0, 0, 0.25, 0.75, 0, 0, 0, 0 }));
  Triangles quad;
  quad.Add({ 0.25, 0.25 }, { 0.75, 0.25 }, { 0.75, 0.75 }, 0.5);
  quad.Add({ 0.25, 0.25 }, { 0.25, 0.75 }, { 0.75, 0.75 }, 0.5);
  EXPECT_EQ(rasterized(quad, { 2, 2 }), (std::vector<double>{ 0.25, 0.25, 0.25, 0.25 }));
  EXPECT_EQ(sum(rasterized({}, { 3, 3 })), 0.0);
  // The square's half, in cells of which the diagonal has halves.
  constexpr std::int64_t n = 50;
  const std::vector<double> fine = rasterized(lower, { n, n });
  for (std::int64_t i = 0; i < n * n; ++i)
  {
    const std::int64_t above = i % n + i / n - (n - 1);
    const double cells = above < 0 ? 1.0 : above == 0 ? 0.5 : 0.0;
    ASSERT_NEAR(fine[static_cast<std::size_t>(i)], 16.0 * cells / (n * n), 1e-14);
  }
}

// The masses of all columns, and of all rows, on both sides of each line of the grid.
TEST(MassRaster, PartsBelowLines)
{
  const Triangles all = randomTriangles(400, 1, 40.0);
  for (const GridSize<2> size :
    { GridSize<2>{ 40, 40 }, GridSize<2>{ 1, 120 }, GridSize<2>{ 61, 7 }, GridSize<2>{ 16, 33 } })
  {
    for (std::size_t t = 0; t < all.Masses.size(); ++t)
    {
      Triangles one;
      one.Add(all.Positions[3 * t], all.Positions[3 * t + 1], all.Positions[3 * t + 2]);
      const std::vector<double> masses = rasterized(one, size);
      std::array<std::vector<double>, 2> sums{ std::vector<double>(size[0]),
        std::vector<double>(size[1]) };
      for (std::size_t i = 0; i < masses.size(); ++i)
      {
        ASSERT_GE(masses[i], 0.0);
        sums[0][i % size[0]] += masses[i];
        sums[1][i / size[0]] += masses[i];
      }
      const double width = widthOf(one.Positions[0], one.Positions[1], one.Positions[2]);
      const double tolerance = 1e-13 + 2e-15 / width; // rounding of coordinates
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        double below = 0.0;
        for (std::size_t i = 0; i < sums[axis].size(); ++i)
        {
          below += sums[axis][i];
          const double line = static_cast<double>(i + 1) / static_cast<double>(size[axis]);
          ASSERT_NEAR(below, partBelow(one, 0, axis, line), tolerance)
            << "triangle " << t << " of width " << width << ", axis " << axis << ", line " << i + 1;
        }
      }
    }
  }
}

// Of coordinates that are far larger than a triangle, rounding leaves less of its parts' areas.
TEST(MassRaster, CoarseCellsAreSumsOfFineOnes)
{
  for (const auto& [smallest, tolerance] :
    { std::make_pair(0.1, 1e-11), std::make_pair(1e-6, 1e-7) })
  {
    const Triangles all = randomTriangles(3000, 2, 24.0, smallest);
    const std::vector<double> fine = rasterized(all, { 72, 96 });
    EXPECT_NEAR(sum(fine), sum(all.Masses), tolerance);
    for (const GridSize<2> size : { GridSize<2>{ 24, 24 }, GridSize<2>{ 12, 48 },
           GridSize<2>{ 36, 1 }, GridSize<2>{ 1, 1 }, GridSize<2>{ 72, 32 } })
    {
      std::vector<double> sums(static_cast<std::size_t>(size[0] * size[1]), 0.0);
      for (std::int64_t i = 0; i < 72 * 96; ++i)
      {
        const std::int64_t column = i % 72 * size[0] / 72;
        const std::int64_t row = i / 72 * size[1] / 96;
        sums[static_cast<std::size_t>(row * size[0] + column)] += fine[static_cast<std::size_t>(i)];
      }
      expectNear(rasterized(all, size), sums, tolerance);
    }
  }
}

TEST(MassRaster, AxesAndTurns)
{
  const Triangles all = randomTriangles(2000, 3, 37.0);
  const GridSize<2> size{ 45, 30 };
  const std::vector<double> masses = rasterized(all, size);
  Triangles swapped = all;
  Triangles turnedOver = all;
  Triangles mirrored = all;
  for (std::size_t i = 0; i < all.Positions.size(); ++i)
  {
    std::swap(swapped.Positions[i][0], swapped.Positions[i][1]);
    mirrored.Positions[i][0] = 1.0 - mirrored.Positions[i][0];
  }
  for (std::size_t t = 0; t < all.Masses.size(); ++t)
  {
    std::swap(turnedOver.Positions[3 * t], turnedOver.Positions[3 * t + 2]);
  }
  expectNear(rasterized(turnedOver, size), masses, 1e-11);
  const std::vector<double> transposed = rasterized(swapped, { size[1], size[0] });
  const std::vector<double> reversed = rasterized(mirrored, size);
  for (std::int64_t i = 0; i < size[0]; ++i)
  {
    for (std::int64_t j = 0; j < size[1]; ++j)
    {
      const double mass = masses[static_cast<std::size_t>(j * size[0] + i)];
      ASSERT_NEAR(transposed[static_cast<std::size_t>(i * size[1] + j)], mass, 1e-9);
      ASSERT_NEAR(reversed[static_cast<std::size_t>(j * size[0] + size[0] - 1 - i)], mass, 1e-9);
    }
  }
}

// Triangles without area are points, in the cell of their centre; also on the sides of the square.
TEST(MassRaster, WithoutArea)
{
  const auto cellOf = [](const Point<2>& a, const Point<2>& b, const Point<2>& c) {
    Triangles one;
    one.Add(a, b, c, 3.0);
    const std::vector<double> masses = rasterized(one, { 5, 40 });
    EXPECT_EQ(*std::max_element(masses.begin(), masses.end()), 3.0);
    EXPECT_EQ(sum(masses), 3.0);
    return std::max_element(masses.begin(), masses.end()) - masses.begin();
  };
  EXPECT_EQ(cellOf({ 0.5, 0.5 }, { 0.5, 0.5 }, { 0.5, 0.5 }), 2 + 5 * 20);
  EXPECT_EQ(cellOf({ 0, 0 }, { 0, 0 }, { 0, 0 }), 0);
  EXPECT_EQ(cellOf({ 1, 1 }, { 1, 1 }, { 1, 1 }), 199);
  EXPECT_EQ(cellOf({ 0, 1 }, { 0.5, 1 }, { 0.25, 1 }), 1 + 5 * 39);
  EXPECT_EQ(cellOf({ 1, 0 }, { 1, 0.2 }, { 1, 0.4 }), 4 + 5 * 8);
  EXPECT_EQ(cellOf({ 0.1, 0.1 }, { 0.9, 0.9 }, { 0.7, 0.7 }), 2 + 5 * 22);
}

// As thin as doubles can tell: the mass is all there, and in cells that the triangle meets.
TEST(MassRaster, Slivers)
{
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> number(0.0, 1.0);
  for (int run = 0; run < 1500; ++run)
  {
    const Point<2> a{ number(random), number(random) };
    const Point<2> b{ number(random), number(random) };
    const double part = number(random);
    const double width = std::pow(10.0, -17.0 + 15.0 * number(random));
    const Point<2> c{ std::clamp(a[0] + part * (b[0] - a[0]) - width * (b[1] - a[1]), 0.0, 1.0),
      std::clamp(a[1] + part * (b[1] - a[1]) + width * (b[0] - a[0]), 0.0, 1.0) };
    Triangles one;
    one.Add(a, b, c);
    const std::vector<double> masses = rasterized(one, { 500, 500 });
    ASSERT_NEAR(sum(masses), 1.0, 1e-5) << "width " << width;
    ASSERT_GE(*std::min_element(masses.begin(), masses.end()), 0.0);
  }
}

TEST(MassRaster, ThreadsAndExecutors)
{
  const Triangles all = randomTriangles(5000, 4, 50.0);
  const GridSize<2> size{ 77, 101 }; // several bands, the last one not whole
  const std::vector<double> reference = rasterized(all, size);
  for (const int threads : { 1, 2, 3 })
  {
    EXPECT_EQ(rasterized(all, size, ThreadsExecutor(threads)), reference) << threads;
  }
}

TEST(MassRaster, ProgressAndCancel)
{
  const Triangles all = randomTriangles(2000, 5, 50.0);
  const GridSize<2> size{ 800, 800 };
  RecordingContext whole(serial);
  rasterized(all, size, whole.Context());
  whole.ExpectReported(0.0, 1.0);
  ASSERT_GT(whole.Queries, 1);
  for (const int maximum : { 0, whole.Queries / 2 })
  {
    RecordingContext recorder(serial);
    recorder.MaximumQueries = maximum;
    EXPECT_THROW(rasterized(all, size, recorder.Context()), Cancelled);
    EXPECT_EQ(recorder.Queries, maximum + 1);
  }
}

} // namespace
} // namespace RectifiedTransport
