// SPDX-License-Identifier: BSD-3-Clause
// Numbers for the nodes of a tree, which its boxes share.
#ifndef RectifiedTransport_NodeNumbering_h
#define RectifiedTransport_NodeNumbering_h

#include "Core/Geometry/ReproducibleMath.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

// Numbers nodes in the order in which they are first asked for, by open addressing: large trees
// have millions.
template <int Dimension>
class NodeNumbering
{
public:
  using Node = std::array<std::int64_t, Dimension>;

  explicit NodeNumbering(std::size_t expected)
  {
    // The table has a power of two of slots, so that a mask takes the place of a remainder. It is
    // at most half full, so that a linear probe ends after about two slots.
    std::size_t slots = 64;
    while (slots < 4 * expected)
    {
      slots *= 2;
    }
    this->Slots.assign(slots, -1);
  }

  // Throws std::bad_alloc beyond 2^31 nodes.
  std::int32_t operator[](const Node& node)
  {
    std::int32_t& slot = this->SlotOf(node);
    if (slot >= 0)
    {
      return slot;
    }
    const std::size_t number = this->Nodes.size();
    if (number >= std::size_t{ 1 } << 31)
    {
      throw std::bad_alloc();
    }
    slot = static_cast<std::int32_t>(number);
    this->Nodes.push_back(node);
    if (2 * this->Nodes.size() > this->Slots.size())
    {
      this->Slots.assign(2 * this->Slots.size(), -1);
      for (std::size_t i = 0; i < this->Nodes.size(); ++i)
      {
        this->SlotOf(this->Nodes[i]) = static_cast<std::int32_t>(i);
      }
    }
    return static_cast<std::int32_t>(number);
  }

  std::vector<Node> Release() { return std::move(this->Nodes); }

private:
  // The slot of the node, or a free slot for it.
  std::int32_t& SlotOf(const Node& node)
  {
    std::uint64_t hash = 0;
    for (const std::int64_t coordinate : node)
    {
      hash = mixBits(hash ^ static_cast<std::uint64_t>(coordinate));
    }
    const std::size_t last = this->Slots.size() - 1;
    std::size_t at = static_cast<std::size_t>(hash) & last;
    while (this->Slots[at] >= 0 && this->Nodes[static_cast<std::size_t>(this->Slots[at])] != node)
    {
      at = (at + 1) & last;
    }
    return this->Slots[at];
  }

  std::vector<std::int32_t> Slots; // numbers, -1 in free ones
  std::vector<Node> Nodes;
};

} // namespace RectifiedTransport

#endif
