// SPDX-License-Identifier: BSD-3-Clause
// Blocks of cells, spread over a density, by whose images the error of a flow is measured.
#ifndef RectifiedTransport_ProbeBlocks_h
#define RectifiedTransport_ProbeBlocks_h

#include "Core/Flow/FlowEngine.h"
#include "Core/Flow/FlowOptions.h"
#include "Core/Flow/Steps/BoxCells.h"
#include "Core/Flow/Steps/ProbePlan.h"
#include "Core/Flow/Steps/SymmetricPlace.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Ranks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// The part of a block that is measured.
template <int Dimension>
struct ProbeBlock
{
  Point<Dimension> Low{};
  Point<Dimension> High{};
  double Weight = 1.0; // what errors are relative to, in cells of the mean density
  bool Counts = true;  // backward its corners touch mass
};

// The corners of a block that a cell touches, a bit for each.
template <int Dimension>
int cornersOf(
  const ProbeBlock<Dimension>& block, const Point<Dimension>& from, const Point<Dimension>& to)
{
  int found = 0;
  for (int corner = 0; corner < 1 << Dimension; ++corner)
  {
    bool touches = true;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double place = (corner >> axis & 1) != 0 ? block.High[axis] : block.Low[axis];
      touches = touches && from[axis] <= place && place <= to[axis];
    }
    found |= touches ? 1 << corner : 0;
  }
  return found;
}

template <int Dimension>
class ProbeBlocks
{
public:
  // Backward only blocks that count. Collective. Throws Cancelled.
  ProbeBlocks(FlowEngine<Dimension>& engine, FlowDirection direction,
    const ProbePlan<Dimension>& plan, Progress& progress)
    : Engine(engine)
    , IsBackward(direction == FlowDirection::Backward)
    , Plan(plan)
  {
    std::copy_n(engine.View().Cells, Dimension, this->Size.begin());
    const bool isAll = this->Plan.SideBySide[0] > 0;
    // Some tries fall in voids and do not count.
    const std::int64_t tries = isAll ? 1 : 8; // a wanted block
    this->Draw(
      tries * this->WantedBlocks(),
      [&](std::int64_t number) {
        if (isAll)
        {
          return this->BlockAt(this->Plan.LowestOf(number, this->Size));
        }
        const SymmetricPlace<Dimension> place(number);
        Point<Dimension> low;
        for (int axis = 0; axis < Dimension; ++axis)
        {
          low[axis] =
            place.Integer(axis, static_cast<double>(this->Size[axis] - this->Plan.Side[axis]));
        }
        return this->BlockAt(low);
      },
      progress);
  }

  // How many blocks there shall be.
  std::int64_t WantedBlocks() const { return this->Plan.Blocks; }
  // Backward: adds blocks about places that count, until there are as many as wanted. Collective.
  void AddAbout(const std::vector<Point<Dimension>>& places, Progress& progress)
  {
    this->Draw(
      static_cast<std::int64_t>(places.size()),
      [&](std::int64_t number) {
        Point<Dimension> low = places[static_cast<std::size_t>(number)];
        for (int axis = 0; axis < Dimension; ++axis)
        {
          const auto side = static_cast<double>(this->Plan.Side[axis]);
          low[axis] = std::clamp(std::floor(low[axis] - 0.5 * side + 0.5), 0.0,
            static_cast<double>(this->Size[axis]) - side);
        }
        return this->BlockAt(low);
      },
      progress);
  }

  const std::vector<ProbeBlock<Dimension>>& Blocks() const { return this->Found; }

private:
  // A share of the mass above the rounding of the tables.
  static constexpr double leastShare = 2e-15;
  static constexpr double margin = 0.125; // in sides of a block: its border is left out

  // Blocks of numbers [0, count), each rank every so many-th, until as many count as are wanted.
  template <class MakeBlock>
  void Draw(std::int64_t count, const MakeBlock& makeBlock, Progress& progress)
  {
    // Every rank has whole tables.
    const Ranks& ranks = this->Engine.HasWholeTables() ? SoloRanks::Get() : progress.Group();
    progress.Expect(count);
    for (std::int64_t first = 0; first < count; first += ranks.Count())
    {
      progress.EndSlice(std::min<std::int64_t>(ranks.Count(), count - first));
      ProbeBlock<Dimension> examined = makeBlock(std::min(first + ranks.Own(), count - 1));
      this->Examine(examined);
      const std::vector<ProbeBlock<Dimension>> blocks = gatherValues(ranks, examined);
      for (std::int64_t i = 0; i < std::min<std::int64_t>(ranks.Count(), count - first); ++i)
      {
        // All images of a place, or none.
        if ((first + i) % SymmetricPlace<Dimension>::Images == 0 &&
          static_cast<std::int64_t>(this->Found.size()) >= this->WantedBlocks())
        {
          return;
        }
        if (blocks[static_cast<std::size_t>(i)].Counts)
        {
          this->Found.push_back(blocks[static_cast<std::size_t>(i)]);
        }
      }
    }
  }

  // The block of the plan's size with this low corner.
  ProbeBlock<Dimension> BlockAt(const Point<Dimension>& low) const
  {
    ProbeBlock<Dimension> block;
    block.Low = low;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      block.High[axis] = low[axis] + static_cast<double>(this->Plan.Side[axis]);
    }
    return block;
  }

  // Collective.
  void Examine(ProbeBlock<Dimension>& block) const
  {
    if (this->IsBackward)
    {
      this->ExamineCells(block);
      return;
    }
    this->LeaveOutBorders(block);
    // Forward, areas become masses: errors are relative to the block's volume, its mass under the
    // uniform measure.
    block.Weight = boxVolume<Dimension>(block.Low, block.High);
  }

  // Corners in empty regions have no certain image: such blocks do not count. Nor have those next
  // to one: an eighth of the block is left out at each of its sides then.
  void ExamineCells(ProbeBlock<Dimension>& block) const
  {
    Point<Dimension> first;
    Point<Dimension> end;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      first[axis] = std::max(0.0, block.Low[axis] - 1.0);
      end[axis] = std::min(static_cast<double>(this->Size[axis]), block.High[axis] + 1.0);
    }
    prepareShares<Dimension>(this->Engine, first, end);
    bool isFull = true;
    bool isSurrounded = true;
    int cornersWithMass = 0; // a bit for each
    forCells<Dimension>(first, end, [&](const Point<Dimension>& from, const Point<Dimension>& to) {
      const bool hasMass = this->Engine.Share(from, to) > leastShare;
      bool isInside = true;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        isInside = isInside && from[axis] >= block.Low[axis] && to[axis] <= block.High[axis];
      }
      isSurrounded = isSurrounded && hasMass;
      isFull = isFull && (hasMass || !isInside);
      cornersWithMass |= hasMass ? cornersOf<Dimension>(block, from, to) : 0;
    });
    constexpr int corners = 1 << Dimension;
    // A block counts if all its cells have mass, or if every corner touches one that has.
    block.Counts = isFull || cornersWithMass == (1 << corners) - 1;
    for (int axis = 0; axis < Dimension && isFull && !isSurrounded; ++axis)
    {
      const double left = margin * (block.High[axis] - block.Low[axis]);
      block.Low[axis] += left;
      block.High[axis] -= left;
    }
    block.Weight =
      std::max(this->Engine.Share(block.Low, block.High) * numberOfCells<Dimension>(this->Size),
        leastOfMean * boxVolume<Dimension>(block.Low, block.High));
  }

  // Points on the border of the domain may slide along the border of an empty region, and no
  // particle lies there. Of the blocks side by side those at the border do not count, if there are
  // others.
  void LeaveOutBorders(ProbeBlock<Dimension>& block) const
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double left = margin * (block.High[axis] - block.Low[axis]);
      const bool isFirst = block.Low[axis] == 0.0;
      const bool isLast = block.High[axis] == static_cast<double>(this->Size[axis]);
      constexpr std::int64_t few = 4;
      block.Counts = block.Counts && ((!isFirst && !isLast) || this->Plan.SideBySide[axis] <= few);
      block.Low[axis] += isFirst ? left : 0.0;
      block.High[axis] -= isLast ? left : 0.0;
    }
  }

  FlowEngine<Dimension>& Engine;
  const bool IsBackward;
  const ProbePlan<Dimension> Plan;
  GridSize<Dimension> Size{};
  std::vector<ProbeBlock<Dimension>> Found;
};

} // namespace RectifiedTransport

#endif
