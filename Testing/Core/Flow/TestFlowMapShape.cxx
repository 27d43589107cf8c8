// SPDX-License-Identifier: BSD-3-Clause
// Which lattices flow maps have.
#include "FlowMapShapes.h"

#include "Core/Flow/RectifiedFlow.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

namespace RectifiedTransport
{
namespace
{

template <int Dimension>
double nodesOf(const typename FlowMapShape<Dimension>::Level& level)
{
  double nodes = 1.0;
  for (const std::int64_t cells : level.Cells)
  {
    nodes *= static_cast<double>(cells + 1);
  }
  return nodes;
}

TEST(FlowMapShape, CoarserLevelsFirst)
{
  for (const FlowDirection direction : { FlowDirection::Forward, FlowDirection::Backward })
  {
    const FlowMapShape<2> shape({ 1024, 1024 }, 64, direction);
    ASSERT_GE(shape.Levels.size(), 2u);
    for (std::size_t i = 1; i < shape.Levels.size(); ++i)
    {
      EXPECT_LT(shape.Levels[i].HandOver, shape.Levels[i - 1].HandOver);
      EXPECT_LT(shape.Levels[i].TimeLeft, shape.Levels[i - 1].TimeLeft);
      EXPECT_GT(nodesOf<2>(shape.Levels[i]), 1.5 * nodesOf<2>(shape.Levels[i - 1]));
    }
    EXPECT_LE(shape.Levels.front().TimeLeft, 0.4);
  }
}

// More steps: more nodes, each in its place with less deviation.
TEST(FlowMapShape, FollowsTheSteps)
{
  const FlowMapShape<2> few = forwardShape<2>({ 500, 400 }, 32);
  const FlowMapShape<2> many = forwardShape<2>({ 500, 400 }, 64);
  ASSERT_FALSE(few.Levels.empty() || many.Levels.empty());
  for (int axis = 0; axis < 2; ++axis)
  {
    EXPECT_DOUBLE_EQ(many.Deviation[axis], few.Deviation[axis] / 4.0);
  }
  EXPECT_GT(nodesOf<2>(many.Levels.back()), nodesOf<2>(few.Levels.back()));
}

TEST(FlowMapShape, NoneWhereTheyDoNotServe)
{
  EXPECT_TRUE(forwardShape<1>({ 100000 }).Levels.empty());
  EXPECT_TRUE(forwardShape<2>({ 1024, 1024 }, 3).Levels.empty());
  EXPECT_TRUE(forwardShape<2>({ 3, 3 }).Levels.empty());
  EXPECT_TRUE(forwardShape<2>({ 4096, 4096 }, 10000).Levels.empty()); // records are floats
  EXPECT_FALSE(forwardShape<2>({ 1024, 1024 }).PaysFor(1000.0));
  EXPECT_TRUE(forwardShape<2>({ 1024, 1024 }).PaysFor(40000.0));
  EXPECT_FALSE(forwardShape<3>({ 256, 256, 256 }).PaysFor(8192.0));
  EXPECT_TRUE(forwardShape<3>({ 128, 128, 128 }).PaysFor(128.0 * 128.0 * 128.0));
}

// The lattices of a stretched grid are those of the square one of as many cells.
TEST(FlowMapShape, FollowsTheAxes)
{
  const FlowMapShape<2> square = forwardShape<2>({ 512, 512 });
  const FlowMapShape<2> flat = forwardShape<2>({ 4096, 64 });
  ASSERT_EQ(square.Levels.size(), flat.Levels.size());
  for (std::size_t i = 0; i < flat.Levels.size(); ++i)
  {
    EXPECT_EQ(square.Levels[i].Cells, flat.Levels[i].Cells);
    EXPECT_EQ(square.Levels[i].HandOver, flat.Levels[i].HandOver);
    EXPECT_DOUBLE_EQ(flat.Levels[i].Layers[0], 64.0 * flat.Levels[i].Layers[1]);
  }
}

// Of any number of steps and size: half of what the tables take.
TEST(FlowMapShape, Memory)
{
  EXPECT_GT(forwardShape<3>({ 256, 256, 256 }).MemorySize(), 1e6);
  EXPECT_LT(forwardShape<3>({ 256, 256, 256 }).MemorySize(), 60e6);
  for (const int count : { 16, 32, 64, 128, 256, 512 })
  {
    for (const std::int64_t side : { 64, 128, 256, 512 })
    {
      const GridSize<2> square{ 8 * side, 6 * side };
      EXPECT_LT(
        forwardShape<2>(square, count).MemorySize(), 0.5 * RectifiedFlow<2>::MemoryFor(square));
      const GridSize<3> cube{ side, side, 2 * side };
      EXPECT_LT(forwardShape<3>(cube, count).MemorySize(), 0.5 * RectifiedFlow<3>::MemoryFor(cube));
    }
  }
  EXPECT_FALSE(forwardShape<3>({ 512, 512, 512 }, 64).Levels.empty());
}

} // namespace
} // namespace RectifiedTransport
