// SPDX-License-Identifier: BSD-3-Clause
// Cells on grids: which carry mass, exact means over grid cells, regions within outlines, and
// places among the cells' points.
#include "Core/Resampling/CellLocator.h"
#include "Core/Resampling/CellSums.h"
#include "Core/Resampling/RegionShapes.h"
#include "Core/Resampling/RingValues.h"

#include "TestCellSet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace RectifiedTransport
{
namespace
{

using Values = std::vector<double>;
using Shape = CellShape;

struct Means
{
  Values Cells;
  CellSize Size;
};

Means meansOn(const ImageGrid& grid, std::vector<CellValues> sets)
{
  Progress progress{ Context() };
  if (grid.Dimension() == 2)
  {
    markRegions(sets, grid, progress);
  }
  Means means{ Values(static_cast<std::size_t>(grid.NumberOfCells()), -1.0), {} };
  means.Size = resampleCells(sets, grid, progress, means.Cells.data());
  return means;
}

double sumOf(const Values& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// Two triangles of the rectangle [0,3] x [0,2].
std::shared_ptr<TestCells> twoTriangles()
{
  return std::make_shared<TestCells>(
    std::vector<Point<3>>{ { 0, 0, 0 }, { 3, 0, 0 }, { 3, 2, 0 }, { 0, 2, 0 } },
    std::vector<TestCells::Cell>{
      { Shape::Triangle, { 0, 1, 2 } }, { Shape::Triangle, { 0, 2, 3 } } });
}

TEST(CellSums, LinearOnTriangles)
{
  // The density x + 10 y has its value at the middle of each cell as mean.
  const auto means =
    meansOn(unitGrid(3, 2), { valuesOf(twoTriangles(), { 2, false }, true, { 0, 3, 23, 20 }) });
  for (int y = 0; y < 2; ++y)
  {
    for (int x = 0; x < 3; ++x)
    {
      EXPECT_NEAR(
        means.Cells[static_cast<std::size_t>(x + 3 * y)], x + 0.5 + 10 * (y + 0.5), 1e-13);
    }
  }
  EXPECT_NEAR(means.Size.Measure, 6.0, 1e-14);
  EXPECT_NEAR(means.Size.Integral, sumOf(means.Cells), 1e-12);
  EXPECT_EQ(means.Size.LeftOut, 0);
}

TEST(CellSums, MissingAndHidden)
{
  const auto cells = twoTriangles();
  const MassCells mass{ 2, false };
  const ImageGrid grid = unitGrid(3, 2);
  EXPECT_NEAR(sumOf(meansOn(grid, { valuesOf(cells, mass, false, { 5, 7 }) }).Cells), 36.0, 1e-13);
  EXPECT_NEAR(
    sumOf(meansOn(grid, { valuesOf(cells, mass, false, { 5, 7 }, { 0, 1 }) }).Cells), 15.0, 1e-13);
  // A point without a value takes its cells with it.
  EXPECT_NEAR(
    sumOf(meansOn(grid, { valuesOf(cells, mass, true, { 1, 1, 1, 1 }, { 0, 1, 0, 0 }) }).Cells),
    3.0, 1e-13);
  const unsigned char ofCells[] = { 4, 2 };
  cells->HiddenCells = { ofCells, 2 };
  EXPECT_NEAR(sumOf(meansOn(grid, { valuesOf(cells, mass, false, { 5, 7 }) }).Cells), 15.0, 1e-13);
  cells->HiddenCells = {};
  const unsigned char ofPoints[] = { 0, 8, 0, 0 };
  cells->HiddenPoints = { ofPoints, 8 };
  EXPECT_NEAR(sumOf(meansOn(grid, { valuesOf(cells, mass, false, { 5, 7 }) }).Cells), 21.0, 1e-13);
}

TEST(CellSums, OnlyAndGround)
{
  const CellValues values = valuesOf(twoTriangles(), { 2, false }, false, { 5, 7 });
  const ImageGrid grid = unitGrid(3, 2);
  EXPECT_NEAR(sumOf(meansOn(grid, { values.Only(7) }).Cells), 21.0, 1e-13);
  for (const double share : meansOn(grid, { values.Ground() }).Cells)
  {
    EXPECT_NEAR(share, 1.0, 1e-15);
  }
  Progress progress{ Context() };
  EXPECT_NEAR(integralOf({ values, values.Only(5) }, grid, progress), 36.0 + 15.0, 1e-12);
}

TEST(CellSums, BoxesAreMultilinear)
{
  // The density x y z of a voxel, whose integral over a cell is the product of those along the
  // axes.
  std::vector<Point<3>> points;
  Values values;
  for (int i = 0; i < 8; ++i)
  {
    points.push_back({ 2.0 * (i & 1), 2.0 * (i >> 1 & 1), 2.0 * (i >> 2 & 1) });
    values.push_back(points.back()[0] * points.back()[1] * points.back()[2]);
  }
  const auto cells = std::make_shared<TestCells>(
    points, std::vector<TestCells::Cell>{ { Shape::Voxel, { 0, 1, 2, 3, 4, 5, 6, 7 } } });
  const Means means = meansOn(unitGrid(2, 2, 2), { valuesOf(cells, { 3, false }, true, values) });
  for (std::size_t i = 0; i < 8; ++i)
  {
    const double expected = (i & 1 ? 1.5 : 0.5) * (i & 2 ? 1.5 : 0.5) * (i & 4 ? 1.5 : 0.5);
    EXPECT_NEAR(means.Cells[i], expected, 1e-14);
  }
}

TEST(CellSums, CellsThatCannotBeDivided)
{
  const auto cells = std::make_shared<TestCells>(
    std::vector<Point<3>>{ { 0, 0, 0 }, { 2, 0, 0 }, { 0, 1, 0 }, { 2, 1, 3 } },
    std::vector<TestCells::Cell>{ { Shape::Hexahedron, { 0, 1, 2, 3 } } });
  const Means means = meansOn(unitGrid(2, 2, 2), { valuesOf(cells, { 3, false }, false, { 4 }) });
  EXPECT_EQ(means.Size.LeftOut, 1);
  EXPECT_EQ(means.Size.FirstLeftOut, 0);
  EXPECT_EQ(means.Size.LeftOutMeasure, 6.0);
  EXPECT_EQ(means.Size.LeftOutIntegral, 24.0);
  EXPECT_EQ(sumOf(means.Cells), 0.0);
}

TEST(CellSums, ConcavePolygon)
{
  // An L of three unit squares, of which a fan would cover another area.
  const auto cells =
    std::make_shared<TestCells>(std::vector<Point<3>>{ { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 0 },
                                  { 2, 0, 0 }, { 2, 2, 0 }, { 1, 2, 0 } },
      std::vector<TestCells::Cell>{ { Shape::Polygon, { 0, 1, 2, 3, 4, 5 } } });
  EXPECT_EQ(meansOn(unitGrid(2, 2), { valuesOf(cells, { 2, false }, false, { 3 }) }).Cells,
    (Values{ 3, 3, 0, 3 }));
}

TEST(CellSums, ClosedLinesWithAHole)
{
  std::vector<Point<3>> points;
  for (const double side : { 4.0, 2.0 })
  {
    const double low = 2.0 - 0.5 * side;
    points.insert(points.end(),
      { { low, low, 0 }, { low + side, low, 0 }, { low + side, low + side, 0 },
        { low, low + side, 0 } });
  }
  const auto cells = std::make_shared<TestCells>(points,
    std::vector<TestCells::Cell>{ { Shape::PolyLine, { 0, 1, 2, 3, 0 } },
      { Shape::PolyLine, { 4, 5, 6, 7, 4 } }, { Shape::PolyLine, { 0, 1, 2 } } });
  Progress progress{ Context() };
  const MassCells mass = massCells({ cells }, 1, progress);
  EXPECT_TRUE(mass.AreClosedLines);
  EXPECT_EQ(mass.Dimension, 2);
  const CellValues values = valuesOf(cells, mass, false, { 6, 6, 6 });
  EXPECT_EQ(values.OpenLines(), 1);
  EXPECT_EQ(values.FirstOpenLine(), 2);
  const Means means = meansOn(unitGrid(4, 4), { values });
  EXPECT_EQ(means.Cells[0], 6.0);
  EXPECT_EQ(means.Cells[5], 0.0);
  EXPECT_NEAR(sumOf(means.Cells), 72.0, 1e-12);
  // On a straight line they are lines.
  const auto straight =
    std::make_shared<TestCells>(std::vector<Point<3>>{ { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } },
      std::vector<TestCells::Cell>{ { Shape::PolyLine, { 0, 1, 2, 0 } } });
  EXPECT_FALSE(massCells({ straight }, 1, progress).AreClosedLines);
}

TEST(RingValues, PlaneOfSquare)
{
  Rings rings;
  for (const Point<2>& x :
    { Point<2>{ 0, 0 }, Point<2>{ 2, 0 }, Point<2>{ 2, 2 }, Point<2>{ 0, 2 } })
  {
    rings.Add(x);
  }
  rings.EndRing();
  const double values[] = { 1, 3, 13, 11 }; // 1 + x + 5 y
  const RingValues plane(rings, 0, values);
  EXPECT_NEAR(plane.Mean(), 7.0, 1e-14);
  EXPECT_NEAR(plane.At({ 0.5, 1.5 }), 9.0, 1e-13);
  EXPECT_EQ(plane.At({ 9.0, 9.0 }), 13.0);
}

TEST(CellLocator, OnTriangles)
{
  const CellValues values = valuesOf(twoTriangles(), { 2, false }, false, { 5, 7 });
  const std::vector<Point<3>> places{ { 2, 0.5, 0 }, { 0.5, 1.5, 0 }, { 1.5, 2.5, 0 },
    { 1.5, 5, 0 } };
  Progress progress{ Context() };
  const auto found = locateInCells({ values }, unitGrid(3, 6), places, progress);
  EXPECT_EQ(found.data()[0].Cell, 0);
  EXPECT_EQ(found.data()[1].Cell, 1);
  EXPECT_EQ(found.data()[2].Cell, 1); // beyond its edge
  EXPECT_EQ(found.data()[3].Cell, -1);
  const Point<3> corners[] = { { 0, 0, 0 }, { 3, 0, 0 }, { 3, 2, 0 }, { 0, 2, 0 } };
  for (std::size_t p = 0; p < 2; ++p)
  {
    EXPECT_EQ(found.data()[p].Distance, 0.0);
    Point<2> at{ 0, 0 };
    for (std::size_t i = 0; i < 4; ++i)
    {
      const auto corner = static_cast<std::size_t>(found.data()[p].Points[i]);
      at[0] += found.data()[p].Weights[i] * corners[corner][0];
      at[1] += found.data()[p].Weights[i] * corners[corner][1];
    }
    EXPECT_NEAR(at[0], places[p][0], 1e-14);
    EXPECT_NEAR(at[1], places[p][1], 1e-14);
  }
  EXPECT_GE(found.data()[2].Distance, 0.25);
  EXPECT_LT(found.data()[2].Distance, 1.0);
}

} // namespace
} // namespace RectifiedTransport
