// SPDX-License-Identifier: BSD-3-Clause
// The runs of surface relaxations: the same bits however they run, progress, cancellation, memory
// and errors.
#include "Surfaces/SurfaceRelaxation/Kernels/DotKernels.h"
#include "Surfaces/SurfaceRelaxation/SurfaceRelaxation.h"

#include "../../MemoryLimit.h"
#include "RecordingContext.h"
#include "SurfaceRelaxation/Surfaces.h"
#include "TestRefusal.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <cstring>
#include <ctime>
#include <limits>

namespace RectifiedTransport
{
namespace
{

struct Job
{
  Mesh Surface;
  std::vector<double> Density; // of the triangles
  SurfaceRelaxationOptions Options;

  SurfaceRelaxation Run(const Context& context = Context()) const
  {
    SurfaceDensityValues density;
    density.OfTriangles = this->Density.empty() ? nullptr : this->Density.data();
    return relaxOnSurface(this->Surface.Surface(), density, this->Options, context);
  }
};

// With boundaries, edges of three triangles, jumps, noise and empty triangles.
Job manyThings(std::int64_t samples)
{
  Job job;
  job.Surface = makeLeaves(3, 30);
  std::mt19937_64 random(5);
  for (std::size_t t = 0; t < job.Surface.Triangles.size(); ++t)
  {
    const double part = static_cast<double>(random() % 1000) / 1000.0;
    job.Density.push_back(t < 1800 ? 0.1 : t < 3600 ? 1.0 : part < 0.2 ? 0.0 : part);
  }
  job.Options.NumberOfSamples = samples;
  return job;
}

void expectSame(const SurfaceRelaxation& a, const SurfaceRelaxation& b)
{
  ASSERT_EQ(a.Places.size(), b.Places.size());
  EXPECT_EQ(
    std::memcmp(a.Places.data(), b.Places.data(), static_cast<std::size_t>(a.Places.bytes())), 0);
}

TEST(SurfaceRelaxationRun, Threads)
{
  for (const bool hasDensity : { false, true })
  {
    Job job = manyThings(3001);
    if (!hasDensity)
    {
      job.Density.clear();
    }
    const SurfaceRelaxation serial = job.Run(SerialExecutor());
    for (const int threads : { 2, 3, 7 })
    {
      expectSame(serial, job.Run(ThreadsExecutor(threads)));
    }
  }
}

TEST(SurfaceRelaxationRun, Seeds)
{
  Job job = manyThings(500);
  const SurfaceRelaxation first = job.Run();
  job.Options.RandomSeed = 2;
  const SurfaceRelaxation second = job.Run();
  EXPECT_NE(std::memcmp(first.Places.data(), second.Places.data(),
              static_cast<std::size_t>(first.Places.bytes())),
    0);
}

// The kernels against a plain sum, and each other to the last bit.
TEST(SurfaceRelaxationRun, Kernels)
{
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit;
  std::vector<ScaledDot> dots(29);
  for (ScaledDot& dot : dots)
  {
    const double spacing = 0.5 + unit(random);
    dot = { { unit(random), unit(random), unit(random) }, 1.0 / spacing, 1.0 / std::sqrt(spacing),
      spacing * spacing };
  }
  DotBlock block;
  for (int lane = 0; lane < dotBlock; ++lane)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      block.X[axis][lane] = dots[static_cast<std::size_t>(lane)].X[axis];
    }
    block.Inverse[lane] = dots[static_cast<std::size_t>(lane)].Inverse;
    block.Square[lane] = dots[static_cast<std::size_t>(lane)].Square;
  }
  const std::vector<std::int64_t> blocks{ 0, 1, 3 };
  const DotNeighbourhood inReach{ dots.data(), 29, blocks.data(), 3 };
  DotBlock sums = block;
  dotKernel(InstructionSet::SSE2)(inReach, sums);
  for (int lane = 0; lane < dotBlock; ++lane)
  {
    double push[3] = { 0.0, 0.0, 0.0 };
    double weight = 0.0;
    double mean = 0.0;
    for (std::size_t j = 0; j < 29; ++j)
    {
      const ScaledDot& dot = dots[j];
      double squared = 0.0;
      for (int axis = 0; axis < 3; ++axis)
      {
        squared += std::pow(block.X[axis][lane] - dot.X[axis], 2.0);
      }
      const double bump =
        std::max(0.0, 1.0 - squared * block.Inverse[lane] * dot.Inverse / squaredDotReach);
      if (j / 8 == 2)
      {
        continue;
      }
      for (int axis = 0; axis < 3; ++axis)
      {
        push[axis] += (block.X[axis][lane] - dot.X[axis]) * dot.Root * std::pow(bump, 8.0);
      }
      const double ratio = dot.Square / block.Square[lane];
      if (ratio <= mostOfSquares && ratio >= 1.0 / mostOfSquares)
      {
        weight += bump;
        mean += bump * dot.Square;
      }
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(sums.Push[axis][lane], push[axis], 1e-14);
    }
    EXPECT_NEAR(sums.Weight[lane], weight, 1e-13);
    EXPECT_NEAR(sums.Mean[lane], mean, 1e-13);
  }
  for (const InstructionSet set :
    { InstructionSet::SSE2, InstructionSet::AVX2, InstructionSet::AVX512 })
  {
    if (set > widestInstructionSet())
    {
      continue;
    }
    DotBlock other = block;
    dotKernel(set)(inReach, other);
    EXPECT_EQ(std::memcmp(&sums, &other, sizeof(sums)), 0) << nameOf(set);
  }
}

TEST(SurfaceRelaxationRun, Progress)
{
  const SerialExecutor serial;
  for (const std::int64_t samples : { 0, 3000 })
  {
    RecordingContext recording(serial);
    manyThings(samples).Run(recording.Context());
    recording.ExpectReported(0.0, 1.0);
    const int queries = recording.Queries;
    EXPECT_GT(queries, samples > 0 ? 60 : 10);
    for (const int most : { 0, 5, queries / 3, queries - 1 })
    {
      RecordingContext stopped(serial);
      stopped.MaximumQueries = most;
      EXPECT_THROW(manyThings(samples).Run(stopped.Context()), Cancelled) << most;
    }
  }
}

// Between two queries there is at most a tenth of a second of the processor, with and without a
// density.
TEST(SurfaceRelaxationRun, QueriesOften)
{
  Job job;
  job.Surface = makeTorus(300, 200);
  job.Options.NumberOfSamples = 60000;
  job.Options.Iterations = 2;
  std::mt19937_64 random(5);
  for (const bool hasDensity : { false, true })
  {
    for (std::size_t t = 0; t < job.Surface.Triangles.size() && hasDensity; ++t)
    {
      job.Density.push_back(static_cast<double>(random() % 100));
    }
    int queries = 0;
    std::clock_t longest = 0;
    std::clock_t last = std::clock();
    const SerialExecutor executor;
    const Context context(executor, {}, [&]() {
      const std::clock_t now = std::clock();
      longest = std::max(longest, now - last);
      last = now;
      ++queries;
      return false;
    });
    job.Run(context);
    EXPECT_GT(queries, 20);
    EXPECT_LT(longest, CLOCKS_PER_SEC / 10);
  }
}

#ifdef HAS_MEMORY_LIMIT
// What is foretold is enough, where dots need most of it, and where triangles do; a third is not.
TEST(SurfaceRelaxationRun, ForetoldMemory)
{
  for (const bool isFine : { false, true })
  {
    Job job;
    job.Surface = isFine ? makeTorus(500, 300) : makeTorus(30, 20);
    job.Options.NumberOfSamples = isFine ? 1000 : 200000;
    job.Options.Iterations = 1;
    for (const bool hasDensity : { false, true })
    {
      for (std::size_t t = 0; t < job.Surface.Triangles.size() && hasDensity; ++t)
      {
        job.Density.push_back(t % 7 == 0 ? 1.0 : 5.0);
      }
      const double foretold =
        memoryForSurfaceRelaxation(static_cast<std::int64_t>(job.Surface.Points.size()),
          static_cast<std::int64_t>(job.Surface.Triangles.size()), hasDensity,
          job.Options.NumberOfSamples);
      const SerialExecutor serial;
      const auto runWithin = [&](double bytes) {
        const MemoryLimit limit(static_cast<std::int64_t>(bytes));
        return job.Run(serial);
      };
      EXPECT_EQ(runWithin(foretold).Places.size(), job.Options.NumberOfSamples)
        << isFine << hasDensity;
      EXPECT_THROW(runWithin(foretold / 3.0), std::bad_alloc) << isFine << hasDensity;
    }
  }
}
#endif

TEST(SurfaceRelaxationRun, Errors)
{
  Job job;
  job.Options.NumberOfSamples = 10;
  EXPECT_EQ(refusal([&]() { job.Run(); }), "the surface has no triangles");
  job.Surface = makeTorus(10, 10);
  job.Options.NumberOfSamples = -1;
  EXPECT_EQ(refusal([&]() { job.Run(); }), "the number of samples is -1; it must be at least 0");
  job.Options.NumberOfSamples = 10;
  job.Options.Iterations = -2;
  EXPECT_EQ(refusal([&]() { job.Run(); }), "the number of iterations is -2; it must be at least 0");
  job.Options.Iterations = 1;
  job.Surface.Points[7][1] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal([&]() { job.Run(); }), "point 7 is not finite");
  job.Surface.Triangles[0][1] = 100;
  EXPECT_EQ(
    refusal([&]() { job.Run(); }), "triangle 0 has the point 100, but there are 100 points");
  job.Surface = makeQuads(2, 2, [](double u, double) { return Point<3>{ u, u, 2.0 * u }; });
  EXPECT_EQ(refusal([&]() { job.Run(); }), "no triangle of the surface has an area");
  job.Surface = makeQuads(2, 2, [](double, double) { return Point<3>{ 1.0, 1.0, 1.0 }; });
  EXPECT_EQ(refusal([&]() { job.Run(); }), "no triangle of the surface has an area");
}

} // namespace
} // namespace RectifiedTransport
