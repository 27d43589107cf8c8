// SPDX-License-Identifier: BSD-3-Clause
// How good the particles are: their distance from where the flow truly takes them, how well they
// follow the density, and how many are where there is none. Each density once, with each
// integrator.
#include "PaperTransport.h"
#include "PhotographInput.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTable.h>
#include <vtkTransportQuality.h>
#include <vtkVariant.h>

#include <cmath>
#include <string>

namespace RectifiedTransport
{
namespace
{

// A density, its particles at time 0, and where some of them truly go.
template <int Dimension>
struct QualityCase
{
  QualityCase(TestDensity<Dimension> density, std::int64_t particles)
    : Density(std::move(density))
    , Seeds(static_cast<std::size_t>(particles))
  {
    Point<Dimension> lengths;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      lengths[axis] = static_cast<double>(this->Density.Size[axis]);
    }
    generateSeeds<Dimension>(SeedPattern::BlueNoise, lengths, 1, this->Seeds);
    for (Point<Dimension>& seed : this->Seeds)
    {
      for (int axis = 0; axis < Dimension; ++axis)
      {
        seed[axis] *= lengths[axis];
      }
    }
    const std::size_t stride = this->Seeds.size() / 2000;
    Particles<Dimension> sample;
    for (std::size_t i = stride / 2; i < this->Seeds.size(); i += stride)
    {
      this->Chosen.push_back(i);
      sample.push_back(this->Seeds[i]);
    }
    this->Truth = Oracle<Dimension>(this->Density.Values, this->Density.Size).Forward(sample);
  }

  TestDensity<Dimension> Density;
  Particles<Dimension> Seeds;
  std::vector<std::size_t> Chosen;
  Particles<Dimension> Truth;
};

template <int Dimension>
bool isLost(const Point<Dimension>& particle, const GridSize<Dimension>& size)
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    if (!(particle[axis] >= 0.0 && particle[axis] <= static_cast<double>(size[axis])))
    {
      return true;
    }
  }
  return false;
}

// What Transport Quality says of the particles that are not lost.
template <int Dimension>
void reportDensity(benchmark::State& state, const QualityCase<Dimension>& example,
  const Particles<Dimension>& particles)
{
  int dimensions[3] = { 1, 1, 1 };
  for (int axis = 0; axis < Dimension; ++axis)
  {
    dimensions[axis] = static_cast<int>(example.Density.Size[axis]) + 1;
  }
  vtkNew<vtkImageData> image;
  image->SetDimensions(dimensions);
  vtkNew<vtkDoubleArray> values;
  values->SetName("Density");
  for (const double value : example.Density.Values)
  {
    values->InsertNextValue(value);
  }
  image->GetCellData()->SetScalars(values);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Point<Dimension>& particle : particles)
  {
    if (!isLost<Dimension>(particle, example.Density.Size))
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

template <int Dimension>
void report(benchmark::State& state, const QualityCase<Dimension>& example,
  const Particles<Dimension>& particles, double evaluations)
{
  Particles<Dimension> found;
  Particles<Dimension> truth;
  for (std::size_t i = 0; i < example.Chosen.size(); ++i)
  {
    const Point<Dimension>& particle = particles[example.Chosen[i]];
    if (!isLost<Dimension>(particle, example.Density.Size))
    {
      found.push_back(particle);
      truth.push_back(example.Truth[i]);
    }
  }
  const PositionErrors errors = comparePositions<Dimension>(found, truth);
  state.counters["error_mean"] = errors.Mean;
  state.counters["error_95"] = errors.Percentile95;
  state.counters["evaluations"] = evaluations;
  reportDensity<Dimension>(state, example, particles);
}

template <int Dimension>
void paper(benchmark::State& state, const QualityCase<Dimension>& example)
{
  Particles<Dimension> particles;
  for (auto _ : state)
  {
    particles = example.Seeds;
    Paper::advect(Paper::buildTables(example.Density.Values, example.Density.Size), particles,
      PaperSteps, Paper::FinalVelocity::Zero);
  }
  report<Dimension>(state, example, particles, 4.0 * PaperSteps);
}

template <int Dimension>
void core(benchmark::State& state, const QualityCase<Dimension>& example, FlowOptions options)
{
  const RectifiedFlow<Dimension> flow(example.Density.Source());
  Particles<Dimension> particles(example.Seeds.size());
  FlowReport done;
  for (auto _ : state)
  {
    done = flow.Forward(example.Seeds, particles, options);
  }
  report<Dimension>(state, example, particles,
    static_cast<double>(done.Evaluations) / static_cast<double>(particles.size()));
}

FlowOptions multistep(int steps)
{
  FlowOptions options;
  options.NumberOfSteps = steps;
  return options;
}

FlowOptions adaptive()
{
  FlowOptions options;
  options.Method = Integrator::Adaptive;
  return options;
}

// `make` makes the case, once it is needed.
template <int Dimension>
void addCase(const std::string& name, TestDensity<Dimension> (*make)(), std::int64_t particles)
{
  const auto example = [make, particles]() -> const QualityCase<Dimension>& {
    static std::map<TestDensity<Dimension> (*)(), QualityCase<Dimension>> cases;
    const auto found = cases.find(make);
    return found != cases.end()
      ? found->second
      : cases.emplace(make, QualityCase<Dimension>(make(), particles)).first->second;
  };
  const auto add = [&name](const std::string& method, auto run) {
    benchmark::RegisterBenchmark(("Quality/" + name + "/" + method).c_str(), run)
      ->Iterations(1)
      ->Repetitions(1)
      ->Unit(benchmark::kMillisecond);
  };
  add("paper", [example](benchmark::State& state) { paper<Dimension>(state, example()); });
  for (const int steps : { 16, 32, 64 })
  {
    add("multistep_" + std::to_string(steps), [example, steps](benchmark::State& state) {
      core<Dimension>(state, example(), multistep(steps));
    });
  }
  add("adaptive",
    [example](benchmark::State& state) { core<Dimension>(state, example(), adaptive()); });
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
