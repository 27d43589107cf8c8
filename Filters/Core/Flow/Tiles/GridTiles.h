// SPDX-License-Identifier: BSD-3-Clause
// A grid cut in tiles, the tables of each of which reach a halo of grid cells around it.
#ifndef RectifiedTransport_GridTiles_h
#define RectifiedTransport_GridTiles_h

#include "Core/Flow/FlowTables.h"
#include "Core/Geometry/LatticePart.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Tiles are numbered with axis 0 fastest, and cover the grid without overlap; their widths along an
// axis differ by one cell at most. Tables with their halos overlap.
template <int Dimension>
class GridTiles
{
public:
  GridTiles() = default;
  // As wide as the limits say, or, where they leave it open, wide for the halo; narrower where
  // their tables would have too many cells.
  GridTiles(
    const GridSize<Dimension>& size, const GridSize<Dimension>& halo, const TileLimits& limits)
    : Size(size)
    , HaloCells(halo)
  {
    // The tables of a tile have (width + 2 halo)^d cells to be built for width^d cells of use:
    // tiles are wide enough that this is not many times as much, and else narrow, as their tables
    // are what memory holds.
    constexpr std::int64_t usualWidth = Dimension == 3 ? 64 : 1024;
    constexpr double usualHalos = 2.5; // a tile, of both sides
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const std::int64_t width = limits.Width > 0
        ? limits.Width
        : std::max(usualWidth,
            static_cast<std::int64_t>(usualHalos * 2.0 * static_cast<double>(halo[axis])));
      this->Counts[axis] = std::max<std::int64_t>(1, (size[axis] + width / 2) / width);
    }
    // Too large tables are made smaller along the axis of the widest tiles, but not below the halos
    // on both sides, from where on more tiles would hardly make smaller tables.
    for (;;)
    {
      double cells = 1.0;
      int widest = 0;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        cells *= static_cast<double>(this->MostCellsAlong(axis));
        widest =
          size[axis] * this->Counts[widest] > size[widest] * this->Counts[axis] ? axis : widest;
      }
      if (cells <= static_cast<double>(limits.Cells) ||
        size[widest] < 2 * halo[widest] * this->Counts[widest])
      {
        break;
      }
      ++this->Counts[widest];
    }
    for (int axis = 0; axis < Dimension; ++axis)
    {
      // A table instead of a division for each particle.
      const std::int64_t count = this->Counts[axis];
      for (std::int64_t tile = 0; tile < count; ++tile)
      {
        const std::int64_t end = tileStart(tile + 1, count, size[axis]);
        this->TileBelow[axis].resize(
          static_cast<std::size_t>(end), static_cast<std::int32_t>(tile));
      }
    }
  }

  std::int64_t Count() const { return LatticePart<Dimension>::WholeOf(this->Counts).Count(); }

  // The tile of a place, or of the nearest place in the grid.
  std::int64_t TileOf(const Point<Dimension>& place) const
  {
    std::int64_t tile = 0;
    for (int axis = Dimension; axis-- > 0;)
    {
      const double cell =
        std::min(std::max(place[axis], 0.0), static_cast<double>(this->Size[axis]) - 1.0);
      tile = tile * this->Counts[axis] + this->TileBelow[axis][static_cast<std::size_t>(cell)];
    }
    return tile;
  }

  // The grid cells [low, high) of a tile's tables: the tile and its halo, as far as the grid
  // reaches.
  void FindCells(std::int64_t tile, GridSize<Dimension>& low, GridSize<Dimension>& high) const
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const std::int64_t count = this->Counts[axis];
      const std::int64_t size = this->Size[axis];
      const std::int64_t halo = this->HaloCells[axis];
      const std::int64_t along = tile % count;
      tile /= count;
      low[axis] = std::max<std::int64_t>(0, tileStart(along, count, size) - halo);
      high[axis] = std::min(size, tileStart(along + 1, count, size) + halo);
    }
  }

  // The most cells of a tile's tables along each axis.
  GridSize<Dimension> MostCells() const
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

  // Around a tile.
  const GridSize<Dimension>& Halo() const { return this->HaloCells; }

private:
  // The first cell of a tile along an axis: `size` cells in `count` tiles, the first of which get
  // the cells that are left over.
  static std::int64_t tileStart(std::int64_t tile, std::int64_t count, std::int64_t size)
  {
    return tile * (size / count) + std::min(tile, size % count);
  }

  // The widest tile with its halo, which the grid bounds.
  std::int64_t MostCellsAlong(int axis) const
  {
    const std::int64_t width = (this->Size[axis] + this->Counts[axis] - 1) / this->Counts[axis];
    return std::min(this->Size[axis], width + 2 * this->HaloCells[axis]);
  }

  GridSize<Dimension> Size{};                     // of the grid, in cells
  GridSize<Dimension> HaloCells{};                // on either side of a tile
  GridSize<Dimension> Counts{};                   // tiles along each axis
  std::vector<std::int32_t> TileBelow[Dimension]; // for each grid cell
};

} // namespace RectifiedTransport

#endif
