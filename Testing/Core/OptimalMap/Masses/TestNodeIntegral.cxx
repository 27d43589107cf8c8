// SPDX-License-Identifier: BSD-3-Clause
// Integrals of functions at nodes against sums over their hats' masses.
#include "Core/OptimalMap/Masses/NodeMasses.h"

#include "Core/Parallel/Progress.h"
#include "OptimalMap/Masses/ParticleMasses.h"
#include "TestDimensions.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace RectifiedTransport
{
namespace
{

template <class T>
using NodeIntegral = DimensionTest<T>;
TYPED_TEST_SUITE(NodeIntegral, Dimensions, );

template <int D>
NodeValues randomValues(const NodeGrid<D>& grid)
{
  std::mt19937_64 engine(5);
  NodeValues values(grid.NumberOfNodes());
  for (std::int64_t node = 0; node < values.size(); ++node)
  {
    values.data()[node] = uniformNumber(engine) - 0.3;
  }
  return values;
}

template <int D>
double integralOf(const CellDensity<D>& density, const CellPlacement<D>& placement,
  const NodeGrid<D>& grid, const NodeValues& values, const Executor& threads = SerialExecutor())
{
  Progress progress(threads);
  return integrateOver<D>(density, placement, grid, values.data(), progress);
}

// With cells that fill the box or a part of it, on nodes of other numbers.
TYPED_TEST(NodeIntegral, IsThatOfHats)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = sizeFor<D>({ 41 }, { 23, 14 }, { 9, 7, 12 });
  const CellDensity<D> densities[] = { cellDensity(twoGaussians<D>(size)),
    cellDensity(discWithHole<D>(size)), CellDensity<D>(size) };
  Progress progress{ Context() };
  for (const std::int64_t cells : { 2, 10, 28, 46 })
  {
    NodeGrid<D> grid{ evenSize<D>(cells), evenPoint<D>(1.0) };
    const NodeValues values = randomValues<D>(grid);
    CellPlacement<D> part = CellPlacement<D>::Filling(size, grid.Cells);
    for (int axis = 0; axis < D; ++axis)
    {
      part.Low[axis] = 0.13 * static_cast<double>(cells);
      part.Sides[axis] *= 0.7;
    }
    for (const CellDensity<D>& density : densities)
    {
      for (const CellPlacement<D>& placement :
        { CellPlacement<D>::Filling(size, grid.Cells), part })
      {
        const NodeValues hats = hatMasses<D>(density, placement, grid, progress);
        const double expected =
          std::inner_product(hats.data(), hats.data() + hats.size(), values.data(), 0.0);
        EXPECT_NEAR(integralOf<D>(density, placement, grid, values), expected, 1e-14);
      }
    }
  }
}

TYPED_TEST(NodeIntegral, HasTheSameBitsForEveryNumberOfThreads)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = sizeFor<D>({ 70000 }, { 300, 200 }, { 40, 30, 50 });
  NodeGrid<D> grid{ size, evenPoint<D>(1.0) };
  for (std::int64_t& cells : grid.Cells)
  {
    cells *= 2;
  }
  const NodeValues values = randomValues<D>(grid);
  const CellDensity<D> density = cellDensity(randomCells<D>(size));
  const auto placement = CellPlacement<D>::Filling(size, grid.Cells);
  const double expected = integralOf<D>(density, placement, grid, values);
  for (const int threads : { 2, 3, 7 })
  {
    EXPECT_EQ(integralOf<D>(density, placement, grid, values, ThreadsExecutor(threads)), expected);
  }
}

} // namespace
} // namespace RectifiedTransport
