// SPDX-License-Identifier: BSD-3-Clause
// Sets of points in memory of others: what is one, and what is none.
#include "Core/Geometry/Points.h"

#include <gtest/gtest.h>

#include <type_traits>
#include <vector>

namespace RectifiedTransport
{
namespace
{

template <class From, class To>
constexpr bool isConvertible = std::is_convertible_v<From, To>;

// What may be written may be read, and not the other way round.
static_assert(isConvertible<std::vector<Point<2>>&, PointSpan<2>>);
static_assert(isConvertible<std::vector<Point<2>>&, ConstPointSpan<2>>);
static_assert(isConvertible<const std::vector<Point<2>>&, ConstPointSpan<2>>);
static_assert(!isConvertible<const std::vector<Point<2>>&, PointSpan<2>>);
static_assert(isConvertible<PointSpan<2>, ConstPointSpan<2>>);
static_assert(!isConvertible<ConstPointSpan<2>, PointSpan<2>>);
static_assert(isConvertible<std::array<Point<3>, 7>&, PointSpan<3>>);
static_assert(isConvertible<std::vector<std::array<float, 3>>&, ConstPointSpan<3, float>>);

// Of another dimension, of another type, or without one.
static_assert(!isConvertible<std::vector<Point<3>>&, PointSpan<2>>);
static_assert(!isConvertible<std::vector<Point<2>>&, ConstPointSpan<3>>);
static_assert(!isConvertible<PointSpan<2>, PointSpan<3>>);
static_assert(!isConvertible<std::vector<std::array<float, 3>>&, ConstPointSpan<3>>);
static_assert(!isConvertible<PointSpan<3, float>, ConstPointSpan<3>>);
static_assert(!isConvertible<std::vector<double>&, PointSpan<1>>);
static_assert(!isConvertible<double*, PointSpan<1>>);

TEST(Points, SpanOfAVector)
{
  std::vector<Point<3>> points{ { 0.0, 1.0, 2.0 }, { 3.0, 4.0, 5.0 }, { 6.0, 7.0, 8.0 } };
  const PointSpan<3> span = points;
  EXPECT_EQ(span.data(), points[0].data());
  EXPECT_EQ(span.size(), 3);
  for (std::int64_t i = 0; i < 3; ++i)
  {
    EXPECT_EQ(span[i], points[static_cast<std::size_t>(i)].data());
  }
  span[1][2] = -5.0;
  EXPECT_EQ(points[1], (Point<3>{ 3.0, 4.0, -5.0 }));

  const ConstPointSpan<3> read = span;
  EXPECT_EQ(read.data(), span.data());
  EXPECT_EQ(read.size(), 3);
  EXPECT_EQ(read[2][0], 6.0);
}

TEST(Points, SpanOfCoordinates)
{
  float coordinates[] = { 0.0F, 1.0F, 2.0F, 3.0F };
  const PointSpan<2, float> span(coordinates, 2);
  EXPECT_EQ(span.size(), 2);
  EXPECT_EQ(span[1], coordinates + 2);
  const std::array<Point<1>, 2> line{ { { 4.0 }, { 5.0 } } };
  const ConstPointSpan<1> onLine = line;
  EXPECT_EQ(onLine.size(), 2);
  EXPECT_EQ(onLine[1][0], 5.0);
}

TEST(Points, EmptySpan)
{
  const std::vector<Point<2>> none;
  EXPECT_EQ(ConstPointSpan<2>(none).data(), nullptr);
  EXPECT_EQ(ConstPointSpan<2>(none).size(), 0);
  EXPECT_EQ(PointSpan<2>().data(), nullptr);
  EXPECT_EQ(PointSpan<2>().size(), 0);
}

TEST(Points, PartOfASpan)
{
  const std::vector<Point<2>> points{ { 0.0, 1.0 }, { 2.0, 3.0 }, { 4.0, 5.0 }, { 6.0, 7.0 } };
  const ConstPointSpan<2> part = ConstPointSpan<2>(points).Part(1, 2);
  EXPECT_EQ(part.data(), points[1].data());
  EXPECT_EQ(part.size(), 2);
  EXPECT_EQ(part[1][1], 5.0);
  EXPECT_EQ(ConstPointSpan<2>(points).Part(4, 0).size(), 0);
}

} // namespace
} // namespace RectifiedTransport
