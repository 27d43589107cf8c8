// SPDX-License-Identifier: BSD-3-Clause
// What rank_model.py asks the core: the sizes of what ranks make and send for a cube of cells, and
// what the parts of an advection take on one thread. Prints numbers by name as JSON.
#include "BenchmarkInputs.h"
#include "Core/Flow/Kernels/FlowMapView.h"
#include "Core/Flow/Tiles/TilePlan.h"
#include "Core/Tables/GradedTables.h"
#include "Core/Tables/TileTables.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <random>
#include <string>
#include <vector>

namespace RectifiedTransport
{
namespace
{

void print(const std::string& name, double value)
{
  std::cout << ",\n\"" << name << "\": " << value;
}

double gradedNodesOf(const GridSize<3>& size, const TileLimits& limits)
{
  const GridSize<3> strides = gradedStrides<3>(size, limits);
  double nodes = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    nodes *= static_cast<double>(gradedNodes(size[axis], strides[axis], gradedRatio).size());
  }
  return nodes;
}

void printPlan(std::int64_t side, int steps, const TileLimits& limits)
{
  const TilePlan<3> plan(evenSize<3>(side), steps, FlowDirection::Forward, true, limits);
  double tileCells = 0.0; // of all tiles, with their halos
  for (std::int64_t tile = 0; tile < plan.Tiles.Count(); ++tile)
  {
    GridSize<3> low;
    GridSize<3> high;
    plan.Tiles.FindCells(tile, low, high);
    double cells = 1.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      cells *= static_cast<double>(high[axis] - low[axis]);
    }
    tileCells += cells;
  }
  print("possible", plan.IsPossible() ? 1.0 : 0.0);
  print("graded_stride", static_cast<double>(gradedStrides<3>(plan.Size, limits)[0]));
  print("graded_nodes", gradedNodesOf(plan.Size, limits));
  print("hand_over", plan.HandOver);
  print("tiles", static_cast<double>(plan.Tiles.Count()));
  print("halo", static_cast<double>(plan.Tiles.Halo()[0]));
  print("tile_cells", tileCells);
  print("most_tile_cells", numberOfCells<3>(plan.Tiles.MostCells()));
  print("tile_table_bytes", TileTables<3>::MemoryFor(plan.Tiles.MostCells()));
  print("levels", static_cast<double>(plan.Shape.Levels.size()));
  print("map_bytes", plan.Shape.MemorySize());
  print("map_evaluations", plan.Shape.Cost);
}

// Two Gaussians on a constant.
std::vector<float> gaussians(std::int64_t side)
{
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(side * side * side));
  const auto at = [side](std::int64_t i, double centre, double width) {
    const double x = (static_cast<double>(i) + 0.5) / static_cast<double>(side) - centre;
    return std::exp(-width * x * x);
  };
  for (std::int64_t k = 0; k < side; ++k)
  {
    for (std::int64_t j = 0; j < side; ++j)
    {
      const double first = at(j, 0.3, 20.0) * at(k, 0.3, 20.0);
      const double second = 0.6 * at(j, 0.72, 60.0) * at(k, 0.72, 60.0);
      for (std::int64_t i = 0; i < side; ++i)
      {
        values.push_back(
          static_cast<float>(0.05 + first * at(i, 0.3, 20.0) + second * at(i, 0.72, 60.0)));
      }
    }
  }
  return values;
}

// Of the processor, on one thread.
template <class Function>
double seconds(const Function& function)
{
  const std::clock_t start = std::clock();
  function();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

void measure(std::int64_t side, int steps, std::int64_t particles)
{
  const std::vector<float> values = gaussians(side);
  const DensityArray<3, float> density(values.data(), evenSize<3>(side));
  std::vector<Point<3>> seeds(static_cast<std::size_t>(particles));
  std::mt19937_64 engine(7);
  for (Point<3>& seed : seeds)
  {
    for (double& coordinate : seed)
    {
      coordinate = uniformNumber(engine) * static_cast<double>(side);
    }
  }
  const std::vector<Point<3>> one(seeds.begin(), seeds.begin() + 1);
  std::vector<Point<3>> positions(seeds.size());
  FlowOptions options;
  options.NumberOfSteps = steps;
  options.Maps = FlowMaps::On;
  std::vector<Point<3>> position(1);
  RectifiedFlow<3> flow(density, FlowTables::Tiled); // warms the memory up
  print("graded_seconds", seconds([&]() { flow = RectifiedFlow<3>(density, FlowTables::Tiled); }));
  TileLimits few;
  few.GradedNodes = std::int64_t{ 1 } << 20;
  print("few_graded_nodes", gradedNodesOf(evenSize<3>(side), few));
  print("few_graded_seconds",
    seconds([&]() { const RectifiedFlow<3> other(density, FlowTables::Tiled, Context(), few); }));
  const double mapAndTile = seconds([&]() { flow.Forward(one, position, options); });
  const double tile = seconds([&]() { flow.Forward(one, position, options); });
  print("map_seconds", mapAndTile - tile);
  print("tile_seconds", tile); // one particle's tables
  print("flow_seconds", seconds([&]() { flow.Forward(seeds, positions, options); }));
  print("particles", static_cast<double>(particles));
}

} // namespace
} // namespace RectifiedTransport

int main(int argc, char** argv)
{
  if (argc != 4 && argc != 5)
  {
    std::cerr << "usage: " << argv[0]
              << " CELLS-ALONG-AN-AXIS STEPS MOST-GRADED-NODES [PARTICLES-TO-TIME]\n"
                 "MOST-GRADED-NODES: 0 for the usual number\n";
    return EXIT_FAILURE;
  }
  const std::int64_t side = std::atoll(argv[1]);
  const int steps = std::atoi(argv[2]);
  RectifiedTransport::TileLimits limits;
  const std::int64_t nodes = std::atoll(argv[3]);
  limits.GradedNodes = nodes > 0 ? nodes : limits.GradedNodes;
  std::cout.precision(12);
  std::cout << "{\"side\": " << side;
  RectifiedTransport::printPlan(side, steps, limits);
  if (argc == 5)
  {
    RectifiedTransport::measure(side, steps, std::atoll(argv[4]));
  }
  std::cout << "\n}\n";
  return EXIT_SUCCESS;
}
