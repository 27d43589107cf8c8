// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Series/LabelVotes.h"

#include "Core/Parallel/Progress.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Splat/ScaledClouds.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <tuple>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// In the middle of an interval, both steps have the same mass up to errors of the map. Masses
// within this part of each other count as equal.
constexpr double equalMasses = 0.02;

// Returns the cells that a vote's cloud covers along an axis.
template <int D>
CloudRow rowOf(const LabelVote<D>& vote, int axis, const GridSize<D>& size)
{
  return cloudRow(vote.Centre[axis], vote.Lengths[axis], size[axis]);
}

// Counts the votes in a few layers of cells across the last axis.
template <int D>
class LayerCount
{
public:
  LayerCount(const LatticePart<D>& part, const GridSize<D>& size)
    : Part(part)
    , Size(size)
    , Firsts(static_cast<std::size_t>(part.Count()), Sum{ -1, 0.0 })
  {
  }

  // A cloud gives each cell the mass of their overlap.
  void Add(const LabelVote<D>& vote, std::int64_t label)
  {
    CloudRows<D> rows;
    for (int axis = 0; axis < D; ++axis)
    {
      rows[static_cast<std::size_t>(axis)] = rowOf<D>(vote, axis, this->Size);
    }
    visitRows<D>(rows, vote.Mass, [&](std::int64_t row, std::int64_t plane, double mass) {
      // The first cell of the row; the others follow along axis 0.
      const std::int64_t at[3] = { rows[0].First, row, plane };
      GridSize<D> cell;
      std::copy_n(at, D, cell.begin());
      for (int i = 0; i < rows[0].Count; ++i, ++cell[0])
      {
        if (this->Part.Contains(cell))
        {
          this->AddTo(this->Part.NumberOf(cell), label, mass * rows[0].Parts[i]);
        }
      }
    });
  }

  // Writes the label with the largest mass of each cell, -1 for cells without mass.
  void Write(std::int64_t* winners)
  {
    // Most cells have votes for one label only, so that just the other votes are sorted and summed.
    std::stable_sort(this->Others.begin(), this->Others.end(), [](const Other& a, const Other& b) {
      return std::tie(a.Cell, a.Label) < std::tie(b.Cell, b.Label);
    });
    for (auto begin = this->Others.begin(); begin != this->Others.end();)
    {
      // Votes are sorted by cell and label, so that each run is the mass of one label in one cell.
      Sum sum{ begin->Label, 0.0 };
      const std::int64_t cell = begin->Cell;
      for (; begin != this->Others.end() && begin->Cell == cell && begin->Label == sum.Label;
           ++begin)
      {
        sum.Mass += begin->Mass;
      }
      Sum& best = this->Firsts[static_cast<std::size_t>(cell)];
      // Equal masses go to the smaller label, so that rounding does not decide.
      const bool areEqual = std::abs(sum.Mass - best.Mass) <= equalMasses * best.Mass;
      const bool isBetter = areEqual ? sum.Label < best.Label : sum.Mass > best.Mass;
      best = isBetter ? sum : best;
    }
    std::transform(
      this->Firsts.begin(), this->Firsts.end(), winners, [](const Sum& sum) { return sum.Label; });
  }

private:
  struct Sum
  {
    std::int64_t Label;
    double Mass;
  };
  // A vote for another label than the cell's first one.
  struct Other
  {
    std::int64_t Cell;
    std::int64_t Label;
    double Mass;
  };

  // Most cells have only one label.
  void AddTo(std::int64_t cell, std::int64_t label, double mass)
  {
    Sum& first = this->Firsts[static_cast<std::size_t>(cell)];
    if (!(mass > 0.0))
    {
      return;
    }
    if (first.Label < 0 || first.Label == label)
    {
      first = { label, first.Mass + mass };
      return;
    }
    this->Others.push_back({ cell, label, mass });
  }

  const LatticePart<D> Part;
  const GridSize<D> Size;
  std::vector<Sum> Firsts;
  std::vector<Other> Others;
};

// Returns the votes of all ranks that reach this rank's part, in the order of their numbers.
template <int D>
std::vector<LabelVote<D>> exchangeVotes(std::vector<LabelVote<D>> own, const LatticePart<D>& part,
  const GridSize<D>& size, const Ranks& ranks)
{
  // The votes for each rank.
  std::vector<std::vector<LabelVote<D>>> given;
  for (const LatticePart<D>& wanted : gatherValues(ranks, part))
  {
    given.emplace_back();
    std::copy_if(
      own.begin(), own.end(), std::back_inserter(given.back()), [&](const LabelVote<D>& vote) {
        // A vote goes to every rank whose part its cloud overlaps.
        bool reaches = !wanted.IsEmpty();
        for (int axis = 0; axis < D && reaches; ++axis)
        {
          const CloudRow row = rowOf<D>(vote, axis, size);
          reaches = row.First < wanted.End(axis) && row.End() > wanted.Low[axis];
        }
        return reaches;
      });
  }
  own = {};
  for (const std::vector<LabelVote<D>>& votes : exchangeValues(ranks, std::move(given)))
  {
    own.insert(own.end(), votes.begin(), votes.end());
  }
  std::stable_sort(own.begin(), own.end(),
    [](const LabelVote<D>& a, const LabelVote<D>& b) { return a.Number < b.Number; });
  return own;
}

} // namespace

template <int D>
LabelVotes<D>::LabelVotes(std::vector<LabelVote<D>> votes, const GridSize<D>& size,
  const LatticePart<D>& part, const Ranks& ranks)
  : Size(size)
  , Part(part)
  , Votes(
      ranks.AreSeveral() ? exchangeVotes<D>(std::move(votes), part, size, ranks) : std::move(votes))
  , Begins(static_cast<std::size_t>(size[D - 1]) + 1, 0)
{
  // In the order of the layers in which the votes begin; within a layer their order stays.
  const auto layerOf = [&](const LabelVote<D>& vote) {
    return static_cast<std::size_t>(rowOf<D>(vote, D - 1, size).First);
  };
  std::stable_sort(this->Votes.begin(), this->Votes.end(),
    [&](const LabelVote<D>& a, const LabelVote<D>& b) { return layerOf(a) < layerOf(b); });
  for (const LabelVote<D>& vote : this->Votes)
  {
    // Counting sort: the first vote of each layer.
    ++this->Begins[layerOf(vote) + 1];
  }
  std::partial_sum(this->Begins.begin(), this->Begins.end(), this->Begins.begin());
}

template <int D>
std::vector<std::int64_t> LabelVotes<D>::Count(
  const std::vector<std::int64_t>& equal, Progress& progress) const
{
  // A label for each cell of the part, axis 0 fastest; -1 without mass.
  std::vector<std::int64_t> winners(static_cast<std::size_t>(this->Part.Count()), -1);
  if (this->Part.IsEmpty())
  {
    return winners;
  }
  // Chunks of about so many cells bound the memory of the counts.
  constexpr std::int64_t atOnce = std::int64_t{ 1 } << 14;
  const std::int64_t layers = this->Part.Cells[D - 1];
  // Cells in a layer of the part.
  const std::int64_t cells = this->Part.Count() / layers;
  // A chunk has several layers, because it also reads the clouds that begin up to CloudRow::Most
  // layers before it.
  const std::int64_t grain = std::max<std::int64_t>(2 * CloudRow::Most, atOnce / cells);
  progress.For(
    layers, grain,
    [&](std::int64_t first, std::int64_t last) {
      LatticePart<D> some = this->Part;
      some.Low[D - 1] += first;
      some.Cells[D - 1] = last - first;
      LayerCount<D> count(some, this->Size);
      // A cloud that begins up to CloudRow::Most layers below may still reach the first layer.
      const std::int64_t low = std::max<std::int64_t>(0, some.Low[D - 1] - CloudRow::Most);
      const std::int64_t begin = this->Begins[static_cast<std::size_t>(low)];
      const std::int64_t end = this->Begins[static_cast<std::size_t>(some.End(D - 1))];
      for (std::int64_t i = begin; i < end; ++i)
      {
        const LabelVote<D>& vote = this->Votes[static_cast<std::size_t>(i)];
        if (rowOf<D>(vote, D - 1, this->Size).End() > some.Low[D - 1])
        {
          count.Add(vote, equal[static_cast<std::size_t>(vote.Tuple)]);
        }
      }
      count.Write(winners.data() + first * cells);
    },
    grain);
  return winners;
}

template class LabelVotes<1>;
template class LabelVotes<2>;
template class LabelVotes<3>;

} // namespace RectifiedTransport
