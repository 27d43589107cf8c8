// SPDX-License-Identifier: BSD-3-Clause
// Who adds the particles, in which tasks and with which instructions: always the bits of a plain
// loop over the particles.
#include "TestSplat.h"

#include "Core/Splat/Kernels/SplatKernels.h"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>

namespace RectifiedTransport
{
namespace
{

// One particle at a time, whose shares are then added in a plain loop.
template <int D>
Splatted oneByOne(const Cloud<D>& cloud, const GridSize<D>& size, const SplatOptions& options)
{
  Splatted sum{ std::vector<double>(static_cast<std::size_t>(numberOfCells<D>(size)), 0.0) };
  for (std::int64_t i = 0; i < cloud.Count(); ++i)
  {
    SplatParticles<D, double> one = cloud.Particles();
    one.Points = one.Points.Part(i, 1);
    one.Masses += i;
    const Splatted share = splat(one, size, options);
    sum.Outside += share.Outside;
    for (std::size_t cell = 0; cell < sum.Cells.size(); ++cell)
    {
      sum.Cells[cell] += share.Cells[cell];
    }
  }
  return sum;
}

template <int D>
void checkOrder(const GridSize<D>& size, std::int64_t count, const SplatOptions& options)
{
  for (const bool sorted : { false, true })
  {
    // Some are outside.
    const Cloud<D> cloud = randomCloud<D>(size, count, -0.3, sorted);
    const Splatted expected = oneByOne<D>(cloud, size, options);
    EXPECT_GT(expected.Outside, 0);
    for (const int concurrency : { 1, 2, 3, 64 })
    {
      const Splatted result =
        splat(cloud.Particles(), size, options, BackwardExecutor(concurrency));
      EXPECT_EQ(result.Outside, expected.Outside);
      EXPECT_EQ(result.Cells, expected.Cells)
        << D << "D, kernel " << static_cast<int>(options.Kernel) << ", " << concurrency
        << (sorted ? " sorted" : " random");
    }
    EXPECT_EQ(splat(cloud.Particles(), size, options, OpenMPExecutor()).Cells, expected.Cells);
  }
}

TEST(SplatOrder, PlainLoop)
{
  for (const SplatKernel kernel : allKernels)
  {
    for (const SplatBoundary boundary : { SplatBoundary::Renormalize, SplatBoundary::Drop })
    {
      const SplatOptions options = splatOptions(kernel, boundary);
      checkOrder<1>({ 300 }, 9001, options);
      checkOrder<2>({ 150, 20 }, 9001, options);
      checkOrder<3>({ 36, 5, 70 }, 9001, options);
      checkOrder<3>({ 2, 30, 1 }, 4500, options);
    }
  }
}

// All particles to all cells by one call of a kernel.
template <int D>
std::vector<double> addInOrder(const Cloud<D>& cloud, const GridSize<D>& size, SplatKernel kernel,
  const SplatKernels<D, double>& kernels)
{
  std::vector<double> table;
  for (int k = 0; k < 8; ++k)
  {
    table.push_back(kernels.Exponential(-0.5 * k * k));
  }
  SplatJob<D, double> job{};
  job.Particles = cloud.Particles();
  job.Width = kernel == SplatKernel::Gaussian ? 7
    : kernel == SplatKernel::NearestCell      ? 1
    : kernel == SplatKernel::CloudInCell      ? 2
                                              : 3;
  job.Renormalize = true;
  job.Scale = 1.0;
  job.Cut = 3.0;
  job.PerVariance = 1.0;
  job.AtOffset = table.data();
  std::int64_t stride = 1;
  for (int a = 0; a < D; ++a)
  {
    job.Size[a] = static_cast<std::int32_t>(size[a]);
    job.Memory.Stride[a] = stride;
    job.Span[a] = std::min(job.Width, job.Size[a]);
    stride *= size[a];
  }
  std::vector<double> scratch(21);
  std::vector<double> cells(static_cast<std::size_t>(stride), 0.0);
  job.Memory.Cells = cells.data();
  kernels.Add(job, 0, nullptr, cloud.Count(), nullptr, scratch.data());
  return cells;
}

// A grid of many tiles and planes.
TEST(SplatOrder, LargeGrid)
{
  const GridSize<3> size{ 130, 120, 110 };
  for (const bool sorted : { false, true })
  {
    const Cloud<3> cloud = randomCloud<3>(size, 300000, -0.01, sorted);
    for (const SplatKernel kernel : allKernels)
    {
      const std::vector<double> expected =
        addInOrder<3>(cloud, size, kernel, splatKernels<3, double>(kernel));
      for (const int concurrency : { 1, 2, 20 })
      {
        EXPECT_EQ(
          splat(cloud.Particles(), size, splatOptions(kernel), BackwardExecutor(concurrency)).Cells,
          expected);
      }
    }
  }
}

#ifdef __x86_64__
template <int D>
void checkInstructionSets(const GridSize<D>& size, SplatKernel kernel)
{
  const Cloud<D> cloud = randomCloud<D>(size, 1000, -0.2, false);
  EXPECT_EQ(addInOrder<D>(cloud, size, kernel, splatKernelsSSE2<D, double>(kernel)),
    addInOrder<D>(cloud, size, kernel, splatKernelsAVX2<D, double>(kernel)));
}

TEST(SplatOrder, InstructionSets)
{
  if (!__builtin_cpu_supports("avx2"))
  {
    GTEST_SKIP();
  }
  for (const SplatKernel kernel : allKernels)
  {
    checkInstructionSets<1>({ 50 }, kernel);
    checkInstructionSets<2>({ 50, 20 }, kernel);
    checkInstructionSets<3>({ 20, 30, 10 }, kernel);
  }
}
#endif

TEST(SplatContext, ProgressAndCancel)
{
  const GridSize<3> size{ 90, 90, 90 };
  const Cloud<3> cloud = randomCloud<3>(size, 400000, 0.0, false);
  std::vector<double> cells(90 * 90 * 90);
  std::vector<double> reported;
  std::function<bool()> isCancelled;
  const SplatOptions options = splatOptions(SplatKernel::Gaussian);
  const auto run = [&](const Executor& executor) {
    const Context context(
      executor, [&reported](double progress) { reported.push_back(progress); }, isCancelled);
    splatMass<3, double>(cloud.Particles(), size, options, 1.0, cells.data(), context);
  };
  run(SerialExecutor());
  EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end()));
  EXPECT_GT(reported.size(), 3u);
  EXPECT_NEAR(reported.back(), 1.0, 1e-12);

  for (const int concurrency : { 1, 2 })
  {
    std::atomic<int> asked{ 0 };
    isCancelled = [&asked]() { return ++asked > 4; };
    reported.clear();
    EXPECT_THROW(run(BackwardExecutor(concurrency)), Cancelled);
    EXPECT_LT(asked, 40);
    EXPECT_TRUE(reported.empty() || reported.back() < 0.9) << "went on after it was cancelled";
  }
}

} // namespace
} // namespace RectifiedTransport
