// SPDX-License-Identifier: BSD-3-Clause
// Which rank advects the particles of which tile.
#ifndef RectifiedTransport_TileUnits_h
#define RectifiedTransport_TileUnits_h

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// A share of the particles of a tile: of `Shares` equal ones the one of number `Share`.
struct TileUnit
{
  std::int64_t Tile;
  std::int64_t Share;
  std::int64_t Shares;

  // The first of `count` items in a row of the tile that are in this share, or the next one.
  std::int64_t FirstOf(std::int64_t count) const { return count * this->Share / this->Shares; }
  std::int64_t EndOf(std::int64_t count) const { return count * (this->Share + 1) / this->Shares; }
};

// The units of each rank, of about equal costs: those of the particles, of which there are so many
// in each tile, and of the tables of a tile, in particles. A tile that has more than a rank's part
// of all is divided.
std::vector<std::vector<TileUnit>> assignTiles(
  const std::vector<std::int64_t>& particles, double costOfTables, int ranks);

} // namespace RectifiedTransport

#endif
