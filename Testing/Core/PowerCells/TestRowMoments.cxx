// SPDX-License-Identifier: BSD-3-Clause
// Integrals over polygons: against closed forms, and against the polygons cut by the grid.
#include "Core/PowerCells/RowMoments.h"

#include "TestPowerCells.h"
#include "ThreadsExecutor.h"

#include "Core/Parallel/Progress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace RectifiedTransport
{
namespace
{

// Counter-clockwise, on an ellipse about `centre`.
Points<2> randomPolygon(
  std::mt19937_64& engine, const Point<2>& centre, const Point<2>& radii, int corners)
{
  constexpr double turn = 6.283185307179586;
  std::vector<double> angles;
  for (int k = 0; k < corners; ++k)
  {
    angles.push_back(turn * uniformNumber(engine));
  }
  std::sort(angles.begin(), angles.end());
  Points<2> polygon;
  for (const double angle : angles)
  {
    polygon.push_back(
      { centre[0] + radii[0] * std::cos(angle), centre[1] + radii[1] * std::sin(angle) });
  }
  return polygon;
}

Points<2> rectangle(double x0, double x1, double y0, double y1)
{
  return { { x0, y0 }, { x1, y0 }, { x1, y1 }, { x0, y1 } };
}

// Counts the values that are read.
class CountedDensity final : public DensityValues
{
public:
  void Read(std::int64_t, std::int64_t count, double* values) const override
  {
    std::fill_n(values, count, 1.0);
    this->Count += count;
  }
  mutable std::int64_t Count = 0;
};

// Long rows are as many cells between polls as short ones.
TEST(RowMoments, PollAfterAFixedNumberOfCells)
{
  for (const GridSize<2>& size : { GridSize<2>{ 3000, 1000 }, GridSize<2>{ 50, 60000 } })
  {
    const CountedDensity values;
    const SerialExecutor serial;
    Progress progress(Context(serial, {}, []() { return true; }));
    EXPECT_THROW(
      RowMoments(DensitySource<2>{ size, values }, { 1.0, 1.0 }, 1.0, progress), Cancelled);
    EXPECT_GT(values.Count, 0);
    EXPECT_LE(values.Count, std::int64_t{ 1 } << 18);
  }
}

TEST(RowMoments, OfAnEvenDensityHaveClosedForms)
{
  const Point<2> scale = { 0.5, 2.0 };
  const RowMoments rows = makeRows(uniformDensity<2>({ 12, 7 }, 3.0), scale, 6.0 * 14.0);
  EXPECT_EQ(rows.Lengths(), (Point<2>{ 6.0, 14.0 }));
  EXPECT_FALSE(rows.HasEmptyCells());
  // The density is 1: a rectangle off the faces, with its moments in full.
  const PolygonMoments found = rowMomentsOf(rows, rectangle(0.8, 4.1, 3.3, 12.7));
  const auto power = [](
                       double a, double b, int n) { return (std::pow(b, n) - std::pow(a, n)) / n; };
  expectMoments(found,
    { 3.3 * 9.4, { power(0.8, 4.1, 2) * 9.4, 3.3 * power(3.3, 12.7, 2) },
      power(0.8, 4.1, 3) * 9.4 + 3.3 * power(3.3, 12.7, 3) },
    1e-10);
  // A triangle about the middle of its corners.
  const Points<2> triangle = { { 1.0, 1.0 }, { 5.5, 2.0 }, { 2.0, 13.0 } };
  expectMoments(rowMomentsOf(rows, triangle), fanMoments(triangle), 1e-10);
}

TEST(RowMoments, OfRandomPolygonsAreThoseOfTheirParts)
{
  std::mt19937_64 engine(3);
  const TestDensity<2> density = randomCells<2>({ 9, 11 });
  for (const Point<2>& scale : { Point<2>{ 1.0, 1.0 }, Point<2>{ 0.25, 3.0 } })
  {
    const RowMoments rows = makeRows(density, scale, 40.0);
    const Point<2> lengths = rows.Lengths();
    for (int i = 0; i < 60; ++i)
    {
      const Point<2> radii = { (0.02 + 0.4 * uniformNumber(engine)) * lengths[0],
        (0.02 + 0.4 * uniformNumber(engine)) * lengths[1] };
      const Point<2> centre = { radii[0] + uniformNumber(engine) * (lengths[0] - 2.0 * radii[0]),
        radii[1] + uniformNumber(engine) * (lengths[1] - 2.0 * radii[1]) };
      const Points<2> polygon = randomPolygon(engine, centre, radii, 3 + i % 6);
      expectMoments(
        rowMomentsOf(rows, polygon), clippedMoments(density, scale, 40.0, polygon), 1e-9);
    }
  }
}

// Sides along the faces of the grid's cells, through its nodes, and at the border.
TEST(RowMoments, OfPolygonsOnTheGridAreExact)
{
  const TestDensity<2> density = randomCells<2>({ 6, 5 });
  const Point<2> scale = { 1.0, 1.0 };
  const RowMoments rows = makeRows(density, scale);
  const std::vector<Points<2>> polygons = { rectangle(0, 6, 0, 5), rectangle(0, 1, 0, 1),
    rectangle(5, 6, 4, 5), rectangle(2, 5, 1, 4), rectangle(2, 5, 1.5, 2.5),
    rectangle(1.5, 3.5, 0, 5), rectangle(0, 6, 3, 3), { { 1, 1 }, { 4, 4 }, { 1, 4 } },
    { { 0, 0 }, { 5, 5 }, { 0, 5 } }, { { 3, 0 }, { 6, 3 }, { 3, 5 }, { 0, 3 } },
    { { 2, 1 }, { 4, 2 }, { 2, 5 } } };
  for (const Points<2>& polygon : polygons)
  {
    expectMoments(rowMomentsOf(rows, polygon), clippedMoments(density, scale, 1.0, polygon), 1e-13);
  }
}

// Far along an axis, over many cells and within a few: as if the grid began there.
TEST(RowMoments, KeepTheirDigitsOnLongStrips)
{
  constexpr std::int64_t length = 400000;
  constexpr std::int64_t width = 500;
  for (const std::size_t axis : { 0u, 1u })
  {
    GridSize<2> size = { 2, 2 };
    size[axis] = length;
    GridSize<2> first{};
    first[axis] = length - width;
    GridSize<2> window = { 2, 2 };
    window[axis] = width;
    const TestDensity<2> density = randomCells<2>(size);
    RowMoments rows = makeRows(density, { 1.0, 1.0 }, 2.0 * length);
    for (const double reach : { 480.0, 2.0 })
    {
      Points<2> polygon = { { 3.25, 0.5 }, { 0.75 * reach, 0.125 }, { reach + 1.5, 1.25 },
        { 0.375 * reach, 1.875 } };
      for (Point<2>& corner : polygon)
      {
        corner = { corner[axis], corner[1 - axis] };
        corner[axis] += static_cast<double>(first[axis]);
      }
      if (axis == 1)
      {
        std::reverse(polygon.begin(), polygon.end()); // counter-clockwise again
      }
      for (const double share : { 0.0, 0.25 })
      {
        rows.SetEvenShare(share);
        TestDensity<2> mixed = density;
        const double mean =
          std::accumulate(density.Values.begin(), density.Values.end(), 0.0) / (2.0 * length);
        for (double& value : mixed.Values)
        {
          value = (1.0 - share) * value + share * mean;
        }
        PolygonMoments found;
        for (std::size_t k = 0; k < 4; ++k)
        {
          rows.AddSide(polygon[k], polygon[(k + 1) % 4], first, found);
        }
        const PolygonMoments expected =
          windowMoments(mixed, { 1.0, 1.0 }, 2.0 * length, first, window, polygon);
        constexpr double rounding = 1e-10; // of coordinates
        EXPECT_NEAR(found.Mass, expected.Mass, rounding);
        EXPECT_NEAR(found.First[0], expected.First[0], rounding * reach);
        EXPECT_NEAR(found.First[1], expected.First[1], rounding * reach);
        EXPECT_NEAR(found.Second, expected.Second, rounding * reach * reach);
      }
    }
  }
}

// The integral along a side, times the side's motion, is the mass that it passes over.
TEST(RowMoments, AlongASideIsTheDerivativeOfTheMass)
{
  const Point<2> scale = { 0.5, 2.0 };
  const TestDensity<2> density = randomCells<2>({ 14, 9 }, 0.2);
  const RowMoments rows = makeRows(density, scale, 100.0);
  std::mt19937_64 engine(9);
  constexpr double shift = 1e-4;
  for (int i = 0; i < 40; ++i)
  {
    // The quad between a side and its copy in the direction of its normal; where it crosses a
    // corner of the grid the density jumps within.
    const Point<2> a = { 0.3 + 6.0 * uniformNumber(engine), 0.3 + 17.0 * uniformNumber(engine) };
    const Point<2> b = { 0.3 + 6.0 * uniformNumber(engine), 0.3 + 17.0 * uniformNumber(engine) };
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    const Point<2> by = { (b[1] - a[1]) / length * shift, (a[0] - b[0]) / length * shift };
    double mass = 0.0;
    const double along = rows.AddSideMass(a, b, mass);
    double around = 0.0;
    const Points<2> quad = { { a[0] - by[0] / 2, a[1] - by[1] / 2 },
      { a[0] + by[0] / 2, a[1] + by[1] / 2 }, { b[0] + by[0] / 2, b[1] + by[1] / 2 },
      { b[0] - by[0] / 2, b[1] - by[1] / 2 } };
    for (std::size_t k = 0; k < 4; ++k)
    {
      rows.AddSideMass(quad[k], quad[(k + 1) % 4], around);
    }
    EXPECT_NEAR(around / shift, along, 2e-3 * length);
    PolygonMoments whole;
    rows.AddSide(a, b, { 0, 0 }, whole);
    EXPECT_NEAR(mass, whole.Mass, 1e-11);
  }
}

TEST(RowMoments, EvenShareMixesTheDensityWithAnEvenOne)
{
  TestDensity<2> density = dirac<2>({ 8, 6 }, { 2, 3 });
  const Point<2> scale = { 1.5, 0.5 };
  RowMoments rows = makeRows(density, scale, 5.0);
  EXPECT_TRUE(rows.HasEmptyCells());
  TestDensity<2> mixed = density;
  for (double& value : mixed.Values)
  {
    value = 0.75 * value + 0.25 / 48.0;
  }
  const Points<2> polygon = { { 0.5, 0.2 }, { 10.3, 0.9 }, { 6.0, 2.9 } };
  rows.SetEvenShare(0.25);
  expectMoments(rowMomentsOf(rows, polygon), clippedMoments(mixed, scale, 5.0, polygon), 1e-12);
  rows.SetEvenShare(0.0);
  expectMoments(rowMomentsOf(rows, polygon), clippedMoments(density, scale, 5.0, polygon), 1e-12);
}

TEST(RowMoments, TheTotalIsGivenWhateverTheUnit)
{
  const TestDensity<2> plain = randomCells<2>({ 5, 4 });
  for (const double unit : { 1e-300, 1.0, 1e300 })
  {
    TestDensity<2> density = plain;
    for (double& value : density.Values)
    {
      value *= unit;
    }
    EXPECT_NEAR(
      rowMomentsOf(makeRows(density, { 1.0, 1.0 }, 7.0), rectangle(0, 5, 0, 4)).Mass, 7.0, 1e-13);
  }
  TestDensity<2> wrong = plain;
  wrong.Values[7] = -1.0;
  wrong.Values[9] = std::numeric_limits<double>::quiet_NaN();
  try
  {
    makeRows(wrong);
    ADD_FAILURE();
  }
  catch (const InvalidDensity& error)
  {
    EXPECT_EQ(error.Summary().FirstNegative, 7);
    EXPECT_EQ(error.Summary().FirstNotFinite, 9);
  }
  EXPECT_THROW(makeRows(uniformDensity<2>({ 3, 3 }, 0.0)), InvalidDensity);
}

TEST(RowMoments, NearestMassIsInACellThatHasSome)
{
  const Point<2> scale = { 2.0, 0.5 };
  const RowMoments rows = makeRows(dirac<2>({ 10, 10 }, { 6, 2 }), scale);
  // That cell is [12,14] x [1,1.5].
  EXPECT_EQ(rows.NearestMass({ 12.5, 1.25 }), (Point<2>{ 12.5, 1.25 }));
  const Point<2> moved = rows.NearestMass({ 1.0, 4.5 });
  EXPECT_NEAR(moved[0], 12.0, 1e-5); // within the cell
  EXPECT_NEAR(moved[1], 1.5, 1e-5);
  const RowMoments full = makeRows(uniformDensity<2>({ 4, 4 }));
  EXPECT_EQ(full.NearestMass({ 4.0, 0.0 }), (Point<2>{ 4.0, 0.0 }));
}

// A cell ten times as high as wide: four cells to the side are nearer than one above.
TEST(RowMoments, NearestMassIsNearInSpace)
{
  TestDensity<2> density = dirac<2>({ 9, 9 }, { 8, 4 });
  density.Values[cellIndex<2>({ 4, 6 }, density.Size)] = 1.0;
  const Point<2> upright = makeRows(density, { 0.1, 1.0 }).NearestMass({ 0.45, 4.5 });
  EXPECT_NEAR(upright[0], 0.8, 1e-5);
  EXPECT_NEAR(upright[1], 4.5, 1e-5);
  const Point<2> flat = makeRows(density, { 1.0, 0.1 }).NearestMass({ 4.5, 0.45 });
  EXPECT_NEAR(flat[0], 4.5, 1e-5);
  EXPECT_NEAR(flat[1], 0.6, 1e-5);
  const Point<2> square = makeRows(density).NearestMass({ 4.5, 4.5 });
  EXPECT_NEAR(square[1], 6.0, 1e-5);
}

TEST(RowMoments, ThreadsDoNotMatter)
{
  const TestDensity<2> density = randomCells<2>({ 130, 90 });
  const Points<2> polygon = { { 3.1, 2.2 }, { 127.0, 40.3 }, { 60.0, 88.8 } };
  const PolygonMoments serial =
    rowMomentsOf(makeRows(density, { 1.0, 1.0 }, 9.0, SerialExecutor()), polygon);
  for (const int threads : { 2, 3 })
  {
    expectMoments(
      rowMomentsOf(makeRows(density, { 1.0, 1.0 }, 9.0, ThreadsExecutor(threads)), polygon), serial,
      0.0);
  }
}

} // namespace
} // namespace RectifiedTransport
