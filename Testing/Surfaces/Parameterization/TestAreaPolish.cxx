// SPDX-License-Identifier: BSD-3-Clause
// Sweeps that even areas out: the energy falls, sides and corners stay, threads do not matter.
#include "DiskSurfaces.h"
#include "RecordingContext.h"
#include "Surfaces/Parameterization/MapPolish.h"
#include "ThreadsExecutor.h"

#include "Surfaces/Parameterization/MapDistortion.h"

#include <gtest/gtest.h>

namespace RectifiedTransport
{
namespace
{

using Positions = std::vector<Point<2>>;

const SerialExecutor serial;

// Points moved so that areas change by up to a half; those of sides along them.
Positions unevenly(Positions positions)
{
  for (Point<2>& p : positions)
  {
    const Point<2> q = p;
    p[0] += 0.06 * std::sin(2.0 * pi * q[0]) * std::cos(pi * q[1]);
    p[1] += 0.05 * std::sin(pi * q[1]) * std::cos(3.0 * q[0]);
  }
  return positions;
}

double rootMeanSquare(const DiskMesh& disk, const Positions& positions)
{
  return measureDistortion(disk, positions, serial).AreaRootMeanSquare;
}

void expectOnSides(const SquareMap& square, const Positions& positions)
{
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      ASSERT_GE(positions[i][axis], 0.0);
      ASSERT_LE(positions[i][axis], 1.0);
      if (square.OnSides[i] >> axis & 1)
      {
        ASSERT_EQ(positions[i][axis], square.Positions[i][axis]) << "point " << i;
      }
    }
  }
}

TEST(AreaPolish, AreasBecomeEven)
{
  const SquareGrid grid(30);
  Positions positions = unevenly(grid.Square.Positions);
  double before = rootMeanSquare(grid.Disk, positions);
  ASSERT_GT(before, 0.2);
  for (int sweep = 0; sweep < 3; ++sweep)
  {
    polishAreas(grid.Parts, sweep, positions, serial);
    const double after = rootMeanSquare(grid.Disk, positions);
    EXPECT_LT(after, 0.5 * before) << sweep;
    before = after;
    expectOnSides(grid.Square, positions);
  }
  EXPECT_LT(before, 1e-3);
  EXPECT_EQ(measureDistortion(grid.Disk, positions).Flipped, 0);
}

// From anywhere: with points at random places, full steps would often make it worse.
TEST(AreaPolish, EnergyFalls)
{
  const SquareGrid grid(12);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> number(0.0, 1.0);
  for (int run = 0; run < 20; ++run)
  {
    Positions positions = grid.Square.Positions;
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        positions[i][axis] =
          grid.Square.OnSides[i] >> axis & 1 ? positions[i][axis] : number(random);
      }
    }
    double before = rootMeanSquare(grid.Disk, positions);
    for (int sweep = 1; sweep < 6; ++sweep) // the first one, 0, also smooths
    {
      polishAreas(grid.Parts, sweep, positions, serial);
      const double after = rootMeanSquare(grid.Disk, positions);
      EXPECT_LE(after, before * (1.0 + 1e-12));
      before = after;
    }
    EXPECT_LT(before, 2.0);
  }
}

// What is even already moves by rounding only, after the first sweep, which smooths.
TEST(AreaPolish, EvenAreasStay)
{
  const SquareGrid grid(20);
  Positions positions = grid.Square.Positions;
  polishAreas(grid.Parts, 1, positions, serial);
  EXPECT_LT(largestDifference(positions, grid.Square.Positions), 1e-12);
  polishAreas(grid.Parts, 0, positions, serial);
  EXPECT_LT(largestDifference(positions, grid.Square.Positions), 1e-6);
}

TEST(AreaPolish, FlippedTrianglesTurnBack)
{
  const SquareGrid grid(20);
  Positions positions = grid.Square.Positions;
  for (const std::size_t point : { 47, 200, 333 })
  {
    positions[point][0] += 1.3 / 20.0;
  }
  ASSERT_GE(measureDistortion(grid.Disk, positions).Flipped, 3);
  for (int sweep = 0; sweep < 3; ++sweep)
  {
    polishAreas(grid.Parts, sweep, positions, serial);
  }
  EXPECT_EQ(measureDistortion(grid.Disk, positions).Flipped, 0);
  EXPECT_LT(rootMeanSquare(grid.Disk, positions), 0.01);
  expectOnSides(grid.Square, positions);
}

// Several tiles and groups.
TEST(AreaPolish, ThreadsAndTiles)
{
  const SquareGrid grid(150);
  const Positions uneven = unevenly(grid.Square.Positions);
  Positions reference = uneven;
  polishAreas(grid.Parts, 0, reference, serial);
  EXPECT_LT(rootMeanSquare(grid.Disk, reference), 0.85 * rootMeanSquare(grid.Disk, uneven));
  for (const int threads : { 1, 2, 3 })
  {
    Positions positions = uneven;
    polishAreas(grid.Parts, 0, positions, ThreadsExecutor(threads));
    EXPECT_TRUE(sameBits(positions, reference)) << threads;
  }
}

TEST(AreaPolish, ProgressAndCancel)
{
  const SquareGrid grid(150);
  const Positions uneven = unevenly(grid.Square.Positions);
  RecordingContext whole(serial);
  Positions positions = uneven;
  polishAreas(grid.Parts, 0, positions, whole.Context());
  whole.ExpectReported(0.0, 1.0);
  ASSERT_GT(whole.Queries, 20);
  for (const int maximum : { 0, 1, whole.Queries / 2 })
  {
    RecordingContext recorder(serial);
    recorder.MaximumQueries = maximum;
    positions = uneven;
    EXPECT_THROW(polishAreas(grid.Parts, 0, positions, recorder.Context()), Cancelled);
    EXPECT_EQ(recorder.Queries, maximum + 1);
  }
}

} // namespace
} // namespace RectifiedTransport
