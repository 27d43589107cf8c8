// SPDX-License-Identifier: BSD-3-Clause
// The order of particles: neighbours in memory are neighbours in space.
#include "Core/Flow/Particles/ParticleOrder.h"
#include "TestFlow.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace RectifiedTransport
{
namespace
{

// On the line tiles ascend, however many there are: no particle is further back than in the same
// tile.
TEST(ParticleOrder, AscendsOnTheLine)
{
  for (const std::size_t count : { 1000, 100000, 1000000 })
  {
    const Points<1> points = randomPoints<1>({ 1000 }, count);
    ParticleOrder<1> order;
    constexpr int perTile = 8;
    const auto number = static_cast<std::int64_t>(count);
    ASSERT_EQ(order.Sort(points, 0, number, perTile), -1);
    const double tile = 1000.0 * perTile / static_cast<double>(count);
    double highest = 0.0;
    std::vector<char> seen(count, 0);
    for (std::int64_t i = 0; i < number; ++i)
    {
      const std::int64_t particle = order.Order()[i];
      const double x = points[particle][0];
      ASSERT_GT(x, highest - 1.01 * tile) << count << ", at " << i;
      highest = std::max(highest, x);
      seen[particle] = 1;
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), number);
  }
}

// In the plane and in space the way through all particles is short: a few spacings each.
template <int Dimension>
void expectShortWay(const GridSize<Dimension>& size)
{
  constexpr std::size_t count = 40000;
  const Points<Dimension> points = randomPoints<Dimension>(size, count);
  ParticleOrder<Dimension> order;
  ASSERT_EQ(order.Sort(points, 0, count, 8), -1);
  double way = 0.0;
  for (std::size_t i = 1; i < count; ++i)
  {
    const Point<Dimension>& a = points[order.Order()[i - 1]];
    const Point<Dimension>& b = points[order.Order()[i]];
    double square = 0.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      square += (a[axis] - b[axis]) * (a[axis] - b[axis]);
    }
    way += std::sqrt(square);
  }
  const double spacing = std::pow(
    static_cast<double>(cellCount<Dimension>(size)) / static_cast<double>(count), 1.0 / Dimension);
  EXPECT_LT(way / static_cast<double>(count), 3.0 * spacing);
}

TEST(ParticleOrder, IsAShortWay)
{
  expectShortWay<2>({ 300, 200 });
  expectShortWay<3>({ 40, 30, 50 });
}

} // namespace
} // namespace RectifiedTransport
