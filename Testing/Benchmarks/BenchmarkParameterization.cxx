// SPDX-License-Identifier: BSD-3-Clause
// Area-preserving maps of hills over the number of triangles: the conformal map, the flow alone
// against the paper's, and with the polish.
#include "BenchmarkInputs.h"

#include "PaperTransport.h"
#include "Surfaces/Parameterization/AreaPreservingMap.h"
#include "Surfaces/Parameterization/MassRaster.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace RectifiedTransport
{
namespace
{

constexpr std::int64_t resolution = 1024;

struct Hills
{
  std::unique_ptr<DiskMesh> Disk;
  ConformalMap Conformal;
};

// About as many triangles as wanted: two in each of the squares of a grid.
std::unique_ptr<DiskMesh> makeHills(std::int64_t triangles)
{
  const auto side = static_cast<std::int64_t>(std::sqrt(0.5 * static_cast<double>(triangles)));
  std::vector<Point<3>> points;
  std::vector<std::int64_t> corners;
  for (std::int64_t j = 0; j <= side; ++j)
  {
    for (std::int64_t i = 0; i <= side; ++i)
    {
      const double x = static_cast<double>(i) / static_cast<double>(side);
      const double y = static_cast<double>(j) / static_cast<double>(side);
      points.push_back({ x, y, 0.2 * std::sin(9.0 * x + 4.0 * y) * std::cos(13.0 * y - 3.0 * x) });
      const std::int64_t a = j * (side + 1) + i;
      const std::int64_t b = a + side + 1;
      if (i < side && j < side)
      {
        corners.insert(corners.end(), { a, a + 1, b + 1, a, b + 1, b });
      }
    }
  }
  return std::make_unique<DiskMesh>(
    TriangleSurface{ points, corners.data(), static_cast<std::int64_t>(corners.size() / 3) },
    SerialExecutor());
}

const Hills& hillsOf(std::int64_t triangles)
{
  static std::int64_t last = 0;
  static Hills hills;
  if (last != triangles)
  {
    hills.Disk = makeHills(triangles);
    hills.Conformal = mapConformally(*hills.Disk, chooseCorners(*hills.Disk), SerialExecutor());
    last = triangles;
  }
  return hills;
}

void report(benchmark::State& state, const DiskMesh& disk, ConstPointSpan<2> positions)
{
  const MapDistortion distortion = measureDistortion(disk, positions, SerialExecutor());
  state.counters["triangles"] = static_cast<double>(disk.NumberOfTriangles());
  state.counters["rms"] = distortion.AreaRootMeanSquare;
  state.counters["area_95"] = distortion.Area95;
  state.counters["flipped"] = static_cast<double>(distortion.Flipped);
}

void conformal(benchmark::State& state)
{
  const DiskMesh& disk = *hillsOf(state.range(0)).Disk;
  const SquareCorners corners = chooseCorners(disk);
  ConformalMap map;
  for (auto _ : state)
  {
    map = mapConformally(disk, corners, SerialExecutor());
  }
  report(state, disk, map.Square.Positions);
}

template <bool Polish>
void areaPreserving(benchmark::State& state)
{
  const Hills& hills = hillsOf(state.range(0));
  AreaPreservingMap map;
  for (auto _ : state)
  {
    map = mapAreaPreserving(
      *hills.Disk, hills.Conformal.Square, { resolution, Polish }, SerialExecutor());
  }
  report(state, *hills.Disk, map.Positions);
  state.counters["sweeps"] = map.Sweeps;
}

// The paper's own: the same raster, then its tables and Algorithm 2 from time 1 to 0. Points on the
// sides stay on them.
void paperFlow(benchmark::State& state)
{
  const Hills& hills = hillsOf(state.range(0));
  const DiskMesh& disk = *hills.Disk;
  const auto cells = static_cast<double>(resolution);
  std::vector<double> masses(resolution * resolution);
  std::vector<Point<2>> positions;
  for (auto _ : state)
  {
    positions = hills.Conformal.Square.Positions;
    rasterizeMass({ positions, disk.Triangle(0), disk.AreaShares(), disk.NumberOfTriangles() },
      { resolution, resolution }, masses.data(), SerialExecutor());
    const auto tables = Paper::buildTables(masses, Paper::Size<2>{ resolution, resolution });
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
      Paper::Vector<2> x{ positions[i][0] * cells, positions[i][1] * cells };
      Paper::retrace(tables, x, PaperSteps);
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        if ((hills.Conformal.Square.OnSides[i] >> axis & 1) == 0)
        {
          positions[i][axis] = std::clamp(x[axis] / cells, 0.0, 1.0);
        }
      }
    }
  }
  report(state, disk, positions);
}

void sizes(benchmark::internal::Benchmark* b)
{
  b->RangeMultiplier(4)->Range(1 << 14, 1 << 20)->Unit(benchmark::kMillisecond);
}

BENCHMARK(conformal)->Name("Parameterization/conformal")->Apply(sizes);
BENCHMARK(paperFlow)->Name("Parameterization/flow/paper")->Apply(sizes);
BENCHMARK(areaPreserving<false>)->Name("Parameterization/flow/core")->Apply(sizes);
BENCHMARK(areaPreserving<true>)->Name("Parameterization/polish/core")->Apply(sizes);

} // namespace
} // namespace RectifiedTransport
