// SPDX-License-Identifier: BSD-3-Clause
// The nearest cell with mass, against a search through all of them.
#include "Core/Parallel/Progress.h"
#include "Core/Tables/NearestMass.h"
#include "Core/Tables/SummedAreaTables.h"
#include "TestFlow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace RectifiedTransport
{
namespace
{

template <int Dimension>
double distanceToCell(
  const Point<Dimension>& point, const GridSize<Dimension>& cell, const Point<Dimension>& sides)
{
  double squared = 0.0;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double low = static_cast<double>(cell[axis]);
    const double gap =
      std::max({ low - point[axis], point[axis] - (low + 1.0), 0.0 }) * sides[axis];
    squared += gap * gap;
  }
  return std::sqrt(squared);
}

// One cell in `rarity` has mass.
template <int Dimension>
void expectNearest(const GridSize<Dimension>& size, int rarity,
  const Point<Dimension>& sides = evenPoint<Dimension>(1.0))
{
  TestDensity<Dimension> density = uniformDensity<Dimension>(size);
  std::mt19937_64 engine(7);
  for (double& value : density.Values)
  {
    value = uniformNumber(engine) * rarity < 1.0 ? 1.0 : 0.0;
  }
  density.Values[density.Values.size() / 3] = 1.0;
  const SerialExecutor serial;
  Progress progress(serial);
  const SummedAreaTables<Dimension> tables(density.Source(), progress);
  for (const Point<Dimension>& point : randomPoints<Dimension>(size, 200))
  {
    double least = std::numeric_limits<double>::max();
    for (std::int64_t index = 0; index < cellCount<Dimension>(size); ++index)
    {
      if (density.Values[static_cast<std::size_t>(index)] > 0.0)
      {
        least =
          std::min(least, distanceToCell<Dimension>(point, cellAt<Dimension>(index, size), sides));
      }
    }
    const Point<Dimension> moved = nearestMass<Dimension>(tables.View(), point, sides);
    EXPECT_TRUE(hasMass<Dimension>(tables.View(), moved));
    double squared = 0.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double way = (moved[axis] - point[axis]) * sides[axis];
      squared += way * way;
    }
    EXPECT_NEAR(std::sqrt(squared), least, 1e-5);
  }
}

TEST(NearestMass, OnTheLine)
{
  expectNearest<1>({ 1000 }, 100);
  expectNearest<1>({ 64 }, 1000);
}

TEST(NearestMass, InThePlane)
{
  expectNearest<2>({ 200, 30 }, 300);
  expectNearest<2>({ 65, 64 }, 100000);
}

TEST(NearestMass, InSpace)
{
  expectNearest<3>({ 70, 11, 9 }, 500);
  expectNearest<3>({ 5, 6, 130 }, 2000);
}

TEST(NearestMass, AmongCellsThatAreNotSquare)
{
  expectNearest<2>({ 90, 70 }, 400, { 1.0, 10.0 });
  expectNearest<2>({ 90, 70 }, 400, { 1.0, 0.1 });
  expectNearest<3>({ 20, 19, 18 }, 700, { 0.2, 1.0, 3.0 });
}

} // namespace
} // namespace RectifiedTransport
