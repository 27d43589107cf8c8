// SPDX-License-Identifier: BSD-3-Clause
// One kernel source, compiled for several instruction sets: all compute the same bits.
#include "TestFlow.h"

#include "Core/Flow/Kernels/FlowKernels.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/SummedAreaTables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace RectifiedTransport
{
namespace
{

// Those that this machine runs, the plainest first.
std::vector<const FlowKernels*> runnableKernels()
{
  std::vector<const FlowKernels*> kernels = { &flowKernelsSSE2() };
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2"))
  {
    kernels.push_back(&flowKernelsAVX2());
  }
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
    __builtin_cpu_supports("avx512vl"))
  {
    kernels.push_back(&flowKernelsAVX512());
  }
#endif
  return kernels;
}

template <int Dimension>
struct BlockRun
{
  Points<Dimension> Positions;
  std::vector<char> Troubled;
  std::int64_t Evaluations = 0;
};

// Advects all seeds block by block with the given kernels.
template <int Dimension>
BlockRun<Dimension> advect(
  const FlowKernels& kernels, FlowJob<Dimension> job, const NotDeduced<Points<Dimension>>& seeds)
{
  const auto count = static_cast<std::int64_t>(seeds.size());
  BlockRun<Dimension> run{ seeds, std::vector<char>(seeds.size()) };
  job.Output = run.Positions.data()->data();
  std::vector<std::int64_t> index(seeds.size());
  std::iota(index.begin(), index.end(), 0);
  for (std::int64_t first = 0; first < count; first += BlockSize)
  {
    bool troubled[BlockSize] = {};
    const int lanes = static_cast<int>(std::min<std::int64_t>(BlockSize, count - first));
    run.Evaluations += kernels.Advect<Dimension>()(
      job, seeds[first].data(), index.data() + first, lanes, 0, troubled);
    std::copy_n(troubled, lanes, run.Troubled.begin() + first);
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
  std::vector<StepWeights> weights;
  for (std::int64_t step = 0; step < 24; ++step)
  {
    weights.push_back(multistepWeights(step, 24));
  }
  for (const bool nearest : { false, true })
  {
    for (const bool back : { false, true })
    {
      for (const Integrator method : AllIntegrators)
      {
        FlowJob<Dimension> job{};
        job.Tables = tables.View();
        job.Method = method;
        job.Backward = back;
        job.Nearest = nearest;
        job.Tolerance = 0.01;
        job.Steps = 24;
        job.Weights = method == Integrator::Multistep ? weights.data() : nullptr;
        job.CoarseRatio = 32.0;
        job.TimeCount = 1;
        const BlockRun<Dimension> plain = advect(flowKernelsSSE2(), job, seeds);
        for (const FlowKernels* kernels : runnableKernels())
        {
          const std::string what = std::string(kernels->InstructionSet) + ", " + nameOf(method) +
            (back ? ", backward" : ", forward") + (nearest ? ", nearest" : "");
          const BlockRun<Dimension> run = advect(*kernels, job, seeds);
          EXPECT_TRUE(sameBits<Dimension>(run.Positions, plain.Positions)) << what;
          EXPECT_EQ(run.Troubled, plain.Troubled) << what;
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

} // namespace
} // namespace RectifiedTransport
