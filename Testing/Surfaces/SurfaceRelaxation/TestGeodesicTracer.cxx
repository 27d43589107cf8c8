// SPDX-License-Identifier: BSD-3-Clause
// Walks over triangles, against those of a plane that surfaces unfold to.
#include "Core/Parallel/Progress.h"
#include "Surfaces/SurfaceRelaxation/GeodesicTracer.h"

#include "SurfaceRelaxation/SurfaceMeasures.h"
#include "SurfaceRelaxation/Surfaces.h"

#include <gtest/gtest.h>

namespace RectifiedTransport
{
namespace
{

// A strip of paper, folded up as a fan, with triangles that turn in either way: where it is, by
// its own coordinates.
constexpr int folds = 12;

Mesh foldedPaper(int quads, bool flat)
{
  Mesh mesh = makeQuads(folds, quads, [=](double u, double v) {
    const double column = u * folds;
    const bool isOdd = static_cast<int>(std::lround(column)) % 2 == 1;
    return flat ? Point<3>{ column, v, 0.0 } : Point<3>{ 0.6 * column, v, isOdd ? 0.8 : 0.0 };
  });
  for (std::size_t i = 0; i < mesh.Triangles.size(); i += 3)
  {
    std::swap(mesh.Triangles[i][0], mesh.Triangles[i][2]);
  }
  return mesh;
}

GeodesicTracer tracerOn(const Mesh& mesh)
{
  Progress progress{ Context() };
  return GeodesicTracer(mesh.Surface(), 0.0, progress);
}

SurfacePlace placeAt(const GeodesicTracer& surface, const PlaceOnTriangle& place)
{
  SurfacePlace at{ { 0.0, 0.0, 0.0 }, place.Triangle };
  for (std::size_t i = 0; i < 3; ++i)
  {
    at.X = at.X + place.Weights[i] * surface.Corner(place.Triangle, static_cast<std::int64_t>(i));
  }
  return at;
}

// The vector of a triangle's plane with the same parts along its sides.
Point<3> sameVector(const TriangleSurface& from, const TriangleSurface& to, std::int64_t triangle,
  const Point<3>& vector, double scale)
{
  // vector = s ab + t ac, in the plane z = 0
  Point<3> ab;
  Point<3> ac;
  Point<3> toAB;
  Point<3> toAC;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    ab[axis] = cornerOf(from, triangle, 1)[axis] - cornerOf(from, triangle, 0)[axis];
    ac[axis] = cornerOf(from, triangle, 2)[axis] - cornerOf(from, triangle, 0)[axis];
    toAB[axis] = cornerOf(to, triangle, 1)[axis] - cornerOf(to, triangle, 0)[axis];
    toAC[axis] = cornerOf(to, triangle, 2)[axis] - cornerOf(to, triangle, 0)[axis];
  }
  const double turn = ab[0] * ac[1] - ab[1] * ac[0];
  const double s = (vector[0] * ac[1] - vector[1] * ac[0]) / turn;
  const double t = (ab[0] * vector[1] - ab[1] * vector[0]) / turn;
  return (scale * s) * toAB + (scale * t) * toAC;
}

// Walks on the folded paper lead where straight ways on the flat one do, and along its border where
// these leave it.
TEST(GeodesicTracer, Unfolds)
{
  for (const int quads : { 1, 7 })
  {
    const Mesh folded = foldedPaper(quads, false);
    const Mesh flat = foldedPaper(quads, true);
    const GeodesicTracer tracer = tracerOn(folded);
    // What lengths are multiplied by in its frame.
    const double scale = std::sqrt(tracer.Area(0) / areaOf(folded.Surface(), 0));
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> unit;
    for (int i = 0; i < 2000; ++i)
    {
      const double root = std::sqrt(unit(random));
      const double v = unit(random);
      const auto t = static_cast<std::int64_t>(random() % flat.Triangles.size());
      const PlaceOnTriangle start{ t, { 1.0 - root, root * (1.0 - v), root * v } };
      const Point<3> from = positionOf(flat.Surface(), start);
      const Point<3> by{ 8.0 * unit(random) - 4.0, 2.0 * unit(random) - 1.0, 0.0 };
      SurfacePlace place = placeAt(tracer, start);
      tracer.Trace(place, sameVector(flat.Surface(), folded.Surface(), t, by, scale), nullptr);
      const Point<3> to = positionOf(flat.Surface(), tracer.WeightsOf(place));
      ASSERT_NEAR(to[0], std::clamp(from[0] + by[0], 0.0, 1.0 * folds), 1e-12);
      ASSERT_NEAR(to[1], std::clamp(from[1] + by[1], 0.0, 1.0), 1e-12);
    }
  }
}

// Walks do not end where levels are 0, and end before if there is nothing beyond.
TEST(GeodesicTracer, Levels)
{
  const Mesh flat = foldedPaper(1, true);
  const GeodesicTracer tracer = tracerOn(flat);
  std::vector<double> levels(flat.Triangles.size(), 1.0);
  levels[6] = levels[7] = 0.0; // 3 to 4
  const double scale = std::sqrt(2.0 * tracer.Area(0));
  for (const double by : { 0.2, 0.5, 1.0, 1.3, 1.5, 2.5 })
  {
    SurfacePlace place = placeAt(tracer, { 5, { 0.5, 0.0, 0.5 } }); // at 2, 1/2
    const double from = positionOf(flat.Surface(), tracer.WeightsOf(place))[0];
    tracer.Trace(place, { scale * by, 0.0, 0.0 }, levels.data());
    const double to = positionOf(flat.Surface(), tracer.WeightsOf(place))[0];
    const bool isEmpty = from + by > 3.0 && from + by < 4.0;
    EXPECT_NEAR(to, isEmpty ? 3.0 : from + by, 1e-13) << by;
    EXPECT_GT(levels[static_cast<std::size_t>(place.Triangle)], 0.0);
  }
}

// Of four leaves, opposite ones continue each other; of three, one ends.
TEST(GeodesicTracer, ManyOnOneEdge)
{
  for (const int leaves : { 3, 4 })
  {
    const Mesh mesh = makeLeaves(leaves, 1);
    const GeodesicTracer tracer = tracerOn(mesh);
    EXPECT_EQ(tracer.NonManifoldEdges(), 1);
    int walls = 0;
    for (int leaf = 0; leaf < leaves; ++leaf)
    {
      for (std::int64_t side = 6 * leaf; side < 6 * leaf + 6; ++side)
      {
        walls += tracer.Across(side) == GeodesicTracer::Wall ? 1 : 0;
        const std::int64_t other = tracer.Across(side);
        if (other >= 0 && other / 6 != leaf)
        {
          EXPECT_EQ(tracer.Across(other), side);
          if (leaves == 4)
          {
            EXPECT_EQ(other / 6, (leaf + 2) % 4);
          }
        }
      }
    }
    EXPECT_EQ(walls, leaves % 2);
  }
}

} // namespace
} // namespace RectifiedTransport
