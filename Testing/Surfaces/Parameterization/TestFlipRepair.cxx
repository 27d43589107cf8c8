// SPDX-License-Identifier: BSD-3-Clause
// Flipped triangles that are turned over again, by moves of the points about them only.
#include "DiskSurfaces.h"
#include "RecordingContext.h"
#include "Surfaces/Parameterization/MapPolish.h"
#include "ThreadsExecutor.h"

#include "Surfaces/Parameterization/MapDistortion.h"

#include <gtest/gtest.h>

#include <set>

namespace RectifiedTransport
{
namespace
{

using Positions = std::vector<Point<2>>;

const SerialExecutor serial;
constexpr std::int64_t cells = 40;

struct FlippedGrid : SquareGrid
{
  FlippedGrid()
    : SquareGrid(cells)
    , Positions(Square.Positions)
  {
    const double step = 1.0 / static_cast<double>(cells);
    this->Move(10, 12, 1.4 * step, 0.0);
    this->Move(11, 30, -0.9 * step, -1.2 * step);
    this->Move(30, 30, 0.0, 2.6 * step);
    this->Move(25, 1, 0.2 * step, -step); // onto the lower side
    this->Move(40, 20, 0.0, 1.5 * step);  // along the right side
  }

  void Move(std::int64_t i, std::int64_t j, double x, double y)
  {
    Point<2>& position = this->Positions[static_cast<std::size_t>(j * (cells + 1) + i)];
    position = { position[0] + x, position[1] + y };
  }

  // The points of flipped triangles, and of so many rings of triangles about them.
  std::set<std::int64_t> PointsWithin(int rings) const
  {
    std::set<std::int64_t> points;
    for (std::int64_t t = 0; t < this->Disk.NumberOfTriangles(); ++t)
    {
      if (!(turnOf(this->Disk, t, this->Positions) > 0.0))
      {
        points.insert(this->Disk.Triangle(t), this->Disk.Triangle(t) + 3);
      }
    }
    for (int ring = 0; ring < rings; ++ring)
    {
      const std::set<std::int64_t> before = points;
      for (std::int64_t t = 0; t < this->Disk.NumberOfTriangles(); ++t)
      {
        const std::int64_t* corners = this->Disk.Triangle(t);
        if (std::any_of(
              corners, corners + 3, [&](std::int64_t id) { return before.count(id) > 0; }))
        {
          points.insert(corners, corners + 3);
        }
      }
    }
    return points;
  }

  std::vector<Point<2>> Positions;
};

TEST(FlipRepair, TurnsTrianglesBack)
{
  for (const int rings : { 1, 2, 3 })
  {
    const FlippedGrid grid;
    ASSERT_GE(measureDistortion(grid.Disk, grid.Positions).Flipped, 6);
    Positions positions = grid.Positions;
    repairFlips(grid.Parts, rings, positions, serial);
    EXPECT_EQ(measureDistortion(grid.Disk, positions).Flipped, 0) << rings;
    const std::set<std::int64_t> patch = grid.PointsWithin(rings);
    std::size_t moved = 0;
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
      if (patch.count(static_cast<std::int64_t>(i)) == 0)
      {
        ASSERT_EQ(positions[i], grid.Positions[i]) << i;
      }
      moved += positions[i] != grid.Positions[i] ? 1 : 0;
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        if (grid.Square.OnSides[i] >> axis & 1)
        {
          ASSERT_EQ(positions[i][axis], grid.Square.Positions[i][axis]);
        }
      }
    }
    EXPECT_GT(moved, patch.size() / 2);
  }
}

// Without flips nothing moves.
TEST(FlipRepair, NothingToDo)
{
  const FlippedGrid grid;
  Positions positions = grid.Square.Positions;
  repairFlips(grid.Parts, 3, positions, serial);
  EXPECT_TRUE(sameBits(positions, grid.Square.Positions));
}

// Triangles with three points on a side cannot be turned, and do not keep others from it; a patch
// of no others stays as it is.
TEST(FlipRepair, CollapsedTrianglesStay)
{
  const DiskMesh disk(makeRectangle(10, 4).Surface());
  // On the lower side all points to the right of the left half, and the right border.
  const SquareMap square = mapConformally(disk, { 0, 5, 54, 44 }).Square;
  const MapParts parts(disk, square);
  const std::int64_t collapsed = countCollapsed(disk, square.Corners);
  ASSERT_EQ(collapsed, 1); // the triangle at the lower right corner
  Positions positions = square.Positions;
  repairFlips(parts, 0, positions, serial);
  EXPECT_EQ(measureDistortion(disk, positions).Flipped, collapsed);
  positions[24] = { positions[24][0] + 0.4, positions[24][1] };
  ASSERT_GT(measureDistortion(disk, positions).Flipped, collapsed);
  repairFlips(parts, 2, positions, serial);
  EXPECT_EQ(measureDistortion(disk, positions).Flipped, collapsed);
}

TEST(FlipRepair, ThreadsAndCancel)
{
  const FlippedGrid grid;
  Positions reference = grid.Positions;
  repairFlips(grid.Parts, 2, reference, serial);
  for (const int threads : { 1, 2, 3 })
  {
    Positions positions = grid.Positions;
    repairFlips(grid.Parts, 2, positions, ThreadsExecutor(threads));
    EXPECT_TRUE(sameBits(positions, reference)) << threads;
  }
  RecordingContext whole(serial);
  Positions positions = grid.Positions;
  repairFlips(grid.Parts, 2, positions, whole.Context());
  whole.ExpectReported(0.0, 1.0);
  RecordingContext recorder(serial);
  recorder.MaximumQueries = 0;
  EXPECT_THROW(
    repairFlips(grid.Parts, 2, positions = grid.Positions, recorder.Context()), Cancelled);
}

} // namespace
} // namespace RectifiedTransport
