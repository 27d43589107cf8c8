// SPDX-License-Identifier: BSD-3-Clause
// The cells that a move inverts: the measures of simplices, mirrored and flattened cells, cells of
// several pieces, and what has no orientation.
#include "Core/Geometry/InvertedCells.h"

#include <gtest/gtest.h>

#include <vector>

namespace RectifiedTransport
{
namespace
{

using Points2D = std::vector<Point<2>>;

template <int D>
InvertedCells moved(const std::vector<Point<D>>& vertices, const std::vector<Point<D>>& images,
  std::int64_t pieces = 1, double offset = 0.0)
{
  InvertedCells found;
  found.AddCell<D>(vertices, images, pieces, offset);
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

template <int D>
void check(const std::vector<Point<D>>& vertices, double measure)
{
  const InvertedCells still = moved<D>(vertices, vertices);
  EXPECT_EQ(still.Inverted, 0);
  EXPECT_EQ(still.All, 1);
  EXPECT_NEAR(still.Area.Value(), measure, 1e-14);
  const InvertedCells mirrored = moved<D>(vertices, scaled<D>(vertices, -2.0));
  EXPECT_EQ(mirrored.Inverted, 1);
  EXPECT_NEAR(mirrored.InvertedArea.Value(), 2.0 * measure, 1e-14);
  EXPECT_EQ(moved<D>(vertices, scaled<D>(vertices, 0.0)).Inverted, 1);
  EXPECT_EQ(moved<D>(scaled<D>(vertices, 0.0), vertices).All, 0);
}

TEST(InvertedCells, SimplicesHaveTheirMeasures)
{
  check<1>({ { 1.0 }, { 1.5 } }, 0.5);
  check<2>({ { 0, 0 }, { 2, 0 }, { 2, 1 } }, 1.0);
  check<3>({ { 0, 0, 0 }, { 2, 0, 0 }, { 0, 1, 0 }, { 0, 0, 3 } }, 1.0);
}

TEST(InvertedCells, TheSumOfAConcaveOutlineCounts)
{
  // The triangles at one corner of an arrowhead, of which one lies outside of it.
  const Points2D fan = { { 4, 0 }, { 0, 3 }, { 1, 0 }, { 4, 0 }, { 1, 0 }, { 0, -3 } };
  check<2>(fan, 9.0);
  Points2D pushed = fan; // its tip, through the notch
  for (Point<2>& point : pushed)
  {
    point[0] = point[0] == 4.0 ? -4.0 : point[0];
  }
  EXPECT_EQ(moved<2>(fan, pushed).Inverted, 1);
}

TEST(InvertedCells, OnePieceOfSeveralIsEnough)
{
  const InvertedCells line =
    moved<1>({ { 0 }, { 1 }, { 1 }, { 2 } }, { { 0 }, { 2 }, { 2 }, { 1 } }, 2);
  EXPECT_EQ(line.Inverted, 1);
  EXPECT_EQ(line.All, 1);
  EXPECT_EQ(line.InvertedArea.Value(), 1.0);
  const Points2D strip = { { 0, 0 }, { 1, 0 }, { 0, 1 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };
  Points2D images = strip;
  images[4] = { 0.25, 0.25 };
  const InvertedCells folded = moved<2>(strip, images, 2);
  EXPECT_EQ(folded.Inverted, 1);
  EXPECT_NEAR(folded.InvertedArea.Value(), 0.25, 1e-15);
  EXPECT_EQ(moved<2>(strip, images, 1).Inverted, 0);
}

TEST(InvertedCells, RoundingIsNoOrientation)
{
  const Points2D flat = { { 0.1, 1e6 + 0.3 }, { 0.3, 1e6 + 0.9 }, { 0.7, 1e6 + 2.1 } };
  EXPECT_EQ(moved<2>(flat, flat).All, 0);
  const Points2D small = { { 0, 0 }, { 1e-9, 0 }, { 0, 1e-9 } };
  EXPECT_EQ(moved<2>(small, small).All, 1);
  EXPECT_EQ(moved<2>(small, small, 1, 1e6).All, 0);
}

} // namespace
} // namespace RectifiedTransport
