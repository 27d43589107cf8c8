// SPDX-License-Identifier: BSD-3-Clause
// The flow of a lattice: its order is complete and compact, its results are those of any order, and
// each direction by itself agrees with the oracle.
#include "Core/Flow/Particles/LatticeOrder.h"
#include "TestFlow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace RectifiedTransport
{
namespace
{

template <int Dimension>
Points<Dimension> runLattice(const RectifiedFlow<Dimension>& flow,
  const NotDeduced<GridSize<Dimension>>& lattice, bool backward, const FlowOptions& options = {},
  const Context& context = Context())
{
  Points<Dimension> positions(cellCount<Dimension>(lattice));
  backward ? flow.Backward(FlowSeeds<Dimension>::Lattice(lattice), positions, options, context)
           : flow.Forward(FlowSeeds<Dimension>::Lattice(lattice), positions, options, context);
  return positions;
}

// Every sample once, with its coordinates, however the ranges are cut.
template <int Dimension>
void expectComplete(const GridSize<Dimension>& lattice, const GridSize<Dimension>& size)
{
  const LatticeOrder<Dimension> order(lattice, size);
  const std::int64_t count = cellCount<Dimension>(lattice);
  ASSERT_EQ(order.Count(), count);
  const Points<Dimension> wanted = latticePoints<Dimension>(size, lattice);
  for (const std::int64_t grain : { 64, 1000, 7 })
  {
    std::vector<int> seen(count, 0);
    std::vector<std::int64_t> index(grain);
    Points<Dimension> points(grain);
    for (std::int64_t first = 0; first < count; first += grain)
    {
      const int taken = static_cast<int>(std::min(grain, count - first));
      order.Fill(first, taken, index.data(), points.data()->data());
      for (int i = 0; i < taken; ++i)
      {
        ASSERT_TRUE(index[i] >= 0 && index[i] < count);
        ++seen[index[i]];
        ASSERT_EQ(points[i], wanted[index[i]]);
      }
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), count);
  }
}

// The numbers of a row of cells, in their order, in as few boxes as may be.
template <int Dimension>
void expectParts(const GridSize<Dimension>& lattice)
{
  const auto whole = LatticePart<Dimension>::WholeOf(lattice);
  const std::int64_t all = cellCount<Dimension>(lattice);
  for (std::int64_t first = 0; first <= all; ++first)
  {
    for (std::int64_t count = 0; first + count <= all; ++count)
    {
      const auto parts = partsOf<Dimension>(lattice, first, count);
      ASSERT_LE(parts.size(), 2U * Dimension - 1U);
      std::int64_t number = first;
      for (const LatticePart<Dimension>& part : parts)
      {
        for (std::int64_t i = 0; i < part.Count(); ++i, ++number)
        {
          ASSERT_EQ(whole.NumberOf(part.CellOf(i)), number);
        }
      }
      ASSERT_EQ(number, first + count);
    }
  }
  ASSERT_EQ(partsOf<Dimension>(lattice, 0, all).size(), 1U);
}

TEST(Lattice, PartsOfNumbers)
{
  expectParts<1>({ 9 });
  expectParts<2>({ 5, 6 });
  expectParts<2>({ 1, 6 });
  expectParts<2>({ 6, 1 });
  expectParts<3>({ 4, 3, 5 });
  expectParts<3>({ 4, 1, 5 });
}

TEST(Lattice, OrderIsComplete)
{
  expectComplete<1>({ 5000 }, { 300 });
  expectComplete<1>({ 1 }, { 300 });
  expectComplete<2>({ 70, 45 }, { 70, 45 });
  expectComplete<2>({ 1, 200 }, { 40, 10 });
  expectComplete<2>({ 131, 67 }, { 40, 90 });
  expectComplete<3>({ 19, 34, 5 }, { 19, 34, 5 });
  expectComplete<3>({ 1, 1, 1 }, { 3, 4, 5 });
  expectComplete<3>({ 33, 1, 17 }, { 8, 9, 10 });
}

// A block of particles is a cube, where the border does not cut it.
TEST(Lattice, BlocksAreCompact)
{
  const LatticeOrder<3> order({ 32, 16, 48 }, { 32, 16, 48 });
  std::int64_t index[64];
  Points<3> points(64);
  for (std::int64_t first = 0; first < order.Count(); first += 64)
  {
    order.Fill(first, 64, index, points.data()->data());
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto range = std::minmax_element(points.begin(), points.end(),
        [axis](const Point<3>& a, const Point<3>& b) { return a[axis] < b[axis]; });
      ASSERT_EQ((*range.second)[axis] - (*range.first)[axis], 3.0);
    }
  }
}

template <int Dimension>
void expectSameBits(const TestDensity<Dimension>& density, const GridSize<Dimension>& lattice)
{
  const RectifiedFlow<Dimension> flow = makeFlow(density);
  const Points<Dimension> points = latticePoints<Dimension>(density.Size, lattice);
  const SerialExecutor serial;
  for (const Integrator method : AllIntegrators)
  {
    const FlowOptions options = steps(16, method);
    const Points<Dimension> forth = runLattice(flow, lattice, false, options);
    const Points<Dimension> back = runLattice(flow, lattice, true, options);
    EXPECT_TRUE(sameBits<Dimension>(forth, runForward(flow, points, options))) << nameOf(method);
    EXPECT_TRUE(sameBits<Dimension>(back, runBackward(flow, points, options))) << nameOf(method);
    EXPECT_TRUE(sameBits<Dimension>(forth, runLattice(flow, lattice, false, options, serial)));
    EXPECT_TRUE(sameBits<Dimension>(back, runLattice(flow, lattice, true, options, serial)));
  }
}

TEST(Lattice, SameBitsAsAnyOrder)
{
  expectSameBits<1>(twoGaussians<1>({ 300 }), { 300 });
  expectSameBits<2>(twoGaussians<2>({ 90, 70 }), { 90, 70 });
  expectSameBits<2>(discWithHole<2>({ 64, 64 }), { 33, 150 });
  expectSameBits<3>(twoGaussians<3>({ 22, 18, 25 }), { 22, 18, 25 });
  expectSameBits<3>(discWithHole<3>({ 16, 20, 12 }), { 31, 7, 12 });
}

// A round trip would hide an error that both directions share.
template <int Dimension>
void expectOracle(
  const TestDensity<Dimension>& density, const GridSize<Dimension>& lattice, double error)
{
  const RectifiedFlow<Dimension> flow = makeFlow(density);
  const Oracle<Dimension> oracle(density.Values, density.Size);
  const Points<Dimension> points = latticePoints<Dimension>(density.Size, lattice);
  for (const bool backward : { false, true })
  {
    const Points<Dimension> truth = backward ? oracle.Backward(points) : oracle.Forward(points);
    const double coarse =
      comparePositions<Dimension>(runLattice(flow, lattice, backward, steps(32)), truth).Mean;
    EXPECT_LT(coarse, error) << (backward ? "backward" : "forward");
    EXPECT_LT(
      comparePositions<Dimension>(runLattice(flow, lattice, backward, steps(128)), truth).Mean,
      coarse / 4.0)
      << (backward ? "backward" : "forward");
  }
}

TEST(Lattice, Oracle)
{
  expectOracle<1>(twoGaussians<1>({ 300 }), { 300 }, 0.3);
  expectOracle<2>(twoGaussians<2>({ 96, 80 }), { 24, 20 }, 0.3);
  expectOracle<3>(twoGaussians<3>({ 40, 33, 36 }), { 8, 7, 6 }, 0.1);
}

TEST(Lattice, WrongSizes)
{
  const RectifiedFlow<2> flow = makeFlow(twoGaussians<2>({ 9, 8 }));
  double nothing = 0.0;
  for (const std::int64_t cells :
    { std::int64_t{ 0 }, std::int64_t{ -4 }, std::int64_t{ 1 } << 31 })
  {
    const PointSpan<2> positions(&nothing, 4 * cells);
    EXPECT_THROW(
      flow.Forward(FlowSeeds<2>::Lattice({ 4, cells }), positions), std::invalid_argument);
    EXPECT_THROW(
      flow.Backward(FlowSeeds<2>::Lattice({ cells, 4 }), positions), std::invalid_argument);
  }
}

TEST(Lattice, Cancel)
{
  const RectifiedFlow<2> flow = makeFlow(twoGaussians<2>({ 200, 200 }));
  Points<2> positions(40000);
  double last = 0.0;
  const SerialExecutor serial;
  const Context cancelled(
    serial, [&last](double progress) { last = progress; }, []() { return true; });
  EXPECT_THROW(
    flow.Forward(FlowSeeds<2>::Lattice({ 200, 200 }), positions, {}, cancelled), Cancelled);
  EXPECT_LT(last, 0.9);
  last = 0.0;
  EXPECT_THROW(
    flow.Backward(FlowSeeds<2>::Lattice({ 200, 200 }), positions, {}, cancelled), Cancelled);
  EXPECT_LT(last, 0.9);
}

// Mass of boxes, cell by cell.
template <int Dimension>
void expectShare(const GridSize<Dimension>& size)
{
  const TestDensity<Dimension> density = randomCells<Dimension>(size);
  const RectifiedFlow<Dimension> flow = makeFlow(density);
  const Points<Dimension> ends = randomPoints<Dimension>(size, 60);
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2)
  {
    Point<Dimension> low;
    Point<Dimension> high;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      low[axis] = std::min(ends[i][axis], ends[i + 1][axis]);
      high[axis] = std::max(ends[i][axis], ends[i + 1][axis]);
    }
    double sum = 0.0;
    double all = 0.0;
    for (std::size_t index = 0; index < density.Values.size(); ++index)
    {
      const GridSize<Dimension> cell = cellAt<Dimension>(static_cast<std::int64_t>(index), size);
      double part = density.Values[index];
      all += part;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        const auto at = static_cast<double>(cell[axis]);
        part *= std::max(0.0, std::min(high[axis], at + 1.0) - std::max(low[axis], at));
      }
      sum += part;
    }
    EXPECT_NEAR(flow.Share(low, high), sum / all, 1e-13);
  }
  const auto below = evenPoint<Dimension>(-3.0);
  const auto above = evenPoint<Dimension>(1e9);
  EXPECT_NEAR(flow.Share(below, above), 1.0, 1e-15);
  EXPECT_EQ(flow.Share(below, below), 0.0);
  EXPECT_EQ(flow.Share(above, above), 0.0);
}

TEST(Lattice, ShareOfABox)
{
  expectShare<1>({ 40 });
  expectShare<2>({ 13, 17 });
  expectShare<3>({ 7, 9, 6 });
}

} // namespace
} // namespace RectifiedTransport
