// SPDX-License-Identifier: BSD-3-Clause
// Whole updates of the filter that covers the cells of an image by a closed surface: cells, and
// triangles.
#include <benchmark/benchmark.h>

#include <vtkCellArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSolidDensity.h>

#include <cmath>

namespace RectifiedTransport
{
namespace
{

// A knotted tube of 2 * around * across triangles.
void makeKnot(int around, int across, vtkPolyData* knot)
{
  const double turn = 2.0 * std::acos(-1.0);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> triangles;
  for (vtkIdType i = 0; i < around; ++i)
  {
    for (vtkIdType j = 0; j < across; ++j)
    {
      const double u = 2.0 * turn * static_cast<double>(i) / around;
      const double v = turn * static_cast<double>(j) / across;
      const double r = 3.0 + std::cos(1.5 * u) + 0.6 * std::cos(v);
      points->InsertNextPoint(
        r * std::cos(u), r * std::sin(u), std::sin(1.5 * u) + 0.6 * std::sin(v));
      const vtkIdType k = (i + 1) % around;
      const vtkIdType l = (j + 1) % across;
      const vtkIdType lower[3] = { i * across + j, k * across + j, k * across + l };
      const vtkIdType upper[3] = { i * across + j, k * across + l, i * across + l };
      triangles->InsertNextCell(3, lower);
      triangles->InsertNextCell(3, upper);
    }
  }
  knot->SetPoints(points);
  knot->SetPolys(triangles);
}

void solid(benchmark::State& state, int around, int across)
{
  vtkNew<vtkPolyData> knot;
  makeKnot(around, across, knot);
  vtkNew<vtkSolidDensity> filter;
  filter->SetInputData(knot);
  filter->SetResolution(static_cast<int>(state.range(0)));
  filter->SetThreadingToSerial();
  for (auto _ : state)
  {
    filter->Modified();
    filter->Update();
  }
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
