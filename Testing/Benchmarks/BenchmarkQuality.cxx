// SPDX-License-Identifier: BSD-3-Clause
// How good the particles are: their distance from where the flow truly takes them, forward and
// backward, how well they follow the density, and how many are where there is none. Each density
// once, with each integrator.
#include "FilterRuns.h"
#include "PaperTransport.h"
#include "PhotographInput.h"

#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTable.h>
#include <vtkTransportQuality.h>
#include <vtkVariant.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

namespace RectifiedTransport
{
namespace
{

// A density, particles at time 0, those of them that are where there is mass, taken for particles
// at time 1, and where some of both truly go.
template <int Dimension>
struct QualityCase
{
  QualityCase(TestDensity<Dimension> density, std::int64_t particles)
    : Density(std::move(density))
    , Seeds(this->Spread(particles))
    , Truth(this->Density, this->Seeds, 10000)
    , Points(this->WithMass(this->Seeds))
    , BackwardTruth(this->Density, this->Points, 10000, true)
  {
  }

  TestDensity<Dimension> Density;
  Particles<Dimension> Seeds;
  SampleTruth<Dimension> Truth;
  Particles<Dimension> Points;
  SampleTruth<Dimension> BackwardTruth;

private:
  Particles<Dimension> Spread(std::int64_t particles) const
  {
    Particles<Dimension> seeds(static_cast<std::size_t>(particles));
    Point<Dimension> lengths;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      lengths[axis] = static_cast<double>(this->Density.Size[axis]);
    }
    generateSeeds<Dimension>(SeedPattern::BlueNoise, lengths, 1, seeds);
    for (Point<Dimension>& seed : seeds)
    {
      for (int axis = 0; axis < Dimension; ++axis)
      {
        seed[axis] *= lengths[axis];
      }
    }
    return seeds;
  }

  Particles<Dimension> WithMass(const Particles<Dimension>& all) const
  {
    const RectifiedFlow<Dimension> flow(this->Density.Source());
    Particles<Dimension> points;
    std::copy_if(all.begin(), all.end(), std::back_inserter(points),
      [&](const Point<Dimension>& point) { return flow.HasMass(point); });
    return points;
  }
};

// What Transport Quality says of the particles that are not lost.
template <int Dimension>
void reportDensity(benchmark::State& state, const QualityCase<Dimension>& example,
  const Particles<Dimension>& particles)
{
  const auto image = newImage<Dimension>(example.Density.Size, example.Density.Values);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Point<Dimension>& particle : particles)
  {
    if (isInside<Dimension>(particle, example.Density.Size))
    {
      double x[3] = { 0.0, 0.0, 0.0 };
      std::copy(particle.begin(), particle.end(), x);
      points->InsertNextPoint(x);
    }
  }
  vtkNew<vtkPolyData> set;
  set->SetPoints(points);
  vtkNew<vtkTransportQuality> quality;
  quality->SetInputData(set);
  quality->SetDensityData(image);
  quality->SetBlockSize(Dimension == 2 ? 32 : 8);
  quality->Update();
  const auto value = [&](const char* column) {
    return quality->GetOutput()->GetValueByName(0, column).ToDouble();
  };
  state.counters["density_error"] = value("DensityError");
  state.counters["in_empty_cells"] = value("InEmptyCells");
  state.counters["lost"] =
    static_cast<double>(example.Seeds.size()) - static_cast<double>(points->GetNumberOfPoints());
  state.counters["particles"] = static_cast<double>(example.Seeds.size());
}

enum class Way
{
  Forward,
  Backward
};

template <int Dimension>
void report(benchmark::State& state, const QualityCase<Dimension>& example, Way way,
  const Particles<Dimension>& particles, double evaluations)
{
  (way == Way::Forward ? example.Truth : example.BackwardTruth).Report(state, particles);
  state.counters["evaluations"] = evaluations;
  if (way == Way::Forward)
  {
    reportDensity<Dimension>(state, example, particles);
  }
}

template <int Dimension>
void paper(benchmark::State& state, const QualityCase<Dimension>& example, Way way)
{
  Particles<Dimension> particles;
  for (auto _ : state)
  {
    particles = way == Way::Forward ? example.Seeds : example.Points;
    const auto tables = Paper::buildTables(example.Density.Values, example.Density.Size);
    way == Way::Forward ? Paper::advect(tables, particles, PaperSteps, Paper::FinalVelocity::Zero)
                        : Paper::retrace(tables, particles, PaperSteps);
  }
  report<Dimension>(state, example, way, particles, 4.0 * PaperSteps);
}

template <int Dimension>
void core(
  benchmark::State& state, const QualityCase<Dimension>& example, Way way, FlowOptions options)
{
  const RectifiedFlow<Dimension> flow(example.Density.Source());
  const Particles<Dimension>& start = way == Way::Forward ? example.Seeds : example.Points;
  Particles<Dimension> particles(start.size());
  FlowReport done;
  for (auto _ : state)
  {
    done = way == Way::Forward ? flow.Forward(start, particles, options)
                               : flow.Backward(start, particles, options);
  }
  report<Dimension>(state, example, way, particles,
    static_cast<double>(done.Evaluations) / static_cast<double>(particles.size()));
}

FlowOptions multistep(int steps, FlowMaps maps)
{
  FlowOptions options = withMaps(maps);
  options.NumberOfSteps = steps;
  return options;
}

FlowOptions adaptive()
{
  FlowOptions options;
  options.Integrator = Integrator::Adaptive;
  return options;
}

// `make` makes the case, once it is needed.
template <int Dimension>
void addCase(const std::string& name, TestDensity<Dimension> (*make)(), std::int64_t particles)
{
  const auto example = [make, particles]() -> const QualityCase<Dimension>& {
    static std::map<TestDensity<Dimension> (*)(), QualityCase<Dimension>> cases;
    const auto found = cases.find(make);
    return found != cases.end() ? found->second
                                : cases.try_emplace(make, make(), particles).first->second;
  };
  for (const Way way : { Way::Forward, Way::Backward })
  {
    const auto add = [&](const std::string& method, auto run) {
      const std::string direction = way == Way::Forward ? "/forward/" : "/backward/";
      addBenchmark("Quality/" + name + direction + method, {}, run)->Iterations(1)->Repetitions(1);
    };
    const auto addCore = [&](const std::string& method, const FlowOptions& options) {
      add(method, [example, way, options](benchmark::State& state) {
        core<Dimension>(state, example(), way, options);
      });
    };
    add("paper",
      [example, way](benchmark::State& state) { paper<Dimension>(state, example(), way); });
    for (const int steps : { 16, 32, 64 })
    {
      addCore("multistep_" + std::to_string(steps), multistep(steps, FlowMaps::On));
      addCore("multistep_" + std::to_string(steps) + "_off", multistep(steps, FlowMaps::Off));
    }
    addCore("adaptive", adaptive());
  }
}

const bool added = []() {
  addCase<2>(
    "photograph", []() { return Photograph::Instance().Density; }, PhotographParticles);
  addCase<2>(
    "gaussians_1024",
    []() {
      return twoGaussians<2>({ 1024, 1024 });
    },
    PhotographParticles);
  addCase<2>(
    "shape_256",
    []() {
      return discWithHole<2>({ 256, 256 });
    },
    PhotographParticles);
  addCase<3>(
    "gaussians_128",
    []() {
      return twoGaussians<3>({ 128, 128, 128 });
    },
    200000);
  addCase<3>(
    "shape_64",
    []() {
      return discWithHole<3>({ 64, 64, 64 });
    },
    200000);
  return true;
}();

} // namespace
} // namespace RectifiedTransport
