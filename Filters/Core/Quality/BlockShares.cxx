// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Quality/BlockShares.h"

#include "Core/Parallel/Progress.h"
#include "Core/Parallel/RankExchange.h"

#include <algorithm>
#include <utility>

namespace RectifiedTransport
{

namespace
{

constexpr double mostCells = 1 << 22; // cells of the density that a turn may need
constexpr std::int64_t grain = 256;   // blocks a range

// Returns the corners of a box as points of index space.
template <int Dimension>
std::pair<Point<Dimension>, Point<Dimension>> sidesOf(const GridBox<Dimension>& box)
{
  Point<Dimension> low;
  Point<Dimension> high;
  std::copy(box.Low.begin(), box.Low.end(), low.begin());
  std::copy(box.High.begin(), box.High.end(), high.begin());
  return { low, high };
}

// Returns the smallest box that contains two boxes.
template <int Dimension>
GridBox<Dimension> joined(const GridBox<Dimension>& a, const GridBox<Dimension>& b)
{
  GridBox<Dimension> box;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    box.Low[axis] = std::min(a.Low[axis], b.Low[axis]);
    box.High[axis] = std::max(a.High[axis], b.High[axis]);
  }
  return box;
}

// Divides a rank's blocks into turns, each with one box of the density: a box of several blocks,
// or of some layers of one large block.
template <int Dimension>
class BlockTurns
{
public:
  BlockTurns(const GridBlocks<Dimension>& blocks, std::int64_t first, std::int64_t count)
    : Blocks(blocks)
    , Next(first)
    , End(first + count)
  {
  }

  bool HasMore() const { return this->Next < this->End; }

  struct Turn
  {
    GridBox<Dimension> Box{};
    std::int64_t First = 0; // first block
    std::int64_t Count = 0;
    bool IsPart = false;  // the turn has a part of one block
    bool IsFirst = false; // it is the first part of that block
  };

  // An empty turn if there are no more.
  Turn Take()
  {
    Turn turn;
    turn.First = this->Next;
    if (!this->HasMore())
    {
      return turn;
    }
    turn.Box = this->Blocks.Box(this->Next);
    turn.Count = 1;
    if (turn.Box.Cells() > mostCells)
    {
      this->TakePart(turn);
      return turn;
    }
    // Blocks join the turn while the box around them stays within the bound.
    for (++this->Next; this->HasMore(); ++this->Next, ++turn.Count)
    {
      const GridBox<Dimension> larger = joined(turn.Box, this->Blocks.Box(this->Next));
      if (larger.Cells() > mostCells)
      {
        break;
      }
      turn.Box = larger;
    }
    return turn;
  }

private:
  // Takes whole layers of a large block, at least one.
  void TakePart(Turn& turn)
  {
    constexpr int last = Dimension - 1;
    const std::int64_t end = turn.Box.High[last];
    // The number of cells in a layer of the box.
    const double layer = turn.Box.Cells() / static_cast<double>(end - turn.Box.Low[last]);
    // The box of this turn: the layers from those that are done, as many as the bound allows.
    turn.IsPart = true;
    turn.IsFirst = this->Layers == 0;
    turn.Box.Low[last] += this->Layers;
    const std::int64_t layers = std::min(end - turn.Box.Low[last],
      std::max<std::int64_t>(1, static_cast<std::int64_t>(mostCells / layer)));
    turn.Box.High[last] = turn.Box.Low[last] + layers;
    this->Layers += layers;
    // The block is done with its last layer.
    if (turn.Box.High[last] == end)
    {
      this->Layers = 0;
      ++this->Next;
    }
  }

  const GridBlocks<Dimension>& Blocks;
  std::int64_t Next;
  const std::int64_t End;
  std::int64_t Layers = 0; // layers of the next block that are done
};

} // namespace

template <int Dimension>
void findBlockShares(const RectifiedFlow<Dimension>& flow, const GridBlocks<Dimension>& blocks,
  std::int64_t first, std::int64_t count, double* shares, Progress& progress)
{
  const auto shareIn = [&flow](const GridBox<Dimension>& box) {
    const auto [low, high] = sidesOf(box);
    return flow.Share(low, high);
  };
  progress.Expect(count);
  // The number of turns differs between ranks, because their densities and blocks do.
  BlockTurns<Dimension> turns(blocks, first, count);
  // Ranks with fewer turns take empty ones, because preparing shares is collective.
  while (!onAllRanks(progress.Group(), !turns.HasMore()))
  {
    const auto turn = turns.Take();
    // Makes tables of the box where the flow has none of the whole density. Collective.
    flow.PrepareShares(turn.Box.Low, turn.Box.High);
    double* found = shares + (turn.First - first);
    if (turn.IsPart)
    {
      // The share of a large block is the sum of those of its parts.
      *found = shareIn(turn.Box) + (turn.IsFirst ? 0.0 : *found);
      progress.EndSlice(turn.IsFirst ? 1 : 0);
      continue;
    }
    progress.ForEach(
      turn.Count, grain, [&](std::int64_t i) { found[i] = shareIn(blocks.Box(turn.First + i)); },
      16 * grain);
  }
}

template decltype(findBlockShares<1>) findBlockShares<1>;
template decltype(findBlockShares<2>) findBlockShares<2>;
template decltype(findBlockShares<3>) findBlockShares<3>;

} // namespace RectifiedTransport
