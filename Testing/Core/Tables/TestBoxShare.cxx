// SPDX-License-Identifier: BSD-3-Clause
// Shares of boxes, against the sum over all cells, and boxes of shares, against shares of boxes.
#include "Core/Parallel/Progress.h"
#include "Core/Tables/BoxShare.h"
#include "Core/Tables/SummedAreaTables.h"
#include "TestFlow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{
namespace
{

template <int Dimension>
SummedAreaTables<Dimension> makeTables(const TestDensity<Dimension>& density)
{
  const SerialExecutor serial;
  Progress progress(serial);
  return SummedAreaTables<Dimension>(density.Source(), progress);
}

// The share in a box, and the measure of the part of the box in the domain.
template <int Dimension>
std::pair<double, double> sumCells(
  const TestDensity<Dimension>& density, const Point<Dimension>& low, const Point<Dimension>& high)
{
  double sum = 0.0;
  double all = 0.0;
  double measure = 0.0;
  for (std::int64_t i = 0; i < cellCount<Dimension>(density.Size); ++i)
  {
    const GridSize<Dimension> cell = cellAt<Dimension>(i, density.Size);
    double part = 1.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const auto left = static_cast<double>(cell[axis]);
      part *= std::max(std::min(high[axis], left + 1.0) - std::max(low[axis], left), 0.0);
    }
    const double value = density.Values[static_cast<std::size_t>(i)];
    sum += part * value;
    measure += part;
    all += value;
  }
  return { sum / all, measure };
}

template <int Dimension>
void expectShares(const TestDensity<Dimension>& density)
{
  const SummedAreaTables<Dimension> tables = makeTables(density);
  const Points<Dimension> a = randomPoints<Dimension>(density.Size, 100, 1);
  const Points<Dimension> b = randomPoints<Dimension>(density.Size, 100, 2);
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    Point<Dimension> low;
    Point<Dimension> high;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      low[axis] = std::min(a[i][axis], b[i][axis]) - (i % 3 == 0 ? 5.0 : 0.0);
      high[axis] = std::max(a[i][axis], b[i][axis]) + (i % 5 == 0 ? 7.0 : 0.0);
    }
    EXPECT_NEAR(boxShare<Dimension>(tables.View(), low, high),
      sumCells<Dimension>(density, low, high).first, 1e-13);
  }
}

TEST(BoxShare, AllCells)
{
  expectShares<1>(randomCells<1>({ 57 }));
  expectShares<2>(twoGaussians<2>({ 23, 31 }));
  expectShares<2>(discWithHole<2>({ 20, 20 }));
  expectShares<3>(randomCells<3>({ 9, 7, 11 }));
}

template <int Dimension>
void expectMeasures(const TestDensity<Dimension>& density, const Point<Dimension>& aspect)
{
  const SummedAreaTables<Dimension> tables = makeTables(density);
  std::mt19937_64 engine(3);
  for (const Point<Dimension>& centre : randomPoints<Dimension>(density.Size, 100))
  {
    const double h = 6.0 * uniformNumber(engine);
    Point<Dimension> low;
    Point<Dimension> high;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      low[axis] = centre[axis] - h * aspect[axis];
      high[axis] = centre[axis] + h * aspect[axis];
    }
    const auto [share, measure] = sumCells<Dimension>(density, low, high);
    if (share > 1e-6)
    {
      EXPECT_NEAR(
        measureOfShare<Dimension>(tables.View(), centre, aspect, share), measure, 1e-5 * measure);
    }
    EXPECT_EQ(measureOfShare<Dimension>(tables.View(), centre, aspect, 0.0), 0.0);
    EXPECT_NEAR(measureOfShare<Dimension>(tables.View(), centre, aspect, 1.0),
      static_cast<double>(cellCount<Dimension>(density.Size)), 1e-9);
  }
}

TEST(BoxShare, BoxesOfShares)
{
  expectMeasures<1>(randomCells<1>({ 57 }, 0.01), { 1.0 });
  expectMeasures<2>(randomCells<2>({ 23, 31 }, 0.01), { 1.0, 2.5 });
  expectMeasures<3>(randomCells<3>({ 19, 17, 11 }, 0.01), { 0.5, 1.0, 0.7 });
}

// From an empty region the box grows until it reaches mass.
TEST(BoxShare, AcrossAVoid)
{
  TestDensity<1> density = uniformDensity<1>({ 100 });
  std::fill(density.Values.begin() + 20, density.Values.end(), 0.0);
  const SummedAreaTables<1> tables = makeTables(density);
  // From 50 to the mass are 30, and half of the mass are 10 more, on one side.
  EXPECT_NEAR(measureOfShare<1>(tables.View(), { 50.0 }, { 1.0 }, 0.5), 80.0, 1e-5);
  EXPECT_NEAR(measureOfShare<1>(tables.View(), { 95.0 }, { 1.0 }, 0.5), 90.0, 1e-5);
}

} // namespace
} // namespace RectifiedTransport
