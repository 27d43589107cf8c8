// SPDX-License-Identifier: BSD-3-Clause
// Simplices and boxes to grids: sums and moments, single cells against sampling, meshes without
// gaps, flat and large ones, slabs.
#include "Core/Overlap/Overlap.h"

#include "TestDimensions.h"

#include <Eigen/LU>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
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

// A simplex from the low to the high corner of a box, along one axis after the other: those of all
// orders of the axes fill the box, with diagonals in its faces and through it.
template <int D>
LinearSimplex<D> pathSimplex(
  const Point<D>& low, const Point<D>& high, const std::array<int, D>& order)
{
  LinearSimplex<D> simplex;
  Point<D> corner = low;
  for (std::size_t i = 0; i <= D; ++i)
  {
    simplex.Vertices[i] = corner;
    if (i < D)
    {
      corner[order[i]] = high[order[i]];
    }
  }
  return simplex;
}

template <int D>
double linearAt(const Point<D>& x)
{
  double value = 9.0;
  for (int a = 0; a < D; ++a)
  {
    value += (a - 0.75) * 0.25 * x[a];
  }
  return value;
}

// Visits the simplices of boxes that share faces, some of which are planes of the grid. `mirrored`:
// the axes, as bits, along which the diagonals run downwards.
template <int D, class Visit>
void visitSimplicesOfBoxes(const GridSize<D>& size, unsigned int mirrored, const Visit& visit)
{
  std::array<double, 4> steps{ 0.0, 1.0 / 3.0, 0.5, 1.0 };
  const std::size_t boxes = D == 1 ? 3 : D == 2 ? 9 : 27;
  for (std::size_t box = 0; box < boxes; ++box)
  {
    Point<D> low;
    Point<D> high;
    std::array<int, D> order;
    std::size_t rest = box;
    for (int a = 0; a < D; ++a, rest /= 3)
    {
      order[a] = a;
      low[a] = steps[rest % 3] * static_cast<double>(size[a]);
      high[a] = steps[rest % 3 + 1] * static_cast<double>(size[a]);
      if ((mirrored >> a & 1U) != 0)
      {
        std::swap(low[a], high[a]);
      }
    }
    do
    {
      visit(pathSimplex<D>(low, high, order));
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

// Faces along each axis, and diagonals of all directions: each place is counted once.
TYPED_TEST(Overlap, OfBoxesOfSimplicesIsExactInEachCell)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = someSize<D>();
  for (unsigned int mirrored = 0; mirrored < 1U << D; ++mirrored)
  {
    for (const bool isConstant : { true, false })
    {
      std::vector<double> sums(static_cast<std::size_t>(numberOfCells<D>(size)), 0.0);
      visitSimplicesOfBoxes<D>(size, mirrored, [&](LinearSimplex<D> simplex) {
        for (std::size_t i = 0; i <= D; ++i)
        {
          simplex.Values[i] = isConstant ? 3.0 : linearAt<D>(simplex.Vertices[i]);
        }
        addOverlaps<D>(simplex, { size, 0, size[D - 1], sums.data() });
      });
      for (std::size_t cell = 0; cell < sums.size(); ++cell)
      {
        Point<D> centre;
        auto rest = static_cast<std::int64_t>(cell);
        for (int a = 0; a < D; ++a)
        {
          centre[a] = static_cast<double>(rest % size[a]) + 0.5;
          rest /= size[a];
        }
        EXPECT_NEAR(sums[cell], isConstant ? 3.0 : linearAt<D>(centre), 1e-13);
      }
    }
  }
}

// Cutting a simplex at an edge changes nothing in any cell.
TYPED_TEST(Overlap, OfHalvesIsThatOfTheSimplex)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = someSize<D>();
  std::mt19937 engine(23);
  for (int i = 0; i < 100; ++i)
  {
    const LinearSimplex<D> simplex = randomSimplex<D>(size, i % 2 == 0 ? 0.9 : 0.2, engine);
    std::array<LinearSimplex<D>, 2> halves{ simplex, simplex };
    constexpr double part = 0.375;
    Point<D> between;
    for (int a = 0; a < D; ++a)
    {
      between[a] = (1.0 - part) * simplex.Vertices[0][a] + part * simplex.Vertices[1][a];
    }
    for (std::size_t half = 0; half < 2; ++half)
    {
      halves[half].Vertices[half] = between;
      halves[half].Values[half] = (1.0 - part) * simplex.Values[0] + part * simplex.Values[1];
    }
    const std::vector<double> whole = overlapsOf<D>(simplex, size);
    const std::vector<double> first = overlapsOf<D>(halves[0], size);
    const std::vector<double> second = overlapsOf<D>(halves[1], size);
    for (std::size_t cell = 0; cell < whole.size(); ++cell)
    {
      EXPECT_NEAR(first[cell] + second[cell], whole[cell], 1e-12);
      EXPECT_EQ(whole[cell] == 0.0, first[cell] == 0.0 && second[cell] == 0.0);
    }
  }
}

// Four points in a plane up to rounding: a function between them may be as steep as 1e300.
TEST(Overlap, OfFlatTetrahedraIsBounded)
{
  const GridSize<3> size{ 12, 9, 7 };
  for (const double height : { 1e-3, 1e-9, 1e-15, 1e-200, 1e-310 })
  {
    LinearSimplex<3> simplex{
      { { { 2.5, 1.0, 1.0 }, { 2.5, 7.0, 1.5 }, { 2.5, 2.0, 6.5 }, { 2.5 + height, 4.0, 3.0 } } },
      { 1.0, 2.0, 1.0, 5.0 }
    };
    const double expected = measureOf<3>(simplex) * meanOf<3>(simplex);
    EXPECT_NEAR(sumOf(overlapsOf<3>(simplex, size)), expected, 1e-6 * expected + 1e-13);
    std::swap(simplex.Vertices[1], simplex.Vertices[3]);
    for (Point<3>& vertex : simplex.Vertices) // in another plane
    {
      vertex[0] += 0.75 * vertex[1] - 0.5 * vertex[2];
    }
    for (const double value : overlapsOf<3>(simplex, size))
    {
      EXPECT_GE(value, 0.0);
      EXPECT_LE(value, 5.0 * height + 1e-13);
    }
  }
}

// The work grows with the cells that faces cross.
TEST(Overlap, OfLargeTetrahedraIsQuick)
{
  const GridSize<3> size{ 256, 256, 256 };
  std::vector<double> sums(static_cast<std::size_t>(numberOfCells<3>(size)), 0.0);
  const std::clock_t start = std::clock();
  visitSimplicesOfBoxes<3>(size, 0, [&](LinearSimplex<3> simplex) {
    simplex.Values.fill(2.0);
    addOverlaps<3>(simplex, { size, 0, size[2], sums.data() });
  });
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  EXPECT_NEAR(sumOf(sums) / static_cast<double>(sums.size()), 2.0, 2e-12);
  EXPECT_LT(seconds, 20.0); // .3 s in an optimized build; dividing them at all cells takes minutes
}

} // namespace
} // namespace RectifiedTransport
