// SPDX-License-Identifier: BSD-3-Clause
// Points spread evenly over surfaces: time, memory and evenness, of 8192 to a million.
#include "FreshMemory.h"
#include "PeakMemory.h"
#include "SurfaceRelaxation/SurfaceMeasures.h"
#include "SurfaceRelaxation/Surfaces.h"
#include "Surfaces/SurfaceRelaxation/SurfaceRelaxation.h"

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <fstream>
#include <string>

#ifdef _OPENMP
#include <omp.h>
#endif

namespace RectifiedTransport
{
namespace
{

// The numbers of points and triangles, then the points, then the triangles.
Mesh readMesh(const std::string& path)
{
  Mesh mesh;
  std::ifstream file(path);
  std::size_t points = 0;
  std::size_t triangles = 0;
  file >> points >> triangles;
  mesh.Points.resize(points);
  mesh.Triangles.resize(triangles);
  for (Point<3>& x : mesh.Points)
  {
    file >> x[0] >> x[1] >> x[2];
  }
  for (auto& triangle : mesh.Triangles)
  {
    file >> triangle[0] >> triangle[1] >> triangle[2];
  }
  if (!file)
  {
    mesh.Triangles.clear();
  }
  return mesh;
}

Mesh meshOf(const std::string& name)
{
  if (name == "sphere")
  {
    return makeGlobe(150, 75);
  }
  if (name == "torus")
  {
    return makeTorus(120, 60);
  }
  if (name == "box")
  {
    return makeBox(40, { 1.0, 0.7, 0.5 });
  }
  if (name == "hemisphere")
  {
    return makeGlobe(150, 40, 0.5 * pi);
  }
  if (name == "fine")
  {
    return makeTorus(1000, 500);
  }
  const char* folder = std::getenv("RECTIFIEDTRANSPORT_SURFACES");
  return readMesh(std::string(folder ? folder : ".") + "/" + name + ".txt");
}

void relax(
  benchmark::State& state, const std::string& name, [[maybe_unused]] int threads, bool measures)
{
  const Mesh mesh = meshOf(name);
  if (mesh.Triangles.empty())
  {
    state.SkipWithError("there is no such surface in RECTIFIEDTRANSPORT_SURFACES");
    return;
  }
#ifdef _OPENMP
  omp_set_num_threads(threads);
#endif
  SurfaceRelaxationOptions options;
  options.NumberOfSamples = state.range(0);
  SurfaceRelaxation relaxed;
  double memory = 0.0;
  for (auto _ : state)
  {
    state.PauseTiming();
    relaxed = {};
    useFreshMemory();
    resetPeakMemory();
    const double before = peakMemory();
    state.ResumeTiming();
    relaxed = relaxOnSurface(mesh.Surface(), {}, options);
    memory = peakMemory() - before;
  }
#ifdef _OPENMP
  omp_set_num_threads(1);
#endif
  state.counters["megabytes"] = memory / 1e6;
  if (measures)
  {
    const Points3 points = positionsOf(mesh.Surface(), relaxed.Places);
    const Spacing spacing = spacingOf(mesh.Surface(), points);
    state.counters["mean"] = spacing.Mean;
    state.counters["least"] = spacing.Least;
    const double parts = std::max(3e5, 20.0 * static_cast<double>(state.range(0)));
    state.counters["patches"] = patchError(massPoints(mesh.Surface(), parts), points);
  }
}

const bool isRegistered = []() {
  std::vector<std::string> names{ "sphere", "torus", "box", "hemisphere", "fine" };
  if (std::getenv("RECTIFIEDTRANSPORT_SURFACES"))
  {
    names.insert(names.end(), { "bunny", "dragon" });
  }
  for (const std::string& name : names)
  {
    for (const int threads : { 1, 2 })
    {
      const std::string kind = threads == 1 ? "core" : "core_2_threads";
      benchmark::RegisterBenchmark(("Surfaces/" + name + "/" + kind).c_str(),
        [=](benchmark::State& state) { relax(state, name, threads, threads == 1); })
        ->Arg(8192)
        ->Arg(100000)
        ->Arg(1000000)
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
    }
  }
  return true;
}();

} // namespace
} // namespace RectifiedTransport
