// SPDX-License-Identifier: BSD-3-Clause
// Plans move points as their solvers do, say what they did, and make what is missing once.
#include "Core/Plan/TransportPlan.h"
#include "OptimalMap/MapPoints.h"
#include "TestFlow.h"
#include "TestGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace RectifiedTransport
{
namespace
{

template <int D>
PlanEnd<D> endOf(
  const TestDensity<D>& density, const Point<D>& low = {}, const Point<D>& high = evenPoint<D>(1.0))
{
  // Reads a copy: tests give densities that do not last.
  const auto kept = std::make_shared<TestDensity<D>>(density);
  PlanEnd<D> end;
  end.Size = density.Size;
  end.Low = low;
  end.High = high;
  const auto array = std::make_shared<DensityArray<D, double>>(kept->Values.data(), kept->Size);
  end.Read = [kept, array](const Context&) { return DensitySource<D>(kept->Size, *array); };
  return end;
}

PlanOptions optimal()
{
  PlanOptions options;
  options.IsOptimal = true;
  return options;
}

template <class T>
using Plans = DimensionTest<T>;
TYPED_TEST_SUITE(Plans, Dimensions);

TYPED_TEST(Plans, MoveByTheFlowOfADensity)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> density = twoGaussians<D>(evenSize<D>(24));
  const TransportPlan<D> plan(endOf(density), PlanOptions());
  EXPECT_FALSE(plan.IsOptimal());
  EXPECT_FALSE(plan.Certificate());
  EXPECT_EQ(plan.Warning(), "");
  EXPECT_EQ(plan.LowerBound(), 0.0);
  EXPECT_EQ(plan.Size(), density.Size);
  const auto values = density.Source();
  const RectifiedFlow<D> flow(values);
  const Points<D> seeds = randomPoints<D>(density.Size, 300);
  Points<D> images(seeds.size());
  EXPECT_GT(plan.Forward(seeds, images).NumberOfSteps, 0);
  EXPECT_TRUE(sameBits<D>(images, runForward<D>(flow, seeds)));
  plan.Backward(images, images);
  EXPECT_TRUE(sameBits<D>(images, runBackward<D>(flow, runForward<D>(flow, seeds))));
  Points<D> between(2 * seeds.size());
  Points<D> expected(2 * seeds.size());
  plan.ForwardAt(seeds, { 0.5, 1.0 }, between);
  flow.ForwardAt(seeds, { 0.5, 1.0 }, expected);
  EXPECT_TRUE(sameBits<D>(between, expected));
}

TYPED_TEST(Plans, MoveByTheOptimalMap)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = evenSize<D>(sideFor<D>());
  const TestDensity<D> source = uniformDensity<D>(size);
  const TestDensity<D> target = twoGaussians<D>(size);
  const TransportPlan<D> pair(endOf(source), endOf(target), optimal());
  const TransportPlan<D> one(endOf(target), optimal());
  EXPECT_TRUE(pair.IsOptimal() && one.IsOptimal());
  const OptimalMap<D> map = solvedPair<D>(source, target);
  const OptimalMap<D> fromUniform = solvedMap<D>(target);
  EXPECT_EQ(pair.LowerBound(), map.LowerBound());
  EXPECT_EQ(one.LowerBound(), fromUniform.LowerBound());
  const Points<D> seeds = randomPoints<D>(size, 200);
  Points<D> images(seeds.size());
  Points<D> expected(seeds.size());
  EXPECT_EQ(pair.Move(FlowDirection::Forward, seeds, images).size(), 1);
  map.Forward(seeds, expected);
  EXPECT_TRUE(sameBits<D>(images, expected));
  one.Forward(FlowSeeds<D>(seeds).AsSamples(), images);
  fromUniform.Forward(FlowSeeds<D>(seeds).AsSamples(), expected);
  EXPECT_TRUE(sameBits<D>(images, expected));
  std::vector<double> slack(2 * seeds.size());
  one.Certificate()->Slack(seeds, images, slack.data());
  fromUniform.Slack(seeds, images, slack.data() + seeds.size());
  EXPECT_TRUE(
    std::equal(slack.begin(), slack.begin() + seeds.size(), slack.begin() + seeds.size()));
  one.Backward(seeds, images);
  fromUniform.Backward(seeds, expected);
  EXPECT_TRUE(sameBits<D>(images, expected));
}

// Back to the uniform measure and on from there, in both directions, however points are given.
TYPED_TEST(Plans, MoveByTwoFlows)
{
  constexpr int D = TypeParam::value;
  const TestDensity<D> source = twoGaussians<D>(evenSize<D>(20));
  const TestDensity<D> target = denseBall<D>(30, 4.0);
  PlanOptions options;
  options.Flow.NumberOfSteps = 40;
  options.HasBound = true;
  TransportPlan<D> plan(endOf(source), endOf(target), options);
  const double bound = plan.LowerBound();
  EXPECT_GT(bound, 0.0);
  EXPECT_TRUE(plan.Certificate());
  EXPECT_EQ(plan.Target().Size, target.Size);
  const auto from = source.Source();
  const auto to = target.Source();
  const RectifiedFlow<D> first(from);
  const RectifiedFlow<D> second(to);
  const auto follow = [&](const RectifiedFlow<D>& back, const RectifiedFlow<D>& on,
                        Points<D> points) {
    points = runBackward<D>(back, points, options.Flow);
    for (Point<D>& point : points)
    {
      for (int axis = 0; axis < D; ++axis)
      {
        point[axis] *=
          static_cast<double>(on.Size()[axis]) / static_cast<double>(back.Size()[axis]);
      }
    }
    return runForward<D>(on, points, options.Flow);
  };
  const GridSize<D> lattice = evenSize<D>(7);
  const Points<D> seeds = latticePoints<D>(source.Size, lattice);
  const Points<D> expected = follow(first, second, seeds);
  Points<D> images = seeds;
  const std::vector<FlowReport> reports = plan.Move(FlowDirection::Forward, images, images);
  EXPECT_TRUE(sameBits<D>(images, expected));
  ASSERT_EQ(reports.size(), 2);
  EXPECT_EQ(reports[0].NumberOfSteps, 40);
  EXPECT_EQ(reports[1].NumberOfSteps, 40);
  plan.Backward(expected, images);
  EXPECT_TRUE(sameBits<D>(images, follow(second, first, expected)));

  // A part of the lattice, within the memory of all of it, which stays as it is elsewhere.
  auto part = LatticePart<D>::WholeOf(lattice);
  part.Low[D - 1] = 2;
  part.Cells[D - 1] = 3;
  const Point<D> nothing = evenPoint<D>(-1.0);
  std::fill(images.begin(), images.end(), nothing);
  plan.MakeFlows();
  EXPECT_FALSE(plan.Certificate());
  EXPECT_EQ(plan.LowerBound(), bound);
  plan.Forward(FlowSeeds<D>::Lattice(lattice, { part, LatticePart<D>::WholeOf(lattice) }), images);
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    const bool isInPart = part.Contains(cellAt<D>(static_cast<std::int64_t>(i), lattice));
    EXPECT_EQ(images[i], isInPart ? expected[i] : nothing);
  }

  // Straight lines in the index space of the target.
  Points<D> paths(3 * seeds.size());
  plan.ForwardAt(seeds, { 0.0, 0.25, 1.0 }, paths);
  for (std::size_t i = 0; i < seeds.size(); ++i)
  {
    for (int axis = 0; axis < D; ++axis)
    {
      const double begin = seeds[i][axis] * 1.5;
      EXPECT_NEAR(paths[3 * i][axis], begin, 1e-12);
      EXPECT_NEAR(paths[3 * i + 1][axis], 0.75 * begin + 0.25 * expected[i][axis], 1e-12);
      EXPECT_NEAR(paths[3 * i + 2][axis], expected[i][axis], 1e-12);
    }
  }
}

// Single cells on nodes that are far apart.
TEST(Plan, FallsBackToTheFlow)
{
  const GridSize<2> size = evenSize<2>(64);
  const TestDensity<2> thin = sampleDensity<2>(size, [](const Point<2>& p) {
    const double number = 64.0 * p[0] + 64.0 * 64.0 * p[1];
    return std::fmod(number, 151.0) < 1.0 ? 1.0 : 0.0;
  });
  PlanOptions options = optimal();
  options.Optimal.MostNodes = 64.0;
  TransportPlan<2> plan(endOf(thin), options);
  EXPECT_FALSE(plan.IsOptimal());
  EXPECT_EQ(plan.Warning().find("Method Optimal did not reach the density"), 0);
  EXPECT_GE(plan.LowerBound(), 0.0);
  const auto values = thin.Source();
  const RectifiedFlow<2> flow(values);
  const Points<2> seeds = randomPoints<2>(size, 100);
  Points<2> images(seeds.size());
  plan.Forward(seeds, images);
  EXPECT_TRUE(sameBits<2>(images, runForward<2>(flow, seeds)));
}

// What exists is used, and nothing is read for it; what is missing is read and released once.
TEST(Plan, MakesWhatIsMissing)
{
  const TestDensity<2> density = twoGaussians<2>(evenSize<2>(32));
  int reads = 0;
  int releases = 0;
  PlanEnd<2> end = endOf(density);
  end.Read = [&reads, read = end.Read](const Context& context) {
    ++reads;
    return read(context);
  };
  end.Release = [&releases]() { ++releases; };
  const auto map = TransportPlan<2>::Solve(nullptr, end, {});
  EXPECT_EQ(reads, 1);
  EXPECT_EQ(releases, 1);
  const TransportPlan<2> known(end, optimal(), Context(), map);
  EXPECT_EQ(known.LowerBound(), map->LowerBound());
  EXPECT_EQ(reads, 1);
  const TransportPlan<2> flows(end, end, PlanOptions());
  EXPECT_EQ(reads, 1);
  Points<2> points = randomPoints<2>(density.Size, 10);
  flows.Forward(points, points);
  flows.Backward(points, points);
  EXPECT_EQ(reads, 3);
  EXPECT_EQ(releases, 3);
}

TEST(Plan, BoundsFromBothSides)
{
  const GridSize<2> size = evenSize<2>(48);
  PlanOptions options;
  options.HasBound = true;
  // A move by 12 cells.
  const TransportPlan<2> plan(
    endOf(ballAt<2>(size, { 0.375, 0.5 })), endOf(ballAt<2>(size, { 0.625, 0.5 })), options);
  EXPECT_LE(plan.LowerBound(), 0.0625 + 1e-9);
  EXPECT_GE(plan.LowerBound(), 0.0615);
  EXPECT_GE(plan.Certificate()->UpperBound(), plan.LowerBound());
  EXPECT_LE(plan.Certificate()->UpperBound(), 0.0635);
}

// Places of grids in a box, in lengths of its diagonal's power of two.
TEST(Plan, PlacesGrids)
{
  const ImageGrid box = makeGrid<2>({ 8, 4 }, { 1.0, 1.0, 1.0 }, { 1.0, 2.0, 3.0 });
  const ImageGrid grid = makeGrid<2>({ 4, 4 }, { 1.0, 1.0, 1.0 }, { 3.0, 2.0, 3.0 });
  const PlanEnd<2> all = PlanEnd<2>::On(box);
  EXPECT_EQ(all.Size, (GridSize<2>{ 8, 4 }));
  EXPECT_EQ(all.Low, (Point<2>{ 0.0, 0.0 }));
  EXPECT_EQ(all.High, (Point<2>{ 1.0, 0.5 }));
  const PlanEnd<2> same = PlanEnd<2>::In(box, box);
  EXPECT_EQ(same.Low, all.Low);
  EXPECT_EQ(same.High, all.High);
  const PlanEnd<2> part = PlanEnd<2>::In(box, grid);
  EXPECT_EQ(part.Low, (Point<2>{ 0.25, 0.0 }));
  EXPECT_EQ(part.High, (Point<2>{ 0.75, 0.5 }));
}

} // namespace
} // namespace RectifiedTransport
