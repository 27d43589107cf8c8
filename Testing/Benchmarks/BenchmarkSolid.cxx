// SPDX-License-Identifier: BSD-3-Clause
// Whole updates of the filter that covers the cells of an image by a closed surface: cells, and
// triangles.
#include "FilterRuns.h"
#include "KnotInput.h"

#include <vtkImageData.h>
#include <vtkSolidDensity.h>

namespace RectifiedTransport
{
namespace
{

void solid(benchmark::State& state, int around, int across)
{
  vtkNew<vtkPolyData> knot;
  makeKnot(around, across, knot);
  vtkNew<vtkSolidDensity> filter;
  filter->SetInputData(knot);
  filter->SetResolution(static_cast<int>(state.range(0)));
  timeUpdates(state, filter, [&]() { filter->Modified(); });
  state.counters["cells"] = static_cast<double>(filter->GetOutput()->GetNumberOfPoints());
}

// 50,000 triangles; and four and sixteen times as many.
void solid50000(benchmark::State& state)
{
  solid(state, 500, 50);
}
void solid200000(benchmark::State& state)
{
  solid(state, 1000, 100);
}
void solid800000(benchmark::State& state)
{
  solid(state, 2000, 200);
}

BENCHMARK(solid50000)
  ->Name("Solid/50000")
  ->Arg(64)
  ->Arg(128)
  ->Arg(256)
  ->Unit(benchmark::kMillisecond);
BENCHMARK(solid200000)->Name("Solid/200000")->Arg(128)->Unit(benchmark::kMillisecond);
BENCHMARK(solid800000)->Name("Solid/800000")->Arg(128)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace RectifiedTransport
