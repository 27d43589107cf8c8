// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/Particles/ParticleOrder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace RectifiedTransport
{

namespace
{

// Spreads the bits of a tile's number along one axis, for a Morton code.
template <int Dimension>
std::uint32_t spreadBits(std::uint32_t value)
{
  std::uint32_t spread = 0;
  for (int bit = 0; bit * Dimension < 32; ++bit)
  {
    spread |= ((value >> bit) & 1u) << (bit * Dimension);
  }
  return spread;
}

} // namespace

template <int Dimension>
std::int64_t ParticleOrder<Dimension>::Sort(
  ConstPointSpan<Dimension> points, std::int64_t first, std::int64_t count, int particlesPerTile)
{
  // The bounding box of the points; the tiles divide it.
  std::array<double, Dimension> low;
  std::array<double, Dimension> high;
  low.fill(std::numeric_limits<double>::max());
  high.fill(std::numeric_limits<double>::lowest());
  const double* begin = points[first];
  double check = 0.0;
  for (std::int64_t i = 0; i < count; ++i)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double x = begin[i * Dimension + axis];
      low[axis] = x < low[axis] ? x : low[axis];
      high[axis] = x > high[axis] ? x : high[axis];
      check += x - x; // not a number from the first value that is not finite
    }
  }
  // Only if there is one is the first such particle looked for; its number is returned.
  if (!(check == 0.0))
  {
    for (std::int64_t i = 0; i < count * Dimension; ++i)
    {
      if (!std::isfinite(begin[i]))
      {
        return first + i / Dimension;
      }
    }
  }

  // Cubic tiles, about count / particlesPerTile of them.
  double measure = 1.0;
  double widest = 0.0;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    widest = std::max(widest, high[axis] - low[axis]);
  }
  for (int axis = 0; axis < Dimension; ++axis)
  {
    measure *= std::max((high[axis] - low[axis]) / std::max(widest, 1e-300), 1e-6);
  }
  const double tiles = std::max(1.0, static_cast<double>(count) / particlesPerTile);
  // The side of a cube of 1 / tiles of the box's measure. Flat boxes count as 1e-6 of the widest
  // side, so that the measure is not 0.
  const double tileSize = widest * std::pow(measure / tiles, 1.0 / Dimension);
  // The counting sort's array then has at most 2^21 + 2 numbers of 4 bytes, 8 MiB.
  constexpr int bitBudget = 21;
  std::array<double, Dimension> perUnit;
  std::array<double, Dimension> lastTile;
  std::array<std::vector<std::uint32_t>, Dimension> keys;
  std::uint32_t largest = 0;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double extent = high[axis] - low[axis];
    const double most = static_cast<double>(std::int64_t{ 1 } << (bitBudget / Dimension));
    const double wanted = tileSize > 0.0 ? std::ceil(extent / tileSize) : 1.0;
    const double number = std::max(1.0, std::min(wanted, most));
    perUnit[axis] = extent > 0.0 ? number / extent : 0.0;
    lastTile[axis] = number - 1.0;
    keys[axis].resize(static_cast<std::size_t>(number));
    for (std::size_t tile = 0; tile < keys[axis].size(); ++tile)
    {
      // The code of a tile is the "or" of its axes' parts.
      keys[axis][tile] = spreadBits<Dimension>(static_cast<std::uint32_t>(tile)) << axis;
      largest |= keys[axis][tile];
    }
  }

  this->Tile.resize(static_cast<std::size_t>(count));
  this->Sorted.resize(static_cast<std::size_t>(count));
  this->Start.assign(std::size_t{ largest } + 2, 0);
  for (std::int64_t i = 0; i < count; ++i)
  {
    std::uint32_t key = 0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      // The high end is in the last tile, and so is what overflows.
      const double place = (begin[i * Dimension + axis] - low[axis]) * perUnit[axis];
      const double tile = place < lastTile[axis] ? place : lastTile[axis];
      key |= keys[axis][static_cast<std::size_t>(tile)];
    }
    this->Tile[i] = key;
    ++this->Start[key + 1];
  }
  // A counting sort by tiles, in Morton order, which is stable.
  for (std::size_t tile = 1; tile < this->Start.size(); ++tile)
  {
    this->Start[tile] += this->Start[tile - 1];
  }
  for (std::int64_t i = 0; i < count; ++i)
  {
    // Start[t] is where the next particle of tile t goes.
    this->Sorted[this->Start[this->Tile[i]]++] = first + i;
  }
  return -1;
}

template class ParticleOrder<1>;
template class ParticleOrder<2>;
template class ParticleOrder<3>;

} // namespace RectifiedTransport
