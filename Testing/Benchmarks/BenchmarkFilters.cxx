// SPDX-License-Identifier: BSD-3-Clause
// Whole updates of the filter that makes cells.
#include "BenchmarkInputs.h"
#include "FilterRuns.h"

#include <vtkEqualMassCells.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

namespace RectifiedTransport
{
namespace
{

// 1024 random sites.
void cells(benchmark::State& state)
{
  constexpr int count = 1024;
  std::mt19937_64 engine(1);
  vtkNew<vtkPoints> points;
  for (int i = 0; i < count; ++i)
  {
    const double x = uniformNumber(engine);
    points->InsertNextPoint(x, uniformNumber(engine), 0.0);
  }
  vtkNew<vtkPolyData> sites;
  sites->SetPoints(points);
  vtkNew<vtkImageData> domain;
  domain->SetDimensions(2, 2, 1);
  vtkNew<vtkEqualMassCells> filter;
  filter->SetInputData(sites);
  filter->SetDomainData(domain);
  filter->SetResolution(static_cast<int>(state.range(0)));
  timeUpdates(state, filter, [&]() { points->Modified(); });
}

BENCHMARK(cells)
  ->Name("Filters/cells")
  ->Arg(512)
  ->Arg(1024)
  ->Iterations(1)
  ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace RectifiedTransport
