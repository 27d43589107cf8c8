// SPDX-License-Identifier: BSD-3-Clause
// Densities on other grids: values to the bit on their own one, overlaps as those of boxes, mass,
// parts, threads.
#include "Core/Tables/CellMeans.h"

#include "Core/Overlap/Overlap.h"
#include "Core/Parallel/Progress.h"
#include "TestDimensions.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace RectifiedTransport
{
namespace
{

template <class T>
using Means = DimensionTest<T>;
TYPED_TEST_SUITE(Means, Dimensions, );

template <int D>
GridSize<D> densitySize()
{
  return sizeFor<D>({ 11 }, { 11, 7 }, { 11, 7, 5 });
}

std::vector<double> randomValues(double count)
{
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<double> values(static_cast<std::size_t>(count));
  std::generate(values.begin(), values.end(), [&]() { return unit(engine); });
  return values;
}

template <int D>
std::vector<double> meansOf(const std::vector<double>& values, const PlacedCells<D>& placed,
  const GridSize<D>& size, const LatticePart<D>& part, const Executor& executor)
{
  const DensityArray<D, double> density(values.data(), placed.Size);
  std::vector<double> means(static_cast<std::size_t>(part.Count()), -1.0);
  Progress progress{ Context(executor) };
  CellMeans<D>(placed, size, part).Write(density, progress, means.data());
  return means;
}

template <int D>
std::vector<double> meansOf(
  const std::vector<double>& values, const PlacedCells<D>& placed, const GridSize<D>& size)
{
  return meansOf<D>(values, placed, size, LatticePart<D>::WholeOf(size), SerialExecutor());
}

// Coarser along one axis and finer along the others, at a place of no whole number of cells.
template <int D>
PlacedCells<D> placedCells()
{
  PlacedCells<D> placed{ densitySize<D>(), {}, {} };
  for (int axis = 0; axis < D; ++axis)
  {
    placed.Low[axis] = 1.3 + 0.4 * axis;
    placed.Sides[axis] = axis == 0 ? 0.37 : 2.3;
  }
  return placed;
}

template <int D>
GridSize<D> gridSize()
{
  return sizeFor<D>({ 6 }, { 6, 19 }, { 6, 19, 14 });
}

TYPED_TEST(Means, AreTheValuesOnTheSameCells)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = densitySize<D>();
  PlacedCells<D> placed{ size, {}, {} };
  placed.Sides.fill(1.0);
  const std::vector<double> values = randomValues(numberOfCells<D>(size));
  EXPECT_EQ(meansOf<D>(values, placed, size), values);
}

TYPED_TEST(Means, AreTheOverlapsOfBoxes)
{
  constexpr int D = TypeParam::value;
  const PlacedCells<D> placed = placedCells<D>();
  const GridSize<D> size = gridSize<D>();
  const auto cells = LatticePart<D>::WholeOf(placed.Size);
  const std::vector<double> values = randomValues(static_cast<double>(cells.Count()));
  std::vector<double> sums(static_cast<std::size_t>(numberOfCells<D>(size)), 0.0);
  for (std::int64_t i = 0; i < cells.Count(); ++i)
  {
    MultilinearBox<D> box;
    box.Values.fill(values[static_cast<std::size_t>(i)]);
    const GridSize<D> cell = cells.CellOf(i);
    for (int axis = 0; axis < D; ++axis)
    {
      box.Low[axis] = placed.Low[axis] + placed.Sides[axis] * static_cast<double>(cell[axis]);
      box.High[axis] = box.Low[axis] + placed.Sides[axis];
    }
    addOverlaps<D>(box, { size, 0, size[D - 1], sums.data() });
  }
  const std::vector<double> means = meansOf<D>(values, placed, size);
  for (std::size_t i = 0; i < sums.size(); ++i)
  {
    EXPECT_NEAR(means[i], sums[i], 1e-12) << i;
  }
}

// Ends beyond the border by rounding belong to the cells at the border.
TYPED_TEST(Means, KeepTheMass)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = gridSize<D>();
  PlacedCells<D> placed{ densitySize<D>(), {}, {} };
  double measure = 1.0;
  for (int axis = 0; axis < D; ++axis)
  {
    const auto whole = static_cast<double>(size[axis]);
    placed.Low[axis] = -1e-3;
    placed.Sides[axis] = (whole + 2e-3) / static_cast<double>(placed.Size[axis]);
    measure *= placed.Sides[axis];
  }
  const std::vector<double> values = randomValues(numberOfCells<D>(placed.Size));
  const std::vector<double> means = meansOf<D>(values, placed, size);
  const double mass = measure * std::accumulate(values.begin(), values.end(), 0.0);
  EXPECT_NEAR(std::accumulate(means.begin(), means.end(), 0.0), mass, 1e-12 * mass);
}

TYPED_TEST(Means, HaveTheSameBitsInPartsAndOnThreads)
{
  constexpr int D = TypeParam::value;
  const PlacedCells<D> placed = placedCells<D>();
  const GridSize<D> size = gridSize<D>();
  const auto all = LatticePart<D>::WholeOf(size);
  const std::vector<double> values = randomValues(numberOfCells<D>(placed.Size));
  const std::vector<double> means = meansOf<D>(values, placed, size);
  EXPECT_EQ(meansOf<D>(values, placed, size, all, ThreadsExecutor(3)), means);
  LatticePart<D> part = all;
  for (int axis = 0; axis < D; ++axis)
  {
    part.Low[axis] = 2;
    part.Cells[axis] = 3;
  }
  const std::vector<double> inside = meansOf<D>(values, placed, size, part, SerialExecutor());
  for (std::int64_t i = 0; i < part.Count(); ++i)
  {
    EXPECT_EQ(inside[static_cast<std::size_t>(i)],
      means[static_cast<std::size_t>(all.NumberOf(part.CellOf(i)))]);
  }
  // It says which cells it reads.
  const CellMeans<D> what(placed, size, part);
  const auto read = LatticePart<D>::WholeOf(placed.Size);
  std::vector<double> others = values;
  for (std::int64_t i = 0; i < read.Count(); ++i)
  {
    const GridSize<D> cell = read.CellOf(i);
    bool isRead = true;
    for (int axis = 0; axis < D; ++axis)
    {
      isRead = isRead && cell[axis] >= what.Low()[axis] && cell[axis] < what.High()[axis];
    }
    others[static_cast<std::size_t>(i)] = isRead ? others[static_cast<std::size_t>(i)] : 7.0;
  }
  EXPECT_EQ(meansOf<D>(others, placed, size, part, SerialExecutor()), inside);
}

TYPED_TEST(Means, AreZeroOutside)
{
  constexpr int D = TypeParam::value;
  PlacedCells<D> placed = placedCells<D>();
  placed.Sides.fill(0.1);
  const GridSize<D> size = gridSize<D>();
  LatticePart<D> part;
  part.Low.fill(4);
  part.Cells.fill(2);
  const std::vector<double> values(static_cast<std::size_t>(numberOfCells<D>(placed.Size)), 1.0);
  for (const double mean : meansOf<D>(values, placed, size, part, SerialExecutor()))
  {
    EXPECT_EQ(mean, 0.0);
  }
  part.Cells.fill(0);
  EXPECT_TRUE(meansOf<D>(values, placed, size, part, SerialExecutor()).empty());
}

} // namespace
} // namespace RectifiedTransport
