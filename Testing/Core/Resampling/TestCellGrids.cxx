// SPDX-License-Identifier: BSD-3-Clause
// The grids of cells: the box around them, along axes of space or their own, and the lattice that
// boxes form.
#include "Core/Messages/Failure.h"
#include "Core/Resampling/CellFrame.h"
#include "Core/Resampling/CellLattice.h"

#include "TestCellSet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace RectifiedTransport
{
namespace
{

using Shape = CellShape;
using Eigen::Vector3d;

std::shared_ptr<TestCells> triangle(const Point<3>& a, const Point<3>& b, const Point<3>& c)
{
  return std::make_shared<TestCells>(std::vector<Point<3>>{ a, b, c },
    std::vector<TestCells::Cell>{ { Shape::Triangle, { 0, 1, 2 } } });
}

CellFrame frameOf(const std::shared_ptr<TestCells>& cells)
{
  Progress progress{ Context() };
  return CellFrame::Of({ cells }, { 2, false }, progress);
}

TEST(CellFrame, AlongSpace)
{
  const CellFrame frame = frameOf(triangle({ 1, 2, 5 }, { 4, 2, 5 }, { 1, 8, 5 }));
  EXPECT_EQ(frame.Axes, ImageGrid::Matrix(ImageGrid::Matrix::Identity()));
  EXPECT_EQ(Vector3d(frame.Box.min()), Vector3d(1, 2, 5));
  EXPECT_EQ(Vector3d(frame.Box.max()), Vector3d(4, 8, 5));
}

TEST(CellFrame, ObliquePlane)
{
  // In the plane x = z, whose axes are along (1, 0, 1) and y.
  const CellFrame frame = frameOf(triangle({ 0, 0, 0 }, { 3, 0, 3 }, { 0, 4, 0 }));
  Vector3d sides = frame.Box.sizes();
  std::sort(sides.data(), sides.data() + 3);
  EXPECT_EQ(sides[0], 0.0);
  EXPECT_NEAR(sides[1], 4.0, 1e-5);
  EXPECT_NEAR(sides[2], std::hypot(3, 3), 1e-5);
  EXPECT_NEAR(
    (frame.Axes * frame.Axes.transpose() - ImageGrid::Matrix::Identity()).norm(), 0.0, 1e-14);
}

bool arePlane(const std::vector<Point<3>>& points)
{
  return areInPlane(
    static_cast<std::int64_t>(points.size()), [&points](std::int64_t i, double* position) {
      std::copy_n(points[static_cast<std::size_t>(i)].data(), 3, position);
    });
}

TEST(CellFrame, PointsInAPlane)
{
  EXPECT_TRUE(arePlane({}));
  EXPECT_TRUE(arePlane({ { 1, 2, 3 }, { 1, 2, 3 } }));
  EXPECT_TRUE(arePlane({ { 1, 2, 3 }, { 3, 3, 4 }, { 5, 4, 5 } })); // on a line
  std::vector<Point<3>> points;
  for (int i = 0; i < 50; ++i)
  {
    const double u = i % 7;
    const double v = i * i % 11;
    points.push_back({ 1e3 + u + v, 2.0 * u - v, 5.0 - u });
  }
  EXPECT_TRUE(arePlane(points));
  points[9][1] = std::nan("");
  points[17][0] = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(arePlane(points));
  points[30][2] += 1e-6;
  EXPECT_TRUE(arePlane(points));
  points[30][2] += 1e-2;
  EXPECT_FALSE(arePlane(points));
}

// Whether the error for cells without a frame has these words.
bool fails(const std::shared_ptr<TestCells>& cells, const std::string& words)
{
  try
  {
    frameOf(cells);
  }
  catch (const Failure& failure)
  {
    return std::string(failure.what()).find(words) != std::string::npos;
  }
  return false;
}

TEST(CellFrame, Flaws)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto notFinite = triangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, nan, 0 });
  notFinite->Name = "input";
  EXPECT_TRUE(fails(notFinite, "Point 2 of the input is at (0, nan, 0)"));
  EXPECT_TRUE(fails(triangle({ 1, 1, 1 }, { 1, 1, 1 }, { 1, 1, 1 }), "are all at one place"));
  EXPECT_TRUE(
    fails(triangle({ -1.7e308, 0, 0 }, { 1.7e308, 0, 0 }, { 0, 1, 0 }), "past the largest double"));
  const auto bent = std::make_shared<TestCells>(
    std::vector<Point<3>>{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } },
    std::vector<TestCells::Cell>{
      { Shape::Triangle, { 0, 1, 2 } }, { Shape::Triangle, { 0, 1, 3 } } });
  EXPECT_TRUE(fails(bent, "faces that lie in no plane"));
  // Hidden cells may be anywhere.
  const auto hidden = triangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, nan, 0 });
  const unsigned char flags[] = { 1 };
  hidden->HiddenCells = { flags, 1 };
  EXPECT_NO_THROW(frameOf(hidden));
}

TEST(CellFrame, GridsHaveCellsNearToCubes)
{
  const CellFrame frame = frameOf(triangle({ 1, 2, 5 }, { 4, 2, 5 }, { 1, 8, 5 }));
  EXPECT_EQ(frame.Grid(10).NumberOfValues(), (std::array<int, 3>{ 5, 10, 1 }));
  EXPECT_THROW(frame.Grid(0), Failure);
}

// Quads of sides 2 and 1 at these places of a lattice that is turned about z, each begun at another
// corner.
std::shared_ptr<TestCells> quadsAt(const std::vector<std::array<int, 2>>& places, double turn)
{
  std::vector<Point<3>> points;
  std::vector<TestCells::Cell> cells;
  for (const auto& [i, j] : places)
  {
    const auto first = static_cast<std::int64_t>(points.size());
    CellReader::Ids ids;
    for (const auto& [di, dj] : { std::array<int, 2>{ 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } })
    {
      const double x = 2.0 * (i + di);
      const double y = j + dj;
      points.push_back(
        { x * std::cos(turn) - y * std::sin(turn), x * std::sin(turn) + y * std::cos(turn), 3 });
      ids.push_back(first + (static_cast<std::int64_t>(ids.size()) + first / 4) % 4);
    }
    cells.push_back({ Shape::Quad, ids });
  }
  return std::make_shared<TestCells>(points, cells);
}

TEST(CellLattice, TurnedQuads)
{
  const auto cells = quadsAt({ { 2, 0 }, { 0, 0 }, { 0, 1 } }, 0.3);
  Progress progress{ Context() };
  auto lattice = CellLattice::Find({ cells }, 2, progress);
  ASSERT_TRUE(lattice && lattice->Place(*cells, true, progress));
  EXPECT_EQ(lattice->Grid().NumberOfValues(), (std::array<int, 3>{ 3, 2, 1 }));
  EXPECT_NEAR(lattice->Grid().CellMeasure(), 2.0, 1e-12);
  EXPECT_EQ(lattice->DividedGrid(6).NumberOfValues(), (std::array<int, 3>{ 6, 4, 1 }));

  const CellValues values = valuesOf(cells, { 2, false }, false, { 7, 8, 9 });
  EXPECT_TRUE(lattice->HasEachOnce({ values }, progress));
  std::vector<double> density(6);
  lattice->CopyValues({ values }, density.data(), progress);
  EXPECT_EQ(density, (std::vector<double>{ 8, 0, 7, 9, 0, 0 }));

  std::vector<double> divided(24, 1.0);
  lattice->ClearAround({ values }, lattice->DividedGrid(6), divided.data(), progress);
  EXPECT_EQ(divided[0], 1.0);
  EXPECT_EQ(divided[2], 0.0);
  EXPECT_EQ(divided[4], 1.0);

  // A quarter along the sides of the first cell, and in a hole.
  const std::vector<CellValues> sets{ values };
  const LatticeLookup lookup(*lattice, sets, progress);
  const auto at = [](double x, double y) {
    return Point<3>{ x * std::cos(0.3) - y * std::sin(0.3), x * std::sin(0.3) + y * std::cos(0.3),
      3 };
  };
  const auto found = lookup.Find(at(4.5, 0.25).data());
  EXPECT_EQ(found.Cell, 0);
  EXPECT_EQ(found.Count, 4);
  double x[3] = { 0, 0, 0 };
  const auto reader = cells->Read();
  for (std::size_t i = 0; i < 4; ++i)
  {
    double corner[3];
    reader->GetPosition(found.Points[i], corner);
    for (int a = 0; a < 3; ++a)
    {
      x[a] += found.Weights[i] * corner[a];
    }
  }
  EXPECT_NEAR(x[0], at(4.5, 0.25)[0], 1e-12);
  EXPECT_NEAR(x[1], at(4.5, 0.25)[1], 1e-12);
  EXPECT_EQ(lookup.Find(at(3.0, 0.5).data()).Cell, -1);
}

TEST(CellLattice, NotOne)
{
  Progress progress{ Context() };
  // Two cells at one place.
  const auto twice = quadsAt({ { 0, 0 }, { 1, 0 }, { 0, 0 } }, 0.0);
  auto lattice = CellLattice::Find({ twice }, 2, progress);
  ASSERT_TRUE(lattice && lattice->Place(*twice, true, progress));
  EXPECT_FALSE(
    lattice->HasEachOnce({ valuesOf(twice, { 2, false }, false, { 1, 1, 1 }) }, progress));
  // Half a cell off.
  const auto off = std::make_shared<TestCells>(
    std::vector<Point<3>>{ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 1.5, 0, 0 },
      { 2.5, 0, 0 }, { 2.5, 1, 0 }, { 1.5, 1, 0 } },
    std::vector<TestCells::Cell>{
      { Shape::Quad, { 0, 1, 2, 3 } }, { Shape::Quad, { 4, 5, 6, 7 } } });
  lattice = CellLattice::Find({ off }, 2, progress);
  EXPECT_FALSE(lattice && lattice->Place(*off, true, progress));
  EXPECT_FALSE(CellLattice::Find({ triangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }) }, 2, progress));
}

} // namespace
} // namespace RectifiedTransport
