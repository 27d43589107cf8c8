// SPDX-License-Identifier: BSD-3-Clause
// Particles of a long row, marked, and sorted by their tile.
#ifndef RectifiedTransport_TileBins_h
#define RectifiedTransport_TileBins_h

#include "Core/Flow/Kernels/FlowKernels.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Which of a row of particles, by blocks of 64: one bit each. Bits are set in any order on any
// thread; they are only read once all are set, so that the order of memory need not be kept.
class ParticleMask
{
public:
  static_assert(BlockSize == 64, "a block is a word");

  explicit ParticleMask(std::int64_t particles)
    : Words(static_cast<std::size_t>((particles + BlockSize - 1) / BlockSize))
  {
  }
  std::int64_t Blocks() const { return static_cast<std::int64_t>(this->Words.size()); }
  std::uint64_t Block(std::int64_t block) const
  {
    return this->Words[static_cast<std::size_t>(block)].load(std::memory_order_relaxed);
  }
  bool Has(std::int64_t particle) const
  {
    return (this->Block(particle / BlockSize) >> (particle % BlockSize) & 1) != 0;
  }
  // On any thread.
  void Add(std::int64_t particle)
  {
    this->AddToBlock(particle / BlockSize, std::uint64_t{ 1 } << (particle % BlockSize));
  }
  void AddToBlock(std::int64_t block, std::uint64_t particles)
  {
    this->Words[static_cast<std::size_t>(block)].fetch_or(particles, std::memory_order_relaxed);
  }
  std::int64_t Count() const
  {
    std::int64_t count = 0;
    for (const std::atomic<std::uint64_t>& word : this->Words)
    {
      count += __builtin_popcountll(word.load(std::memory_order_relaxed));
    }
    return count;
  }

private:
  std::vector<std::atomic<std::uint64_t>> Words;
};

// Items sorted by their tile, in their order within each: a counting sort, in O(items + tiles). As
// the order of items does not depend on threads, neither does that of the work.
template <class Item>
class TileBins
{
public:
  // tileOf(item), -1 for items to be left out.
  template <class TileOf>
  TileBins(const std::vector<std::vector<Item>>& items, std::int64_t tiles, const TileOf& tileOf)
    : Starts(static_cast<std::size_t>(tiles) + 1)
  {
    // First the number of items of each tile, at the place of the next tile; their running sum,
    // where each tile starts; then each item goes to the end of what its tile has.
    std::vector<std::int64_t> ends(static_cast<std::size_t>(tiles) + 1);
    const auto forAll = [&](const auto& function) {
      for (const std::vector<Item>& part : items)
      {
        for (const Item& item : part)
        {
          const std::int64_t tile = tileOf(item);
          if (tile >= 0)
          {
            function(item, static_cast<std::size_t>(tile));
          }
        }
      }
    };
    forAll([&](const Item&, std::size_t tile) { ++ends[tile + 1]; });
    for (std::size_t tile = 1; tile < ends.size(); ++tile)
    {
      ends[tile] += ends[tile - 1];
    }
    this->Starts = ends;
    this->Items.resize(static_cast<std::size_t>(ends.back()));
    forAll([&](const Item& item, std::size_t tile) {
      this->Items[static_cast<std::size_t>(ends[tile]++)] = item;
    });
  }
  std::int64_t Start(std::int64_t tile) const
  {
    return this->Starts[static_cast<std::size_t>(tile)];
  }
  std::int64_t Count() const { return static_cast<std::int64_t>(this->Items.size()); }
  const Item& operator[](std::int64_t item) const
  {
    return this->Items[static_cast<std::size_t>(item)];
  }

private:
  std::vector<std::int64_t> Starts; // where each tile begins in Items, and the end
  std::vector<Item> Items;
};

} // namespace RectifiedTransport

#endif
