// SPDX-License-Identifier: BSD-3-Clause
// One kernel source, compiled for several instruction sets: all compute the same bits.
#include "TestFlow.h"

#include "Core/Flow/Kernels/FlowKernels.h"
#include "Core/Parallel/InstructionSet.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/Kernels/TableKernels.h"
#include "Core/Tables/SummedAreaTables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace RectifiedTransport
{
namespace
{

// Those that this machine runs, the plainest first.
std::vector<InstructionSet> runnableSets()
{
  std::vector<InstructionSet> sets;
  for (const InstructionSet set :
    { InstructionSet::SSE2, InstructionSet::AVX2, InstructionSet::AVX512 })
  {
    if (set <= widestInstructionSet())
    {
      sets.push_back(set);
    }
  }
  return sets;
}

template <int Dimension>
struct BlockRun
{
  Points<Dimension> Positions;
  std::vector<char> Unresolved;
  std::int64_t Evaluations = 0;
};

// Advects all seeds block by block with the given kernels.
template <int Dimension>
BlockRun<Dimension> advect(const FlowKernels<Dimension>& kernels, FlowJob<Dimension> job,
  const NotDeduced<Points<Dimension>>& seeds)
{
  const auto count = static_cast<std::int64_t>(seeds.size());
  BlockRun<Dimension> run{ seeds, std::vector<char>(seeds.size()) };
  job.Output = run.Positions.data()->data();
  std::vector<std::int64_t> index(seeds.size());
  std::iota(index.begin(), index.end(), 0);
  for (std::int64_t first = 0; first < count; first += BlockSize)
  {
    bool unresolved[BlockSize] = {};
    const int lanes = static_cast<int>(std::min<std::int64_t>(BlockSize, count - first));
    run.Evaluations +=
      kernels.Advect(job, seeds[first].data(), index.data() + first, lanes, 0, unresolved);
    std::copy_n(unresolved, lanes, run.Unresolved.begin() + first);
  }
  return run;
}

template <int Dimension>
void expectSameBits(const TestDensity<Dimension>& density)
{
  const SerialExecutor serial;
  Progress progress(serial);
  const SummedAreaTables<Dimension> tables(density.Source(), progress);
  const Points<Dimension> seeds = randomPoints<Dimension>(density.Size, 1000);
  for (const bool nearest : { false, true })
  {
    for (const bool back : { false, true })
    {
      const std::vector<StepWeights> weights =
        multistepWeightsOf(24, back ? FlowDirection::Backward : FlowDirection::Forward);
      for (const Integrator method : AllIntegrators)
      {
        FlowJob<Dimension> job{};
        job.Tables = tables.View();
        job.Integrator = method;
        job.Backward = back;
        job.Nearest = nearest;
        job.Tolerance = 0.01;
        job.Steps = 24;
        job.Weights = method == Integrator::Multistep ? weights.data() : nullptr;
        job.CoarseRatio = 32.0;
        job.TimeCount = 1;
        const BlockRun<Dimension> plain =
          advect(flowKernels<Dimension>(InstructionSet::SSE2), job, seeds);
        for (const InstructionSet set : runnableSets())
        {
          const std::string what = std::string(nameOf(set)) + ", " + nameOf(method) +
            (back ? ", backward" : ", forward") + (nearest ? ", nearest" : "");
          const BlockRun<Dimension> run = advect(flowKernels<Dimension>(set), job, seeds);
          EXPECT_TRUE(sameBits<Dimension>(run.Positions, plain.Positions)) << what;
          EXPECT_EQ(run.Unresolved, plain.Unresolved) << what;
          EXPECT_EQ(run.Evaluations, plain.Evaluations) << what;
        }
      }
    }
  }
}

TEST(InstructionSets, SameBits)
{
  expectSameBits(discWithHole<1>({ 400 }));
  expectSameBits(discWithHole<2>({ 130, 97 }));
  expectSameBits(randomCells<2>({ 300, 140 }));
  expectSameBits(discWithHole<3>({ 40, 70, 37 }));
}

// A row of cells of any length, with one that is wrong.
TEST(InstructionSets, SameBitsOfARow)
{
  for (const std::int64_t count : { 1, 7, 8, 61 })
  {
    TestDensity<1> density = randomCells<1>({ count });
    density.Values[static_cast<std::size_t>(count / 2)] = -1.0;
    const RowInspection plain =
      tableKernels(InstructionSet::SSE2).Inspect(density.Values.data(), count);
    EXPECT_EQ(plain.Wrong, 1);
    EXPECT_EQ(plain.Smallest, -1.0);
    for (const InstructionSet set : runnableSets())
    {
      const RowInspection row = tableKernels(set).Inspect(density.Values.data(), count);
      EXPECT_EQ(row.Sum, plain.Sum) << nameOf(set) << ", " << count;
      EXPECT_EQ(row.Moment, plain.Moment) << nameOf(set) << ", " << count;
      EXPECT_EQ(row.Largest, plain.Largest) << nameOf(set) << ", " << count;
      EXPECT_EQ(row.Smallest, plain.Smallest) << nameOf(set) << ", " << count;
      EXPECT_EQ(row.Wrong, plain.Wrong) << nameOf(set) << ", " << count;
    }
  }
}

// What the environment asks for, where the processor has it.
TEST(InstructionSets, Chosen)
{
  const char* asked = std::getenv("RECTIFIEDTRANSPORT_ISA");
  InstructionSet expected = widestInstructionSet();
  for (const InstructionSet set : runnableSets())
  {
    expected = asked && std::string(asked) == nameOf(set) ? set : expected;
  }
  EXPECT_EQ(instructionSet(), expected);
  const auto expectFlow = [&](auto kernels, auto wanted) {
    EXPECT_EQ(kernels.Advect, wanted.Advect);
    EXPECT_EQ(kernels.Advance, wanted.Advance);
    EXPECT_EQ(kernels.Read, wanted.Read);
  };
  expectFlow(flowKernels<1>(), flowKernels<1>(expected));
  expectFlow(flowKernels<2>(), flowKernels<2>(expected));
  expectFlow(flowKernels<3>(), flowKernels<3>(expected));
  EXPECT_EQ(&tableKernels(), &tableKernels(expected));
}

} // namespace
} // namespace RectifiedTransport
