// SPDX-License-Identifier: BSD-3-Clause
// A grid cut in tiles, the tables of each of which reach a halo of grid cells around it.
#ifndef RectifiedTransport_GridTiles_h
#define RectifiedTransport_GridTiles_h

#include "Core/Flow/FlowTables.h"
#include "Core/Geometry/GridSize.h"
#include "Core/Geometry/Points.h"

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
    const GridSize<Dimension>& size, const GridSize<Dimension>& halo, const TileLimits& limits);

  std::int64_t Count() const;
  // The tile of a place, or of the nearest place in the grid.
  std::int64_t TileOf(const Point<Dimension>& place) const;
  // The grid cells of a tile's tables.
  void FindCells(std::int64_t tile, GridSize<Dimension>& low, GridSize<Dimension>& high) const;
  GridSize<Dimension> MostCells() const; // of the tables of any tile
  // Around a tile.
  const GridSize<Dimension>& Halo() const { return this->HaloCells; }

private:
  std::int64_t MostCellsAlong(int axis) const;

  GridSize<Dimension> Size{};                     // of the grid, in cells
  GridSize<Dimension> HaloCells{};                // on either side of a tile
  GridSize<Dimension> Counts{};                   // of tiles along each axis
  std::vector<std::int32_t> TileBelow[Dimension]; // of each grid cell
};

} // namespace RectifiedTransport

#endif
