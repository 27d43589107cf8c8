// SPDX-License-Identifier: BSD-3-Clause
// The stippling job: 40,000 blue-noise particles on a photograph of 1024^2 pixels, from the
// transcription to the filter's whole update.
#include "FilterRuns.h"
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

void core(benchmark::State& state, int threadCount, Tables tables, FlowMaps maps)
{
  const Photograph& photograph = Photograph::Instance();
  const OpenMPThreads threads(threadCount);
  const OpenMPExecutor executor;
  Particles<2> particles;
  timeFlow(state, photograph.Density, tables, executor, [&](const RectifiedFlow<2>& flow) {
    particles = photograph.Seeds;
    moveForward(flow, particles, executor, maps);
  });
  truth().Report(state, particles);
}

void maps(benchmark::State& state)
{
  const OpenMPThreads threads(1);
  timeMaps<2>(state, Photograph::Instance().Density);
}

void filter(benchmark::State& state, int maps)
{
  vtkNew<vtkImageData> image;
  image->DeepCopy(Photograph::Instance().Image);
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  sampler->InvertDensityOn();
  sampler->SetNumberOfParticles(PhotographParticles);
  sampler->SetFlowMaps(maps);
  timeUpdates(state, sampler, ChangingDensity(image->GetPointData()->GetScalars()));
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
BENCHMARK_CAPTURE(core, new, 1, Tables::New, FlowMaps::Auto)
  ->Name("Photograph/core")
  ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(core, again, 1, Tables::Kept, FlowMaps::Auto)
  ->Name("Photograph/core_again")
  ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(core, off, 1, Tables::New, FlowMaps::Off)
  ->Name("Photograph/core_off")
  ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(core, two, 2, Tables::New, FlowMaps::Auto)
  ->Name("Photograph/core_2_threads")
  ->Unit(benchmark::kMillisecond)
  ->UseRealTime();
BENCHMARK(maps)->Name("Photograph/maps")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(filter, on, vtkTransportSampler::FLOW_MAPS_AUTO)
  ->Name("Photograph/filter")
  ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(filter, off, vtkTransportSampler::FLOW_MAPS_OFF)
  ->Name("Photograph/filter_off")
  ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace RectifiedTransport
