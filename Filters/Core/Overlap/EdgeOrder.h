// SPDX-License-Identifier: BSD-3-Clause
#ifndef RectifiedTransport_EdgeOrder_h
#define RectifiedTransport_EdgeOrder_h

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

// The edges that a sweep line meets, from left to right. Blocks of up to 512 edges replace a
// balanced tree: a search is binary over blocks and in one, and an insertion moves at most a block.
class EdgeOrder
{
  // Where an edge is; it is invalid after the next change.
public:
  struct Place
  {
    std::size_t Block;
    std::size_t Index; // in it; its size only at the end of all
  };

  // The place of the first edge for which isLeft is false; isLeft is true for all edges before it.
  template <class IsLeft>
  Place Find(const IsLeft& isLeft) const
  {
    if (this->Blocks.empty())
    {
      return { 0, 0 };
    }
    const auto block = std::partition_point(this->Blocks.begin() + 1, this->Blocks.end(),
                         [&](const Edges& edges) { return isLeft(edges.front()); }) -
      1;
    const auto index = std::partition_point(block->begin(), block->end(), isLeft) - block->begin();
    return this->Normal(
      { static_cast<std::size_t>(block - this->Blocks.begin()), static_cast<std::size_t>(index) });
  }

  static constexpr std::int32_t nothing = -1;

  // `nothing` at the end of all.
  std::int32_t At(const Place& place) const
  {
    return place.Block < this->Blocks.size() && place.Index < this->Blocks[place.Block].size()
      ? this->Blocks[place.Block][place.Index]
      : nothing;
  }
  // The neighbours of a place; `nothing` at the ends.
  std::int32_t Before(const Place& place) const
  {
    return place.Index > 0 ? this->Blocks[place.Block][place.Index - 1]
      : place.Block > 0    ? this->Blocks[place.Block - 1].back()
                           : nothing;
  }
  Place Next(const Place& place) const { return this->Normal({ place.Block, place.Index + 1 }); }
  std::int32_t After(const Place& place) const { return this->At(this->Next(place)); }

  void Replace(const Place& place, std::int32_t edge)
  {
    this->Blocks[place.Block][place.Index] = edge;
  }

  // Removes an edge. The next edge is then at the returned place.
  Place Erase(const Place& place)
  {
    Edges& block = this->Blocks[place.Block];
    block.erase(block.begin() + static_cast<std::ptrdiff_t>(place.Index));
    if (block.empty())
    {
      this->Blocks.erase(this->Blocks.begin() + static_cast<std::ptrdiff_t>(place.Block));
      return this->Normal({ place.Block, 0 });
    }
    return this->Normal(place);
  }

  // Inserts edges, at least one, before what is at the place. A block above `most` is halved.
  void Insert(const Place& place, const std::int32_t* first, const std::int32_t* last)
  {
    constexpr std::size_t most = 512;
    if (this->Blocks.empty())
    {
      this->Blocks.emplace_back();
    }
    const std::size_t number = std::min(place.Block, this->Blocks.size() - 1);
    Edges& block = this->Blocks[number];
    const std::size_t index = number == place.Block ? place.Index : block.size();
    block.insert(block.begin() + static_cast<std::ptrdiff_t>(index), first, last);
    if (block.size() > most)
    {
      const auto middle = block.begin() + static_cast<std::ptrdiff_t>(block.size() / 2);
      Edges half(middle, block.end());
      block.erase(middle, block.end());
      this->Blocks.insert(
        this->Blocks.begin() + static_cast<std::ptrdiff_t>(number) + 1, std::move(half));
    }
  }

private:
  using Edges = std::vector<std::int32_t>;

  // The place behind the last edge of a block is the first of the next one.
  Place Normal(const Place& place) const
  {
    return place.Block + 1 < this->Blocks.size() && place.Index >= this->Blocks[place.Block].size()
      ? Place{ place.Block + 1, 0 }
      : place;
  }

  std::vector<Edges> Blocks; // none is empty
};

} // namespace RectifiedTransport

#endif
