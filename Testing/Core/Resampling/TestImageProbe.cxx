// SPDX-License-Identifier: BSD-3-Clause
// Places among the points of an image, seeds moved into it, and its cells with hidden points.
#include "Core/Geometry/PhysicalPoints.h"
#include "Core/Resampling/HiddenPoints.h"
#include "Core/Resampling/ImageProbe.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{
namespace
{

ImageGrid gridOfPoints(int x, int y)
{
  return { { 0, x - 1, 0, y - 1, 0, 0 }, Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones(),
    ImageGrid::Matrix::Identity(), false };
}

// Weights give back a linear function, and points without weight are left out.
TEST(ImageProbe, InterpolateLinearly)
{
  const ImageGrid grid = gridOfPoints(5, 4);
  const std::array<int, 6> part = { 1, 4, 0, 3, 0, 0 };
  const std::vector<Point<3>> places = { { 2.25, 1.5, 0.0 }, { 1.0, 3.0, 0.0 }, { 4.0, 0.5, 0.0 } };
  const ImageProbe<2> found(grid, part, places);
  const int counts[3] = { 4, 1, 2 };
  const std::int64_t cells[3] = { 4, 6, 2 };
  ASSERT_EQ(found.Count(), 3);
  for (std::int64_t i = 0; i < 3; ++i)
  {
    const ProbeLocation place = found.Find(i);
    const Point<3>& x = places[static_cast<std::size_t>(i)];
    EXPECT_EQ(place.Count, counts[i]);
    EXPECT_EQ(place.Cell, cells[i]);
    double sum = 0.0;
    for (int k = 0; k < place.Count; ++k)
    {
      sum += place.Weights[k] *
        static_cast<double>(1 + place.Points[k] % 4 + 10 * (place.Points[k] / 4));
    }
    EXPECT_DOUBLE_EQ(sum, x[0] + 10.0 * x[1]);
  }
}

TEST(ImageProbe, AreMovedToTheDomain)
{
  const ImageGrid grid = gridOfPoints(5, 4);
  double index[2];
  Point<3> inside = { 0.1, 0.2, 0.0 };
  EXPECT_FALSE(moveToDomain<2>(grid, inside.data(), index));
  EXPECT_EQ(inside, (Point<3>{ 0.1, 0.2, 0.0 }));
  Point<3> outside = { -1.0, 0.5, 0.0 };
  EXPECT_TRUE(moveToDomain<2>(grid, outside.data(), index));
  EXPECT_EQ(outside, (Point<3>{ 0.0, 0.5, 0.0 }));
  EXPECT_EQ(index[0], 0.0);
}

TEST(HiddenPoints, BlankTheirCells)
{
  std::vector<unsigned char> points(12);
  points[5] = 2; // the second of the second row of four
  const std::vector<unsigned char> own = { 1, 0, 0, 0, 0, 0 };
  std::vector<unsigned char> flags(6, 9);
  blankCellsOfHiddenPoints({ 4, 3, 1 }, points.data(), own.data(), 0, 2, flags.data(), { 2, 32 });
  EXPECT_EQ(flags, (std::vector<unsigned char>{ 32, 32, 0, 32, 32, 0 }));
  points[5] = 1;
  blankCellsOfHiddenPoints({ 4, 3, 1 }, points.data(), own.data(), 0, 2, flags.data(), { 2, 32 });
  EXPECT_EQ(flags, own);
}

} // namespace
} // namespace RectifiedTransport
