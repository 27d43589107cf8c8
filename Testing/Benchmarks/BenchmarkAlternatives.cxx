// SPDX-License-Identifier: BSD-3-Clause
// What the core does itself beside what VTK has for it: Documentation/Alternatives.md draws the
// conclusions. `silence` is the longest time in which a filter neither reports progress nor looks
// whether it is aborted, in ms.
#include "BenchmarkInputs.h"
#include "KnotInput.h"

#include "Core/Geometry/CoincidentPoints.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Quality/NearestNeighbours.h"
#include "Core/Seeds/Seeds.h"
#include "Surfaces/Mesh/SurfaceOrientation.h"

#include <vtkCallbackCommand.h>
#include <vtkCleanPolyData.h>
#include <vtkCommand.h>
#include <vtkDoubleArray.h>
#include <vtkFeatureEdges.h>
#include <vtkIdList.h>
#include <vtkPolyDataNormals.h>
#include <vtkSMPTools.h>
#include <vtkStaticCleanPolyData.h>
#include <vtkStaticPointLocator.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

namespace RectifiedTransport
{
namespace
{

// 800,000 triangles; every fifth one is turned where they are to be oriented.
void knot(vtkPolyData* surface)
{
  makeKnot(2000, 200, surface);
}

// 50,000 triangles in a corner of their bounds, a millionth of these wide.
void corner(vtkPolyData* surface)
{
  makeKnot(500, 50, surface);
  vtkPoints* points = surface->GetPoints();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    double x[3];
    points->GetPoint(i, x);
    points->SetPoint(i, 1e-7 * x[0], 1e-7 * x[1], 1e-7 * x[2]);
  }
  points->InsertNextPoint(1.0, 1.0, 1.0);
}

// 20,000 triangles that meet in two points.
void fans(vtkPolyData* surface)
{
  constexpr vtkIdType around = 10000;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> triangles;
  for (vtkIdType i = 0; i < around; ++i)
  {
    const double angle = 2.0 * std::acos(-1.0) * static_cast<double>(i) / around;
    points->InsertNextPoint(std::cos(angle), std::sin(angle), 0.0);
    const vtkIdType upper[3] = { i, (i + 1) % around, around };
    const vtkIdType lower[3] = { (i + 1) % around, i, around + 1 };
    triangles->InsertNextCell(3, upper);
    triangles->InsertNextCell(3, lower);
  }
  points->InsertNextPoint(0.0, 0.0, 1.0);
  points->InsertNextPoint(0.0, 0.0, -1.0);
  surface->SetPoints(points);
  surface->SetPolys(triangles);
}

using MakeSurface = void (*)(vtkPolyData*);

struct Surface
{
  explicit Surface(MakeSurface make, bool turn = false)
  {
    make(this->Data);
    const vtkIdType count = this->Data->GetNumberOfPoints();
    this->Points = LargeBuffer<double>(3 * count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      this->Data->GetPoint(i, this->Points.data() + 3 * i);
    }
    vtkNew<vtkCellArray> turned;
    vtkNew<vtkIdList> ids;
    for (vtkIdType i = 0; i < this->Data->GetNumberOfPolys(); ++i)
    {
      this->Data->GetPolys()->GetCellAtId(i, ids);
      const bool other = turn && i % 5 == 0;
      const vtkIdType corners[3] = { ids->GetId(0), ids->GetId(other ? 2 : 1),
        ids->GetId(other ? 1 : 2) };
      turned->InsertNextCell(3, corners);
      this->Triangles.insert(this->Triangles.end(), corners, corners + 3);
    }
    this->Data->SetPolys(turned);
  }

  TriangleSurface Get() const
  {
    const auto triangles = static_cast<std::int64_t>(this->Triangles.size()) / 3;
    return { { this->Points.data(), this->Points.size() / 3 }, this->Triangles.data(), triangles };
  }

  vtkNew<vtkPolyData> Data;
  LargeBuffer<double> Points;
  std::vector<std::int64_t> Triangles;
};

// The time of filters made anew.
template <class Filter, class Set>
void runFilter(benchmark::State& state, vtkPolyData* surface, const Set& set)
{
  using Clock = std::chrono::steady_clock;
  struct Silence
  {
    Clock::time_point Since = Clock::now();
    double Longest = 0.0;

    void End()
    {
      const Clock::time_point now = Clock::now();
      const std::chrono::duration<double, std::milli> silence = now - this->Since;
      this->Longest = std::max(this->Longest, silence.count());
      this->Since = now;
    }
  };
  vtkSMPTools::Initialize(1);
  double longest = std::numeric_limits<double>::infinity();
  for (auto _ : state)
  {
    vtkNew<Filter> filter;
    filter->SetInputData(surface);
    set(filter.Get());
    Silence silence;
    vtkNew<vtkCallbackCommand> observer;
    observer->SetClientData(&silence);
    observer->SetCallback(
      [](vtkObject*, unsigned long, void* data, void*) { static_cast<Silence*>(data)->End(); });
    filter->AddObserver(vtkCommand::ProgressEvent, observer);
    filter->Update();
    silence.End();
    longest = std::min(longest, silence.Longest);
  }
  vtkSMPTools::Initialize(0);
  state.counters["silence"] = longest;
}

template <MakeSurface Make>
void mergeOurs(benchmark::State& state)
{
  const Surface surface(Make);
  LargeBuffer<std::int64_t> firsts(surface.Points.size() / 3);
  for (auto _ : state)
  {
    mergePoints<3>(surface.Get().Points, firsts.data(), SerialExecutor());
  }
}

template <MakeSurface Make>
void mergeStaticClean(benchmark::State& state)
{
  const Surface surface(Make);
  runFilter<vtkStaticCleanPolyData>(state, surface.Data, [](auto*) {});
}

template <MakeSurface Make>
void mergeClean(benchmark::State& state)
{
  const Surface surface(Make);
  runFilter<vtkCleanPolyData>(state, surface.Data, [](auto* filter) {
    filter->ToleranceIsAbsoluteOn();
    filter->SetAbsoluteTolerance(0.0);
  });
}

template <MakeSurface Make>
void edgesOurs(benchmark::State& state)
{
  const Surface surface(Make);
  for (auto _ : state)
  {
    const SurfaceEdges edges(surface.Get(), SerialExecutor());
    benchmark::DoNotOptimize(edges.Open());
  }
}

template <MakeSurface Make>
void edgesOfVTK(benchmark::State& state)
{
  const Surface surface(Make);
  runFilter<vtkFeatureEdges>(state, surface.Data, [](auto* filter) { filter->FeatureEdgesOff(); });
}

template <MakeSurface Make>
void orientOurs(benchmark::State& state)
{
  const Surface surface(Make, true);
  const SurfaceEdges edges(surface.Get(), SerialExecutor());
  for (auto _ : state)
  {
    std::vector<std::int64_t> triangles(surface.Triangles.size());
    orientSurface(surface.Get(), edges, triangles.data(), SerialExecutor());
  }
}

template <MakeSurface Make>
void orientByNormals(benchmark::State& state)
{
  const Surface surface(Make, true);
  runFilter<vtkPolyDataNormals>(state, surface.Data, [](auto* filter) {
    filter->SplittingOff();
    filter->ConsistencyOn();
    filter->ComputePointNormalsOff(); // normals of some kind it has to make
    filter->ComputeCellNormalsOn();
  });
}

// Blue noise in a square; and 99 of 100 points in a millionth of it.
std::vector<double> neighbourPoints(std::int64_t count, bool clustered)
{
  std::vector<double> flat(static_cast<std::size_t>(2 * count));
  generateSeeds<2>(SeedPattern::BlueNoise, { 1.0, 1.0 }, 1, { flat.data(), count });
  std::vector<double> points;
  for (std::int64_t i = 0; i < count; ++i)
  {
    const double scale = clustered && i % 100 != 0 ? 1e-6 : 1.0;
    const auto at = static_cast<std::size_t>(2 * i);
    points.insert(points.end(), { scale * flat[at], scale * flat[at + 1], 0.0 });
  }
  return points;
}

template <bool IsClustered>
void neighboursOurs(benchmark::State& state)
{
  const std::vector<double> points = neighbourPoints(state.range(0), IsClustered);
  std::vector<double> distances(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state)
  {
    nearestDistances({ points.data(), state.range(0) }, distances.data(), SerialExecutor());
  }
}

template <bool IsClustered>
void neighboursOfVTK(benchmark::State& state)
{
  std::vector<double> points = neighbourPoints(state.range(0), IsClustered);
  vtkNew<vtkDoubleArray> array;
  array->SetNumberOfComponents(3);
  array->SetArray(points.data(), static_cast<vtkIdType>(points.size()), 1);
  vtkNew<vtkPoints> all;
  all->SetData(array);
  vtkNew<vtkPolyData> set;
  set->SetPoints(all);
  vtkSMPTools::Initialize(1);
  for (auto _ : state)
  {
    vtkNew<vtkStaticPointLocator> locator;
    locator->SetDataSet(set);
    locator->BuildLocator();
    vtkNew<vtkIdList> nearest;
    for (vtkIdType i = 0; i < set->GetNumberOfPoints(); ++i)
    {
      locator->FindClosestNPoints(2, points.data() + 3 * i, nearest);
      benchmark::DoNotOptimize(nearest->GetId(1));
    }
  }
  vtkSMPTools::Initialize(0);
}

void milliseconds(benchmark::internal::Benchmark* b)
{
  b->Unit(benchmark::kMillisecond);
}

BENCHMARK(mergeOurs<knot>)->Name("Merge/knot/ours")->Apply(milliseconds);
BENCHMARK(mergeStaticClean<knot>)->Name("Merge/knot/vtkStaticCleanPolyData")->Apply(milliseconds);
BENCHMARK(mergeClean<knot>)->Name("Merge/knot/vtkCleanPolyData")->Apply(milliseconds);
BENCHMARK(mergeOurs<corner>)->Name("Merge/corner/ours")->Apply(milliseconds);
BENCHMARK(mergeStaticClean<corner>)
  ->Name("Merge/corner/vtkStaticCleanPolyData")
  ->Apply(milliseconds);
BENCHMARK(edgesOurs<knot>)->Name("Edges/knot/ours")->Apply(milliseconds);
BENCHMARK(edgesOfVTK<knot>)->Name("Edges/knot/vtkFeatureEdges")->Apply(milliseconds);
BENCHMARK(edgesOurs<fans>)->Name("Edges/fans/ours")->Apply(milliseconds);
BENCHMARK(edgesOfVTK<fans>)->Name("Edges/fans/vtkFeatureEdges")->Apply(milliseconds);
BENCHMARK(orientOurs<knot>)->Name("Orient/knot/ours")->Apply(milliseconds);
BENCHMARK(orientByNormals<knot>)->Name("Orient/knot/vtkPolyDataNormals")->Apply(milliseconds);
BENCHMARK(orientOurs<fans>)->Name("Orient/fans/ours")->Apply(milliseconds);
BENCHMARK(orientByNormals<fans>)->Name("Orient/fans/vtkPolyDataNormals")->Apply(milliseconds);
BENCHMARK(neighboursOurs<false>)
  ->Name("Neighbours/spread/ours")
  ->Arg(100000)
  ->Arg(1000000)
  ->Apply(milliseconds);
BENCHMARK(neighboursOfVTK<false>)
  ->Name("Neighbours/spread/vtkStaticPointLocator")
  ->Arg(100000)
  ->Arg(1000000)
  ->Apply(milliseconds);
BENCHMARK(neighboursOurs<true>)->Name("Neighbours/clusters/ours")->Arg(10000)->Apply(milliseconds);
BENCHMARK(neighboursOfVTK<true>)
  ->Name("Neighbours/clusters/vtkStaticPointLocator")
  ->Arg(10000)
  ->Apply(milliseconds);

} // namespace
} // namespace RectifiedTransport
