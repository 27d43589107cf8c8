// SPDX-License-Identifier: BSD-3-Clause
// Barycentric embeddings: flat rectangles stay, nothing is flipped, and areas are more even than
// those of conformal maps.
#include "DiskSurfaces.h"
#include "RecordingContext.h"
#include "Surfaces/Parameterization/TutteEmbedding.h"

#include "Core/Geometry/Vectors.h"
#include "Surfaces/Parameterization/MapDistortion.h"

#include <gtest/gtest.h>

namespace RectifiedTransport
{
namespace
{

// A tube that is closed at one end; conformal maps squeeze that end.
Mesh makeThimble(std::int64_t rings, double length)
{
  return makeRoundDisk(rings).Mapped([length](const Point<3>& p) {
    const double radius = std::hypot(p[0], p[1]);
    const double way = radius * (1.0 + length);
    const double scale = radius > 0.0 ? std::min(way, 1.0) / radius : 0.0;
    return Point<3>{ scale * p[0], scale * p[1], std::max(way - 1.0, 0.0) };
  });
}

std::int64_t flips(const DiskMesh& disk, const std::vector<Point<2>>& positions)
{
  return measureDistortion(disk, positions).Flipped;
}

TEST(TutteEmbedding, FlatRectanglesStayAsTheyAre)
{
  const Mesh mesh = makeRectangle(20, 15);
  const DiskMesh disk(mesh.Surface());
  const ConformalMap map = mapped(disk, sheetCorners(20, 15));
  const SquareMap even = tutteEmbedding(disk, map.Square);
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    EXPECT_NEAR(even.Positions[i][0], mesh.Points[i][0], 1e-12);
    EXPECT_NEAR(even.Positions[i][1], mesh.Points[i][1], 1e-12);
  }
  EXPECT_NEAR(areaDistortion(disk, even.Positions), 0.0, 1e-12);
}

TEST(TutteEmbedding, DistortionIsThatOfTheLogarithm)
{
  // Halves of a rectangle, mapped to a quarter and three quarters of the square.
  const DiskMesh disk(makeRectangle(2, 1).Surface());
  std::vector<Point<2>> positions;
  for (std::int64_t i = 0; i < disk.NumberOfPoints(); ++i)
  {
    const double* point = disk.Surface().Points[i];
    const double x = point[0] / (2.0 * std::abs(disk.Surface().Points[0][0])) + 0.5;
    const double y = point[1] / (2.0 * std::abs(disk.Surface().Points[0][1])) + 0.5;
    positions.push_back({ x == 0.5 ? 0.25 : x, y });
  }
  const double low = std::log(0.5);
  const double high = std::log(1.5);
  EXPECT_NEAR(areaDistortion(disk, positions), std::sqrt(0.5 * (low * low + high * high)), 1e-12);
}

TEST(TutteEmbedding, BoundaryPointsAreAtTheirLengths)
{
  const Mesh mesh = makeTerrain(12, 9).Mapped([](const Point<3>& p) {
    return Point<3>{ p[0] * p[0], p[1], p[2] };
  });
  const DiskMesh disk(mesh.Surface());
  const SquareMap even = tutteEmbedding(disk, mapped(disk, sheetCorners(12, 9)).Square);
  std::vector<double> lengths{ 0.0 };
  for (std::size_t i = 0; i < 12; ++i)
  {
    lengths.push_back(
      lengths.back() + std::sqrt(squaredDistance(mesh.Points[i], mesh.Points[i + 1])));
  }
  for (std::size_t i = 0; i <= 12; ++i)
  {
    EXPECT_NEAR(even.Positions[i][0], lengths[i] / lengths[12], 1e-12);
    EXPECT_EQ(even.Positions[i][1], 0.0);
  }
}

TEST(TutteEmbedding, IsMoreEvenThanConformalMaps)
{
  for (const double length : { 2.0, 4.0, 6.0 })
  {
    const DiskMesh disk(makeThimble(40, length).Surface());
    const ConformalMap map = mapped(disk);
    const SquareMap even = tutteEmbedding(disk, map.Square);
    const double distortion = areaDistortion(disk, even.Positions);
    EXPECT_LT(distortion, 0.15 * areaDistortion(disk, map.Square.Positions)) << length;
    EXPECT_LT(distortion, 0.5) << length;
    EXPECT_EQ(flips(disk, even.Positions), 0) << length;
    EXPECT_EQ(even.OnSides, map.Square.OnSides);
    EXPECT_EQ(even.Corners, map.Square.Corners);
  }
}

TEST(TutteEmbedding, NothingIsFlippedWhereAnglesAreObtuse)
{
  const Mesh mesh = makeRandomTriangulation(24, 24, 1e-3).Mapped([](const Point<3>& p) {
    return Point<3>{ 20.0 * p[0], p[1], std::sin(9.0 * p[0]) * std::cos(7.0 * p[1]) };
  });
  const DiskMesh disk(mesh.Surface());
  const SquareMap even = tutteEmbedding(disk, mapped(disk).Square);
  EXPECT_EQ(flips(disk, even.Positions), 0);
}

TEST(TutteEmbedding, WithoutInnerPoints)
{
  const DiskMesh disk(makeRectangle(6, 1).Surface());
  const SquareMap even = tutteEmbedding(disk, mapped(disk, sheetCorners(6, 1)).Square);
  EXPECT_EQ(flips(disk, even.Positions), 0);
  EXPECT_NEAR(areaDistortion(disk, even.Positions), 0.0, 1e-12);
}

TEST(TutteEmbedding, Cancelled)
{
  const DiskMesh disk(makeThimble(30, 3.0).Surface());
  const ConformalMap map = mapped(disk);
  const SerialExecutor serial;
  RecordingContext whole(serial);
  tutteEmbedding(disk, map.Square, whole.Context());
  whole.ExpectReported(0.0, 1.0);
  ASSERT_GT(whole.Queries, 15);
  for (int maximum = 0; maximum < whole.Queries / 2; ++maximum)
  {
    RecordingContext recorder(serial);
    recorder.MaximumQueries = maximum;
    EXPECT_THROW(tutteEmbedding(disk, map.Square, recorder.Context()), Cancelled) << maximum;
  }
}

} // namespace
} // namespace RectifiedTransport
