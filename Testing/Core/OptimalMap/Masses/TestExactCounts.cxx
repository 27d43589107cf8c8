// SPDX-License-Identifier: BSD-3-Clause
// Exact counts: of particles in all boxes that halve the grid, by a recursion of their own; what
// stays, what leaves voids; the same bits for every number of threads.
#include "Core/OptimalMap/Masses/ExactCounts.h"

#include "OptimalMap/Masses/ParticleMasses.h"
#include "RecordingContext.h"
#include "TestDimensions.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <string>

namespace RectifiedTransport
{
namespace
{

template <int D>
std::int64_t makeExact(const CellDensity<D>& density, const Point<D>& sides,
  Particles<D>& particles, const Executor& threads = SerialExecutor())
{
  Progress progress(threads);
  return makeCountsExact<D>(density, sides, particles, progress);
}

// Expects floor or ceil of its share in each half of a box of at least five particles, and of its
// halves.
template <int D>
void expectExact(const CellDensity<D>& density, const Point<D>& sides, const GridBox<D>& box,
  const Particles<D>& particles)
{
  int axis = -1;
  double longest = 0.0;
  for (int a = 0; a < D; ++a)
  {
    const std::int64_t cells = box.High[a] - box.Low[a];
    if (cells > 1 && static_cast<double>(cells) * sides[a] > longest)
    {
      longest = static_cast<double>(cells) * sides[a];
      axis = a;
    }
  }
  if (axis < 0 || particles.size() < 5)
  {
    return;
  }
  GridBox<D> halves[2] = { box, box };
  halves[0].High[axis] = box.Low[axis] + (box.High[axis] - box.Low[axis] + 1) / 2;
  halves[1].Low[axis] = halves[0].High[axis];
  double masses[2] = { 0.0, 0.0 };
  for (std::int64_t cell = 0; cell < density.NumberOfCells(); ++cell)
  {
    for (int half = 0; half < 2; ++half)
    {
      masses[half] +=
        isIn<D>(cellAt<D>(cell, density.Size()), halves[half]) ? density.Share(cell) : 0.0;
    }
  }
  Particles<D> parts[2];
  for (const Point<D>& particle : particles)
  {
    parts[particle[axis] < static_cast<double>(halves[1].Low[axis]) ? 0 : 1].push_back(particle);
  }
  for (int half = 0; half < 2; ++half)
  {
    const double share =
      static_cast<double>(particles.size()) * masses[half] / (masses[0] + masses[1]);
    const auto count = static_cast<double>(parts[half].size());
    ASSERT_GE(count, std::floor(share - 1e-9)) << "of " << particles.size();
    ASSERT_LE(count, std::ceil(share + 1e-9)) << "of " << particles.size();
    if (masses[half] == 0.0)
    {
      ASSERT_EQ(parts[half].size(), 0U);
    }
    expectExact<D>(density, sides, halves[half], parts[half]);
  }
}

template <int D>
void expectExact(
  const CellDensity<D>& density, const Point<D>& sides, const Particles<D>& particles)
{
  expectExact<D>(density, sides, { {}, density.Size() }, particles);
  EXPECT_EQ(inVoids<D>(density, particles), 0);
  EXPECT_TRUE(areInBox<D>(density.Size(), particles));
}

template <int D>
GridSize<D> someSize()
{
  return sizeFor<D>({ 300 }, { 37, 22 }, { 13, 9, 16 });
}

template <int D>
Point<D> unitSides()
{
  return evenPoint<D>(1.0);
}

template <int D>
Point<D> unequalSides()
{
  Point<D> sides;
  for (int axis = 0; axis < D; ++axis)
  {
    sides[axis] = axis == 0 ? 0.3 : 1.7 * axis;
  }
  return sides;
}

template <class T>
using ExactCounts = DimensionTest<T>;
TYPED_TEST_SUITE(ExactCounts, Dimensions, );

TYPED_TEST(ExactCounts, AreFloorOrCeilInAllHalves)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = someSize<D>();
  const TestDensity<D> densities[] = { twoGaussians<D>(size), discWithHole<D>(size),
    randomCells<D>(size), checker<D>(size, 3), dirac<D>(size, cellAt<D>(77, size)),
    uniformDensity<D>(size) };
  for (const TestDensity<D>& values : densities)
  {
    const CellDensity<D> density = cellDensity(values);
    for (const Point<D>& sides : { unitSides<D>(), unequalSides<D>() })
    {
      for (const std::size_t number : { 0U, 1U, 4U, 5U, 333U, 20000U })
      {
        Particles<D> particles = samplesOf<D>(uniformDensity<D>(size), number);
        makeExact<D>(density, sides, particles);
        SCOPED_TRACE("density " + std::to_string(&values - densities) + ", " +
          std::to_string(number) + " particles");
        expectExact<D>(density, sides, particles);
      }
    }
  }
}

TYPED_TEST(ExactCounts, OfTheUniformMeasure)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = someSize<D>();
  const CellDensity<D> density(size);
  Particles<D> particles = samplesOf<D>(twoGaussians<D>(size), 20000);
  EXPECT_GT(makeExact<D>(density, unequalSides<D>(), particles), 1000);
  expectExact<D>(density, unequalSides<D>(), particles);
}

TYPED_TEST(ExactCounts, OfOneCell)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = evenSize<D>(1);
  const Particles<D> before = samplesOf<D>(uniformDensity<D>(size), 100);
  for (const CellDensity<D>& density :
    { CellDensity<D>(size), cellDensity(uniformDensity<D>(size)) })
  {
    Particles<D> particles = before;
    EXPECT_EQ(makeExact<D>(density, unitSides<D>(), particles), 0);
    EXPECT_EQ(particles, before);
  }
}

TYPED_TEST(ExactCounts, OfParticlesInOnePlaceOrOnFaces)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = someSize<D>();
  const CellDensity<D> density = cellDensity(discWithHole<D>(size));
  Point<D> last;
  Point<D> middle;
  for (int axis = 0; axis < D; ++axis)
  {
    last[axis] = static_cast<double>(size[axis]);
    middle[axis] = static_cast<double>((size[axis] + 1) / 2);
  }
  for (const Point<D>& place : { Point<D>{}, middle, last, evenPoint<D>(4.0) })
  {
    Particles<D> particles(5000, place);
    makeExact<D>(density, unitSides<D>(), particles);
    expectExact<D>(density, unitSides<D>(), particles);
  }
  // At the cells' corners.
  Particles<D> particles = samplesOf<D>(uniformDensity<D>(size), 5000);
  for (Point<D>& particle : particles)
  {
    for (double& coordinate : particle)
    {
      coordinate = std::round(coordinate);
    }
  }
  makeExact<D>(density, unitSides<D>(), particles);
  expectExact<D>(density, unitSides<D>(), particles);
}

TYPED_TEST(ExactCounts, LeaveRightParticlesWhereTheyAre)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = someSize<D>();
  // As many as there should be: 3 in each cell that has mass.
  const CellDensity<D> density = cellDensity(checker<D>(size, 2));
  Particles<D> particles;
  for (const Point<D>& sample : samplesOf<D>(uniformDensity<D>(evenSize<D>(1)), 3))
  {
    for (std::int64_t cell = 0; cell < density.NumberOfCells(); ++cell)
    {
      if (density.Share(cell) > 0.0)
      {
        Point<D> particle = sample;
        const GridSize<D> place = cellAt<D>(cell, size);
        std::transform(place.begin(), place.end(), particle.begin(), particle.begin(),
          [](std::int64_t a, double b) { return static_cast<double>(a) + b; });
        particles.push_back(particle);
      }
    }
  }
  const Particles<D> before = particles;
  EXPECT_EQ(makeExact<D>(density, unitSides<D>(), particles), 0);
  EXPECT_EQ(particles, before);
  // One that is in a wrong cell comes back to its neighbour, and no other one moves.
  particles[0] = particles[1];
  const Particles<D> wrong = particles;
  EXPECT_GE(makeExact<D>(density, unitSides<D>(), particles), 1);
  std::size_t moved = 0;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    moved += particles[i] != wrong[i] ? 1 : 0;
  }
  EXPECT_GE(moved, 1U);
  EXPECT_LE(moved, 12U);
  // What was done once is right.
  Particles<D> any = samplesOf<D>(uniformDensity<D>(size), 4000);
  const CellDensity<D> gaussians = cellDensity(twoGaussians<D>(size));
  EXPECT_GT(makeExact<D>(gaussians, unitSides<D>(), any), 100);
  const Particles<D> once = any;
  EXPECT_EQ(makeExact<D>(gaussians, unitSides<D>(), any), 0);
  EXPECT_EQ(any, once);
}

TYPED_TEST(ExactCounts, ImproveOtherBoxes)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = sizeFor<D>({ 512 }, { 64, 48 }, { 24, 24, 24 });
  const TestDensity<D> values = twoGaussians<D>(size);
  const CellDensity<D> density = cellDensity(values);
  Particles<D> particles = samplesOf<D>(values, 40000);
  const auto blocks = blocksOf<D>(size, 6, 3);
  const auto boxes = randomBoxes<D>(size, 100);
  const double blocksBefore = massError<D>(density, particles, {}, blocks);
  const double boxesBefore = massError<D>(density, particles, {}, boxes);
  makeExact<D>(density, unitSides<D>(), particles);
  EXPECT_LT(massError<D>(density, particles, {}, blocks), 0.5 * blocksBefore);
  EXPECT_LT(massError<D>(density, particles, {}, boxes), 0.4 * boxesBefore);
}

TYPED_TEST(ExactCounts, MoveParticlesToTheirMirrorImages)
{
  constexpr int D = TypeParam::value;
  // Two cells, all of ten particles in the first one: the nearest five cross the plane.
  GridSize<D> size = evenSize<D>(1);
  size[0] = 2;
  const CellDensity<D> density(size);
  Particles<D> particles(10, evenPoint<D>(0.25));
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    particles[i][0] = 0.05 + 0.09 * static_cast<double>((7 * i) % 10);
  }
  const Particles<D> before = particles;
  EXPECT_EQ(makeExact<D>(density, unitSides<D>(), particles), 5);
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    Point<D> expected = before[i];
    if ((7 * i) % 10 >= 5)
    {
      expected[0] = 2.0 - expected[0];
    }
    EXPECT_EQ(particles[i], expected);
  }
  // Of equal ones, the first numbers.
  Particles<D> equal(10, evenPoint<D>(0.25));
  EXPECT_EQ(makeExact<D>(density, unitSides<D>(), equal), 5);
  for (std::size_t i = 0; i < equal.size(); ++i)
  {
    EXPECT_EQ(equal[i][0], i < 5 ? 1.75 : 0.25);
  }
}

TYPED_TEST(ExactCounts, MoveParticlesToTheNearestMassBeyondAVoid)
{
  constexpr int D = TypeParam::value;
  // Mass in the first and the third of four cells: mirror images are in the fourth one.
  GridSize<D> size = evenSize<D>(1);
  size[0] = 4;
  TestDensity<D> values = uniformDensity<D>(size, 0.0);
  values.Values[0] = 1.0;
  values.Values[2] = 1.0;
  Particles<D> particles(10, evenPoint<D>(0.5));
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    particles[i][0] = 0.0625 * static_cast<double>(i + 1);
  }
  const Particles<D> before = particles;
  EXPECT_EQ(makeExact<D>(cellDensity(values), unitSides<D>(), particles), 5);
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    const double at = before[i][0];
    EXPECT_EQ(particles[i][0], i < 5 ? at : 2.0 + (1.0 - at));
  }
}

TYPED_TEST(ExactCounts, MoveTheNearestParticlesFarFromThePlane)
{
  constexpr int D = TypeParam::value;
  GridSize<D> size = evenSize<D>(1);
  size[0] = 64;
  TestDensity<D> values = uniformDensity<D>(size, 0.0);
  values.Values.front() = 9.0;
  values.Values.back() = 1.0;
  Particles<D> particles = samplesOf<D>(uniformDensity<D>(evenSize<D>(1)), 1000);
  Particles<D> before = particles;
  EXPECT_EQ(makeExact<D>(cellDensity(values), unitSides<D>(), particles), 100);
  std::vector<double> places;
  for (const Point<D>& particle : before)
  {
    places.push_back(particle[0]);
  }
  std::sort(places.begin(), places.end());
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    EXPECT_EQ(particles[i][0] > 32.0, before[i][0] >= places[900]);
  }
}

TYPED_TEST(ExactCounts, SameBitsForEveryNumberOfThreads)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = someSize<D>();
  const CellDensity<D> density = cellDensity(discWithHole<D>(size));
  const Particles<D> before = samplesOf<D>(randomCells<D>(size), 30000);
  Particles<D> expected = before;
  const std::int64_t moves = makeExact<D>(density, unequalSides<D>(), expected);
  for (const int threads : { 1, 2, 3, 7 })
  {
    Particles<D> particles = before;
    EXPECT_EQ(makeExact<D>(density, unequalSides<D>(), particles, ThreadsExecutor(threads)), moves);
    EXPECT_EQ(particles, expected) << threads;
  }
}

TYPED_TEST(ExactCounts, ReportAndCancel)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = someSize<D>();
  const CellDensity<D> density = cellDensity(twoGaussians<D>(size));
  const Particles<D> before = samplesOf<D>(uniformDensity<D>(size), 300000);
  const ThreadsExecutor threads(2);
  RecordingContext recording(threads);
  {
    Particles<D> particles = before;
    Progress progress(recording.Context());
    progress.Expect(static_cast<std::int64_t>(before.size()));
    makeCountsExact<D>(density, unitSides<D>(), particles, progress);
    recording.ExpectReported(0.0, 1.0);
  }
  const int queries = recording.Queries;
  EXPECT_GT(queries, 30);
  for (const int most : { 0, queries / 3, queries - 5 })
  {
    Particles<D> particles = before;
    recording.Queries = 0;
    recording.MaximumQueries = most;
    Progress progress(recording.Context());
    EXPECT_THROW(makeCountsExact<D>(density, unitSides<D>(), particles, progress), Cancelled);
  }
}

} // namespace
} // namespace RectifiedTransport
