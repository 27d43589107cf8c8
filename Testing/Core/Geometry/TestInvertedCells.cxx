// SPDX-License-Identifier: BSD-3-Clause
// The cells that a move inverts: the measures of all shapes, mirrored and flattened cells, parts of
// strips and lines, and what has no orientation.
#include "Core/Geometry/InvertedCells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace RectifiedTransport
{
namespace
{

using Points3D = std::vector<Point<3>>;

template <int D>
InvertedCells moved(OrientedShape shape, const std::vector<Point<D>>& corners,
  const std::vector<Point<D>>& images, double offset = 0.0)
{
  InvertedCells found;
  found.AddCell<D>(
    orientedPieces<D>(shape, static_cast<std::int64_t>(corners.size())), corners, images, offset);
  return found;
}

template <int D>
std::vector<Point<D>> scaled(std::vector<Point<D>> points, double factor)
{
  for (Point<D>& point : points)
  {
    point[D - 1] *= factor;
  }
  return points;
}

Points3D prism(int sides)
{
  Points3D corners;
  for (const double z : { 0.0, 1.0 })
  {
    for (int i = 0; i < sides; ++i)
    {
      const double angle = 2.0 * std::acos(-1.0) * i / sides;
      corners.push_back({ std::cos(angle), std::sin(angle), z });
    }
  }
  return corners;
}

template <int D>
void check(OrientedShape shape, const std::vector<Point<D>>& corners, double measure)
{
  const InvertedCells still = moved<D>(shape, corners, corners);
  EXPECT_EQ(still.Inverted, 0);
  EXPECT_EQ(still.All, 1);
  EXPECT_NEAR(still.Area.Value(), measure, 1e-14);
  const InvertedCells mirrored = moved<D>(shape, corners, scaled<D>(corners, -2.0));
  EXPECT_EQ(mirrored.Inverted, 1);
  EXPECT_NEAR(mirrored.InvertedArea.Value(), 2.0 * measure, 1e-14);
  EXPECT_EQ(moved<D>(shape, corners, scaled<D>(corners, 0.0)).Inverted, 1);
  EXPECT_EQ(moved<D>(shape, scaled<D>(corners, 0.0), corners).All, 0);
}

TEST(InvertedCells, ShapesHaveTheirMeasures)
{
  check<1>(OrientedShape::Line, { { 1.0 }, { 1.5 } }, 0.5);
  check<2>(OrientedShape::Polygon, { { 0, 0 }, { 2, 0 }, { 2, 1 } }, 1.0);
  check<2>(OrientedShape::Pixel, { { 0, 0 }, { 2, 0 }, { 0, 1 }, { 2, 1 } }, 2.0);
  check<2>(OrientedShape::TriangleStrip, { { 0, 0 }, { 2, 0 }, { 0, 1 }, { 2, 1 } }, 2.0);
  const Points3D box = { { 0, 0, 0 }, { 2, 0, 0 }, { 2, 1, 0 }, { 0, 1, 0 }, { 0, 0, 3 },
    { 2, 0, 3 }, { 2, 1, 3 }, { 0, 1, 3 } };
  check<3>(OrientedShape::Hexahedron, box, 6.0);
  check<3>(
    OrientedShape::Voxel, { box[0], box[1], box[3], box[2], box[4], box[5], box[7], box[6] }, 6.0);
  check<3>(OrientedShape::Tetrahedron, { box[0], box[1], box[3], box[4] }, 1.0);
  check<3>(OrientedShape::Pyramid, { box[0], box[1], box[2], box[3], box[4] }, 2.0);
  check<3>(OrientedShape::Wedge, { box[0], box[1], box[3], box[4], box[5], box[7] }, 3.0);
  check<3>(OrientedShape::PentagonalPrism, prism(5), 2.5 * std::sin(0.4 * std::acos(-1.0)));
  check<3>(OrientedShape::HexagonalPrism, prism(6), 1.5 * std::sqrt(3.0));
}

TEST(InvertedCells, OnePieceOfSeveralIsEnough)
{
  const InvertedCells line =
    moved<1>(OrientedShape::PolyLine, { { 0 }, { 1 }, { 2 } }, { { 0 }, { 2 }, { 1 } });
  EXPECT_EQ(line.Inverted, 1);
  EXPECT_EQ(line.InvertedArea.Value(), 1.0);
  const std::vector<Point<2>> strip = { { 0, 0 }, { 1, 0 }, { 0, 1 }, { 1, 1 } };
  const InvertedCells folded =
    moved<2>(OrientedShape::TriangleStrip, strip, { strip[0], strip[1], strip[2], { 0.25, 0.25 } });
  EXPECT_EQ(folded.Inverted, 1);
  EXPECT_NEAR(folded.InvertedArea.Value(), 0.25, 1e-15);
}

TEST(InvertedCells, RoundingIsNoOrientation)
{
  const std::vector<Point<2>> flat = { { 0.1, 1e6 + 0.3 }, { 0.3, 1e6 + 0.9 }, { 0.7, 1e6 + 2.1 } };
  EXPECT_EQ(moved<2>(OrientedShape::Polygon, flat, flat).All, 0);
  const std::vector<Point<2>> small = { { 0, 0 }, { 1e-9, 0 }, { 0, 1e-9 } };
  EXPECT_EQ(moved<2>(OrientedShape::Polygon, small, small).All, 1);
  EXPECT_EQ(moved<2>(OrientedShape::Polygon, small, small, 1e6).All, 0);
}

TEST(InvertedCells, OtherDimensionsHaveNoPieces)
{
  EXPECT_TRUE(orientedPieces<1>(OrientedShape::Polygon, 3).empty());
  EXPECT_TRUE(orientedPieces<2>(OrientedShape::Voxel, 8).empty());
  EXPECT_TRUE(orientedPieces<2>(OrientedShape::PolyLine, 3).empty());
  EXPECT_TRUE(orientedPieces<3>(OrientedShape::TriangleStrip, 5).empty());
}

} // namespace
} // namespace RectifiedTransport
