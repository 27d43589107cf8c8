// SPDX-License-Identifier: BSD-3-Clause
// The particles of the pivot: exactly as many in each cell, spread evenly, and moved as any others.
#include "Core/Flow/Particles/LatticeOrder.h"
#include "Core/Flow/PivotLattice.h"
#include "FlowMapShapes.h"
#include "TestFlow.h"
#include "TestRefusal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{
namespace
{

// The points that samples have on a box, place by place.
template <int Dimension>
Points<Dimension> pointsOf(const PivotLattice<Dimension>& samples, const GridSize<Dimension>& size)
{
  const auto each = static_cast<std::size_t>(cellCount<Dimension>(samples.Lattice));
  Points<Dimension> all(each * samples.Places.size());
  std::vector<std::int64_t> index(each);
  Points<Dimension> points(each);
  for (std::size_t place = 0; place < samples.Places.size(); ++place)
  {
    const LatticeOrder<Dimension> order(samples.Lattice, size, samples.Places[place]);
    order.Fill(0, static_cast<int>(each), index.data(), points.data()->data());
    for (std::size_t i = 0; i < each; ++i)
    {
      all[place * each + static_cast<std::size_t>(index[i])] = points[i];
    }
  }
  return all;
}

template <int Dimension>
std::int64_t power(std::int64_t base)
{
  std::int64_t product = base;
  for (int axis = 1; axis < Dimension; ++axis)
  {
    product *= base;
  }
  return product;
}

template <int Dimension>
bool isPower(std::int64_t value)
{
  std::int64_t base = 1;
  while (power<Dimension>(base) < value)
  {
    ++base;
  }
  return power<Dimension>(base) == value;
}

// The box is not as large as the grid, as where the domains of two densities differ.
template <int Dimension>
void expectAsManyInEachCell(const GridSize<Dimension>& grid, const GridSize<Dimension>& size)
{
  for (std::int64_t perCell = 1; perCell <= 20; ++perCell)
  {
    const PivotLattice<Dimension> samples = pivotLattice<Dimension>(grid, perCell);
    const Points<Dimension> points = pointsOf<Dimension>(samples, size);
    ASSERT_EQ(static_cast<std::int64_t>(points.size()), perCell * cellCount<Dimension>(grid));
    std::vector<std::int64_t> counts(static_cast<std::size_t>(cellCount<Dimension>(grid)), 0);
    for (const Point<Dimension>& point : points)
    {
      GridSize<Dimension> cell;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        ASSERT_TRUE(point[axis] > 0.0 && point[axis] < static_cast<double>(size[axis]));
        cell[axis] = static_cast<std::int64_t>(
          point[axis] * static_cast<double>(grid[axis]) / static_cast<double>(size[axis]));
      }
      ++counts.at(static_cast<std::size_t>(cellIndex<Dimension>(cell, grid)));
    }
    EXPECT_EQ(std::count(counts.begin(), counts.end(), perCell), cellCount<Dimension>(grid))
      << perCell << " a cell";
  }
}

TEST(PivotLattice, AsManyInEachCell)
{
  expectAsManyInEachCell<1>({ 7 }, { 7 });
  expectAsManyInEachCell<1>({ 7 }, { 30 });
  expectAsManyInEachCell<2>({ 5, 4 }, { 5, 4 });
  expectAsManyInEachCell<2>({ 5, 4 }, { 3, 11 });
  expectAsManyInEachCell<3>({ 3, 4, 2 }, { 3, 4, 2 });
  expectAsManyInEachCell<3>({ 3, 1, 2 }, { 10, 9, 1 });
}

template <int Dimension>
void expectSubGridOfPowers(const GridSize<Dimension>& grid)
{
  for (std::int64_t perCell = 1; perCell <= 64; ++perCell)
  {
    const PivotLattice<Dimension> samples = pivotLattice<Dimension>(grid, perCell);
    if (!isPower<Dimension>(perCell))
    {
      EXPECT_EQ(samples.Lattice, grid) << perCell;
      EXPECT_EQ(static_cast<std::int64_t>(samples.Places.size()), perCell);
      continue;
    }
    ASSERT_EQ(samples.Places.size(), std::size_t{ 1 }) << perCell;
    EXPECT_EQ(samples.Places[0], cellCentre<Dimension>());
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const std::int64_t side = samples.Lattice[axis] / grid[axis];
      EXPECT_EQ(side * grid[axis], samples.Lattice[axis]);
      EXPECT_EQ(power<Dimension>(side), perCell);
    }
  }
}

TEST(PivotLattice, SubGridOfPowers)
{
  expectSubGridOfPowers<1>({ 9 });
  expectSubGridOfPowers<2>({ 6, 7 });
  expectSubGridOfPowers<3>({ 2, 5, 3 });
}

// Point i and the one as far from the other end mirror each other in the centre, and none is close
// to another, beside the distance of a grid of as many points.
template <int Dimension>
void expectEvenPlaces(double closest)
{
  for (std::int64_t perCell = 2; perCell <= 200; ++perCell)
  {
    const auto places = pivotLattice<Dimension>({}, perCell).Places;
    const std::size_t count = places.size();
    Point<Dimension> mean{};
    double nearest = HUGE_VAL;
    for (std::size_t i = 0; i < count; ++i)
    {
      for (int axis = 0; axis < Dimension; ++axis)
      {
        ASSERT_TRUE(places[i][axis] > 0.0 && places[i][axis] < 1.0) << perCell;
        EXPECT_NEAR(places[i][axis] + places[count - 1 - i][axis], 1.0, 0x1p-52);
        mean[axis] += places[i][axis] / static_cast<double>(count);
      }
      for (std::size_t k = 0; k < i; ++k)
      {
        double squared = 0.0;
        for (int axis = 0; axis < Dimension; ++axis)
        {
          // Cells of the same points lie side by side.
          const double apart = std::abs(places[i][axis] - places[k][axis]);
          squared += std::pow(std::min(apart, 1.0 - apart), 2);
        }
        nearest = std::min(nearest, std::sqrt(squared));
      }
    }
    for (const double coordinate : mean)
    {
      EXPECT_NEAR(coordinate, 0.5, 1e-15) << perCell;
    }
    EXPECT_GT(nearest * std::pow(static_cast<double>(count), 1.0 / Dimension), closest) << perCell;
  }
}

TEST(PivotLattice, EvenPlaces)
{
  expectEvenPlaces<2>(0.5);
  expectEvenPlaces<3>(0.4);
}

// The flow of the pivot is that of its points, in any order.
template <int Dimension>
void expectFlowOfPlaces(const TestDensity<Dimension>& density, const GridSize<Dimension>& grid)
{
  const RectifiedFlow<Dimension> flow = makeFlow(density);
  const SerialExecutor serial;
  const PivotLattice<Dimension> pivot = pivotLattice<Dimension>(grid, 3);
  const Points<Dimension> points = pointsOf<Dimension>(pivot, density.Size);
  ASSERT_EQ(static_cast<std::int64_t>(points.size()), pivot.NumberOfParticles());
  for (const Integrator method : AllIntegrators)
  {
    const FlowOptions options = steps(24, method);
    Points<Dimension> threaded(points.size());
    Points<Dimension> alone(points.size());
    Points<Dimension> others(points.size());
    const FlowReport report = transportPivot<Dimension>(flow, pivot, threaded, options);
    transportPivot<Dimension>(flow, pivot, alone, options, serial);
    const FlowReport expected = flow.Forward(points, others, options);
    EXPECT_TRUE(sameBits<Dimension>(threaded, others)) << nameOf(method);
    EXPECT_TRUE(sameBits<Dimension>(alone, threaded)) << nameOf(method);
    EXPECT_EQ(report.Redone, expected.Redone) << nameOf(method);
    EXPECT_EQ(report.MovedToMass, expected.MovedToMass) << nameOf(method);
  }
}

TEST(PivotLattice, FlowIsThatOfThePoints)
{
  expectFlowOfPlaces<1>(twoGaussians<1>({ 300 }), { 200 });
  expectFlowOfPlaces<2>(twoGaussians<2>({ 90, 70 }), { 90, 70 });
  expectFlowOfPlaces<2>(discWithHole<2>({ 64, 64 }), { 33, 70 });
  expectFlowOfPlaces<3>(twoGaussians<3>({ 22, 18, 25 }), { 21, 7, 12 });
}

// Flow maps that pay for the particles of all places, but not for those of one, serve each.
TEST(PivotLattice, FlowMapsForAllPlaces)
{
  const TestDensity<2> density = twoGaussians<2>({ 224, 208 });
  const FlowMapShape<2> maps = forwardShape<2>(density.Size, 16);
  const auto enough = static_cast<double>(particlesThatPay(maps));
  const auto side = static_cast<std::int32_t>(std::sqrt(0.4 * enough));
  const PivotLattice<2> pivot = pivotLattice<2>({ side, side }, 3);
  ASSERT_EQ(pivot.Places.size(), 3u);
  ASSERT_TRUE(maps.PaysFor(3.0 * side * side));
  ASSERT_FALSE(maps.PaysFor(1.0 * side * side));
  const RectifiedFlow<2> flow = makeFlow(density);
  const Points<2> points = pointsOf<2>(pivot, density.Size);
  Points<2> found(points.size());
  transportPivot<2>(flow, pivot, found, with(FlowMaps::Auto, steps(16)));
  EXPECT_TRUE(sameBits<2>(found, runForward(flow, points, with(FlowMaps::On, steps(16)))));
  EXPECT_FALSE(sameBits<2>(found, runForward(flow, points, with(FlowMaps::Off, steps(16)))));
}

// What all places report together: in a density of few cells some particles of each are put on
// mass.
TEST(PivotLattice, ReportsOfAllPlaces)
{
  TestDensity<2> density{ { 40, 40 }, std::vector<double>(1600, 0.0) };
  density.Values[3 * 40 + 5] = density.Values[33 * 40 + 31] = 1.0;
  const RectifiedFlow<2> flow = makeFlow(density);
  const PivotLattice<2> pivot = pivotLattice<2>(density.Size, 3);
  const std::int64_t each = cellCount<2>(pivot.Lattice);
  Points<2> positions(static_cast<std::size_t>(3 * each));
  const FlowOptions few = steps(2, Integrator::Euler);
  FlowReport sum;
  for (std::int64_t place = 0; place < 3; ++place)
  {
    const FlowReport part = flow.Forward(
      FlowSeeds<2>::Lattice(pivot.Lattice, pivot.Places[static_cast<std::size_t>(place)]),
      PointSpan<2>(positions).Part(place * each, each), few);
    EXPECT_GT(part.MovedToMass, 0);
    sum.Redone += part.Redone;
    sum.MovedToMass += part.MovedToMass;
    sum.Evaluations += part.Evaluations;
  }
  const FlowReport report = transportPivot<2>(flow, pivot, positions, few);
  EXPECT_EQ(report.Redone, sum.Redone);
  EXPECT_EQ(report.MovedToMass, sum.MovedToMass);
  EXPECT_EQ(report.Evaluations, sum.Evaluations);
}

// Any numbers in a row, alone: as with all others.
template <int Dimension>
void expectShares(const TestDensity<Dimension>& density, const GridSize<Dimension>& grid)
{
  const RectifiedFlow<Dimension> flow = makeFlow(density);
  for (const std::int64_t perCell : { 1, 3, 1 << Dimension })
  {
    const PivotLattice<Dimension> pivot = pivotLattice<Dimension>(grid, perCell);
    const std::int64_t count = pivot.NumberOfParticles();
    Points<Dimension> all(static_cast<std::size_t>(count));
    transportPivot<Dimension>(flow, pivot, all);
    for (const std::int64_t shares : { 2, 3, 7, 50 })
    {
      Points<Dimension> found(all.size());
      for (std::int64_t share = 0; share < shares; ++share)
      {
        const std::int64_t first = count * share / shares;
        const std::int64_t last = count * (share + 1) / shares;
        transportPivot<Dimension>(
          flow, pivot, first, PointSpan<Dimension>(found).Part(first, last - first));
      }
      EXPECT_TRUE(sameBits<Dimension>(found, all)) << perCell << " a cell, shares: " << shares;
    }
    transportPivot<Dimension>(flow, pivot, count, PointSpan<Dimension>());
    EXPECT_NE(refusal([&]() {
      transportPivot<Dimension>(flow, pivot, 1, all);
    }).find("there is memory for positions 1 to " + std::to_string(count)),
      std::string::npos);
  }
}

TEST(PivotLattice, SharesAreParts)
{
  expectShares<1>(twoGaussians<1>({ 60 }), { 21 });
  expectShares<2>(twoGaussians<2>({ 40, 30 }), { 40, 30 });
  expectShares<2>(discWithHole<2>({ 24, 24 }), { 13, 7 });
  expectShares<3>(twoGaussians<3>({ 12, 8, 10 }), { 5, 1, 12 });
  expectShares<3>(twoGaussians<3>({ 12, 8, 10 }), { 5, 7, 4 });
}

TEST(PivotLattice, ProgressCancelAndSizes)
{
  const RectifiedFlow<2> flow = makeFlow(twoGaussians<2>({ 120, 90 }));
  const PivotLattice<2> pivot = pivotLattice<2>({ 120, 90 }, 3);
  Points<2> positions(static_cast<std::size_t>(pivot.NumberOfParticles()));
  std::vector<double> heard;
  double limit = 2.0;
  const SerialExecutor serial;
  const Context context(
    serial, [&heard](double done) { heard.push_back(done); },
    [&]() { return !heard.empty() && heard.back() >= limit; });
  transportPivot<2>(flow, pivot, positions, {}, context);
  EXPECT_TRUE(std::is_sorted(heard.begin(), heard.end()));
  EXPECT_EQ(heard.back(), 1.0);
  for (const double from : { 0.0, 0.5, 0.9 })
  {
    heard.clear();
    limit = from;
    EXPECT_THROW(transportPivot<2>(flow, pivot, positions, {}, context), Cancelled) << from;
  }
  positions.pop_back();
  EXPECT_EQ(refusal([&]() { transportPivot<2>(flow, pivot, positions); }),
    "there is memory for 32399 positions, but the pivot has 32400 particles");
}

} // namespace
} // namespace RectifiedTransport
