// SPDX-License-Identifier: BSD-3-Clause
// Simplices and boxes to grids: sums and moments, single cells against sampling, meshes without
// gaps, slabs.
#include "Core/Overlap/Overlap.h"

#include "Core/Overlap/OverlapLines.h"
#include "TestDimensions.h"

#include <Eigen/LU>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace RectifiedTransport
{
namespace
{

template <class T>
using Overlap = DimensionTest<T>;
TYPED_TEST_SUITE(Overlap, Dimensions, );

template <int D>
GridSize<D> someSize()
{
  return sizeFor<D>({ 12 }, { 12, 9 }, { 12, 9, 7 });
}

template <int D, class Piece>
std::vector<double> overlapsOf(const Piece& piece, const GridSize<D>& size, std::int64_t slabs = 1)
{
  std::vector<double> sums(static_cast<std::size_t>(numberOfCells<D>(size)), 0.0);
  for (std::int64_t s = 0; s < slabs; ++s)
  {
    const std::int64_t all = size[D - 1];
    const GridSlab<D> slab{ size, all * s / slabs, all * (s + 1) / slabs, sums.data() };
    addOverlaps<D>(piece, slab);
  }
  return sums;
}

double sumOf(const std::vector<double>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0);
}

template <int D>
LinearSimplex<D> randomSimplex(const GridSize<D>& size, double extent, std::mt19937& engine)
{
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  LinearSimplex<D> simplex;
  Point<D> corner;
  for (int a = 0; a < D; ++a)
  {
    corner[a] = unit(engine) * (1.0 - extent) * static_cast<double>(size[a]);
  }
  for (std::size_t i = 0; i <= D; ++i)
  {
    for (int a = 0; a < D; ++a)
    {
      simplex.Vertices[i][a] = corner[a] + unit(engine) * extent * static_cast<double>(size[a]);
    }
    simplex.Values[i] = unit(engine);
  }
  return simplex;
}

template <int D>
double meanOf(const LinearSimplex<D>& simplex)
{
  return std::accumulate(simplex.Values.begin(), simplex.Values.end(), 0.0) / (D + 1);
}

// The value at a point; 0 outside.
template <int D>
double valueAt(const LinearSimplex<D>& simplex, const Point<D>& x)
{
  Eigen::Matrix<double, D + 1, D + 1> system;
  Eigen::Matrix<double, D + 1, 1> right;
  for (int i = 0; i <= D; ++i)
  {
    for (int a = 0; a < D; ++a)
    {
      system(a, i) = simplex.Vertices[static_cast<std::size_t>(i)][a];
      right[a] = x[a];
    }
    system(D, i) = 1.0;
  }
  right[D] = 1.0;
  const Eigen::Matrix<double, D + 1, 1> weights = system.fullPivLu().solve(right);
  double value = 0.0;
  for (int i = 0; i <= D; ++i)
  {
    if (weights[i] < 0.0)
    {
      return 0.0;
    }
    value += weights[i] * simplex.Values[static_cast<std::size_t>(i)];
  }
  return value;
}

TYPED_TEST(Overlap, OfSimplicesIsConserved)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = someSize<D>();
  std::mt19937 engine(7);
  for (int i = 0; i < 300; ++i)
  {
    LinearSimplex<D> simplex = randomSimplex<D>(size, 0.9, engine);
    if (i % 3 == 0) // faces on the grid's own planes
    {
      simplex.Vertices[0][D - 1] = std::round(simplex.Vertices[0][D - 1]);
      simplex.Vertices[1][D - 1] = simplex.Vertices[0][D - 1];
    }
    const double expected = measureOf<D>(simplex) * meanOf<D>(simplex);
    EXPECT_NEAR(sumOf(overlapsOf<D>(simplex, size)), expected, 1e-12 * std::max(expected, 1.0));
  }
}

TYPED_TEST(Overlap, IsThatOfEachCell)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = someSize<D>();
  std::mt19937 engine(11);
  for (int i = 0; i < 6; ++i)
  {
    const LinearSimplex<D> simplex = randomSimplex<D>(size, D == 3 ? 0.5 : 0.9, engine);
    const std::vector<double> sums = overlapsOf<D>(simplex, size);
    constexpr int samples = D == 1 ? 4000 : D == 2 ? 60 : 12;
    for (std::size_t cell = 0; cell < sums.size(); ++cell)
    {
      double expected = 0.0;
      const auto count = static_cast<int>(std::lround(std::pow(samples, D)));
      for (int s = 0; s < count; ++s)
      {
        Point<D> x;
        auto restOfCell = static_cast<std::int64_t>(cell);
        int restOfSample = s;
        for (int a = 0; a < D; ++a)
        {
          x[a] =
            static_cast<double>(restOfCell % size[a]) + (restOfSample % samples + 0.5) / samples;
          restOfCell /= size[a];
          restOfSample /= samples;
        }
        expected += valueAt<D>(simplex, x) / count;
      }
      EXPECT_NEAR(sums[cell], expected, D == 1 ? 1e-3 : 0.02);
    }
  }
}

TYPED_TEST(Overlap, OfBoxIsThatOfItsFunction)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = someSize<D>();
  MultilinearBox<D> box;
  double measure = 1.0;
  for (int a = 0; a < D; ++a)
  {
    box.Low[a] = 0.3 + a;
    box.High[a] = static_cast<double>(size[a]) - 0.4 * (a + 1);
    measure *= box.High[a] - box.Low[a];
  }
  double mean = 0.0;
  for (std::size_t i = 0; i < box.Values.size(); ++i)
  {
    box.Values[i] = 1.0 + static_cast<double>(i * i);
    mean += box.Values[i] / static_cast<double>(box.Values.size());
  }
  const std::vector<double> sums = overlapsOf<D>(box, size);
  EXPECT_NEAR(sumOf(sums), measure * mean, 1e-11 * measure * mean);
  // An inner cell has the value at its centre, by interpolation along one axis after the other.
  std::vector<double> corners(box.Values.begin(), box.Values.end());
  std::size_t cell = 0;
  std::int64_t step = 1;
  for (int a = 0; a < D; ++a)
  {
    const std::int64_t index = 3;
    const double part = (3.5 - box.Low[a]) / (box.High[a] - box.Low[a]);
    std::vector<double> next;
    for (std::size_t i = 0; i < corners.size(); i += 2)
    {
      next.push_back(corners[i] + part * (corners[i + 1] - corners[i]));
    }
    corners = next;
    cell += static_cast<std::size_t>(index * step);
    step *= size[a];
  }
  EXPECT_NEAR(sums[cell], corners[0], 1e-12 * corners[0]);
}

TYPED_TEST(Overlap, HasTheSameBitsInSlabs)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = someSize<D>();
  std::mt19937 engine(3);
  for (int i = 0; i < 30; ++i)
  {
    const LinearSimplex<D> simplex = randomSimplex<D>(size, 0.1 + 0.03 * i, engine);
    EXPECT_EQ(overlapsOf<D>(simplex, size), overlapsOf<D>(simplex, size, 3));
  }
}

TYPED_TEST(Overlap, BeyondTheGridIsNotAdded)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = someSize<D>();
  MultilinearBox<D> box;
  box.Values.fill(2.0);
  box.Low.fill(-3.0);
  for (int a = 0; a < D; ++a)
  {
    box.High[a] = static_cast<double>(size[a]) + 2.5;
  }
  for (const double value : overlapsOf<D>(box, size))
  {
    EXPECT_DOUBLE_EQ(value, 2.0);
  }
  LinearSimplex<D> simplex;
  simplex.Values.fill(2.0);
  for (std::size_t i = 0; i <= D; ++i)
  {
    simplex.Vertices[i].fill(-30.0);
    if (i > 0)
    {
      simplex.Vertices[i][static_cast<int>(i) - 1] = 300.0;
    }
  }
  for (const double value : overlapsOf<D>(simplex, size))
  {
    EXPECT_NEAR(value, 2.0, 1e-10);
  }
}

// The six tetrahedra of a box that meet along a diagonal.
std::vector<LinearSimplex<3>> tetrahedraOf(const Point<3>& low, const Point<3>& high)
{
  std::vector<LinearSimplex<3>> tetrahedra;
  std::array<int, 3> order{ 0, 1, 2 };
  do
  {
    LinearSimplex<3> simplex;
    Point<3> corner = low;
    for (std::size_t i = 0; i < 4; ++i)
    {
      simplex.Vertices[i] = corner;
      simplex.Values[i] = 1.0 + corner[0] - 0.5 * corner[1] + 0.25 * corner[2];
      if (i < 3)
      {
        corner[static_cast<std::size_t>(order[i])] = high[static_cast<std::size_t>(order[i])];
      }
    }
    tetrahedra.push_back(simplex);
  } while (std::next_permutation(order.begin(), order.end()));
  return tetrahedra;
}

TEST(OverlapLines, LeaveNoGaps)
{
  const GridSize<3> size{ 24, 20, 18 };
  std::vector<double> sums(static_cast<std::size_t>(numberOfCells<3>(size)), 0.0);
  const GridSlab<3> slab{ size, 0, size[2], sums.data() };
  int wide = 0;
  // Steps at fractions of the grid's, and at its own planes.
  for (const auto& [lowZ, highZ] : { std::pair(0.0, 6.0), std::pair(6.0, 18.0) })
  {
    for (const auto& [lowX, highX] : { std::pair(0.0, 10.625), std::pair(10.625, 24.0) })
    {
      for (const LinearSimplex<3>& simplex :
        tetrahedraOf({ lowX, 0.0, lowZ }, { highX, 20.0, highZ }))
      {
        wide += isWideAlongLines(simplex) ? 1 : 0;
        addAlongLines(simplex, slab);
      }
    }
  }
  EXPECT_EQ(wide, 24);
  std::size_t cell = 0;
  for (int k = 0; k < 18; ++k)
  {
    for (int j = 0; j < 20; ++j)
    {
      for (int i = 0; i < 24; ++i, ++cell)
      {
        // The lines' offset from the middles of their shares moves the values by little.
        const double expected = 1.0 + (i + 0.5) - 0.5 * (j + 0.5) + 0.25 * (k + 0.5);
        EXPECT_NEAR(sums[cell], expected, 0.004);
      }
    }
  }
}

TEST(OverlapLines, NearlyConserveWideTetrahedra)
{
  const GridSize<3> size{ 40, 40, 40 };
  std::mt19937 engine(19);
  int wide = 0;
  double worst = 0.0;
  for (int i = 0; i < 100; ++i)
  {
    const LinearSimplex<3> simplex = randomSimplex<3>(size, 0.9, engine);
    if (isWideAlongLines(simplex))
    {
      std::vector<double> sums(static_cast<std::size_t>(numberOfCells<3>(size)), 0.0);
      addAlongLines(simplex, { size, 0, 25, sums.data() });
      addAlongLines(simplex, { size, 25, 40, sums.data() });
      const double expected = measureOf<3>(simplex) * meanOf<3>(simplex);
      worst = std::max(worst, std::abs(sumOf(sums) / expected - 1.0));
      ++wide;
    }
  }
  EXPECT_GT(wide, 80);
  EXPECT_LT(worst, 0.05);
}

} // namespace
} // namespace RectifiedTransport
