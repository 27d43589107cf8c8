// SPDX-License-Identifier: BSD-3-Clause
// Areas of cells after the map to the uniform measure: of numbers of steps alone, and of
// equalizeAreas after them. Names end in the steps and the passes of equalizeAreas; 0 passes time
// the flow of the corners of all cells, else the passes alone. Errors are those of blocks of 4^d
// cells (AreaErrors.h): of the corners' images, and, `points_`, of the images of points twice as
// close, which take the correction of the corners by interpolation.
#include "BenchmarkInputs.h"

#include "../Core/AreaErrors.h"
#include "AreaPhotographs.h"

#include "Core/Equalize/AreaCorrection.h"

#include <functional>

namespace RectifiedTransport
{
namespace
{

EqualizeOptions passes(std::int64_t count)
{
  EqualizeOptions options;
  options.Passes = static_cast<int>(count);
  return options;
}

// A density and the flow of its corners, made at first use and kept for the next benchmark: those
// of one density follow each other.
template <int Dimension>
struct AreaRun
{
  std::string Name;
  TestDensity<Dimension> Density;
  std::optional<RectifiedFlow<Dimension>> Flow;
  FlowOptions Options;
  Particles<Dimension> Moved;

  static AreaRun& Of(const std::string& name, const std::function<TestDensity<Dimension>()>& make)
  {
    static AreaRun run;
    if (run.Name != name)
    {
      run = AreaRun();
      run.Name = name;
      run.Density = make();
      run.Flow.emplace(run.Density.Source(), SerialExecutor());
    }
    return run;
  }

  void Move(std::int64_t steps)
  {
    this->Options.NumberOfSteps = static_cast<int>(steps);
    this->Options = AreaCorrection<Dimension>::OptionsFor(this->Options);
    this->Moved = cornerLattice<Dimension>(this->Density.Size);
    this->Flow->Backward(this->Moved, this->Moved, this->Options, SerialExecutor());
  }
};

void report(const std::string& kind, const AreaErrors& errors, benchmark::State& state)
{
  state.counters[kind + "999"] = errors.Quantile999;
  state.counters[kind + "99"] = errors.Quantile99;
  state.counters[kind + "mean"] = errors.Mean;
  state.counters[kind + "folded"] = static_cast<double>(errors.Folded);
}

template <int Dimension>
void measurePoints(AreaRun<Dimension>& run, std::int64_t count, benchmark::State& state)
{
  constexpr std::int64_t parts = 2;
  const Particles<Dimension> points = cornerLattice<Dimension>(run.Density.Size, parts);
  Particles<Dimension> images = points;
  run.Flow->Backward(images, images, run.Options, SerialExecutor());
  if (count > 0)
  {
    const AreaCorrection<Dimension> correction(
      *run.Flow, run.Options, passes(count), SerialExecutor());
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      correction.Correct(points[i].data(), images[i].data());
    }
  }
  report("points_", measureAreas<Dimension>(run.Density, images, parts), state);
}

template <int Dimension>
void areas(benchmark::State& state, const std::string& name,
  const std::function<TestDensity<Dimension>()>& make)
{
  AreaRun<Dimension>& run = AreaRun<Dimension>::Of(name, make);
  const std::int64_t count = state.range(1);
  const DensityArray<Dimension, double> values(run.Density.Values.data(), run.Density.Size);
  double total = 0.0;
  for (const double value : run.Density.Values)
  {
    total += value;
  }
  Particles<Dimension> corners;
  run.Move(state.range(0));
  for (auto _ : state)
  {
    if (count == 0)
    {
      run.Move(state.range(0));
    }
    else
    {
      state.PauseTiming();
      corners = run.Moved;
      state.ResumeTiming();
      equalizeAreas<Dimension>(
        values, run.Density.Size, total, corners, passes(count), SerialExecutor());
    }
  }
  report("", measureAreas<Dimension>(run.Density, count == 0 ? run.Moved : corners), state);
  measurePoints<Dimension>(run, count, state);
  state.counters["cell_s"] = benchmark::Counter(static_cast<double>(run.Density.Values.size()),
    benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <int Dimension>
void add(const std::string& name, const std::function<TestDensity<Dimension>()>& make)
{
  benchmark::internal::Benchmark* added = benchmark::RegisterBenchmark(("Areas/" + name).c_str(),
    [name, make](benchmark::State& state) { areas<Dimension>(state, name, make); });
  for (const std::int64_t steps : { 32, 64, 128, 256 })
  {
    for (const std::int64_t count : { 0, 1, 2, 3 })
    {
      if (steps < 256 || count == 0)
      {
        added->Args({ steps, count });
      }
    }
  }
  added->Unit(benchmark::kMillisecond);
}

const bool isRegistered = []() {
  forAreaDensities([](const std::string& name, const auto& make) { add(name, make); });
  return true;
}();

} // namespace
} // namespace RectifiedTransport
