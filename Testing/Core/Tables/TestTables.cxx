// SPDX-License-Identifier: BSD-3-Clause
// The summed-area tables, node by node.
#include "TestFlow.h"

#include "ThreadsExecutor.h"

#include "Core/Parallel/Progress.h"
#include "Core/Tables/SummedAreaTables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>

namespace RectifiedTransport
{
namespace
{

template <int Dimension>
std::unique_ptr<SummedAreaTables<Dimension>> build(const TestDensity<Dimension>& density)
{
  Progress progress((Context()));
  return std::make_unique<SummedAreaTables<Dimension>>(density.Source(), progress);
}

// The record of a node of a level.
template <int Dimension>
const double* record(
  const TableView<Dimension>& view, int level, const NotDeduced<GridSize<Dimension>>& node)
{
  const double* nodes = view.Levels[level].Nodes;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    nodes += node[axis] * view.Levels[level].Stride[axis];
  }
  return nodes;
}

// Mass and moments of the cells below a node, summed one by one.
template <int Dimension>
std::array<double, Dimension + 1> sumBelow(
  const TestDensity<Dimension>& density, const NotDeduced<GridSize<Dimension>>& node)
{
  std::array<long double, Dimension + 1> sums{};
  for (std::int64_t index = 0; index < cellCount<Dimension>(node); ++index)
  {
    const GridSize<Dimension> cell = cellAt<Dimension>(index, node);
    const long double value = density.Values[cellIndex<Dimension>(cell, density.Size)];
    sums[0] += value;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      sums[1 + axis] += value * (cell[axis] + 0.5L);
    }
  }
  std::array<double, Dimension + 1> rounded;
  std::copy(sums.begin(), sums.end(), rounded.begin());
  return rounded;
}

// Integer values, so that every sum is exact.
template <int Dimension>
TestDensity<Dimension> integerDensity(const GridSize<Dimension>& size)
{
  TestDensity<Dimension> density = randomCells<Dimension>(size);
  for (double& value : density.Values)
  {
    value = std::floor(256.0 * value);
  }
  return density;
}

// A random sample of nodes, the last one among them.
template <int Dimension>
std::vector<GridSize<Dimension>> someNodes(const GridSize<Dimension>& size, std::size_t count)
{
  std::vector<GridSize<Dimension>> nodes = { size };
  for (const Point<Dimension>& point : randomPoints<Dimension>(size, count))
  {
    GridSize<Dimension> node = cellOf<Dimension>(point, size);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      ++node[axis];
    }
    nodes.push_back(node);
  }
  return nodes;
}

template <int Dimension>
void expectExactSums(const GridSize<Dimension>& size, std::size_t samples)
{
  const TestDensity<Dimension> density = integerDensity<Dimension>(size);
  const auto tables = build(density);
  for (const GridSize<Dimension>& node : someNodes<Dimension>(size, samples))
  {
    const double* found = record(tables->View(), 0, node);
    const auto wanted = sumBelow(density, node);
    for (int entry = 0; entry <= Dimension; ++entry)
    {
      ASSERT_EQ(found[entry], wanted[entry]) << "entry " << entry;
    }
  }
}

TEST(Tables, IntegersAreSummedExactly)
{
  expectExactSums<1>({ 1 }, 1);
  expectExactSums<1>({ 70001 }, 200);
  expectExactSums<2>({ 1, 1 }, 1);
  expectExactSums<2>({ 7, 1 }, 20);
  expectExactSums<2>({ 1000, 700 }, 60);
  expectExactSums<2>({ 9000, 4 }, 60);
  expectExactSums<3>({ 1, 1, 1 }, 1);
  expectExactSums<3>({ 3, 100, 5 }, 60);
  expectExactSums<3>({ 100, 90, 37 }, 60);
}

TEST(Tables, RealsAreSummedToRounding)
{
  const TestDensity<2> flat = randomCells<2>({ 300, 257 });
  const auto flatTables = build(flat);
  for (const GridSize<2>& node : someNodes<2>(flat.Size, 60))
  {
    const double* found = record(flatTables->View(), 0, node);
    const auto wanted = sumBelow(flat, node);
    for (int entry = 0; entry <= 2; ++entry)
    {
      EXPECT_NEAR(found[entry] / wanted[entry], 1.0, 1e-13);
    }
  }
  const TestDensity<3> volume = randomCells<3>({ 33, 70, 29 });
  const auto volumeTables = build(volume);
  for (const GridSize<3>& node : someNodes<3>(volume.Size, 60))
  {
    const double* found = record(volumeTables->View(), 0, node);
    const auto wanted = sumBelow(volume, node);
    for (int entry = 0; entry <= 3; ++entry)
    {
      EXPECT_NEAR(found[entry] / wanted[entry], 1.0, 1e-13);
    }
  }
}

// Calls f(level, node, fine node) for all nodes of all levels.
template <int Dimension, class F>
void forAllNodes(
  const TableView<Dimension>& view, const NotDeduced<GridSize<Dimension>>& size, F&& f)
{
  for (int level = 0; level < view.LevelCount; ++level)
  {
    GridSize<Dimension> count;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      count[axis] = ((size[axis] - 1) >> (level * levelShift)) + 2;
    }
    for (std::int64_t index = 0; index < cellCount<Dimension>(count); ++index)
    {
      const GridSize<Dimension> node = cellAt<Dimension>(index, count);
      GridSize<Dimension> fine;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        fine[axis] = std::min(node[axis] << (level * levelShift), size[axis]);
      }
      f(level, node, fine);
    }
  }
}

// Coarse levels hold the fine nodes' bits; where the spacing does not divide a side, the last node
// is the side's end.
template <int Dimension>
void expectLevels(const GridSize<Dimension>& size, int leastLevels)
{
  const TestDensity<Dimension> density = randomCells<Dimension>(size);
  const auto tables = build(density);
  const TableView<Dimension>& view = tables->View();
  EXPECT_GE(view.LevelCount, leastLevels);
  std::int64_t wrong = 0;
  std::int64_t notZero = 0;
  forAllNodes<Dimension>(
    view, size, [&](int level, const GridSize<Dimension>& node, const GridSize<Dimension>& fine) {
      const double* coarse = record(view, level, node);
      const double* exact = record(view, 0, fine);
      wrong += std::memcmp(coarse, exact, view.Record * sizeof(double)) != 0;
      const bool lower = std::find(fine.begin(), fine.end(), 0) != fine.end();
      notZero +=
        lower && std::any_of(coarse, coarse + view.Record, [](double e) { return e != 0.0; });
    });
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(notZero, 0) << "nodes on a lower face are not zero";
}

TEST(Tables, CoarseLevels)
{
  expectLevels<1>({ 70001 }, 3);
  expectLevels<1>({ 64 }, 1);
  expectLevels<2>({ 517, 1023 }, 3);
  expectLevels<2>({ 256, 128 }, 2);
  expectLevels<2>({ 1000, 3 }, 1);
  expectLevels<3>({ 129, 70, 97 }, 2);
  expectLevels<3>({ 64, 64, 64 }, 2);
  expectLevels<3>({ 5, 6, 7 }, 1);
}

TEST(Tables, ExtremeValuesStayFinite)
{
  for (const double unit : { 1e-300, 1e300 })
  {
    const TestDensity<2> density = uniformDensity<2>({ 40, 30 }, unit);
    const auto tables = build(density);
    EXPECT_NEAR(tables->View().Centroid[0], 20.0, 1e-9);
    EXPECT_NEAR(tables->View().Centroid[1], 15.0, 1e-9);
    EXPECT_NEAR(tables->Summary().Total / (1200.0 * unit), 1.0, 1e-13);
  }
}

TEST(Tables, Summary)
{
  const TestDensity<3> density = integerDensity<3>({ 31, 44, 17 });
  const auto tables = build(density);
  const DensitySummary& summary = tables->Summary();
  EXPECT_EQ(summary.Total, sumBelow(density, density.Size)[0]);
  EXPECT_EQ(summary.Maximum, *std::max_element(density.Values.begin(), density.Values.end()));
  EXPECT_EQ(summary.NotFinite, 0);
  EXPECT_EQ(summary.Negative, 0);
  const RectifiedFlow<3> flow = makeFlow(density);
  EXPECT_EQ(flow.Total(), summary.Total);
  EXPECT_EQ(flow.Size(), density.Size);
}

// The largest value, its cells, the first of them, and the next value: of all values, by a sort.
template <int Dimension>
void checkLargest(const GridSize<Dimension>& size, int values)
{
  TestDensity<Dimension> density = uniformDensity<Dimension>(size, 0.0);
  std::mt19937_64 engine(static_cast<std::uint64_t>(values));
  for (double& value : density.Values)
  {
    value = std::floor(uniformNumber(engine) * values);
  }
  std::vector<double> sorted = density.Values;
  std::sort(sorted.rbegin(), sorted.rend());
  const auto most = std::count(sorted.begin(), sorted.end(), sorted.front());
  const auto first = std::find(density.Values.begin(), density.Values.end(), sorted.front());
  const auto expect = [&](const DensitySummary& summary) {
    EXPECT_EQ(summary.Maximum, sorted.front());
    EXPECT_EQ(summary.Maxima, most);
    EXPECT_EQ(summary.FirstMaximum, first - density.Values.begin());
    EXPECT_EQ(summary.BelowMaximum, sorted[static_cast<std::size_t>(most)]);
    EXPECT_EQ(summary.Minimum, sorted.back());
  };
  expect(makeFlow(density).Summary());
  if constexpr (Dimension > 1)
  {
    expect(RectifiedFlow<Dimension>(density.Source(), FlowTables::Tiled).Summary());
  }
}

TEST(Tables, SummaryOfTheLargestValues)
{
  for (const int values : { 3, 200, 1000000 })
  {
    checkLargest<1>({ 1234 }, values);
    checkLargest<2>({ 601, 40 }, values);
    checkLargest<3>({ 31, 44, 70 }, values);
  }
}

// All bits of the nodes of all levels, without what pads their rows.
template <int Dimension>
std::vector<double> allRecords(const SummedAreaTables<Dimension>& tables)
{
  const TableView<Dimension>& view = tables.View();
  std::vector<double> all;
  for (int level = 0; level < view.LevelCount; ++level)
  {
    GridSize<Dimension> nodes;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      nodes[axis] = ((view.Cells[axis] - 1) >> (level * levelShift)) + 2;
    }
    for (std::int64_t index = 0; index < cellCount<Dimension>(nodes); ++index)
    {
      const double* sums = record<Dimension>(view, level, cellAt<Dimension>(index, nodes));
      all.insert(all.end(), sums, sums + TableView<Dimension>::Record);
    }
  }
  return all;
}

// Slabs, and the pages that are touched before, depend on the number of threads.
template <int Dimension>
void checkSlabs(const GridSize<Dimension>& size)
{
  const TestDensity<Dimension> density = twoGaussians<Dimension>(size);
  const auto buildWith = [&density](const Executor& threads, TableMemory memory) {
    // What another density has left.
    std::fill_n(memory.Nodes.data(), memory.Nodes.size(), -1.0);
    Progress progress(threads);
    return SummedAreaTables<Dimension>(density.Source(), progress, std::move(memory));
  };
  SummedAreaTables<Dimension> serial = buildWith(SerialExecutor(), {});
  const std::vector<double> expected = allRecords(serial);
  TableMemory memory = serial.ReleaseMemory();
  for (const int threads : { 2, 3, 64 })
  {
    SummedAreaTables<Dimension> tables = buildWith(ThreadsExecutor(threads), std::move(memory));
    EXPECT_EQ(allRecords(tables), expected) << Dimension << "D, " << threads << " threads";
    memory = tables.ReleaseMemory();
  }
}

TEST(Tables, SlabsOfEveryNumberOfThreads)
{
  checkSlabs<2>({ 700, 1000 });
  checkSlabs<3>({ 60, 70, 150 });
}

// 32 bytes a node and a seventh for coarse levels in 3D: 256^3 stays below 650 MB.
TEST(Tables, Memory)
{
  const RectifiedFlow<3> flow = makeFlow(uniformDensity<3>({ 64, 64, 64 }));
  const double nodes = 65.0 * 65.0 * 65.0;
  EXPECT_GE(static_cast<double>(flow.MemorySize()), 32.0 * nodes);
  EXPECT_LE(static_cast<double>(flow.MemorySize()), 32.0 * nodes * 1.25);
}

} // namespace
} // namespace RectifiedTransport
