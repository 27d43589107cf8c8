// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Temporal/LabelVotes.h"

#include "Bridge/Run/Memory.h"
#include "Bridge/Temporal/AdvectedArrays.h"
#include "Bridge/Temporal/CloudRows.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/RankExchange.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <tuple>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

// In the middle between two steps both have as much mass, but for the errors of the map.
constexpr double equalMasses = 0.02;

// The mass of a cloud for one tuple.
template <int D>
struct Vote
{
  double Centre[D]; // in index space
  float Lengths[D]; // in cells
  double Mass;
  vtkIdType Tuple;
  std::int64_t Number; // of the cloud
};

template <int D>
CloudRow rowOf(const Vote<D>& vote, int axis, const GridSize<D>& size)
{
  return cloudRow(vote.Centre[axis], vote.Lengths[axis], size[axis]);
}

// The winners of a few layers of cells across the last axis.
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

  void Add(const Vote<D>& vote, vtkIdType label)
  {
    CloudRow rows[3];
    rows[1].First = rows[2].First = 0;
    rows[1].Count = rows[2].Count = 1;
    rows[1].Parts[0] = rows[2].Parts[0] = 1.0;
    for (int axis = 0; axis < D; ++axis)
    {
      rows[axis] = rowOf<D>(vote, axis, this->Size);
    }
    for (int k = 0; k < rows[2].Count; ++k)
    {
      for (int j = 0; j < rows[1].Count; ++j)
      {
        const double ofRow = vote.Mass * rows[2].Parts[k] * rows[1].Parts[j];
        for (int i = 0; i < rows[0].Count; ++i)
        {
          const std::int64_t at[3] = { rows[0].First + i, rows[1].First + j, rows[2].First + k };
          GridSize<D> cell;
          std::copy_n(at, D, cell.begin());
          if (this->Part.Contains(cell))
          {
            this->AddTo(this->Part.NumberOf(cell), label, ofRow * rows[0].Parts[i]);
          }
        }
      }
    }
  }

  void Write(vtkIdType* winners)
  {
    std::stable_sort(this->Others.begin(), this->Others.end(), [](const Other& a, const Other& b) {
      return std::tie(a.Cell, a.Label) < std::tie(b.Cell, b.Label);
    });
    for (auto begin = this->Others.begin(); begin != this->Others.end();)
    {
      Sum sum{ begin->Label, 0.0 };
      const std::int64_t cell = begin->Cell;
      for (; begin != this->Others.end() && begin->Cell == cell && begin->Label == sum.Label;
           ++begin)
      {
        sum.Mass += begin->Mass;
      }
      Sum& best = this->Firsts[static_cast<std::size_t>(cell)];
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
    vtkIdType Label;
    double Mass;
  };
  struct Other
  {
    std::int64_t Cell;
    vtkIdType Label;
    double Mass;
  };

  // In most cells there is one label.
  void AddTo(std::int64_t cell, vtkIdType label, double mass)
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

template <int D>
class CountedVotes final : public LabelVotes
{
public:
  CountedVotes(std::vector<Vote<D>> votes, const LatticePart<D>& part, const GridSize<D>& size)
    : Size(size)
    , Part(part)
    , Votes(std::move(votes))
    , Begins(static_cast<std::size_t>(size[D - 1]) + 1, 0)
  {
    // In the order of the layers in which they begin, and else in their own one.
    const auto layerOf = [&](const Vote<D>& vote) {
      return static_cast<std::size_t>(rowOf<D>(vote, D - 1, size).First);
    };
    std::stable_sort(this->Votes.begin(), this->Votes.end(),
      [&](const Vote<D>& a, const Vote<D>& b) { return layerOf(a) < layerOf(b); });
    for (const Vote<D>& vote : this->Votes)
    {
      ++this->Begins[layerOf(vote) + 1];
    }
    for (std::size_t i = 1; i < this->Begins.size(); ++i)
    {
      this->Begins[i] += this->Begins[i - 1];
    }
  }

  std::vector<vtkIdType> Count(
    const std::vector<vtkIdType>& equal, Progress& progress) const override
  {
    std::vector<vtkIdType> winners(static_cast<std::size_t>(this->Part.Count()), -1);
    if (this->Part.IsEmpty())
    {
      return winners;
    }
    constexpr std::int64_t atOnce = std::int64_t{ 1 } << 14;
    const std::int64_t layers = this->Part.Cells[D - 1];
    const std::int64_t cells = this->Part.Count() / layers;
    // Several layers, as a range also reads the clouds that begin before it.
    const std::int64_t grain = std::max<std::int64_t>(2 * CloudRow::Most, atOnce / cells);
    progress.For(
      layers, grain,
      [&](std::int64_t first, std::int64_t last) {
        LatticePart<D> some = this->Part;
        some.Low[D - 1] += first;
        some.Cells[D - 1] = last - first;
        LayerCount<D> count(some, this->Size);
        const std::int64_t low = std::max<std::int64_t>(0, some.Low[D - 1] - CloudRow::Most);
        const std::int64_t begin = this->Begins[static_cast<std::size_t>(low)];
        const std::int64_t end = this->Begins[static_cast<std::size_t>(some.End(D - 1))];
        for (std::int64_t i = begin; i < end; ++i)
        {
          const Vote<D>& vote = this->Votes[static_cast<std::size_t>(i)];
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

private:
  const GridSize<D> Size;
  const LatticePart<D> Part;
  std::vector<Vote<D>> Votes;
  std::vector<std::int64_t> Begins; // the first vote of each layer
};

template <int D>
std::vector<Vote<D>> votesOf(
  const AdvectedMoment& moment, const BroughtTuples& tuples, const ImageGrid& geometry)
{
  const MovedClouds& clouds = moment.Clouds;
  const CloudPlaces<D> places(clouds, geometry);
  const std::int64_t count = clouds.Points->GetNumberOfTuples();
  std::vector<Vote<D>> votes;
  votes.reserve(static_cast<std::size_t>(count * tuples.Parts * (moment.TracksParticles ? 2 : 1)));
  for (std::int64_t i = 0; i < count; ++i)
  {
    const std::int64_t particle = clouds.First + i;
    double centre[D];
    places.Centre(i, centre);
    for (int part = 0; part < tuples.Parts; ++part)
    {
      Vote<D> vote;
      vote.Number = moment.Numbers ? moment.Numbers[i] : particle;
      for (int axis = 0; axis < D; ++axis)
      {
        const double length = clouds.Sizes.IsEmpty() ? 1.0 : places.Length(i, axis);
        vote.Centre[axis] = centre[axis] + tuples.OffsetOf(part, axis) * length;
        vote.Lengths[axis] = static_cast<float>(tuples.Parts > 1 ? 0.5 * length : length);
      }
      for (std::size_t end = 0; end < 2; ++end)
      {
        const double ofEnd = end == 0 ? 1.0 - clouds.Part : clouds.Part;
        const bool isOwn = (particle < clouds.OfFirst) == (end == 0);
        const double share = moment.TracksParticles ? ofEnd : isOwn ? 1.0 : 0.0;
        vote.Mass = share * clouds.Masses[i] / tuples.Parts;
        vote.Tuple = tuples.At[end][static_cast<std::size_t>(particle * tuples.Parts + part)];
        if (vote.Mass > 0.0)
        {
          votes.push_back(vote);
        }
      }
    }
  }
  return votes;
}

// The votes of all ranks that reach the wanted cells of this rank, in order.
template <int D>
std::vector<Vote<D>> exchangeVotes(
  std::vector<Vote<D>> own, const LatticePart<D>& part, const GridSize<D>& size, const Ranks& ranks)
{
  std::vector<std::vector<Vote<D>>> given;
  for (const LatticePart<D>& wanted : gatherValues(ranks, part))
  {
    given.emplace_back();
    std::copy_if(
      own.begin(), own.end(), std::back_inserter(given.back()), [&](const Vote<D>& vote) {
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
  for (const std::vector<Vote<D>>& votes : exchangeValues(ranks, std::move(given)))
  {
    own.insert(own.end(), votes.begin(), votes.end());
  }
  std::stable_sort(
    own.begin(), own.end(), [](const Vote<D>& a, const Vote<D>& b) { return a.Number < b.Number; });
  return own;
}

} // namespace

template <int D>
std::unique_ptr<LabelVotes> makeLabelVotes(const AdvectedMoment& moment,
  const BroughtTuples& tuples, const ImageGrid& geometry, const TupleBox& wanted,
  Progress& progress)
{
  const GridSize<D> size = geometry.Size<D>();
  const LatticePart<D> part = latticePartOf<D>(wanted, geometry);
  const double bytes = sizeof(Vote<D>) * 2.0 * tuples.Parts *
    static_cast<double>(moment.Clouds.Points->GetNumberOfTuples());
  return withMemory("the labels that move along", bytes, [&]() {
    std::vector<Vote<D>> votes = votesOf<D>(moment, tuples, geometry);
    const Ranks& ranks = progress.Group();
    if (ranks.AreSeveral())
    {
      votes = exchangeVotes<D>(std::move(votes), part, size, ranks);
    }
    return std::make_unique<CountedVotes<D>>(std::move(votes), part, size);
  });
}

template std::unique_ptr<LabelVotes> makeLabelVotes<1>(
  const AdvectedMoment&, const BroughtTuples&, const ImageGrid&, const TupleBox&, Progress&);
template std::unique_ptr<LabelVotes> makeLabelVotes<2>(
  const AdvectedMoment&, const BroughtTuples&, const ImageGrid&, const TupleBox&, Progress&);
template std::unique_ptr<LabelVotes> makeLabelVotes<3>(
  const AdvectedMoment&, const BroughtTuples&, const ImageGrid&, const TupleBox&, Progress&);

} // namespace RectifiedTransport::Bridge
