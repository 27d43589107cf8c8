// SPDX-License-Identifier: BSD-3-Clause
// Maps of cut surfaces: areas are kept as on disks, no triangle is turned over, and each disk has a
// square of its own.
#include "DiskSurfaces.h"
#include "SeamSurfaces.h"
#include "Surfaces/Seams/CutSurfaceMap.h"
#include "Surfaces/Seams/SquareAtlas.h"

#include <gtest/gtest.h>

#include <numeric>
#include <string>

namespace RectifiedTransport
{
namespace
{

AreaPreservingOptions options()
{
  AreaPreservingOptions coarse;
  coarse.Resolution = 256;
  return coarse;
}

TEST(CutSurfaceMap, AreasAreKept)
{
  Mesh several = makeSphere({ 0.0, 0.0, 0.0 }, 1.0, 16);
  several.Add(shifted(makeRing(32, 16, 0.4), { 4.0, 0.0, 0.0 }));
  several.Add(shifted(makeTerrain(20, 20), { 8.0, 0.0, 0.0 }));
  const std::vector<std::pair<std::string, Mesh>> meshes{
    { "sphere", makeSphere({ 0.0, 0.0, 0.0 }, 1.0, 24) },
    { "torus", makeRing(48, 24, 0.4) },
    { "three handles", makeHandles(3, 5) },
    { "limbs", makeLimbs(32) },
    { "tube", makeBand(60, 12, 0) },
    { "Moebius band", makeBand(60, 12, 1) },
    { "projective plane", makeProjectivePlane(4) },
    { "sheet with 16 holes", makePerforated(48, 4) },
    { "several", several },
  };
  for (const auto& [name, mesh] : meshes)
  {
    const CutSurface cut(mesh.Surface());
    const CutSurfaceMap map = mapCutSurface(cut, options());
    const CutTriangles triangles(cut, mesh.Surface());
    const MapDistortion found = measureDistortion(triangles.Measured(), scaledToUnitArea(map));
    EXPECT_LT(found.AreaMedian, 0.01) << name;
    EXPECT_LT(found.Area95, 0.05) << name;
    EXPECT_EQ(found.Flipped, 0) << name;
    EXPECT_EQ(map.Collapsed, 0) << name;
    EXPECT_LT(found.AngleMean, 12.0) << name;
  }
}

TEST(CutSurfaceMap, AnEmbeddingTakesThePlaceOfUnevenConformalMaps)
{
  for (const bool isUneven : { true, false })
  {
    const Mesh mesh = isUneven ? makeLimbs(40) : makeRing(48, 24, 0.4);
    const CutSurface cut(mesh.Surface());
    const CutDisk& disk = cut.Disks()[0];
    const AreaPreservingMap conformal =
      mapAreaPreserving(*disk.Mesh, disk.Conformal->Square, options());
    const CutSurfaceMap map = mapCutSurface(cut, options());
    if (isUneven)
    {
      const MapDistortion found = measureDistortion(*disk.Mesh, map.Positions);
      EXPECT_LT(found.AngleMean, 0.9 * conformal.Distortion.AngleMean);
      EXPECT_EQ(found.Flipped, 0);
    }
    else
    {
      EXPECT_TRUE(sameBits(map.Positions, conformal.Positions));
    }
    EXPECT_TRUE(sameBits(map.Conformal, disk.Conformal->Square.Positions));
  }
}

TEST(CutSurfaceMap, TheBetterOfTwoMapsIsTaken)
{
  // The embedding alone has 95 % of the area within 5.1 %.
  const Mesh mesh = makeHandles(2, 1);
  const CutSurface cut(mesh.Surface());
  const CutSurfaceMap map = mapCutSurface(cut, options());
  EXPECT_LT(measureDistortion(*cut.Disks()[0].Mesh, map.Positions).Area95, 0.04);
}

TEST(CutSurfaceMap, SquaresHoldTheirDisks)
{
  Mesh mesh = makeSphere({ 0.0, 0.0, 0.0 }, 1.0, 8);
  mesh.Add(shifted(makeTerrain(6, 6), { 8.0, 0.0, 0.0 }));
  mesh.Add(Mesh{ { { 20.0, 0.0, 0.0 }, { 21.0, 0.0, 0.0 }, { 20.0, 1.0, 0.0 } }, { { 0, 1, 2 } } });
  const CutSurface cut(mesh.Surface());
  const CutSurfaceMap map = mapCutSurface(cut, options());
  std::vector<Point<2>> lows;
  std::vector<Point<2>> highs;
  for (const CutDisk& disk : cut.Disks())
  {
    Point<2> low{ 2.0, 2.0 };
    Point<2> high{ -1.0, -1.0 };
    for (std::int64_t i = disk.FirstPoint; i < disk.FirstPoint + disk.NumberOfPoints; ++i)
    {
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        const double x = map.Positions[static_cast<std::size_t>(i)][axis];
        low[axis] = std::min(low[axis], x);
        high[axis] = std::max(high[axis], x);
      }
    }
    lows.push_back(low);
    highs.push_back(high);
  }
  double covered = 0.0;
  for (std::size_t i = 0; i < lows.size(); ++i)
  {
    const double side = highs[i][0] - lows[i][0];
    EXPECT_NEAR(highs[i][1] - lows[i][1], side, 1e-12);
    const double part = cut.Disks()[i].Mesh ? 1.0 : 0.5;
    covered += part * side * side;
    EXPECT_NEAR(part * side * side / cut.Disks()[i].Area,
      map.Coverage /
        std::accumulate(cut.Disks().begin(), cut.Disks().end(), 0.0,
          [](double sum, const CutDisk& disk) { return sum + disk.Area; }),
      1e-9);
  }
  EXPECT_NEAR(covered, map.Coverage, 1e-12);
  EXPECT_EQ(map.Positions.back(), (Point<2>{ highs[2][0], highs[2][1] }));
}

TEST(SquareAtlas, SquaresAreApartAndInside)
{
  EXPECT_EQ(arrangeSquares({ 7.0 })[0].Side, 1.0);
  std::mt19937_64 random(3);
  for (const std::size_t count : { 2u, 3u, 4u, 10u, 100u })
  {
    std::vector<double> areas(count);
    for (double& area : areas)
    {
      area = std::pow(static_cast<double>(random() % 1000 + 1) / 1000.0, 2.0);
    }
    const std::vector<AtlasSquare> squares = arrangeSquares(areas);
    ASSERT_EQ(squares.size(), count);
    const double ratio = squares[0].Side * squares[0].Side / areas[0];
    double covered = 0.0;
    for (std::size_t i = 0; i < count; ++i)
    {
      const AtlasSquare& a = squares[i];
      covered += a.Side * a.Side;
      EXPECT_NEAR(a.Side * a.Side / areas[i], ratio, 1e-12 * ratio);
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        EXPECT_GE(a.Low[axis], 0.0);
        EXPECT_LE(a.Low[axis] + a.Side, 1.0);
      }
      for (std::size_t j = 0; j < i; ++j)
      {
        const AtlasSquare& b = squares[j];
        double apart = -1.0;
        for (std::size_t axis = 0; axis < 2; ++axis)
        {
          apart = std::max(
            { apart, a.Low[axis] - b.Low[axis] - b.Side, b.Low[axis] - a.Low[axis] - a.Side });
        }
        EXPECT_GE(apart, (1.0 - 1e-9) * atlasMargin(count)) << count << ": " << i << ", " << j;
      }
    }
    EXPECT_GT(covered, count < 4 ? 0.3 : 0.5) << count;
  }
}

} // namespace
} // namespace RectifiedTransport
