// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Parameterization/MapTiles.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <utility>

namespace RectifiedTransport
{

namespace
{

using Iterator = std::vector<std::int64_t>::iterator;

class TileTree
{
public:
  TileTree(ConstPointSpan<2> positions, std::int64_t most, int variant)
    : Positions(positions)
    , Most(most)
    , Variant(variant)
  {
  }

  std::vector<MapTile> Cut()
  {
    std::vector<std::int64_t> points(static_cast<std::size_t>(this->Positions.size()));
    std::iota(points.begin(), points.end(), std::int64_t{ 0 });
    this->Split(points.begin(), points.end(), 0);
    return std::move(this->Tiles);
  }

private:
  void Split(Iterator begin, Iterator end, int depth)
  {
    if (end - begin <= this->Most)
    {
      this->Tiles.emplace_back(begin, end);
      std::sort(this->Tiles.back().begin(), this->Tiles.back().end());
      return;
    }
    constexpr std::array<double, 4> parts{ 0.5, 0.38, 0.62, 0.44 };
    constexpr int varied = 2; // levels
    const double part =
      depth < varied ? parts[static_cast<std::size_t>(this->Variant) % parts.size()] : 0.5;
    const int axis = (depth + this->Variant) % 2;
    const Iterator middle =
      begin + static_cast<std::ptrdiff_t>(static_cast<double>(end - begin) * part);
    std::nth_element(begin, middle, end, [this, axis](std::int64_t a, std::int64_t b) {
      return std::make_pair(this->Positions[a][axis], a) <
        std::make_pair(this->Positions[b][axis], b);
    });
    this->Split(begin, middle, depth + 1);
    this->Split(middle, end, depth + 1);
  }

  const ConstPointSpan<2> Positions;
  const std::int64_t Most;
  const int Variant;
  std::vector<MapTile> Tiles;
};

} // namespace

std::vector<std::vector<MapTile>> makeTiles(
  const DiskMesh& disk, ConstPointSpan<2> positions, std::int64_t most, int variant)
{
  std::vector<MapTile> tiles = TileTree(positions, most, variant).Cut();
  std::vector<std::size_t> tileOf(static_cast<std::size_t>(positions.size()));
  for (std::size_t tile = 0; tile < tiles.size(); ++tile)
  {
    for (const std::int64_t point : tiles[tile])
    {
      tileOf[static_cast<std::size_t>(point)] = tile;
    }
  }
  std::vector<std::set<std::size_t>> neighbours(tiles.size());
  for (std::int64_t t = 0; t < disk.NumberOfTriangles(); ++t)
  {
    for (int i = 0; i < 3; ++i)
    {
      const std::size_t a = tileOf[static_cast<std::size_t>(disk.Triangle(t)[i])];
      const std::size_t b = tileOf[static_cast<std::size_t>(disk.Triangle(t)[(i + 1) % 3])];
      if (a != b)
      {
        neighbours[std::max(a, b)].insert(std::min(a, b));
      }
    }
  }
  // Each tile goes into the first group that has no neighbour of it.
  std::vector<std::vector<MapTile>> groups;
  std::vector<std::size_t> groupOf(tiles.size());
  for (std::size_t tile = 0; tile < tiles.size(); ++tile)
  {
    std::set<std::size_t> taken;
    for (const std::size_t neighbour : neighbours[tile])
    {
      taken.insert(groupOf[neighbour]);
    }
    std::size_t group = 0;
    while (taken.count(group) > 0)
    {
      ++group;
    }
    groupOf[tile] = group;
    groups.resize(std::max(groups.size(), group + 1));
    groups[group].push_back(std::move(tiles[tile]));
  }
  return groups;
}

} // namespace RectifiedTransport
