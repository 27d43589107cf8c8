// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/Tiles/TilePlan.h"

#include "Core/Flow/Kernels/FlowKernels.h"
#include "Core/Tables/GradedTables.h"
#include "Core/Tables/TileTables.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

namespace
{

// The power of two that is nearest in ratio, at least 1.
std::int64_t nearestPowerOfTwo(double value)
{
  constexpr double half = 1.4142135623730951;
  std::int64_t power = 1;
  while (half * static_cast<double>(power) < value)
  {
    power *= 2;
  }
  return power;
}

std::int64_t tileStart(std::int64_t tile, std::int64_t count, std::int64_t size)
{
  return tile * (size / count) + std::min(tile, size % count);
}

} // namespace

template <int Dimension>
GridSize<Dimension> gradedStrides(const GridSize<Dimension>& size, const TileLimits& limits)
{
  const std::int64_t longest = *std::max_element(size.begin(), size.end());
  GridSize<Dimension> strides;
  for (std::int64_t stride = 1;; stride *= 2)
  {
    double nodes = 1.0;
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
    return takesFlowMaps(options) &&
      TilePlan<Dimension>(size, options.NumberOfSteps, direction, false, limits).IsPossible();
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

template <int Dimension>
TilePlan<Dimension>::TilePlan(const GridSize<Dimension>& size, int numberOfSteps,
  FlowDirection direction, bool hasMaps, const TileLimits& limits)
  : Size(size)
  , Shape(size, numberOfSteps, direction)
  , Strides(gradedStrides<Dimension>(size, limits))
{
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
  this->Shape = FlowMapShape<Dimension>(size, numberOfSteps, direction, 0, handOver);
  if (!hasMaps)
  {
    this->Shape.Levels.clear();
  }
  this->HandOver = this->Shape.Levels.empty() ? handOver : this->Shape.Levels.back().HandOver;
  this->TimeLeft = timeLeft(direction, this->HandOver, steps);
  this->ChooseTiles(limits);
}

template <int Dimension>
void TilePlan<Dimension>::ChooseTiles(const TileLimits& limits)
{
  constexpr std::int64_t usualWidth = Dimension == 3 ? 64 : 1024;
  constexpr double usualHalos = 2.5; // a tile, of both sides
  const bool isForward = this->Shape.Direction == FlowDirection::Forward;
  this->InverseTime = isForward ? 1.0 / (1.0 - this->TimeLeft) : 1.0;
  GridSize<Dimension> widths;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double box =
      static_cast<double>(this->Size[axis]) * this->TimeLeft / (1.0 - this->TimeLeft);
    // Rounding and the steps' errors let boxes leave the one before a little.
    this->Halo[axis] =
      static_cast<std::int64_t>(std::ceil(isForward ? 0.5 * box + 2.0 : box + 4.0));
    widths[axis] = limits.Width > 0
      ? limits.Width
      : std::max(usualWidth,
          static_cast<std::int64_t>(usualHalos * 2.0 * static_cast<double>(this->Halo[axis])));
    this->Counts[axis] =
      std::max<std::int64_t>(1, (this->Size[axis] + widths[axis] / 2) / widths[axis]);
  }
  const auto mostCells = [this](int axis) {
    const std::int64_t width = (this->Size[axis] + this->Counts[axis] - 1) / this->Counts[axis];
    return std::min(this->Size[axis], width + 2 * this->Halo[axis]);
  };
  for (;;)
  {
    double cells = 1.0;
    int widest = 0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      cells *= static_cast<double>(mostCells(axis));
      widest = this->Size[axis] * this->Counts[widest] > this->Size[widest] * this->Counts[axis]
        ? axis
        : widest;
    }
    if (cells <= static_cast<double>(limits.Cells) ||
      this->Size[widest] < 2 * this->Halo[widest] * this->Counts[widest])
    {
      break;
    }
    ++this->Counts[widest];
  }
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const std::int64_t count = this->Counts[axis];
    for (std::int64_t tile = 0; tile < count; ++tile)
    {
      const std::int64_t end = tileStart(tile + 1, count, this->Size[axis]);
      this->TileBelow[axis].resize(static_cast<std::size_t>(end), static_cast<std::int32_t>(tile));
    }
  }
}

template <int Dimension>
std::int64_t TilePlan<Dimension>::Count() const
{
  std::int64_t count = 1;
  for (const std::int64_t along : this->Counts)
  {
    count *= along;
  }
  return count;
}

template <int Dimension>
std::int64_t TilePlan<Dimension>::TileOf(const double* position) const
{
  std::int64_t tile = 0;
  for (int axis = Dimension; axis-- > 0;)
  {
    const double size = static_cast<double>(this->Size[axis]);
    const double centre = 0.5 * size + (position[axis] - 0.5 * size) * this->InverseTime;
    const double cell = std::min(std::max(centre, 0.0), size - 1.0);
    tile = tile * this->Counts[axis] + this->TileBelow[axis][static_cast<std::size_t>(cell)];
  }
  return tile;
}

template <int Dimension>
void TilePlan<Dimension>::FindCells(
  std::int64_t tile, GridSize<Dimension>& low, GridSize<Dimension>& high) const
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const std::int64_t count = this->Counts[axis];
    const std::int64_t size = this->Size[axis];
    const std::int64_t along = tile % count;
    tile /= count;
    low[axis] = std::max<std::int64_t>(0, tileStart(along, count, size) - this->Halo[axis]);
    high[axis] = std::min(size, tileStart(along + 1, count, size) + this->Halo[axis]);
  }
}

template <int Dimension>
GridSize<Dimension> TilePlan<Dimension>::MostCells() const
{
  GridSize<Dimension> most{};
  for (std::int64_t tile = 0; tile < this->Count(); ++tile)
  {
    GridSize<Dimension> low;
    GridSize<Dimension> high;
    this->FindCells(tile, low, high);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      most[axis] = std::max(most[axis], high[axis] - low[axis]);
    }
  }
  return most;
}

template <int Dimension>
std::int64_t TilePlan<Dimension>::ExtraParticles() const
{
  constexpr double share = 1.0 / 64.0;
  return std::max(std::int64_t{ 1 } << 18,
    static_cast<std::int64_t>(share * numberOfCells<Dimension>(this->Size)));
}

template <int Dimension>
double TilePlan<Dimension>::MemorySize(double particles, bool isLattice) const
{
  constexpr double bits = 1.0 / 8.0;
  constexpr double sorted = 20.0;      // bytes a particle of an array
  constexpr double entries = 2 * 48.0; // a block: most are in one or two tiles, listed twice
  // Of a particle that no map serves: its number and record, and three lists.
  constexpr double noted = 40.0;
  constexpr double node = 16.0; // of a map that is made, besides its record
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
  return this->GradedMemory() + this->Shape.MemorySize() + node * nodes +
    TileTables<Dimension>::MemoryFor(this->MostCells()) + 2.0 * bits * chunk +
    (isLattice ? 0.0 : sorted * chunk) +
    std::max(entries * chunk / BlockSize, (record + noted) * extra);
}

template <int Dimension>
double TilePlan<Dimension>::GradedMemory() const
{
  double nodes = 1.0;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    nodes *=
      static_cast<double>(gradedNodes(this->Size[axis], this->Strides[axis], gradedRatio).size());
  }
  constexpr double bits = 1.0 / 8.0;
  return nodes * TableView<Dimension>::Record * sizeof(double) +
    bits * numberOfCells<Dimension>(this->Size);
}

template GridSize<2> gradedStrides<2>(const GridSize<2>&, const TileLimits&);
template GridSize<3> gradedStrides<3>(const GridSize<3>&, const TileLimits&);
template bool servesTiles<1>(
  const GridSize<1>&, const FlowOptions&, FlowDirection, const TileLimits&);
template bool servesTiles<2>(
  const GridSize<2>&, const FlowOptions&, FlowDirection, const TileLimits&);
template bool servesTiles<3>(
  const GridSize<3>&, const FlowOptions&, FlowDirection, const TileLimits&);
template void requireTiles<2>(
  const GridSize<2>&, const FlowOptions&, FlowDirection, const TileLimits&);
template void requireTiles<3>(
  const GridSize<3>&, const FlowOptions&, FlowDirection, const TileLimits&);
template struct TilePlan<2>;
template struct TilePlan<3>;

} // namespace RectifiedTransport
