// SPDX-License-Identifier: BSD-3-Clause
// Polygons and strips that are read one by one: their triangles and numbers, as they are and as a
// closed surface.
#include "Core/Parallel/Progress.h"
#include "Surfaces/Mesh/CutPolygons.h"
#include "Surfaces/Solid/ClosedMesh.h"
#include "Surfaces/Solid/SolidPolygons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace RectifiedTransport
{
namespace
{

using Cells = std::vector<PolygonCutter::Corners>;

PolygonSource::Visits visitsOf(const Cells& cells)
{
  return [&cells](Progress&, const PolygonSource::Visit& visit) {
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      visit(static_cast<std::int64_t>(i), cells[i]);
    }
  };
}

// Refuses rings of more than five corners.
bool cutFan(const std::vector<Point<3>>& ring, std::vector<std::size_t>& triangles)
{
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
  {
    triangles.insert(triangles.end(), { 0, i, i + 1 });
  }
  return ring.size() < 6;
}

PolygonSource sourceOf(const Cells& polygons, const Cells& strips)
{
  PolygonSource source{ visitsOf(polygons), visitsOf(strips),
    static_cast<std::int64_t>(polygons.size()), static_cast<std::int64_t>(strips.size()), 0,
    cutFan };
  for (const Cells& cells : { polygons, strips })
  {
    for (const PolygonCutter::Corners& corners : cells)
    {
      source.NumberOfTriangles += static_cast<std::int64_t>(corners.size()) - 2;
    }
  }
  return source;
}

template <class T>
std::vector<T> copyOf(const LargeBuffer<T>& values)
{
  return { values.data(), values.data() + values.size() };
}

// Bit a of a point's number is its coordinate along axis a.
std::vector<Point<3>> cube()
{
  std::vector<Point<3>> points;
  for (int i = 0; i < 8; ++i)
  {
    points.push_back({ 1.0 * (i & 1), 0.5 * (i & 2), 0.25 * (i & 4) });
  }
  return points;
}

TEST(CutPolygons, StripsAreNumberedBehindPolygons)
{
  const std::vector<Point<3>> points = cube();
  const Cells polygons{ { 0, 1, 3, 2 }, { 4, 5, 6 } };
  const Cells strips{ { 0, 1, 4, 5 } };
  Progress progress{ Context() };
  const PolygonTriangles cut = cutPolygons(sourceOf(polygons, strips), points, 0.0, progress);
  EXPECT_EQ(copyOf(cut.Corners),
    (std::vector<std::int64_t>{ 0, 1, 3, 0, 3, 2, 4, 5, 6, 0, 1, 4, 4, 1, 5 }));
  EXPECT_EQ(copyOf(cut.Cells), (std::vector<std::int64_t>{ 0, 0, 1, 2, 2 }));
}

TEST(CutPolygons, RefusesPolygonsThatCannotBeCut)
{
  const std::vector<Point<3>> points = cube();
  const Cells polygons{ { 4, 5, 6 }, { 0, 1, 3, 2, 6, 4 } };
  const Cells strips;
  Progress progress{ Context() };
  try
  {
    cutPolygons(sourceOf(polygons, strips), points, 0.0, progress);
    FAIL() << "was cut";
  }
  catch (const std::runtime_error& error)
  {
    EXPECT_EQ(
      std::string(error.what())
        .rfind("The input surface has polygons that cannot be cut into triangles: 4 triangles are "
               "missing (the first of polygon 1, counted from 0)",
          0),
      0u);
  }
}

// The sides of a cube: quads, one as a strip, one with a corner twice and one as two triangles.
TEST(CutPolygons, BoundASolid)
{
  const std::vector<Point<3>> points = cube();
  const Cells polygons{ { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4, 4 }, { 2, 6, 7, 3 },
    { 0, 4, 6 }, { 0, 6, 2 } };
  const Cells strips{ { 1, 3, 5, 7 } };
  LargeBuffer<double> coordinates(24);
  std::copy_n(points.front().data(), 24, coordinates.data());
  ClosedMesh mesh(std::move(coordinates));
  Progress progress{ Context() };
  addPolygons(sourceOf(polygons, strips), mesh, progress);
  mesh.CountEdges();
  EXPECT_TRUE(mesh.IsClosed());
  EXPECT_EQ(mesh.Surface().NumberOfTriangles, 12);
  EXPECT_TRUE(mesh.Orient());
}

} // namespace
} // namespace RectifiedTransport
