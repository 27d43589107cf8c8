// SPDX-License-Identifier: BSD-3-Clause
// One particle a cell of the photograph and of volumes, forward and backward: transcription, core
// and the filters' whole updates. The transcription moves a fixed share of the particles (32 runs
// of 1024, see latticeParticles), and its time is scaled to all. As in BenchmarkTables, memory is
// used once before the clock starts.
#include "FilterRuns.h"
#include "PaperTransport.h"
#include "PhotographInput.h"

#include <vtkTransportMap.h>
#include <vtkTransportSampler.h>

#include <map>
#include <string>

namespace RectifiedTransport
{
namespace
{

template <int Dimension>
const TestDensity<Dimension>& densityOf(std::int64_t side)
{
  if constexpr (Dimension == 2)
  {
    return Photograph::Instance().Density; // the only side
  }
  else
  {
    return texturedGaussians<Dimension>(side);
  }
}

template <int Dimension, bool Backward>
struct Lattice
{
  const TestDensity<Dimension>& Density;
  Particles<Dimension> PaperSeeds;
  SampleTruth<Dimension> PaperTruth;
  SampleTruth<Dimension> Truth;

  explicit Lattice(std::int64_t side)
    : Density(densityOf<Dimension>(side))
    , PaperSeeds(latticeParticles<Dimension>(this->Density.Size, 32))
    , PaperTruth(this->Density, this->PaperSeeds, 500, Backward)
    , Truth(this->Density, latticeParticles<Dimension>(this->Density.Size), 2000, Backward)
  {
  }

  static const Lattice& Instance(std::int64_t side)
  {
    static std::map<std::int64_t, Lattice> lattices;
    return lattices.try_emplace(side, side).first->second;
  }
};

template <int Dimension, bool Backward>
void paper(benchmark::State& state)
{
  const auto& lattice = Lattice<Dimension, Backward>::Instance(state.range(0));
  const TestDensity<Dimension>& density = lattice.Density;
  const double share =
    static_cast<double>(lattice.PaperSeeds.size()) / static_cast<double>(density.Values.size());
  Particles<Dimension> particles;
  benchmark::DoNotOptimize(Paper::buildTables(density.Values, density.Size));
  for (auto _ : state)
  {
    particles = lattice.PaperSeeds;
    const Stopwatch tablesTime;
    const auto tables = Paper::buildTables(density.Values, density.Size);
    const double seconds = tablesTime.Seconds();
    const Stopwatch flowTime;
    Backward ? Paper::retrace(tables, particles, PaperSteps)
             : Paper::advect(tables, particles, PaperSteps, Paper::FinalVelocity::Zero);
    state.SetIterationTime(seconds + flowTime.Seconds() / share);
  }
  lattice.PaperTruth.Report(state, particles);
}

template <int Dimension, bool Backward>
void core(benchmark::State& state, Tables tables, FlowMaps maps)
{
  const auto& lattice = Lattice<Dimension, Backward>::Instance(state.range(0));
  const TestDensity<Dimension>& density = lattice.Density;
  Particles<Dimension> particles(density.Values.size());
  const SerialExecutor serial;
  timeFlow(state, density, tables, serial, [&](const RectifiedFlow<Dimension>& flow) {
    Backward ? flow.Backward(
                 FlowSeeds<Dimension>::Lattice(density.Size), particles, withMaps(maps), serial)
             : flow.Forward(
                 FlowSeeds<Dimension>::Lattice(density.Size), particles, withMaps(maps), serial);
  });
  lattice.Truth.Report(state, particles);
}

template <int Dimension>
void update(benchmark::State& state, vtkTransportAlgorithm* filter, int maps)
{
  const TestDensity<Dimension>& density = densityOf<Dimension>(state.range(0));
  const auto image = newImage<Dimension>(density.Size, density.Values);
  filter->SetInputData(image);
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Density");
  filter->SetFlowMaps(maps);
  filter->SetThreadingToSerial();
  filter->Update();
  timeUpdates(state, filter, ChangingDensity(image->GetCellData()->GetScalars()));
}

template <int Dimension, bool Backward>
void map(benchmark::State& state, int maps)
{
  vtkNew<vtkTransportMap> filter;
  filter->SetDirection(
    Backward ? vtkTransportMap::DENSITY_TO_UNIFORM : vtkTransportMap::UNIFORM_TO_DENSITY);
  update<Dimension>(state, filter, maps);
}

template <int Dimension>
void sampler(benchmark::State& state, int maps)
{
  vtkNew<vtkTransportSampler> filter;
  filter->SetSeedPatternToLattice();
  filter->SetSamplesPerCell(1);
  update<Dimension>(state, filter, maps);
}

template <int Dimension, bool Backward>
void addAll(const std::vector<std::int64_t>& sides)
{
  const auto add = [&](const std::string& kind, auto run) {
    const std::string name = "OnePerCell" + std::to_string(Dimension) + "D/" +
      (Backward ? "backward/" : "forward/") + kind;
    return addBenchmark(name, sides, run)->Iterations(1);
  };
  const auto addCore = [&](const std::string& kind, Tables tables, FlowMaps maps) {
    add(kind,
      [tables, maps](benchmark::State& state) { core<Dimension, Backward>(state, tables, maps); });
  };
  add("paper", paper<Dimension, Backward>)->UseManualTime();
  addCore("core", Tables::New, FlowMaps::Auto);
  addCore("core_again", Tables::Kept, FlowMaps::Auto);
  addCore("core_off", Tables::New, FlowMaps::Off);
  for (const int maps : { vtkTransportMap::FLOW_MAPS_AUTO, vtkTransportMap::FLOW_MAPS_OFF })
  {
    const std::string off = maps == vtkTransportMap::FLOW_MAPS_OFF ? "_off" : "";
    add("map" + off, [maps](benchmark::State& state) { map<Dimension, Backward>(state, maps); });
    if (!Backward)
    {
      add("sampler" + off, [maps](benchmark::State& state) { sampler<Dimension>(state, maps); });
    }
  }
}

const bool added = []() {
  addAll<2, false>({ PhotographSide });
  addAll<2, true>({ PhotographSide });
  addAll<3, false>({ 64, 128, 256 });
  addAll<3, true>({ 128 });
  return true;
}();

} // namespace
} // namespace RectifiedTransport
