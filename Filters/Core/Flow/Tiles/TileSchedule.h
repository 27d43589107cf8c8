// SPDX-License-Identifier: BSD-3-Clause
// Which rank advects the particles of which tile, and in which order.
#ifndef RectifiedTransport_TileSchedule_h
#define RectifiedTransport_TileSchedule_h

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// How many items, of about equally many particles each, a rank has in a tile.
struct TileCount
{
  std::int64_t Tile;
  std::int64_t Items;
};

// The items with numbers [First, End) among those of a rank in a tile.
struct TileVisit
{
  int From;
  std::int64_t First;
  std::int64_t End;

  std::int64_t Count() const { return this->End - this->First; }
};

// What a rank advects on the tables of a tile.
struct TileUnit
{
  std::int64_t Tile;
  std::vector<TileVisit> Visits;

  std::int64_t Count() const;
};

// The units of each rank, the largest first. `counts` are those of the ranks, with each tile once
// at most, and `costOfTables` is that of a tile's tables in items. A rank makes the tables that pay
// for its own items, but takes no more than a little above its part of all; other items visit a
// rank that makes the tables of their tile.
std::vector<std::vector<TileUnit>> scheduleTiles(
  const std::vector<std::vector<TileCount>>& counts, double costOfTables);

} // namespace RectifiedTransport

#endif
