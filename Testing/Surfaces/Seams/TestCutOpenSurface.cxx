// SPDX-License-Identifier: BSD-3-Clause
// Points on seams have copies: every triangle has those of its disk, and the given points come
// first.
#include "SeamSurfaces.h"
#include "Surfaces/Seams/CutOpenSurface.h"
#include "Surfaces/Seams/CutSurfaceMap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace RectifiedTransport
{
namespace
{

CutOpenSurface open(const Mesh& mesh)
{
  Progress progress{ Context() };
  return { mesh.Surface(), SeamOptions(), progress };
}

void expectCopies(const Mesh& mesh, const CutOpenSurface& opened)
{
  for (std::int64_t i = 0; i < opened.NumberOfPoints(); ++i)
  {
    const auto given = static_cast<std::int64_t>(mesh.Points.size());
    EXPECT_EQ(opened.OriginOf(i) == i, i < given) << i;
  }
  for (std::size_t t = 0; t < mesh.Triangles.size(); ++t)
  {
    const auto triangle = static_cast<std::int64_t>(t);
    for (std::int64_t i = 0; i < 3; ++i)
    {
      const std::int64_t point = opened.Triangles()[3 * triangle + i];
      EXPECT_EQ(opened.OriginOf(point), mesh.Triangles[t][static_cast<std::size_t>(i)]);
      if (opened.Cut().DiskOf(triangle) >= 0)
      {
        EXPECT_EQ(opened.PointOf(point), opened.Cut().CornersOf(triangle)[i]);
      }
    }
  }
}

TEST(CutOpenSurface, PointsOnSeamsHaveCopies)
{
  const Mesh ring = makeRing(16, 8, 0.4);
  const CutOpenSurface opened = open(ring);
  EXPECT_GT(opened.NumberOfPoints(), static_cast<std::int64_t>(ring.Points.size()) + 16);
  EXPECT_EQ(opened.NumberOfPoints(), opened.Cut().NumberOfPoints());
  expectCopies(ring, opened);
}

TEST(CutOpenSurface, ADiskHasNone)
{
  const Mesh sheet = makeRectangle(4, 3);
  EXPECT_EQ(open(sheet).NumberOfPoints(), static_cast<std::int64_t>(sheet.Points.size()));
}

// A triangle without area, whose points are those of a side on a seam.
TEST(CutOpenSurface, TrianglesWithoutAreaDoNotLieAcrossTheMap)
{
  Mesh ring = makeRing(16, 8, 0.4);
  const auto flat = static_cast<std::int64_t>(ring.Triangles.size());
  for (std::size_t t = 0; t < static_cast<std::size_t>(flat); ++t)
  {
    const auto& ids = ring.Triangles[t];
    ring.Triangles.push_back({ ids[0], ids[1], ids[0] });
  }
  CutOpenSurface opened = open(ring);
  const CutSurfaceMap map = mapCutSurface(opened.Cut(), { 64, false });
  opened.PlaceDegenerate(map.Positions);
  expectCopies(ring, opened);
  double longest = 0.0;
  for (std::int64_t corner = 3 * flat; corner < 6 * flat; corner += 3)
  {
    EXPECT_LT(opened.Cut().DiskOf(corner / 3), 0);
    const auto at = [&](std::int64_t i) {
      return map.Positions[static_cast<std::size_t>(opened.PointOf(opened.Triangles()[i]))];
    };
    const Point<2> a = at(corner);
    const Point<2> b = at(corner + 1);
    longest = std::max(longest, std::hypot(b[0] - a[0], b[1] - a[1]));
  }
  EXPECT_LT(longest, 0.5);
}

} // namespace
} // namespace RectifiedTransport
