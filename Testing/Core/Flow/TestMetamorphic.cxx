// SPDX-License-Identifier: BSD-3-Clause
// The flow commutes with what does not change the problem: flips, permutations of axes, units of
// mass, refinement of the grid.
#include "TestFlow.h"

#include <gtest/gtest.h>

#include <utility>

namespace RectifiedTransport
{
namespace
{

// In cells. The last boxes are small, and what rounding leaves of them in sums over the whole
// domain is divided by their mass; in Adaptive it may turn a step down. Backward these boxes come
// first, and the rest of the way spreads what they leave.
double rounding(Integrator method, FlowDirection direction)
{
  const bool isMultistep = method == Integrator::Multistep;
  return method == Integrator::Adaptive                   ? 0.1
    : isMultistep && direction == FlowDirection::Backward ? 1e-3
                                                          : 1e-5;
}

// Moves cell (i0, i1, ...) of a density to where `place` says.
template <int Dimension, class F>
TestDensity<Dimension> moveCells(
  const TestDensity<Dimension>& density, const NotDeduced<GridSize<Dimension>>& size, F&& place)
{
  TestDensity<Dimension> moved{ size, std::vector<double>(density.Values.size()) };
  for (std::size_t index = 0; index < density.Values.size(); ++index)
  {
    const GridSize<Dimension> cell =
      cellAt<Dimension>(static_cast<std::int64_t>(index), density.Size);
    moved.Values[cellIndex<Dimension>(place(cell), size)] = density.Values[index];
  }
  return moved;
}

// Runs both directions on a density and on its image, and compares.
template <int Dimension, class F>
void expectCommutes(const TestDensity<Dimension>& density, const TestDensity<Dimension>& image,
  F&& mapPoint, const std::string& what)
{
  const RectifiedFlow<Dimension> flow = makeFlow(density);
  const RectifiedFlow<Dimension> imageFlow = makeFlow(image);
  const Points<Dimension> seeds = randomPoints<Dimension>(density.Size, 500);
  const auto mapAll = [&](Points<Dimension> points) {
    for (Point<Dimension>& point : points)
    {
      point = mapPoint(point);
    }
    return points;
  };
  for (const Integrator method : AllIntegrators)
  {
    const FlowOptions options = steps(32, method);
    EXPECT_LT(largestDistance<Dimension>(mapAll(runForward(flow, seeds, options)),
                runForward(imageFlow, mapAll(seeds), options)),
      rounding(method, FlowDirection::Forward))
      << what << ", forward, " << nameOf(method);
    EXPECT_LT(largestDistance<Dimension>(mapAll(runBackward(flow, seeds, options)),
                runBackward(imageFlow, mapAll(seeds), options)),
      rounding(method, FlowDirection::Backward))
      << what << ", backward, " << nameOf(method);
  }
}

template <int Dimension>
void expectFlip(const TestDensity<Dimension>& density)
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const GridSize<Dimension>& size = density.Size;
    const auto flipCell = [&](GridSize<Dimension> cell) {
      cell[axis] = size[axis] - 1 - cell[axis];
      return cell;
    };
    const auto flipPoint = [&](Point<Dimension> point) {
      point[axis] = static_cast<double>(size[axis]) - point[axis];
      return point;
    };
    expectCommutes(density, moveCells(density, size, flipCell), flipPoint,
      "flip of axis " + std::to_string(axis));
  }
}

TEST(Metamorphic, Flip)
{
  expectFlip(randomCells<1>({ 51 }, 0.1));
  expectFlip(randomCells<2>({ 37, 26 }, 0.1));
  expectFlip(randomCells<3>({ 13, 16, 9 }, 0.1));
}

// With coarse levels too, as long as their spacing divides the sides.
TEST(Metamorphic, FlipOnCoarseLevels)
{
  expectFlip(twoGaussians<2>({ 256, 128 }));
  expectFlip(twoGaussians<3>({ 64, 64, 128 }));
}

template <int Dimension>
void expectPermutation(
  const TestDensity<Dimension>& density, const NotDeduced<std::array<int, Dimension>>& to)
{
  const auto permute = [&](const auto& values) {
    auto permuted = values;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      permuted[to[axis]] = values[axis];
    }
    return permuted;
  };
  expectCommutes(
    density, moveCells(density, permute(density.Size), permute), permute, "permutation");
}

TEST(Metamorphic, AxisPermutation)
{
  expectPermutation(randomCells<2>({ 37, 26 }, 0.1), { 1, 0 });
  expectPermutation(twoGaussians<2>({ 200, 131 }), { 1, 0 });
  expectPermutation(randomCells<3>({ 13, 16, 9 }, 0.1), { 1, 2, 0 });
  expectPermutation(randomCells<3>({ 13, 16, 9 }, 0.1), { 1, 0, 2 });
  expectPermutation(twoGaussians<3>({ 70, 33, 50 }), { 2, 1, 0 });
}

template <int Dimension>
void expectScaledMass(const TestDensity<Dimension>& density)
{
  const RectifiedFlow<Dimension> flow = makeFlow(density);
  const Points<Dimension> seeds = randomPoints<Dimension>(density.Size, 500);
  for (const double factor : { 0x1p-40, 8.0, 0x1p+200, 3.0 })
  {
    TestDensity<Dimension> scaled = density;
    for (double& value : scaled.Values)
    {
      value *= factor;
    }
    const RectifiedFlow<Dimension> scaledFlow = makeFlow(scaled);
    EXPECT_NEAR(scaledFlow.Total() / (factor * flow.Total()), 1.0, 1e-14);
    for (const Integrator method : AllIntegrators)
    {
      const FlowOptions options = steps(32, method);
      const Points<Dimension> first = runForward(flow, seeds, options);
      const Points<Dimension> second = runForward(scaledFlow, seeds, options);
      const Points<Dimension> firstBack = runBackward(flow, seeds, options);
      const Points<Dimension> secondBack = runBackward(scaledFlow, seeds, options);
      if (factor == 3.0)
      {
        EXPECT_LT(
          largestDistance<Dimension>(first, second), rounding(method, FlowDirection::Backward))
          << nameOf(method);
        EXPECT_LT(largestDistance<Dimension>(firstBack, secondBack),
          rounding(method, FlowDirection::Forward))
          << nameOf(method);
      }
      else
      {
        EXPECT_TRUE(sameBits<Dimension>(first, second)) << nameOf(method) << " " << factor;
        EXPECT_TRUE(sameBits<Dimension>(firstBack, secondBack)) << nameOf(method) << " " << factor;
      }
    }
  }
}

TEST(Metamorphic, UnitOfMass)
{
  expectScaledMass(randomCells<1>({ 75 }, 0.1));
  expectScaledMass(randomCells<2>({ 37, 26 }, 0.1));
  expectScaledMass(randomCells<3>({ 13, 16, 9 }, 0.1));
}

// Every cell cut into `factors` equal ones: the same density, finer coordinates.
template <int Dimension>
void expectRefinement(const TestDensity<Dimension>& density, const GridSize<Dimension>& factors)
{
  TestDensity<Dimension> fine;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    fine.Size[axis] = density.Size[axis] * factors[axis];
  }
  fine.Values.resize(cellCount<Dimension>(fine.Size));
  for (std::size_t index = 0; index < fine.Values.size(); ++index)
  {
    GridSize<Dimension> cell = cellAt<Dimension>(static_cast<std::int64_t>(index), fine.Size);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      cell[axis] /= factors[axis];
    }
    fine.Values[index] = density.Values[cellIndex<Dimension>(cell, density.Size)];
  }
  const auto scale = [&](Point<Dimension> point) {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      point[axis] *= static_cast<double>(factors[axis]);
    }
    return point;
  };
  const RectifiedFlow<Dimension> flow = makeFlow(density);
  const RectifiedFlow<Dimension> fineFlow = makeFlow(fine);
  const Points<Dimension> seeds = randomPoints<Dimension>(density.Size, 500);
  Points<Dimension> fineSeeds = seeds;
  for (Point<Dimension>& seed : fineSeeds)
  {
    seed = scale(seed);
  }
  for (const Integrator method :
    { Integrator::Multistep, Integrator::RungeKutta4, Integrator::Euler })
  {
    const FlowOptions options = steps(32, method);
    Points<Dimension> expected = runForward(flow, seeds, options);
    Points<Dimension> expectedBack = runBackward(flow, seeds, options);
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      expected[i] = scale(expected[i]);
      expectedBack[i] = scale(expectedBack[i]);
    }
    EXPECT_LT(largestDistance<Dimension>(expected, runForward(fineFlow, fineSeeds, options)),
      rounding(method, FlowDirection::Forward))
      << nameOf(method);
    EXPECT_LT(largestDistance<Dimension>(expectedBack, runBackward(fineFlow, fineSeeds, options)),
      rounding(method, FlowDirection::Backward))
      << nameOf(method);
  }
}

TEST(Metamorphic, RefinementOfTheGrid)
{
  expectRefinement<1>(randomCells<1>({ 30 }, 0.1), { 2 });
  expectRefinement<2>(randomCells<2>({ 30, 21 }, 0.1), { 2, 2 });
  expectRefinement<3>(randomCells<3>({ 11, 15, 8 }, 0.1), { 2, 2, 2 });
}

// Coarse tables of the finer grid are the tables of the coarser one.
TEST(Metamorphic, RefinementWithCoarseLevels)
{
  expectRefinement<2>(randomCells<2>({ 160, 128 }, 0.1), { 4, 4 });
}

// Another unit of length on one axis.
TEST(Metamorphic, RefinementOfOneAxis)
{
  expectRefinement<2>(randomCells<2>({ 19, 23 }, 0.1), { 3, 1 });
  expectRefinement<3>(randomCells<3>({ 11, 15, 8 }, 0.1), { 1, 4, 1 });
}

// A grid that does not vary along an axis moves like the grid without that axis.
TEST(Metamorphic, ConstantAxis)
{
  const TestDensity<2> density = randomCells<2>({ 26, 17 }, 0.1);
  TestDensity<3> slab = uniformDensity<3>({ 26, 17, 5 });
  for (std::size_t index = 0; index < slab.Values.size(); ++index)
  {
    slab.Values[index] = density.Values[index % density.Values.size()];
  }
  const Points<3> seeds = randomPoints<3>(slab.Size, 500);
  Points<2> flatSeeds(seeds.size());
  for (std::size_t i = 0; i < seeds.size(); ++i)
  {
    flatSeeds[i] = { seeds[i][0], seeds[i][1] };
  }
  const FlowOptions options = steps(32, Integrator::RungeKutta4);
  const Points<3> positions = runForward(makeFlow(slab), seeds, options);
  const Points<2> flatPositions = runForward(makeFlow(density), flatSeeds, options);
  for (std::size_t i = 0; i < seeds.size(); ++i)
  {
    EXPECT_NEAR(
      positions[i][0], flatPositions[i][0], rounding(options.Integrator, FlowDirection::Forward));
    EXPECT_NEAR(
      positions[i][1], flatPositions[i][1], rounding(options.Integrator, FlowDirection::Forward));
  }
}

} // namespace
} // namespace RectifiedTransport
