// SPDX-License-Identifier: BSD-3-Clause
// Cartograms as vtkCartogram makes them, with its graticule: of the map that is shipped, and of the
// GeoJSON files in the folder that the environment variable RECTIFIEDTRANSPORT_MAPS names. Its
// subfolder go-cart may have cartograms of the same names by another program (Maps/go_cart.mjs),
// which are measured alike.
#include "BenchmarkInputs.h"
#include "MapFile.h"
#include "MapMeasures.h"
#include "PeakMemory.h"

#include "Core/Cartogram/Cartogram.h"

#include <cstdlib>
#include <filesystem>
#include <string>

namespace RectifiedTransport
{
namespace
{

void report(const MapFile& before, const RegionMap& after, benchmark::State& state)
{
  const MapMeasures measures(before.Map, after, before.Masses);
  state.counters["regions"] = static_cast<double>(before.Masses.size());
  std::int64_t vertices = 0;
  for (std::int64_t ring = 0; ring < before.Map.Rings(); ++ring)
  {
    vertices += before.Map.CountOf(ring);
  }
  state.counters["vertices"] = static_cast<double>(vertices);
  state.counters["largest_error"] = measures.LargestError;
  state.counters["mean_error"] = measures.MeanError;
  state.counters["crossing_before"] = static_cast<double>(measures.CrossingBefore);
  state.counters["crossing"] = static_cast<double>(measures.CrossingAfter);
  state.counters["overlap"] = measures.Overlap;
  state.counters["shape"] = measures.Shape;
  state.counters["turn"] = measures.Turn;
}

// Lines across the box, as vtkCartogram draws them.
OverlayPoints graticule(const CartogramBox& box)
{
  constexpr int spaces = 16;
  constexpr int parts = 256;
  const auto side = static_cast<double>(box.Side);
  OverlayPoints points;
  for (int line = 0; line <= spaces; ++line)
  {
    for (int i = 0; i <= parts; ++i)
    {
      const double across = side * line / spaces;
      const double along = side * i / parts;
      points.push_back({ across, along });
      points.push_back({ along, across });
    }
  }
  return points;
}

void makeCartogram(benchmark::State& state, const std::string& path)
{
  const MapFile file = MapFileReader(path).Read();
  if (file.Masses.empty())
  {
    state.SkipWithError("a map needs features with a mass and polygons");
    return;
  }
  const CartogramOptions options;
  const SerialExecutor executor;
  RegionMap map;
  CartogramResult result;
  resetPeakMemory();
  for (auto _ : state)
  {
    map = file.Map;
    const CartogramBox box = boxAround(map, options);
    for (Point<2>& place : map.Points())
    {
      place = box.ToIndex(place);
    }
    OverlayPoints overlays = graticule(box);
    CartogramStart start;
    result = runCartogram(map, file.Masses, box, options, overlays, start, executor);
  }
  state.counters["megabytes"] = peakMemory() / 1e6;
  state.counters["passes"] = static_cast<double>(result.Passes.size());
  state.counters["out_of_reach"] = static_cast<double>(result.OutOfReach.size());
  int steps = 0;
  for (const CartogramPass& pass : result.Passes)
  {
    steps = std::max(steps, pass.NumberOfSteps);
  }
  state.counters["steps"] = steps;
  report(file, map, state);
}

// The time and the memory are the other program's own account.
void measureOther(benchmark::State& state, const std::string& path, const std::string& other)
{
  const MapFile before = MapFileReader(path).Read();
  const MapFile after = MapFileReader(other).Read();
  if (before.Masses.empty() || after.Masses.size() != before.Masses.size())
  {
    state.SkipWithError("the cartogram has not the regions of the map");
    return;
  }
  for (auto _ : state)
  {
    state.SetIterationTime(after.Seconds);
  }
  state.counters["megabytes"] = after.Megabytes;
  report(before, after.Map, state);
}

void addMap(const std::filesystem::path& path)
{
  const std::string name = "Cartogram/" + path.stem().string();
  const std::string file = path.string();
  addBenchmark(name, {}, [file](benchmark::State& state) {
    makeCartogram(state, file);
  })->Iterations(1);
  const char* folder = std::getenv("RECTIFIEDTRANSPORT_MAPS");
  const std::filesystem::path other =
    std::filesystem::path(folder ? folder : "") / "go-cart" / path.filename();
  if (folder && std::filesystem::exists(other))
  {
    addBenchmark(name + "/go-cart", {},
      [file, other](benchmark::State& state) { measureOther(state, file, other.string()); })
      ->Iterations(1)
      ->Repetitions(1)
      ->UseManualTime();
  }
}

const bool added = []() {
  addMap(RECTIFIEDTRANSPORT_DATA "/us-states.geojson");
  if (const char* folder = std::getenv("RECTIFIEDTRANSPORT_MAPS"))
  {
    for (const auto& entry : std::filesystem::directory_iterator(folder))
    {
      if (entry.path().extension() == ".geojson")
      {
        addMap(entry.path());
      }
    }
  }
  return true;
}();

} // namespace
} // namespace RectifiedTransport
