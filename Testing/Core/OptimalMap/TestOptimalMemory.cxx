// SPDX-License-Identifier: BSD-3-Clause
// What an optimal map takes is what was foretold, whatever it is wanted for.
#include "../../Benchmarks/PeakMemory.h"
#include "../../MemoryLimit.h"
#include "TestDensities.h"
#include "TestDimensions.h"
#include "TestFlow.h"

#include "Core/OptimalMap/OptimalMap.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace RectifiedTransport
{
namespace
{

#ifdef HAS_MEMORY_LIMIT
template <class T>
using OptimalMemory = DimensionTest<T>;
TYPED_TEST_SUITE(OptimalMemory, Dimensions);

// The bytes that a map and its use take at most; 0 where the system does not tell.
template <int D>
double peakOf(const TestDensity<D>& density, const OptimalMapUse& use)
{
  const SerialExecutor serial;
  const Context context(serial);
  const auto values = density.Source();
  Points<D> samples = randomPoints<D>(density.Size, static_cast<std::size_t>(use.Samples));
  OptimalMapOptions options;
  options.MostIterations = options.LeastIterations = 1;
  useFreshMemory();
  resetPeakMemory();
  const double before = peakMemory();
  OptimalMap<D> map(DensitySource<D>(density.Size, values), evenPoint<D>(1.0), options, context);
  map.Solve(context);
  map.MassError(context); // makes the map
  if (!samples.empty())
  {
    const PointSpan<D> points(samples.front().data(), static_cast<std::int64_t>(samples.size()));
    map.Forward(FlowSeeds<D>(points).AsSamples(), points, context);
  }
  if (use.UpperBound)
  {
    map.UpperBound(context);
  }
  return before > 0.0 ? peakMemory() - before : 0.0;
}

// The formula is enough, and not much more than that, also on one thread.
TYPED_TEST(OptimalMemory, IsThatForetold)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = sizeFor<D>({ 100000 }, { 400, 300 }, { 60, 50, 40 });
  const TestDensity<D> density = discWithHole<D>(size);
  for (const OptimalMapUse& use :
    { OptimalMapUse(), OptimalMapUse{ 3e6 }, OptimalMapUse{ 0.0, false, true } })
  {
    SCOPED_TRACE(std::to_string(use.Samples) + (use.UpperBound ? ", upper bound" : ""));
    const double bytes = OptimalMap<D>::MemoryFor(size, size, {}, use);
    const double peak = peakOf<D>(density, use);
    if (peak == 0.0)
    {
      GTEST_SKIP() << "The system does not tell how much memory a process has";
    }
    constexpr double small = 2e6;
    EXPECT_LE(peak, bytes + small);
    EXPECT_GE(peak, 0.4 * bytes);
  }
}
#endif

// Samples take more than a map alone, if there are enough of them. An upper bound takes what the
// solution has released.
TEST(OptimalMapUses, TakeMemory)
{
  const GridSize<2> size{ 100, 90 };
  const double alone = OptimalMap<2>::MemoryFor(size, size);
  EXPECT_EQ(OptimalMap<2>::MemoryFor(size, size, {}, { 100.0 }), alone);
  const double many = OptimalMap<2>::MemoryFor(size, size, {}, { 1e7 });
  EXPECT_GT(many, 10.0 * alone);
  EXPECT_EQ(OptimalMap<2>::MemoryFor(size, size, {}, { 1e7, true }), many + 2e7 * sizeof(double));
  EXPECT_GE(OptimalMap<2>::MemoryFor(size, size, {}, { 0.0, false, true }), alone);
}

} // namespace
} // namespace RectifiedTransport
