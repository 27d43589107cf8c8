// SPDX-License-Identifier: BSD-3-Clause
// Places that several points share, to the last bit, are there once.
#include "Core/Geometry/CoincidentPoints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace RectifiedTransport
{
namespace
{

using Places = std::vector<Point<2>>;

TEST(DistinctPoints, MoveTheirPoints)
{
  const double near = std::nextafter(1.0, 2.0);
  Places points{ { 3.0, 0.0 }, { 1.0, 2.0 }, { 3.0, -0.0 }, { near, 2.0 }, { 2.0, 1.0 },
    { 1.0, 2.0 }, { 3.0, 0.0 } };
  const DistinctPoints<2> distinct(points);
  EXPECT_EQ(distinct.Places(), (Places{ points[0], points[1], points[3], points[4] }));
  distinct.Move({ { 0.0, 0.0 }, { 1.0, 0.0 }, { 2.0, 0.0 }, { 3.0, 0.0 } }, points);
  EXPECT_EQ(points,
    (Places{ { 0.0, 0.0 }, { 1.0, 0.0 }, { 0.0, 0.0 }, { 2.0, 0.0 }, { 3.0, 0.0 }, { 1.0, 0.0 },
      { 0.0, 0.0 } }));
}

TEST(DistinctPoints, OfNoPoints)
{
  Places points;
  const DistinctPoints<2> distinct(points);
  EXPECT_TRUE(distinct.Places().empty());
  distinct.Move({}, points);
}

} // namespace
} // namespace RectifiedTransport
