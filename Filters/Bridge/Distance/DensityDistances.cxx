// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Distance/DensityDistances.h"

#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Boxes/CommonGrid.h"
#include "Core/Geometry/Boxes/SizedGrids.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Geometry/LengthScale.h"
#include "Core/Parallel/Stages.h"

#include <cmath>
#include <string>

namespace RectifiedTransport::Bridge
{

namespace
{

template <int D>
std::string sizeText(const ImageGrid& grid)
{
  return describeSize<D>(grid.Size<D>());
}

std::string gridText(const ImageGrid& grid)
{
  return dispatchDimension(grid.Dimension(), sizeText<1>, sizeText<2>, sizeText<3>)(grid);
}

std::vector<double> sidesOf(const ImageGrid& grid)
{
  const LengthScale scale(grid);
  const Point<3> lengths = grid.Lengths<3>();
  std::vector<double> sides;
  for (int axis = 0; axis < grid.Dimension(); ++axis)
  {
    sides.push_back(scale.ToUnits(lengths[static_cast<std::size_t>(axis)]));
  }
  return sides;
}

// 1 beyond the axes.
GridSize<3> cellsOf(const ImageGrid& grid)
{
  GridSize<3> cells = grid.Size<3>();
  for (int axis = grid.Dimension(); axis < 3; ++axis)
  {
    cells[static_cast<std::size_t>(axis)] = 1;
  }
  return cells;
}

// Keeps the array.
std::shared_ptr<const double> valuesOf(const vtkSmartPointer<vtkDoubleArray>& array)
{
  return { array->GetPointer(0), [array](const double*) {} };
}

} // namespace

void DensityDistances::Begin(DistanceMethod method)
{
  this->Method = method;
  this->Given.clear();
}

void DensityDistances::Add(DistanceInput input, Progress& progress)
{
  if (this->Given.empty())
  {
    this->Sides = sidesOf(input.Grid);
    this->Distances.Begin(this->Method, this->Sides);
  }
  else
  {
    const DistanceInput& first = this->Given.front();
    requireSameBox({ first.Grid, first.Title }, { input.Grid, input.Title });
    if (this->Method == DistanceMethod::Certified && cellsOf(input.Grid) != cellsOf(first.Grid))
    {
      fail("Method Certified needs densities with the same number of cells along each axis; ",
        first.Title, " has ", gridText(first.Grid), ", ", input.Title, " ", gridText(input.Grid),
        " (Linearized takes both)");
    }
  }
  const GridSize<3> cells = cellsOf(input.Grid);
  DataIdentity identity = input.Identity;
  identity.AddNumbers(this->Sides.data(), static_cast<int>(this->Sides.size()));
  for (const std::int64_t count : cells)
  {
    identity.AddNumber(static_cast<std::uint64_t>(count));
  }
  const auto values = valuesOf(input.Values);
  input.Values = nullptr;
  this->Given.push_back(std::move(input));
  if (this->Distances.Add(identity.Content(), cells, values, progress))
  {
    this->MakeMaps(progress);
  }
}

void DensityDistances::MakeMaps(Progress& progress)
{
  const std::string cells =
    std::to_string(static_cast<std::int64_t>(this->Distances.CellsOfMaps()));
  withRequiredMemory(
    { "the optimal map to a density of " + cells + " cells (a coarser image takes less)",
      this->Distances.MemoryForMaps() },
    [&]() { this->Distances.MakeMaps(progress); });
}

std::vector<DistancePair> DensityDistances::Find(Progress& progress)
{
  const bool lacksMaps = this->Distances.LacksMaps();
  Stages stages(progress, { { "maps", lacksMaps ? 9.0 : 0.0 }, { "pairs", 1 } });
  if (lacksMaps)
  {
    this->MakeMaps(stages["maps"]);
  }
  const std::vector<SquaredBracket> squares = withRequiredMemory(
    { "the bounds of a distance (Method Linearized takes less)", this->Distances.MemoryForPairs() },
    [&]() { return this->Distances.Find(stages["pairs"]); });
  const LengthScale scale(this->Given.front().Grid);
  std::vector<DistancePair> pairs;
  for (const SquaredBracket& square : squares)
  {
    const double lower = scale.LengthFromUnits(std::sqrt(square.Lower));
    const double upper = scale.LengthFromUnits(std::sqrt(square.Upper));
    pairs.push_back({ this->Method == DistanceMethod::Certified ? lower : upper, lower, upper });
  }
  return pairs;
}

} // namespace RectifiedTransport::Bridge
