// SPDX-License-Identifier: BSD-3-Clause
// Figures 1 and 12 of the paper: five steps between two shapes and 25 barycenters of four, all
// included, at 256^2 with one particle a cell; and what a step costs when the maps are there.
#include "BenchmarkInputs.h"
#include "FilterRuns.h"
#include "PaperMorph.h"

#include <vtkTransportBarycenter.h>
#include <vtkTransportInterpolator.h>

#include <cmath>
#include <map>
#include <vector>

namespace RectifiedTransport
{
namespace
{

constexpr std::int64_t side = 256;
constexpr int stepsOfMorph = 5;
constexpr int gridOfBarycenters = 5;

// 0/1 shapes of one piece, of two, with a hole, and a cross.
bool isInShape(int shape, double x, double y)
{
  const auto disc = [=](double centreX, double centreY, double radius) {
    return std::hypot(x - centreX, y - centreY) < radius;
  };
  switch (shape)
  {
    case 0:
      return disc(0.5, 0.5, 0.3);
    case 1:
      return disc(0.3, 0.3, 0.18) || disc(0.7, 0.72, 0.2);
    case 2:
      return disc(0.5, 0.5, 0.35) && !disc(0.55, 0.5, 0.18);
    default:
    {
      // Turned: where the cross and the grid share their diagonals, those alone take a fifth of the
      // time, as they end in the cross's inner corners.
      const double u = 0.96 * (x - 0.5) + 0.28 * (y - 0.5);
      const double v = 0.96 * (y - 0.5) - 0.28 * (x - 0.5);
      return (std::abs(u) < 0.1 && std::abs(v) < 0.4) || (std::abs(v) < 0.1 && std::abs(u) < 0.4);
    }
  }
}

const std::vector<double>& shapeValues(int shape)
{
  static std::map<int, std::vector<double>> shapes;
  std::vector<double>& values = shapes[shape];
  for (std::int64_t cell = 0; values.size() < static_cast<std::size_t>(side * side); ++cell)
  {
    const double x = (static_cast<double>(cell % side) + 0.5) / side;
    const double y = (static_cast<double>(cell / side) + 0.5) / side;
    values.push_back(isInShape(shape, x, y) ? 1.0 : 0.0);
  }
  return values;
}

vtkSmartPointer<vtkImageData> newShape(int shape)
{
  return newImage<2>(evenSize<2>(side), shapeValues(shape));
}

std::vector<double> bilinearWeights(int i, int j)
{
  const double u = i / (gridOfBarycenters - 1.0);
  const double v = j / (gridOfBarycenters - 1.0);
  return { (1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v };
}

void paperMorph(benchmark::State& state)
{
  const Paper::Size<2> cells{ side, side };
  for (auto _ : state)
  {
    const auto all = Paper::transportToAll({ &shapeValues(0), &shapeValues(1) }, cells, PaperSteps);
    for (int step = 0; step < stepsOfMorph; ++step)
    {
      const double t = step / (stepsOfMorph - 1.0);
      benchmark::DoNotOptimize(Paper::between(all, { 1.0 - t, t }, cells).data());
    }
  }
}

// One particle a cell.
void setAsPaper(vtkTransportBlend* filter)
{
  filter->SetParticlesPerCell(1);
  filter->SetKernelToCloudInCell();
}

void filterMorph(benchmark::State& state, int maps)
{
  const auto source = newShape(0);
  const auto target = newShape(1);
  vtkNew<vtkTransportInterpolator> filter;
  filter->SetInputData(source);
  filter->SetTargetData(target);
  filter->SetFlowMaps(maps);
  filter->SetThreadingToSerial();
  setAsPaper(filter);
  ChangingDensity changeSource(source->GetCellData()->GetScalars());
  ChangingDensity changeTarget(target->GetCellData()->GetScalars());
  for (auto _ : state)
  {
    changeSource();
    changeTarget();
    for (int step = 0; step < stepsOfMorph; ++step)
    {
      filter->SetParameter(step / (stepsOfMorph - 1.0));
      filter->Update();
    }
  }
}

void paperBarycenters(benchmark::State& state)
{
  const Paper::Size<2> cells{ side, side };
  for (auto _ : state)
  {
    const auto all = Paper::transportToAll(
      { &shapeValues(0), &shapeValues(1), &shapeValues(2), &shapeValues(3) }, cells, PaperSteps);
    for (int j = 0; j < gridOfBarycenters; ++j)
    {
      for (int i = 0; i < gridOfBarycenters; ++i)
      {
        benchmark::DoNotOptimize(Paper::between(all, bilinearWeights(i, j), cells).data());
      }
    }
  }
}

void filterBarycenters(benchmark::State& state, int maps)
{
  vtkNew<vtkTransportBarycenter> filter;
  filter->SetFlowMaps(maps);
  filter->SetThreadingToSerial();
  setAsPaper(filter);
  std::vector<ChangingDensity> changes;
  for (int shape = 0; shape < 4; ++shape)
  {
    const auto image = newShape(shape);
    changes.emplace_back(image->GetCellData()->GetScalars());
    filter->AddInputDataObject(0, image);
  }
  for (auto _ : state)
  {
    for (ChangingDensity& change : changes)
    {
      change();
    }
    for (int j = 0; j < gridOfBarycenters; ++j)
    {
      for (int i = 0; i < gridOfBarycenters; ++i)
      {
        const std::vector<double> weights = bilinearWeights(i, j);
        for (int k = 0; k < 4; ++k)
        {
          filter->SetWeight(k, weights[static_cast<std::size_t>(k)]);
        }
        filter->Update();
      }
    }
  }
}

// A change of Parameter alone, once the maps are there.
template <int Dimension>
void filterStep(benchmark::State& state)
{
  const auto size = evenSize<Dimension>(state.range(0));
  const auto source =
    newImage<Dimension>(size, texturedGaussians<Dimension>(state.range(0)).Values);
  const auto target = newImage<Dimension>(size, discWithHole<Dimension>(size).Values);
  vtkNew<vtkTransportInterpolator> filter;
  filter->SetInputData(source);
  filter->SetTargetData(target);
  filter->SetThreadingToAuto();
  setAsPaper(filter);
  filter->Update();
  filter->SetThreadingToSerial();
  double parameter = 0.0;
  for (auto _ : state)
  {
    parameter = parameter > 0.9 ? 0.05 : parameter + 0.1;
    filter->SetParameter(parameter);
    filter->Update();
  }
}

BENCHMARK(paperMorph)->Name("Morph/paper")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(filterMorph, on, vtkTransportBlend::FLOW_MAPS_AUTO)
  ->Name("Morph/filter")
  ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(filterMorph, off, vtkTransportBlend::FLOW_MAPS_OFF)
  ->Name("Morph/filter_off")
  ->Unit(benchmark::kMillisecond);
BENCHMARK(paperBarycenters)->Name("Barycenters/paper")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(filterBarycenters, on, vtkTransportBlend::FLOW_MAPS_AUTO)
  ->Name("Barycenters/filter")
  ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(filterBarycenters, off, vtkTransportBlend::FLOW_MAPS_OFF)
  ->Name("Barycenters/filter_off")
  ->Unit(benchmark::kMillisecond);
BENCHMARK(filterStep<2>)->Name("Morph/step2D")->Arg(256)->Unit(benchmark::kMillisecond);
BENCHMARK(filterStep<3>)->Name("Morph/step3D")->Arg(128)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace RectifiedTransport
