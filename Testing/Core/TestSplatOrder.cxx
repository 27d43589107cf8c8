// SPDX-License-Identifier: BSD-3-Clause
// Who adds the particles, in which tasks and with which instructions: always the bits of a plain
// loop over the particles.
#include "TestSplat.h"

#include "SplatKernels.h"

#include <gtest/gtest.h>

#include <atomic>

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
    one.Points += 3 * i;
    one.Masses += i;
    one.Count = 1;
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
      checkOrder<1>({ 700 }, 9001, options);
      checkOrder<2>({ 150, 140 }, 9001, options);
      checkOrder<3>({ 40, 9, 70 }, 9001, options);
      checkOrder<3>({ 2, 30, 1 }, 5000, options);
    }
  }
}

// A grid that is larger than a cache: particles in no order are sorted even for one task.
TEST(SplatOrder, LargeGrid)
{
  const GridSize<3> size{ 130, 120, 110 };
  const Cloud<3> cloud = randomCloud<3>(size, 300000, -0.01, false);
  const Cloud<3> inOrder = randomCloud<3>(size, 300000, -0.01, true);
  for (const SplatKernel kernel : { SplatKernel::CloudInCell, SplatKernel::TriangularShapedCloud })
  {
    for (const Cloud<3>* particles : { &cloud, &inOrder })
    {
      // In parts, each added to what was there: by chunks of one block, the plain loop.
      const SplatOptions options = splatOptions(kernel);
      const Splatted serial = splat(particles->Particles(), size, options);
      for (const int concurrency : { 2, 5 })
      {
        const Splatted result =
          splat(particles->Particles(), size, options, BackwardExecutor(concurrency));
        EXPECT_EQ(result.Cells, serial.Cells);
        EXPECT_EQ(result.Outside, serial.Outside);
      }
      EXPECT_NEAR(sumOf(serial.Cells), sumOf(particles->Masses), 1e-8);
    }
  }
}

#ifdef __x86_64__
template <int D>
void checkInstructionSets(const GridSize<D>& size, SplatKernel kernel)
{
  const Cloud<D> cloud = randomCloud<D>(size, 1000, -0.2, false);
  std::vector<double> table;
  for (int k = 0; k < 8; ++k)
  {
    table.push_back(std::exp(-0.5 * k * k));
  }
  SplatJob<D, double> job{};
  job.Particles = cloud.Particles();
  job.Width = kernel == SplatKernel::Gaussian ? 7
    : kernel == SplatKernel::NearestCell      ? 1
    : kernel == SplatKernel::CloudInCell      ? 2
                                              : 3;
  job.Renormalize = true;
  job.Scale = 1.3;
  job.Cut = 3.0;
  job.PerVariance = 1.0;
  job.AtOffset = table.data();
  std::int64_t stride = 1;
  for (int a = 0; a < D; ++a)
  {
    job.Size[a] = static_cast<std::int32_t>(size[a]);
    job.Stride[a] = stride;
    job.Kept[a] = std::min(job.Width, job.Size[a]);
    stride *= size[a];
  }
  std::vector<double> scratch(21);
  std::vector<double> cells[2];
  const SplatKernels<D, double> kernels[2] = { splatKernelsSSE2<D, double>(kernel),
    splatKernelsAVX2<D, double>(kernel) };
  for (int set = 0; set < 2; ++set)
  {
    cells[set].assign(static_cast<std::size_t>(stride), 0.0);
    job.Cells = cells[set].data();
    kernels[set].Add(job, 0, nullptr, cloud.Count(), nullptr, scratch.data());
  }
  EXPECT_EQ(cells[0], cells[1]);
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

TEST(SplatMonitor, ProgressAndCancel)
{
  const GridSize<3> size{ 90, 90, 90 };
  const Cloud<3> cloud = randomCloud<3>(size, 400000, 0.0, false);
  std::vector<double> cells(90 * 90 * 90);
  std::vector<double> heard;
  Monitor monitor;
  monitor.Progress = [&heard](double progress) { heard.push_back(progress); };
  const SplatOptions options = splatOptions(SplatKernel::Gaussian);
  const auto run = [&](const Executor& executor) {
    return splatMass<3, double>(
      cloud.Particles(), size, options, 1.0, cells.data(), executor, monitor);
  };
  EXPECT_FALSE(run(SerialExecutor()).Cancelled);
  EXPECT_TRUE(std::is_sorted(heard.begin(), heard.end()));
  EXPECT_GT(heard.size(), 3u);
  EXPECT_NEAR(heard.back(), 1.0, 1e-12);

  for (const int concurrency : { 1, 2 })
  {
    std::atomic<int> asked{ 0 };
    monitor.Cancelled = [&asked]() { return ++asked > 4; };
    heard.clear();
    EXPECT_TRUE(run(BackwardExecutor(concurrency)).Cancelled);
    EXPECT_LT(asked, 40);
  }
}

} // namespace
} // namespace RectifiedTransport
