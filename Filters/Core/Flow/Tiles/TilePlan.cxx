// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/Tiles/TilePlan.h"

#include "Core/Flow/Kernels/FlowKernels.h"
#include "Core/Tables/GradedTables.h"
#include "Core/Tables/TileTables.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

namespace
{

// The power of two that is nearest in ratio, at least 1.
std::int64_t nearestPowerOfTwo(double value)
{
  constexpr double half = 1.4142135623730951; // sqrt(2): half of a factor of two
  std::int64_t power = 1;
  while (half * static_cast<double>(power) < value)
  {
    power *= 2;
  }
  return power;
}

} // namespace

template <int Dimension>
GridSize<Dimension> gradedStrides(const GridSize<Dimension>& size, const TileLimits& limits)
{
  // Strides grow together, by a factor of two, until the nodes are few enough. They are in
  // proportion to the sizes: boxes are, too, so that all axes reach the least width of a box at the
  // same time.
  const std::int64_t longest = *std::max_element(size.begin(), size.end());
  GridSize<Dimension> strides;
  for (std::int64_t stride = 1;; stride *= 2)
  {
    double nodes = 1.0;
    // Whether larger strides would still make fewer nodes along any axis.
    bool isCoarser = false;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      strides[axis] = nearestPowerOfTwo(static_cast<double>(stride) *
        static_cast<double>(size[axis]) / static_cast<double>(longest));
      nodes *= static_cast<double>(gradedNodes(size[axis], strides[axis], gradedRatio).size());
      isCoarser = isCoarser || strides[axis] < size[axis];
    }
    if (nodes <= static_cast<double>(limits.GradedNodes) || !isCoarser)
    {
      return strides;
    }
  }
}

// The records of the nodes, and a bit for each grid cell.
template <int Dimension>
double gradedMemory(const GridSize<Dimension>& size, const GridSize<Dimension>& strides)
{
  double nodes = 1.0;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    nodes *= static_cast<double>(gradedNodes(size[axis], strides[axis], gradedRatio).size());
  }
  constexpr double bits = 1.0 / 8.0;
  return nodes * TableView<Dimension>::Record * sizeof(double) +
    bits * numberOfCells<Dimension>(size);
}

// Not in 1D, where whole tables are small.
template <int Dimension>
bool servesTiles(const GridSize<Dimension>& size, const FlowOptions& options,
  FlowDirection direction, const TileLimits& limits)
{
  if constexpr (Dimension == 1)
  {
    return false;
  }
  else
  {
    const int steps =
      options.NumberOfSteps == 0 ? StepChoice().Of(options).NumberOfSteps : options.NumberOfSteps;
    return takesFlowMaps(options) &&
      TilePlan<Dimension>(size, steps, direction, false, limits).IsPossible();
  }
}

template <int Dimension>
void requireTiles(const GridSize<Dimension>& size, const FlowOptions& options,
  FlowDirection direction, const TileLimits& limits)
{
  if (!takesFlowMaps(options))
  {
    throw std::invalid_argument(
      "tiles need the multistep method with interpolated look-ups, whole tables serve the others");
  }
  if (!servesTiles<Dimension>(size, options, direction, limits))
  {
    throw std::invalid_argument("NumberOfSteps is " + std::to_string(options.NumberOfSteps) +
      ", which is too few for tiles of this density: more steps or whole tables are needed");
  }
}

// The hand-over is at the latest time at which boxes are wide enough for the graded tables. There
// is none where steps are so few that particles cannot hand over then.
template <int Dimension>
TilePlan<Dimension>::TilePlan(const GridSize<Dimension>& size, int numberOfSteps,
  FlowDirection direction, bool hasMaps, const TileLimits& limits)
  : Size(size)
  , Shape(size, numberOfSteps, direction)
  , Strides(gradedStrides<Dimension>(size, limits))
{
  // Boxes of the width W_a = S_a (1 - t) / t must be gradedRatio strides wide along every axis:
  // with s = 1 - t at the hand-over, s >= gradedRatio * (stride_a / S_a) * (1 - s). An axis without
  // strides is exact.
  const GridSize<Dimension>& strides = this->Strides;
  double coarsest = 0.0; // stride over the axis
  for (int axis = 0; axis < Dimension; ++axis)
  {
    if (strides[axis] > 1)
    {
      coarsest =
        std::max(coarsest, static_cast<double>(strides[axis]) / static_cast<double>(size[axis]));
    }
  }
  // The last hand-over at which that holds: the fewer steps are left, the narrower the tiles'
  // halos.
  const double least = gradedRatio * coarsest;
  const int steps = this->Shape.Steps;
  int handOver = 1;
  const auto isWide = [&]() {
    const double rest = timeLeft(direction, handOver, steps);
    return rest >= least * (1.0 - rest);
  };
  while (handOver < steps && !isWide())
  {
    ++handOver;
  }
  // Forwards straight starts must be over two steps before, as those steps' velocities are taken
  // along.
  // Backwards nodes that no lattice serves may go any way.
  constexpr double half = 0.5;
  const bool isUsual = isAfterStart(direction, handOver, steps);
  const bool isLate = direction == FlowDirection::Backward && handOver + 2 < steps &&
    timeLeft(direction, handOver, steps) <= half;
  if (!isUsual && !isLate)
  {
    this->Shape.Levels.clear();
    return;
  }
  // The map's lattices are made on the graded tables, too, and so none may hand over later. If it
  // has any, its finest one sets the hand-over.
  this->Shape = FlowMapShape<Dimension>(size, numberOfSteps, direction, 0, handOver);
  if (!hasMaps)
  {
    this->Shape.Levels.clear();
  }
  this->HandOver = this->Shape.Levels.empty() ? handOver : this->Shape.Levels.back().HandOver;
  this->TimeLeft = timeLeft(direction, this->HandOver, steps);
  this->InverseTime = direction == FlowDirection::Forward ? 1.0 / (1.0 - this->TimeLeft) : 1.0;
  this->Tiles = this->ChooseTiles(limits);
}

// Halos that hold all boxes from the hand-over on.
template <int Dimension>
GridTiles<Dimension> TilePlan<Dimension>::ChooseTiles(const TileLimits& limits) const
{
  // Forwards a particle is in the tile of its box's centre c, and its box reaches W/2 from there.
  // Backwards it is in the tile of its place x at time 1, and all its boxes up to the hand-over
  // contain x: they reach W.
  const bool isForward = this->Shape.Direction == FlowDirection::Forward;
  GridSize<Dimension> halo;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double box =
      static_cast<double>(this->Size[axis]) * this->TimeLeft / (1.0 - this->TimeLeft);
    // Rounding and the steps' errors let boxes leave the one before a little.
    halo[axis] = static_cast<std::int64_t>(std::ceil(isForward ? 0.5 * box + 2.0 : box + 4.0));
  }
  return { this->Size, halo, limits };
}

template <int Dimension>
std::int64_t TilePlan<Dimension>::TileOf(const double* position) const
{
  Point<Dimension> centre;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    // c = S/2 + (x - S/2) / t at the hand-over.
    const double middle = 0.5 * static_cast<double>(this->Size[axis]);
    centre[axis] = middle + (position[axis] - middle) * this->InverseTime;
  }
  return this->Tiles.TileOf(centre);
}

template <int Dimension>
std::int64_t TilePlan<Dimension>::ExtraParticles() const
{
  // Few beside the grid's cells, as the memory should be, but enough to be worth the tables of all
  // tiles.
  constexpr double share = 1.0 / 64.0;
  return std::max(std::int64_t{ 1 } << 18,
    static_cast<std::int64_t>(share * numberOfCells<Dimension>(this->Size)));
}

template <int Dimension>
double TilePlan<Dimension>::MemorySize(double particles, bool isLattice) const
{
  // All sizes are in bytes: graded tables, maps and the memory for making them, the tables of one
  // tile, two masks, and the larger of the two lists of particles, with and without a map, as one
  // is released before the other is made.
  constexpr double bits = 1.0 / 8.0;
  constexpr double sorted = 20.0;      // bytes a particle of an array
  constexpr double entries = 2 * 48.0; // a block: most are in one or two tiles, listed twice
  // A particle that no map serves has its number and record, and three lists.
  constexpr double noted = 40.0;
  constexpr double node = 16.0; // a node of a map that is made, besides its record
  const bool isForward = this->Shape.Direction == FlowDirection::Forward;
  using Level = FlowMapLevel<Dimension>;
  const double record =
    static_cast<double>(sizeof(float) * (isForward ? Level::ForwardRecord : Level::BackwardRecord));
  const double chunk =
    isLattice ? particles : std::min(particles, static_cast<double>(SortedParticles));
  const double extra = std::min(chunk, static_cast<double>(this->ExtraParticles()));
  double nodes = 0.0;
  if (!this->Shape.Levels.empty())
  {
    nodes = 1.0;
    for (const std::int64_t cells : this->Shape.Levels.back().Cells)
    {
      nodes *= static_cast<double>(cells + 1);
    }
  }
  return gradedMemory<Dimension>(this->Size, this->Strides) + this->Shape.MemorySize() +
    node * nodes + TileTables<Dimension>::MemoryFor(this->Tiles.MostCells()) + 2.0 * bits * chunk +
    (isLattice ? 0.0 : sorted * chunk) +
    std::max(entries * chunk / BlockSize, (record + noted) * extra);
}

template decltype(gradedStrides<2>) gradedStrides<2>;
template decltype(gradedStrides<3>) gradedStrides<3>;
template decltype(gradedMemory<2>) gradedMemory<2>;
template decltype(gradedMemory<3>) gradedMemory<3>;
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(servesTiles);
template decltype(requireTiles<2>) requireTiles<2>;
template decltype(requireTiles<3>) requireTiles<3>;
template struct TilePlan<2>;
template struct TilePlan<3>;

} // namespace RectifiedTransport
