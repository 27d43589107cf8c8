// SPDX-License-Identifier: BSD-3-Clause
// One particle a cell of a volume: transcription, core and the filter's whole update. The
// transcription moves a fixed share of the particles (32 runs of 1024, see latticeParticles); at
// 256^3 so do the core and the filter, an eighth. Times of a share are scaled to the whole.
// As in BenchmarkTables, memory is used once before the clock starts.
#include "BenchmarkInputs.h"

#include "FilterRuns.h"
#include "PaperTransport.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTransportSampler.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>

namespace RectifiedTransport
{
namespace
{

constexpr std::int64_t PaperRuns = 32;

struct Volume
{
  const TestDensity<3>& Density;
  Particles<3> PaperSeeds;
  Particles<3> Seeds;
  SampleTruth<3> PaperTruth;
  SampleTruth<3> Truth;

  explicit Volume(std::int64_t side)
    : Density(texturedGaussians<3>(side))
    , PaperSeeds(latticeParticles<3>(this->Density.Size, PaperRuns))
    , Seeds(latticeParticles<3>(this->Density.Size, side > 128 ? 2048 : 0))
    , PaperTruth(this->Density, this->PaperSeeds, 500)
    , Truth(this->Density, this->Seeds, 1000)
  {
  }

  double Share(const Particles<3>& particles) const
  {
    return static_cast<double>(particles.size()) / static_cast<double>(this->Density.Values.size());
  }

  static const Volume& Instance(std::int64_t side)
  {
    static std::map<std::int64_t, std::unique_ptr<Volume>> volumes;
    std::unique_ptr<Volume>& volume = volumes[side];
    if (!volume)
    {
      volume = std::make_unique<Volume>(side);
    }
    return *volume;
  }
};

void paper(benchmark::State& state)
{
  const Volume& volume = Volume::Instance(state.range(0));
  Particles<3> particles;
  benchmark::DoNotOptimize(Paper::buildTables(volume.Density.Values, volume.Density.Size));
  for (auto _ : state)
  {
    particles = volume.PaperSeeds;
    const Stopwatch tablesTime;
    const auto tables = Paper::buildTables(volume.Density.Values, volume.Density.Size);
    const double seconds = tablesTime.Seconds();
    const Stopwatch flowTime;
    Paper::advect(tables, particles, PaperSteps, Paper::FinalVelocity::Zero);
    state.SetIterationTime(seconds + flowTime.Seconds() / volume.Share(particles));
  }
  volume.PaperTruth.Report(state, particles);
}

void core(benchmark::State& state)
{
  const Volume& volume = Volume::Instance(state.range(0));
  Particles<3> particles;
  double unscaled = 0.0;
  benchmark::DoNotOptimize(RectifiedFlow<3>(volume.Density.Source(), SerialExecutor()).Total());
  for (auto _ : state)
  {
    particles = volume.Seeds;
    const Stopwatch whole;
    const RectifiedFlow<3> flow(volume.Density.Source(), SerialExecutor());
    const double seconds = whole.Seconds();
    moveForward(flow, particles);
    unscaled = whole.Seconds();
    state.SetIterationTime(seconds + (unscaled - seconds) / volume.Share(particles));
  }
  state.counters["unscaled_ms"] = 1e3 * unscaled;
  volume.Truth.Report(state, particles);
}

void filter(benchmark::State& state)
{
  const Volume& volume = Volume::Instance(state.range(0));
  const auto& density = volume.Density;
  vtkNew<vtkImageData> image;
  image->SetDimensions(static_cast<int>(density.Size[0] + 1), static_cast<int>(density.Size[1] + 1),
    static_cast<int>(density.Size[2] + 1));
  vtkNew<vtkDoubleArray> values;
  values->SetName("Density");
  values->SetNumberOfValues(static_cast<vtkIdType>(density.Values.size()));
  std::copy(density.Values.begin(), density.Values.end(), values->GetPointer(0));
  image->GetCellData()->SetScalars(values);

  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  sampler->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, values->GetName());
  sampler->SetThreadingToSerial();
  vtkNew<vtkPolyData> seeds;
  if (volume.Seeds.size() < density.Values.size())
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(static_cast<vtkIdType>(volume.Seeds.size()));
    std::memcpy(points->GetVoidPointer(0), volume.Seeds.data(),
      volume.Seeds.size() * sizeof(volume.Seeds[0]));
    seeds->SetPoints(points);
    sampler->SetSeedsData(seeds);
  }
  else
  {
    sampler->SetSeedPatternToLattice();
    sampler->SetSamplesPerCell(1);
  }
  sampler->Update();
  timeUpdates(state, sampler, values);
  vtkPolyData* output = sampler->GetOutput();
  Particles<3> particles(static_cast<std::size_t>(output->GetNumberOfPoints()));
  if (particles.size() != volume.Seeds.size())
  {
    state.SkipWithError("the filter's output is not a particle a seed");
    return;
  }
  std::memcpy(particles.data(), output->GetPoints()->GetVoidPointer(0),
    particles.size() * sizeof(particles[0]));
  volume.Truth.Report(state, particles);
}

void sides(benchmark::internal::Benchmark* b)
{
  b->Arg(64)->Arg(128)->Arg(256)->Unit(benchmark::kMillisecond);
}

BENCHMARK(paper)->Name("Volume/paper")->Apply(sides)->UseManualTime()->Iterations(1);
BENCHMARK(core)->Name("Volume/core")->Apply(sides)->UseManualTime()->Iterations(1);
BENCHMARK(filter)->Name("Volume/filter")->Apply(sides)->Iterations(1);

} // namespace
} // namespace RectifiedTransport
