// SPDX-License-Identifier: BSD-3-Clause
// Tables of a part of the nodes, and of a part of the domain: sums at nodes are those of the cells.
#include "Core/Parallel/Progress.h"
#include "Core/Tables/GradedTables.h"
#include "Core/Tables/TileTables.h"

#include "TestDensities.h"
#include "TestDimensions.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace RectifiedTransport
{
namespace
{

TEST(GradedNodes, AreDenserTowardsTheFaces)
{
  for (const std::int64_t size : { 1, 2, 3, 7, 40, 97, 256, 1000 })
  {
    for (const std::int64_t stride : { 1, 2, 4, 16 })
    {
      constexpr double ratio = 6.0;
      const std::vector<std::int64_t> nodes = gradedNodes(size, stride, ratio);
      ASSERT_EQ(nodes.front(), 0);
      ASSERT_EQ(nodes.back(), size);
      for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
      {
        const std::int64_t width = nodes[i + 1] - nodes[i];
        const auto distance = static_cast<double>(std::min(nodes[i], size - nodes[i + 1]));
        ASSERT_GE(width, 1);
        EXPECT_LE(width, stride);
        EXPECT_LE(static_cast<double>(width), std::max(1.0, distance / ratio));
        EXPECT_EQ(nodes[i], size - nodes[nodes.size() - 1 - i]);
      }
      EXPECT_TRUE(stride > 1 || static_cast<std::int64_t>(nodes.size()) == size + 1);
    }
  }
}

// Mass and first moments of the grid cells from `low` up to `high`.
template <int Dimension>
std::vector<double> sumsOf(const TestDensity<Dimension>& density, const GridSize<Dimension>& low,
  const GridSize<Dimension>& high)
{
  std::vector<double> sums(1 + Dimension);
  for (std::size_t i = 0; i < density.Values.size(); ++i)
  {
    const GridSize<Dimension> cell = cellAt<Dimension>(static_cast<std::int64_t>(i), density.Size);
    bool isInside = true;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      isInside = isInside && cell[axis] >= low[axis] && cell[axis] < high[axis];
    }
    if (isInside)
    {
      sums[0] += density.Values[i];
      for (int axis = 0; axis < Dimension; ++axis)
      {
        sums[1 + axis] += density.Values[i] * (static_cast<double>(cell[axis]) + 0.5);
      }
    }
  }
  return sums;
}

template <int Dimension>
void expectSums(const double* record, const std::vector<double>& sums, double all)
{
  for (int entry = 0; entry <= Dimension; ++entry)
  {
    EXPECT_NEAR(record[entry], sums[entry], 1e-10 * all);
  }
}

template <class T>
using PartTables = DimensionTest<T>;
TYPED_TEST_SUITE(PartTables, PlaneAndSpace);

TYPED_TEST(PartTables, OfFewNodes)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = sizeFor<D>({ 1 }, { 91, 78 }, { 29, 34, 25 });
  const TestDensity<D> density = randomCells<D>(size);
  const DensityArray<D, double> source = density.Source();
  constexpr double ratio = 3.0;
  const GridSize<D> strides = sizeFor<D>({ 1 }, { 4, 2 }, { 4, 2, 1 });
  Progress progress{ Context() };
  const GradedTables<D> tables(source, strides, ratio, progress);
  std::vector<std::int64_t> nodes[D];
  std::int64_t count = 1;
  for (int axis = 0; axis < D; ++axis)
  {
    nodes[axis] = gradedNodes(size[axis], strides[axis], ratio);
    count *= static_cast<std::int64_t>(nodes[axis].size());
  }
  const TableView<D>& view = tables.View();
  const std::vector<double> all = sumsOf<D>(density, GridSize<D>{}, size);
  EXPECT_NEAR(tables.Summary().Total, all[0], 1e-10 * all[0]);
  for (std::int64_t i = 0; i < count; i += D == 3 ? 7 : 1)
  {
    GridSize<D> node;
    std::int64_t rest = i;
    std::int64_t offset = 0;
    for (int axis = 0; axis < D; ++axis)
    {
      const auto along = static_cast<std::int64_t>(nodes[axis].size());
      const std::int64_t place = rest % along;
      rest /= along;
      offset += place * view.Levels[1].Stride[axis];
      node[axis] = nodes[axis][static_cast<std::size_t>(place)];
      EXPECT_EQ(view.Uneven[axis].Places[place], static_cast<double>(node[axis]));
    }
    expectSums<D>(view.Levels[1].Nodes + offset, sumsOf<D>(density, GridSize<D>{}, node),
      static_cast<double>(size[0]) * all[0]);
  }

  const SerialExecutor serial;
  Progress alone{ Context(serial) };
  const GradedTables<D> again(source, strides, ratio, alone);
  const std::int64_t last =
    view.Levels[1].Stride[D - 1] * static_cast<std::int64_t>(nodes[D - 1].size() - 1);
  for (std::int64_t i = 0; i < last; i += view.Levels[1].Stride[D - 1])
  {
    EXPECT_EQ(std::memcmp(view.Levels[1].Nodes + i, again.View().Levels[1].Nodes + i,
                nodes[0].size() * 4 * sizeof(double)),
      0);
  }
}

TYPED_TEST(PartTables, OfPartsOneAfterAnother)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = sizeFor<D>({ 1 }, { 91, 78 }, { 29, 34, 25 });
  const TestDensity<D> density = randomCells<D>(size);
  const DensityArray<D, double> source = density.Source();
  Progress progress{ Context() };
  const GradedTables<D> whole(source, evenSize<D>(2), 3.0, progress);
  TileTables<D> tile(whole.View(), whole.Scaling());
  const auto part = [](const GridSize<2>& plane, const GridSize<3>& space) {
    return sizeFor<D>({ 1 }, plane, space);
  };
  const std::vector<std::pair<GridSize<D>, GridSize<D>>> parts = {
    { part({ 5, 7 }, { 5, 7, 2 }), part({ 20, 30 }, { 20, 21, 12 }) },
    { part({ 0, 0 }, { 0, 0, 0 }), size },
    { part({ 90, 0 }, { 28, 0, 24 }), part({ 91, 78 }, { 29, 34, 25 }) },
  };
  for (const auto& [low, high] : parts)
  {
    tile.Build(source, low, high, progress);
    const TableView<D>& view = tile.View();
    const std::vector<double> all = sumsOf<D>(density, low, high);
    GridSize<D> span;
    for (int axis = 0; axis < D; ++axis)
    {
      EXPECT_EQ(view.Low[axis], static_cast<double>(low[axis]));
      EXPECT_EQ(view.High[axis], static_cast<double>(high[axis]));
      EXPECT_EQ(view.Size[axis], static_cast<double>(size[axis]));
      span[axis] = high[axis] - low[axis] + 1;
    }
    for (std::int64_t i = 0; i < cellCount<D>(span); i += D == 3 ? 61 : 7)
    {
      GridSize<D> node = cellAt<D>(i, span);
      std::int64_t offset = 0;
      for (int axis = 0; axis < D; ++axis)
      {
        node[axis] += low[axis];
        offset += node[axis] * view.Levels[0].Stride[axis];
      }
      expectSums<D>(view.Levels[0].Nodes + offset, sumsOf<D>(density, low, node),
        static_cast<double>(size[0]) * all[0]);
    }
    EXPECT_GT(TileTables<D>::MemoryFor(span), 8.0 * (1 + D) * numberOfCells<D>(span));
  }
}

} // namespace
} // namespace RectifiedTransport
