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

constexpr double mostCells = 1 << 22;    // cells of the density that a turn may need
constexpr std::int64_t shareGrain = 256; // blocks a range

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
class BlockBatches
{
public:
  BlockBatches(const GridBlocks<Dimension>& blocks, std::int64_t first, std::int64_t count)
    : Blocks(blocks)
    , Next(first)
    , End(first + count)
  {
  }

  // Other ranks may have more turns when this one has none left.
  bool HasMore() const { return this->Next < this->End; }

  struct Batch
  {
    GridBox<Dimension> Box{};
    std::int64_t First = 0; // first block
    std::int64_t Count = 0;
    bool IsPart = false;  // the turn has a part of one block
    bool IsFirst = false; // it is the first part of that block
  };

  // An empty turn if there are no more.
  Batch Take()
  {
    Batch batch;
    batch.First = this->Next;
    if (!this->HasMore())
    {
      return batch;
    }
    batch.Box = this->Blocks.Box(this->Next);
    batch.Count = 1;
    if (batch.Box.Cells() > mostCells)
    {
      this->TakePart(batch);
      return batch;
    }
    // Blocks join the turn while the box around them stays within the bound.
    for (++this->Next; this->HasMore(); ++this->Next, ++batch.Count)
    {
      const GridBox<Dimension> larger = joined(batch.Box, this->Blocks.Box(this->Next));
      if (larger.Cells() > mostCells)
      {
        break;
      }
      batch.Box = larger;
    }
    return batch;
  }

private:
  // Takes whole layers of a large block, at least one.
  void TakePart(Batch& batch)
  {
    constexpr int last = Dimension - 1;
    const std::int64_t end = batch.Box.High[last];
    // The number of cells in a layer of the box.
    const double layer = batch.Box.Cells() / static_cast<double>(end - batch.Box.Low[last]);
    // The box of this turn: the layers from those that are done, as many as the bound allows.
    batch.IsPart = true;
    batch.IsFirst = this->Layers == 0;
    batch.Box.Low[last] += this->Layers;
    const std::int64_t layers = std::min(end - batch.Box.Low[last],
      std::max<std::int64_t>(1, static_cast<std::int64_t>(mostCells / layer)));
    batch.Box.High[last] = batch.Box.Low[last] + layers;
    this->Layers += layers;
    // The block is done with its last layer.
    if (batch.Box.High[last] == end)
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
  BlockBatches<Dimension> batches(blocks, first, count);
  // Ranks with fewer turns take empty ones, because preparing shares is collective.
  while (!onAllRanks(progress.Group(), !batches.HasMore()))
  {
    const auto batch = batches.Take();
    // Makes tables of the box where the flow has none of the whole density. Collective.
    flow.PrepareShares(batch.Box.Low, batch.Box.High);
    double* found = shares + (batch.First - first);
    if (batch.IsPart)
    {
      // The share of a large block is the sum of those of its parts.
      // Parts follow each other, so that the sum has one order.
      *found = shareIn(batch.Box) + (batch.IsFirst ? 0.0 : *found);
      progress.EndSlice(batch.IsFirst ? 1 : 0);
      continue;
    }
    progress.ForEach(
      batch.Count, shareGrain,
      [&](std::int64_t i) { found[i] = shareIn(blocks.Box(batch.First + i)); }, 16 * shareGrain);
  }
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(findBlockShares);

} // namespace RectifiedTransport
