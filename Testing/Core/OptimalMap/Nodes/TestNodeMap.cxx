// SPDX-License-Identifier: BSD-3-Clause
// Smoothing a map at nodes: stairs go, linear maps and the ends of axes stay, the same bits.
#include "Core/OptimalMap/Nodes/NodeMap.h"

#include "TestDensities.h"
#include "TestDimensions.h"
#include "ThreadsExecutor.h"

#include "Core/Parallel/Progress.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace RectifiedTransport
{
namespace
{

template <int D>
GridSize<D> someCells()
{
  return sizeFor<D>({ 400 }, { 300, 12 }, { 14, 20, 8 });
}

template <int D>
GridSize<D> nodesOf(const GridSize<D>& cells)
{
  GridSize<D> nodes = cells;
  for (std::int64_t& count : nodes)
  {
    ++count;
  }
  return nodes;
}

// Coordinates of images from the place of a node.
template <int D, class Function>
NodeMap<D> mapOf(const GridSize<D>& cells, const Function& imageOf)
{
  auto map = NodeMap<D>::On({ cells, evenPoint<D>(0.1) });
  for (std::int64_t node = 0; node < map.Grid.NumberOfNodes(); ++node)
  {
    const Point<D> image = imageOf(cellAt<D>(node, nodesOf<D>(cells)));
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      map.Images[axis].data()[node] = image[axis];
    }
  }
  return map;
}

template <int D>
void smooth(NodeMap<D>& map, int threads)
{
  const ThreadsExecutor executor(threads);
  Progress progress{ Context(executor) };
  smoothMap<D>(map, progress);
}

template <class T>
using SmoothedMaps = DimensionTest<T>;
TYPED_TEST_SUITE(SmoothedMaps, Dimensions, );

TYPED_TEST(SmoothedMaps, KeepLinearOnes)
{
  constexpr int D = TypeParam::value;
  const auto linear = [](const GridSize<D>& node) {
    Point<D> image;
    for (int axis = 0; axis < D; ++axis)
    {
      image[axis] = 3.0 + 0.5 * static_cast<double>(node[axis]) +
        0.25 * static_cast<double>(node[D - 1 - axis]);
    }
    return image;
  };
  const NodeMap<D> expected = mapOf<D>(someCells<D>(), linear);
  for (const int threads : { 1, 3 })
  {
    NodeMap<D> map = mapOf<D>(someCells<D>(), linear);
    smooth<D>(map, threads);
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      for (std::int64_t node = 0; node < map.Grid.NumberOfNodes(); ++node)
      {
        ASSERT_EQ(map.Images[axis].data()[node], expected.Images[axis].data()[node]);
      }
    }
  }
}

// Stairs along each axis: every other node half a cell too far.
TYPED_TEST(SmoothedMaps, LoseTheirStairs)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> cells = someCells<D>();
  for (int along = 0; along < D; ++along)
  {
    NodeMap<D> map = mapOf<D>(cells, [&](const GridSize<D>& node) {
      return evenPoint<D>(10.0 + (node[along] % 2 == 0 ? 0.25 : -0.25));
    });
    smooth<D>(map, 2);
    for (std::int64_t node = 0; node < map.Grid.NumberOfNodes(); ++node)
    {
      const std::int64_t at = cellAt<D>(node, nodesOf<D>(cells))[along];
      const bool isEnd = at == 0 || at == cells[along];
      ASSERT_EQ(map.Images[0].data()[node], isEnd ? 10.25 : 10.0) << "along axis " << along;
    }
  }
}

} // namespace
} // namespace RectifiedTransport
