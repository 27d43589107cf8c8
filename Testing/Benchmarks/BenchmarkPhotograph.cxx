// SPDX-License-Identifier: BSD-3-Clause
// The stippling job: 40,000 blue-noise particles on a photograph of 1024^2 pixels, from the
// transcription to the filter's whole update.
#include "PaperTransport.h"
#include "PhotographInput.h"

#include <vtkPolyData.h>
#include <vtkTransportSampler.h>

#include <algorithm>

namespace RectifiedTransport
{
namespace
{

const SampleTruth<2>& truth()
{
  static const SampleTruth<2> sample(
    Photograph::Instance().Density, Photograph::Instance().Seeds, 2000);
  return sample;
}

void paper(benchmark::State& state, Paper::FinalVelocity finalVelocity)
{
  const Photograph& photograph = Photograph::Instance();
  Particles<2> particles;
  for (auto _ : state)
  {
    particles = photograph.Seeds;
    const auto tables = Paper::buildTables(photograph.Density.Values, photograph.Density.Size);
    Paper::advect(tables, particles, PaperSteps, finalVelocity);
  }
  truth().Report(state, particles);
}

// The seeds sorted by rows of 16 cells, to see what the order is worth to the transcription.
void paperSorted(benchmark::State& state)
{
  const Photograph& photograph = Photograph::Instance();
  Particles<2> sorted = photograph.Seeds;
  std::sort(sorted.begin(), sorted.end(), [](const Point<2>& p, const Point<2>& q) {
    const auto key = [](const Point<2>& r) { return std::make_pair(std::floor(r[1] / 16), r[0]); };
    return key(p) < key(q);
  });
  for (auto _ : state)
  {
    Particles<2> particles = sorted;
    const auto tables = Paper::buildTables(photograph.Density.Values, photograph.Density.Size);
    Paper::advect(tables, particles, PaperSteps, Paper::FinalVelocity::Zero);
    benchmark::DoNotOptimize(particles.data());
  }
}

void core(benchmark::State& state, int threadCount)
{
  const Photograph& photograph = Photograph::Instance();
  const OpenMPThreads threads(threadCount);
  Particles<2> particles;
  for (auto _ : state)
  {
    particles = photograph.Seeds;
    const RectifiedFlow<2> flow(photograph.Density.Source());
    moveForward(flow, particles, OpenMPExecutor());
  }
  truth().Report(state, particles);
}

void filter(benchmark::State& state)
{
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetNumberOfParticles(PhotographParticles);
  runOnPhotograph(state, sampler);
  vtkPolyData* output = sampler->GetOutput();
  Particles<2> particles(static_cast<std::size_t>(output->GetNumberOfPoints()));
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    double point[3];
    output->GetPoint(static_cast<vtkIdType>(i), point);
    particles[i] = { point[0] + 0.5, point[1] + 0.5 };
  }
  truth().Report(state, particles);
}

BENCHMARK_CAPTURE(paper, published, Paper::FinalVelocity::Zero)
  ->Name("Photograph/paper")
  ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(paper, limit, Paper::FinalVelocity::Limit)
  ->Name("Photograph/paper_limit")
  ->Unit(benchmark::kMillisecond);
BENCHMARK(paperSorted)->Name("Photograph/paper_sorted")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(core, one, 1)->Name("Photograph/core")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(core, two, 2)
  ->Name("Photograph/core_2_threads")
  ->Unit(benchmark::kMillisecond)
  ->UseRealTime();
BENCHMARK(filter)->Name("Photograph/filter")->Unit(benchmark::kMillisecond);

} // namespace
} // namespace RectifiedTransport
