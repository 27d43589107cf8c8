// SPDX-License-Identifier: BSD-3-Clause
// The mass correction: masses of boxes that it does not know improve, nothing enters a void, single
// points move as samples do.
#include "Core/OptimalMap/Masses/MassCorrection.h"

#include "OptimalMap/Masses/ParticleMasses.h"
#include "RecordingContext.h"
#include "TestDimensions.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

namespace RectifiedTransport
{
namespace
{

template <int D>
MassCorrection<D> correct(const CellDensity<D>& target, const Point<D>& sides, int cellsANode,
  Particles<D>& images, const std::vector<double>& masses = {},
  const Executor& threads = SerialExecutor())
{
  Progress progress(threads);
  return MassCorrection<D>(
    target, sides, cellsANode, images, masses.empty() ? nullptr : masses.data(), progress);
}

template <int D>
Point<D> unequalSides()
{
  Point<D> sides;
  for (int axis = 0; axis < D; ++axis)
  {
    sides[axis] = axis == 0 ? 0.5 : 0.8 * axis;
  }
  return sides;
}

// A lattice of samples in each cell with mass, and what each has of it.
template <int D>
Particles<D> latticeOf(
  const CellDensity<D>& density, std::int64_t each, std::vector<double>& masses)
{
  Particles<D> samples;
  const GridSize<D> lattice = evenSize<D>(each);
  for (std::int64_t cell = 0; cell < density.NumberOfCells(); ++cell)
  {
    const GridSize<D> place = cellAt<D>(cell, density.Size());
    for (std::int64_t i = 0; density.Share(cell) > 0.0 && i < cellCount<D>(lattice); ++i)
    {
      const GridSize<D> in = cellAt<D>(i, lattice);
      Point<D> sample;
      for (int axis = 0; axis < D; ++axis)
      {
        sample[axis] = static_cast<double>(place[axis]) +
          (static_cast<double>(in[axis]) + 0.5) / static_cast<double>(each);
      }
      samples.push_back(sample);
      masses.push_back(density.Share(cell) / static_cast<double>(cellCount<D>(lattice)));
    }
  }
  return samples;
}

template <class T>
using MassCorrections = DimensionTest<T>;
TYPED_TEST_SUITE(MassCorrections, Dimensions, );

TYPED_TEST(MassCorrections, ImproveAWrongMarginal)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = sizeFor<D>({ 256 }, { 64, 48 }, { 30, 24, 27 });
  for (const TestDensity<D>& values : { twoGaussians<D>(size), uniformDensity<D>(size) })
  {
    const CellDensity<D> target = cellDensity(values);
    const auto blocks = blocksOf<D>(size, 6, 3);
    const auto boxes = randomBoxes<D>(size, 100);
    for (const int cellsANode : { 1, 2 })
    {
      std::vector<double> masses;
      Particles<D> images = latticeOf<D>(cellDensity(distorted(values)), 4, masses);
      const double blocksBefore = massError<D>(target, images, masses, blocks);
      const double boxesBefore = massError<D>(target, images, masses, boxes);
      correct<D>(target, unequalSides<D>(), cellsANode, images, masses);
      EXPECT_LT(massError<D>(target, images, masses, blocks), 0.2 * blocksBefore);
      EXPECT_LT(massError<D>(target, images, masses, boxes), 0.2 * boxesBefore);
    }
  }
}

TYPED_TEST(MassCorrections, ImproveParticles)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = sizeFor<D>({ 256 }, { 64, 48 }, { 24, 24, 24 });
  // On a line, none can come to the other side of a hole.
  const TestDensity<D> values = D == 1 ? twoGaussians<D>(size) : discWithHole<D>(size);
  const CellDensity<D> target = cellDensity(values);
  Particles<D> particles = samplesOf<D>(values, 30000);
  Particles<D> wrong = samplesOf<D>(distorted(values), 30000);
  const auto blocks = blocksOf<D>(size, 6, 3);
  const auto boxes = randomBoxes<D>(size, 100);
  const double blockNoise = massError<D>(target, particles, {}, blocks);
  const double boxNoise = massError<D>(target, particles, {}, boxes);
  EXPECT_GT(massError<D>(target, wrong, {}, blocks), 2.0 * blockNoise);
  correct<D>(target, evenPoint<D>(1.0), 2, wrong);
  EXPECT_LT(massError<D>(target, wrong, {}, blocks), blockNoise);
  EXPECT_LT(massError<D>(target, wrong, {}, boxes), boxNoise);
}

TYPED_TEST(MassCorrections, NeitherEnterVoidsNorLeaveTheBox)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> sizes[] = { sizeFor<D>({ 61 }, { 33, 22 }, { 13, 9, 16 }),
    sizeFor<D>({ 2 }, { 1, 30 }, { 20, 1, 1 }), evenSize<D>(1) };
  for (const GridSize<D>& size : sizes)
  {
    for (const TestDensity<D>& values :
      { checker<D>(size, 3), randomCells<D>(size), discWithHole<D>(size) })
    {
      if (std::none_of(
            values.Values.begin(), values.Values.end(), [](double value) { return value > 0.0; }))
      {
        continue;
      }
      const CellDensity<D> target = cellDensity(values);
      for (const int cellsANode : { 1, 2, 5 })
      {
        SCOPED_TRACE(std::to_string(size[0]) + " cells along axis 0, " +
          std::to_string(cellsANode) + " a node");
        // All in one corner of what has mass, far from right.
        Particles<D> images = samplesOf<D>(values, 3000);
        for (Point<D>& image : images)
        {
          image = images[0];
        }
        const MassCorrection<D> correction =
          correct<D>(target, unequalSides<D>(), cellsANode, images);
        EXPECT_EQ(inVoids<D>(target, images), 0);
        EXPECT_TRUE(areInBox<D>(size, images));
        Particles<D> others = samplesOf<D>(values, 3000, 3);
        for (Point<D>& other : others)
        {
          correction.Move(other.data());
        }
        EXPECT_EQ(inVoids<D>(target, others), 0);
        EXPECT_TRUE(areInBox<D>(size, others));
      }
    }
  }
}

TYPED_TEST(MassCorrections, LeaveRightMassesWhereTheyAre)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = sizeFor<D>({ 60 }, { 32, 22 }, { 14, 8, 16 });
  const CellDensity<D> target = cellDensity(twoGaussians<D>(size));
  std::vector<double> masses;
  Particles<D> images = latticeOf<D>(target, 2, masses);
  const Particles<D> before = images;
  correct<D>(target, unequalSides<D>(), 1, images, masses);
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    for (int axis = 0; axis < D; ++axis)
    {
      ASSERT_NEAR(images[i][axis], before[i][axis], 1e-9);
    }
  }
}

// On a line, the first step is known: the cumulative error divided by the density, on nodes of the
// cells.
TEST(MassCorrections1D, MoveByTheCumulativeError)
{
  constexpr std::int64_t cells = 64;
  const CellDensity<1> target({ cells });
  // Masses 1 + .01 cos(2 pi x): too much at both ends.
  std::vector<double> masses;
  Particles<1> images = latticeOf<1>(target, 8, masses);
  const Particles<1> before = images;
  const double wave = 2.0 * std::acos(-1.0);
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    masses[i] *= 1.0 + 0.01 * std::cos(wave * images[i][0] / cells);
  }
  correct<1>(target, { 3.0 }, 1, images, masses);
  double error = 0.0;
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    // The quantiles of the masses.
    const double expected = 0.01 / wave * std::sin(wave * before[i][0] / cells) * cells;
    error = std::max(error, std::abs(images[i][0] - before[i][0] - expected));
  }
  EXPECT_LT(error, 0.02 * 0.01 / wave * cells);
}

TYPED_TEST(MassCorrections, MoveOtherPointsInTheSameWay)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = sizeFor<D>({ 61 }, { 33, 22 }, { 13, 9, 16 });
  const TestDensity<D> values = discWithHole<D>(size);
  const CellDensity<D> target = cellDensity(values);
  Particles<D> images = samplesOf<D>(distorted(values), 5000);
  Particles<D> others = images;
  const MassCorrection<D> correction = correct<D>(target, unequalSides<D>(), 2, images);
  EXPECT_NE(images, others);
  for (Point<D>& other : others)
  {
    correction.Move(other.data());
  }
  EXPECT_EQ(images, others);
}

TYPED_TEST(MassCorrections, AreUndone)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = sizeFor<D>({ 61 }, { 33, 22 }, { 13, 9, 16 });
  const TestDensity<D> values = twoGaussians<D>(size);
  const CellDensity<D> target = cellDensity(values);
  Particles<D> images = samplesOf<D>(distorted(values), 20000);
  const Particles<D> before = images;
  const MassCorrection<D> correction = correct<D>(target, unequalSides<D>(), 2, images);
  double moved = 0.0;
  double error = 0.0;
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    Point<D> undone = images[i];
    correction.Undo(undone.data());
    for (int axis = 0; axis < D; ++axis)
    {
      moved = std::max(moved, std::abs(images[i][axis] - before[i][axis]));
      error = std::max(error, std::abs(undone[axis] - before[i][axis]));
    }
  }
  EXPECT_GT(moved, 0.2) << "cells";
  EXPECT_LT(error, 0.02) << "cells";
}

TYPED_TEST(MassCorrections, DoNotDependOnUnitsOfLengthOrMass)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = sizeFor<D>({ 61 }, { 33, 22 }, { 13, 9, 16 });
  const TestDensity<D> values = twoGaussians<D>(size);
  const CellDensity<D> target = cellDensity(values);
  const Particles<D> before = samplesOf<D>(distorted(values), 4096);
  Particles<D> images = before;
  correct<D>(target, unequalSides<D>(), 1, images);
  Point<D> longer = unequalSides<D>();
  for (double& side : longer)
  {
    side *= 1024.0;
  }
  Particles<D> others = before;
  correct<D>(target, longer, 1, others, std::vector<double>(before.size(), 0x1p-12));
  double error = 0.0;
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    for (int axis = 0; axis < D; ++axis)
    {
      error = std::max(error, std::abs(images[i][axis] - others[i][axis]));
    }
  }
  EXPECT_LT(error, 1e-9);
}

TYPED_TEST(MassCorrections, SameBitsForEveryNumberOfThreads)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = sizeFor<D>({ 61 }, { 33, 22 }, { 13, 9, 16 });
  const TestDensity<D> values = discWithHole<D>(size);
  const CellDensity<D> target = cellDensity(values);
  const Particles<D> before = samplesOf<D>(distorted(values), 200000);
  Particles<D> expected = before;
  correct<D>(target, unequalSides<D>(), 1, expected);
  for (const int threads : { 1, 2, 3, 7 })
  {
    Particles<D> images = before;
    correct<D>(target, unequalSides<D>(), 1, images, {}, ThreadsExecutor(threads));
    EXPECT_EQ(images, expected) << threads;
  }
}

TYPED_TEST(MassCorrections, AreNoneWithoutImages)
{
  constexpr int D = TypeParam::value;
  const CellDensity<D> target = cellDensity(twoGaussians<D>(evenSize<D>(12)));
  Particles<D> images;
  const MassCorrection<D> correction = correct<D>(target, evenPoint<D>(1.0), 1, images);
  Point<D> point = evenPoint<D>(3.3);
  correction.Move(point.data());
  EXPECT_EQ(point, evenPoint<D>(3.3));
}

TYPED_TEST(MassCorrections, ReportAndCancel)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = sizeFor<D>({ 4000 }, { 90, 80 }, { 20, 20, 20 });
  const TestDensity<D> values = twoGaussians<D>(size);
  const CellDensity<D> target = cellDensity(values);
  const Particles<D> before = samplesOf<D>(distorted(values), 300000);
  const ThreadsExecutor threads(2);
  RecordingContext recording(threads);
  const auto run = [&]() {
    Particles<D> images = before;
    Progress progress(recording.Context());
    progress.Expect(4 * static_cast<std::int64_t>(before.size()));
    const MassCorrection<D> correction(target, evenPoint<D>(1.0), 1, images, nullptr, progress);
  };
  run();
  recording.ExpectReported(0.0, 1.0);
  const int queries = recording.Queries;
  EXPECT_GT(queries, 20);
  for (const int most : { 0, queries / 2, queries - 2 })
  {
    recording.Queries = 0;
    recording.MaximumQueries = most;
    EXPECT_THROW(run(), Cancelled);
  }
}

} // namespace
} // namespace RectifiedTransport
