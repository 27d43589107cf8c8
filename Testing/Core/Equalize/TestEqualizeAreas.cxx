// SPDX-License-Identifier: BSD-3-Clause
// Corners of cells are moved until areas are masses.
#include "Core/Equalize/AreaCorrection.h"

#include "AreaErrors.h"
#include "RecordingContext.h"
#include "TestDimensions.h"
#include "TestFlow.h"
#include "TestRefusal.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <vector>

namespace RectifiedTransport
{
namespace
{

template <class T>
using EqualizeAreasIn = DimensionTest<T>;
TYPED_TEST_SUITE(EqualizeAreasIn, PlaneAndSpace);

template <int Dimension>
EqualizeReport equalize(const TestDensity<Dimension>& density, Points<Dimension>& corners,
  const EqualizeOptions& options = {}, const Context& context = Context())
{
  const DensityArray<Dimension, double> values(density.Values.data(), density.Size);
  const double total = std::accumulate(density.Values.begin(), density.Values.end(), 0.0);
  return equalizeAreas<Dimension>(values, density.Size, total, corners, options, context);
}

EqualizeOptions passes(int count)
{
  EqualizeOptions options;
  options.Passes = count;
  return options;
}

template <int Dimension>
Points<Dimension> cornersAfter(const TestDensity<Dimension>& density, int numberOfSteps)
{
  const RectifiedFlow<Dimension> flow(density.Source());
  return runBackward(flow, cornerLattice<Dimension>(density.Size), steps(numberOfSteps));
}

// Corners within the box, moved along a smooth field that vanishes on its sides.
template <int Dimension>
Points<Dimension> bentLattice(const GridSize<Dimension>& size, double amplitude)
{
  Points<Dimension> corners = cornerLattice<Dimension>(size);
  for (Point<Dimension>& corner : corners)
  {
    double bump = 1.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double x = corner[axis] / static_cast<double>(size[axis]);
      bump *= 4.0 * x * (1.0 - x);
    }
    for (int axis = 0; axis < Dimension; ++axis)
    {
      corner[axis] += amplitude * bump * std::cos(corner[(axis + 1) % Dimension] * 0.7);
    }
  }
  return corners;
}

TYPED_TEST(EqualizeAreasIn, UniformDensityLeavesTheLattice)
{
  constexpr int D = TypeParam::value;
  const auto density = uniformDensity<D>(sizeFor<D>({}, { 37, 20 }, { 9, 12, 10 }), 3.0);
  Points<D> corners = cornerLattice<D>(density.Size);
  const EqualizeReport report = equalize<D>(density, corners);
  EXPECT_EQ(corners, cornerLattice<D>(density.Size));
  EXPECT_EQ(report.FoldedAfter, 0);
  EXPECT_EQ(report.Limited, 0);
}

// The identity is not the only solution, but one that is near.
TYPED_TEST(EqualizeAreasIn, BentLatticeOfAUniformDensity)
{
  constexpr int D = TypeParam::value;
  const auto density = uniformDensity<D>(sizeFor<D>({}, { 64, 48 }, { 16, 20, 24 }));
  Points<D> corners = bentLattice<D>(density.Size, 0.3);
  const double before = measureAreas<D>(density, corners).Quantile999;
  EXPECT_GT(before, 0.01);
  EXPECT_EQ(equalize<D>(density, corners, passes(3)).Passes, 3);
  EXPECT_LT(measureAreas<D>(density, corners).Quantile999, 0.01 * before);
}

// What few steps leave of a smooth density falls several times in a pass, and again in a second.
TYPED_TEST(EqualizeAreasIn, ErrorsOfTheFlowFall)
{
  constexpr int D = TypeParam::value;
  const auto density = twoGaussians<D>(sizeFor<D>({}, { 101, 76 }, { 30, 34, 29 }));
  const Points<D> moved = cornersAfter<D>(density, 16);
  const AreaErrors before = measureAreas<D>(density, moved);
  Points<D> once = moved;
  equalize<D>(density, once, passes(1));
  const AreaErrors after = measureAreas<D>(density, once);
  EXPECT_LT(after.Quantile999, 0.3 * before.Quantile999);
  EXPECT_LT(after.Mean, 0.15 * before.Mean);
  Points<D> twice = moved;
  equalize<D>(density, twice, passes(2));
  EXPECT_LT(measureAreas<D>(density, twice).Quantile999, 0.6 * after.Quantile999);
}

// A map with folds, of cells of which some have no mass: none is made where there was none before
// in all, and most go.
TYPED_TEST(EqualizeAreasIn, FoldsBecomeFewer)
{
  constexpr int D = TypeParam::value;
  auto density = randomCells<D>(sizeFor<D>({}, { 90, 70 }, { 20, 22, 24 }));
  for (double& value : density.Values)
  {
    value = std::max(0.0, value * value * value - 0.001);
  }
  Points<D> corners = cornersAfter<D>(density, 8);
  const std::int64_t before = measureAreas<D>(density, corners).Folded;
  const EqualizeReport report = equalize<D>(density, corners);
  EXPECT_EQ(report.FoldedBefore, before);
  EXPECT_GT(before, 0);
  EXPECT_GT(report.Limited, 0);
  EXPECT_EQ(report.FoldedAfter, measureAreas<D>(density, corners).Folded);
  EXPECT_LT(report.FoldedAfter, before);
}

// Cells of one part in ten thousand beside a sharp rim fold in no pass.
TEST(EqualizeAreas, NoFoldsAtASharpRim)
{
  const auto density = sampleDensity<2>({ 96, 96 }, [](const Point<2>& p) {
    return std::max(std::abs(p[0] - 0.45), std::abs(p[1] - 0.52)) < 0.15 ? 20.0 : 1.0;
  });
  Points<2> corners = cornersAfter<2>(density, 128);
  ASSERT_EQ(measureAreas<2>(density, corners).Folded, 0);
  const EqualizeReport report = equalize<2>(density, corners);
  EXPECT_EQ(report.FoldedAfter, 0);
  EXPECT_EQ(measureAreas<2>(density, corners).Folded, 0);
}

// Beside a rim of 1000 the equation moves corners of thin cells too far at any length: what sweeps
// of projections do alone is kept.
TEST(EqualizeAreas, KeepsPassesAtAHighRim)
{
  const auto density = sampleDensity<2>({ 128, 128 },
    [](const Point<2>& p) { return std::hypot(p[0] - 0.5, p[1] - 0.5) < 0.2 ? 1000.0 : 1.0; });
  Points<2> corners = cornersAfter<2>(density, 256);
  const AreaErrors before = measureAreas<2>(density, corners);
  const EqualizeReport report = equalize<2>(density, corners);
  const AreaErrors after = measureAreas<2>(density, corners);
  EXPECT_EQ(report.Passes, 2);
  EXPECT_LT(after.Quantile999, 0.8 * before.Quantile999);
  EXPECT_LT(after.Folded, before.Folded);
}

// Images that are far off: no pass may make them worse.
TYPED_TEST(EqualizeAreasIn, FarFromTheMap)
{
  constexpr int D = TypeParam::value;
  const auto density = twoGaussians<D>(sizeFor<D>({}, { 100, 80 }, { 20, 22, 24 }));
  Points<D> corners = bentLattice<D>(density.Size, 0.2);
  const AreaErrors before = measureAreas<D>(density, corners);
  const EqualizeReport report = equalize<D>(density, corners, passes(20));
  const AreaErrors after = measureAreas<D>(density, corners);
  EXPECT_GT(report.Passes, 2);
  EXPECT_EQ(after.Folded, 0);
  EXPECT_LT(after.Mean, 0.7 * before.Mean);
}

TYPED_TEST(EqualizeAreasIn, CornersOfSidesStayOnThem)
{
  constexpr int D = TypeParam::value;
  const auto density = twoGaussians<D>(sizeFor<D>({}, { 40, 50 }, { 14, 12, 16 }));
  const Points<D> flat = cornerLattice<D>(density.Size);
  Points<D> corners = cornersAfter<D>(density, 16);
  const Points<D> before = corners;
  equalize<D>(density, corners);
  EXPECT_NE(corners, before);
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    for (int axis = 0; axis < D; ++axis)
    {
      const auto side = static_cast<double>(density.Size[axis]);
      EXPECT_TRUE(corners[i][axis] >= 0.0 && corners[i][axis] <= side);
      if (flat[i][axis] == 0.0 || flat[i][axis] == side)
      {
        EXPECT_EQ(corners[i][axis], before[i][axis]);
      }
    }
  }
}

TEST(EqualizeAreas, AlongALineTheyAreSums)
{
  const TestDensity<1> density{ { 4 }, { 1.0, 0.0, 4.0, 3.0 } };
  Points<1> corners = cornerLattice<1>(density.Size);
  equalize<1>(density, corners);
  EXPECT_EQ(corners, (Points<1>{ { 0.0 }, { 0.5 }, { 0.5 }, { 2.5 }, { 4.0 } }));
}

// Grids that are as thin as they can be.
TEST(EqualizeAreas, ThinGrids)
{
  for (const GridSize<2>& size : std::vector<GridSize<2>>{ { 1, 1 }, { 1, 40 }, { 40, 1 } })
  {
    const auto density = twoGaussians<2>(size);
    Points<2> corners = cornersAfter<2>(density, 16);
    equalize<2>(density, corners, passes(6));
    for (std::size_t cell = 0; cell < density.Values.size(); ++cell)
    {
      const bool isRow = size[1] == 1;
      const double area = isRow ? corners[cell + 1][0] - corners[cell][0]
                                : corners[2 * cell + 2][1] - corners[2 * cell][1];
      const double total = std::accumulate(density.Values.begin(), density.Values.end(), 0.0);
      const auto cells = static_cast<double>(density.Values.size());
      EXPECT_NEAR(area, density.Values[cell] * cells / total, 1e-3);
    }
  }
  for (const GridSize<3>& size :
    std::vector<GridSize<3>>{ { 1, 1, 1 }, { 30, 1, 20 }, { 1, 30, 20 }, { 20, 30, 1 } })
  {
    const auto density = twoGaussians<3>(size);
    Points<3> corners = cornersAfter<3>(density, 16);
    const std::int64_t folded = measureAreas<3>(density, corners).Folded;
    EXPECT_LE(equalize<3>(density, corners).FoldedAfter, folded);
  }
}

TYPED_TEST(EqualizeAreasIn, SameBitsOnAnyNumberOfThreads)
{
  constexpr int D = TypeParam::value;
  // Several chunks of rows and of cells.
  const auto density = randomCells<D>(sizeFor<D>({}, { 301, 207 }, { 43, 40, 37 }), 0.05);
  const Points<D> moved = bentLattice<D>(density.Size, 0.2);
  Points<D> expected = moved;
  equalize<D>(density, expected, {}, SerialExecutor());
  EXPECT_NE(expected, moved);
  for (const int threads : { 2, 3 })
  {
    Points<D> corners = moved;
    equalize<D>(density, corners, {}, ThreadsExecutor(threads));
    EXPECT_EQ(corners, expected) << threads << " threads";
  }
}

TEST(EqualizeAreas, ReportsProgressAndStops)
{
  const auto density = uniformDensity<2>({ 400, 300 });
  const Points<2> moved = bentLattice<2>(density.Size, 0.3);
  const ThreadsExecutor threads(2);
  RecordingContext all(threads);
  Points<2> corners = moved;
  equalize<2>(density, corners, {}, all.Context());
  const int queries = all.Queries;
  EXPECT_GT(queries, 20);
  all.ExpectReported(0.0, 1.0);
  for (const int allowed : { 0, queries / 3, queries - 2 })
  {
    RecordingContext some(threads);
    some.MaximumQueries = allowed;
    corners = moved;
    EXPECT_THROW(equalize<2>(density, corners, {}, some.Context()), Cancelled) << allowed;
    EXPECT_LE(some.Queries, allowed + 1);
  }
}

// A progress bar moves all the time, though linear systems and limits of moves take as long as they
// take: here many iterations, and many rounds.
TYPED_TEST(EqualizeAreasIn, ProgressDoesNotStandStill)
{
  constexpr int D = TypeParam::value;
  const auto density = sampleDensity<D>(sizeFor<D>({}, { 300, 300 }, { 40, 44, 48 }),
    [](const Point<D>& p) { return std::hypot(p[0] - 0.5, p[1] - 0.5) < 0.2 ? 1.0 : 0.001; });
  Points<D> corners = bentLattice<D>(density.Size, 0.3);
  const SerialExecutor serial;
  RecordingContext recorder(serial);
  equalize<D>(density, corners, passes(3), recorder.Context());
  const std::vector<double> all = recorder.Reported;
  ASSERT_GT(all.size(), 100u);
  recorder.ExpectReported(0.0, 1.0);
  std::size_t stretch = 0;
  for (std::size_t i = 1, still = 0; i < all.size(); ++i)
  {
    still = all[i] > all[i - 1] ? 0 : still + 1;
    stretch = std::max(stretch, still);
  }
  EXPECT_LE(stretch, 3u) << "of " << all.size();
}

TEST(EqualizeAreas, RefusesWrongArguments)
{
  const auto density = uniformDensity<2>({ 4, 5 });
  Points<2> corners = cornerLattice<2>(density.Size);
  EXPECT_EQ(refusal([&]() { equalize<2>(density, corners, passes(-1)); }),
    "Passes is -1; it must be at least 0");
  EqualizeOptions options;
  options.Tolerance = 0.0;
  EXPECT_EQ(refusal([&]() { equalize<2>(density, corners, options); }),
    "Tolerance is 0.000000; it must be between 0 and 1");
  const DensityArray<2, double> values(density.Values.data(), density.Size);
  for (const double total : { 0.0, -1.0, std::nan(""), HUGE_VAL })
  {
    EXPECT_EQ(refusal([&]() { equalizeAreas<2>(values, density.Size, total, corners); }),
      "the total of the density is " + std::to_string(total) + "; it must be positive and finite");
  }
  corners.pop_back();
  EXPECT_EQ(refusal([&]() { equalize<2>(density, corners); }),
    "there are 29 points; the cells have 30 corners");
}

TYPED_TEST(EqualizeAreasIn, NoPassesChangeNothing)
{
  constexpr int D = TypeParam::value;
  const auto density = twoGaussians<D>(evenSize<D>(12));
  Points<D> corners = bentLattice<D>(density.Size, 0.2);
  EXPECT_EQ(equalize<D>(density, corners, passes(0)).Passes, 0);
  EXPECT_EQ(corners, bentLattice<D>(density.Size, 0.2));
}

// Options that mean the same are the same, and give the same correction.
TEST(AreaCorrection, ResolvesOptions)
{
  const auto density = twoGaussians<2>({ 40, 30 });
  const RectifiedFlow<2> flow(density.Source());
  const auto resolve = [&flow](const FlowOptions& options) {
    return AreaCorrection<2>::Resolve(flow, options);
  };
  FlowOptions chosen;
  chosen.Maps = FlowMaps::Off;
  FlowOptions fixed = chosen;
  fixed.NumberOfSteps = flow.ChooseSteps(chosen, FlowDirection::Backward).NumberOfSteps;
  EXPECT_EQ(resolve(chosen), resolve(fixed));
  for (const bool isAdaptive : { false, true })
  {
    FlowOptions one = fixed;
    one.Integrator = isAdaptive ? Integrator::Adaptive : Integrator::Multistep;
    FlowOptions other = one;
    other.AreaTolerance = 0.5;
    EXPECT_EQ(resolve(one), resolve(other));
    other.Tolerance = 0.3;
    EXPECT_EQ(resolve(one) == resolve(other), !isAdaptive);
    other = one;
    other.NumberOfSteps = 77;
    EXPECT_EQ(resolve(one) == resolve(other), isAdaptive);
    other = one;
    other.Maps = FlowMaps::On;
    EXPECT_EQ(resolve(one) == resolve(other), isAdaptive);
    other = one;
    other.Lookup = TableLookup::Nearest;
    EXPECT_FALSE(resolve(one) == resolve(other));
  }
  const AreaCorrection<2> ofChosen(flow, chosen);
  const AreaCorrection<2> ofFixed(flow, resolve(chosen));
  for (const Point<2>& point : randomPoints<2>(density.Size, 100))
  {
    Point<2> one = point;
    Point<2> other = point;
    ofChosen.Correct(point.data(), one.data());
    ofFixed.Correct(point.data(), other.data());
    EXPECT_EQ(one, other);
  }
}

} // namespace
} // namespace RectifiedTransport
