// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Series/SeriesLabels.h"

#include "Core/Geometry/Dispatch.h"
#include "Core/Geometry/LatticePart.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Splat/ScaledClouds.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// The mass of a cloud for one tuple.
template <int D>
struct LabelVote
{
  double Centre[D]; // in index space
  float Lengths[D]; // in cells
  double Mass;
  std::int64_t Tuple;
  std::int64_t Number; // number of the cloud among those of all ranks
};

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

// Which labels have most of the mass of clouds in each cell.
template <int D>
class LabelVotes
{
public:
  // Prepares the votes in a part of a grid. Each rank gets the votes of all ranks that reach its
  // part, in the order of their numbers. Collective. Throws std::bad_alloc.
  LabelVotes(std::vector<LabelVote<D>> votes, const GridSize<D>& size, const LatticePart<D>& part,
    const Ranks& ranks)
    : Size(size)
    , Part(part)
    , Votes(ranks.AreSeveral() ? exchangeVotes<D>(std::move(votes), part, size, ranks)
                               : std::move(votes))
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

  // Returns for each cell of the part the label with most of the mass there, the smallest one if
  // masses are equal; -1 without mass. equal[t] is the label that tuple t counts for. Throws
  // std::bad_alloc and Cancelled.
  std::vector<std::int64_t> Count(const std::vector<std::int64_t>& equal, Progress& progress) const
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
    const std::int64_t grainOfLayers = std::max<std::int64_t>(2 * CloudRow::Most, atOnce / cells);
    progress.For(
      layers, grainOfLayers,
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
      grainOfLayers);
    return winners;
  }

private:
  const GridSize<D> Size;
  const LatticePart<D> Part;
  std::vector<LabelVote<D>> Votes;
  std::vector<std::int64_t> Begins; // the first vote of each layer
};

// Returns the cell of a grid at an index, or the nearest one.
template <int D>
std::int64_t cellAt(const ImageGrid& grid, const double* index)
{
  const GridSize<D> size = grid.Size<D>();
  GridSize<D> cell;
  for (int axis = 0; axis < D; ++axis)
  {
    // Any place within the last cell, so that the index of a point on the upper border is valid.
    const double last = static_cast<double>(size[axis]) - 0.5;
    cell[axis] = static_cast<std::int64_t>(std::clamp(index[axis], 0.0, last));
  }
  return LatticePart<D>::WholeOf(size).NumberOf(cell);
}

} // namespace

// Tuples with equal keys get the number of the first of them, over both steps: a label is the same
// wherever it occurs.
std::vector<std::int64_t> findEqual(
  const std::array<std::int64_t, 2>& tuples, const TupleKey& keyOf)
{
  std::vector<std::int64_t> equal;
  // The number of the first tuple with each key.
  std::unordered_map<std::string, std::int64_t> known;
  for (std::size_t step = 0; step < 2; ++step)
  {
    std::string before;
    for (std::int64_t i = 0; i < tuples[step]; ++i)
    {
      const auto number = static_cast<std::int64_t>(equal.size());
      std::string key = keyOf(step, i);
      // Neighbours are often equal.
      equal.push_back(
        i > 0 && key == before ? equal.back() : known.try_emplace(key, number).first->second);
      before = std::move(key);
    }
  }
  return equal;
}

SeriesLabels::SeriesLabels(
  const std::array<ImageGrid, 2>& grids, bool isAcross, const SeriesParticles& particles)
  : Grids(grids)
  , Parts(isAcross ? 1 << grids[0].Dimension() : 1)
{
  using Self = SeriesLabels;
  // The tuples at both ends of the way: those of the first step at From, of the second one at To.
  const auto add = dispatchDimension(
    grids[0].Dimension(), &Self::AddTuples<1>, &Self::AddTuples<2>, &Self::AddTuples<3>);
  (this->*add)(0, particles.From->Span(), particles.Clouds[0]);
  (this->*add)(1, particles.To->Span(), particles.Clouds[1]);
}

// Two votes for each part of a particle, one for each step.
double SeriesLabels::BytesOfVotes(std::int64_t particles) const
{
  return sizeof(LabelVote<3>) * 2.0 * this->Parts * static_cast<double>(particles);
}

// Returns the offset of a part's centre from the cloud's centre, in lengths of the cloud.
double SeriesLabels::OffsetOf(int part, int axis) const
{
  return this->Parts == 1 ? 0.0 : (part >> axis & 1) == 0 ? -0.25 : 0.25;
}

// Adds the tuple under the centre of each part of each particle. Lengths are in cells of the grid;
// 1 if there are none.
template <int D>
void SeriesLabels::AddTuples(
  std::size_t end, ConstPointSpan<3> points, const std::vector<float>& lengths)
{
  const ImageGrid& grid = this->Grids[end];
  const std::int64_t before = end == 0 ? 0 : this->TuplesOfFirst();
  this->Tuples[end].reserve(static_cast<std::size_t>(points.size() * this->Parts));
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    double centre[D];
    grid.ToIndex<D>(points[i], centre);
    for (int part = 0; part < this->Parts; ++part)
    {
      double index[D];
      for (int axis = 0; axis < D; ++axis)
      {
        const double length =
          lengths.empty() ? 1.0 : lengths[static_cast<std::size_t>(D * i + axis)];
        index[axis] = centre[axis] + this->OffsetOf(part, axis) * length;
      }
      this->Tuples[end].push_back(before + cellAt<D>(grid, index));
    }
  }
}

// Each part of a cloud votes with its mass for its tuples; a tracked particle divides the vote
// between both steps by the time.
template <int D>
void SeriesLabels::Find(const SeriesSnapshot& moment, const ImageGrid& grid,
  const LatticePart<D>& wanted, const std::vector<std::vector<std::int64_t>>& equal,
  Progress& progress, const Take& take) const
{
  const SeriesParticles& particles = moment.All();
  // Centres and lengths of the clouds at the moment, in cells of the grid.
  const ScaledClouds<D> clouds = moment.CloudsIn<D>(grid);
  const std::int64_t* numbers = moment.Numbers();
  std::vector<LabelVote<D>> cast;
  cast.reserve(
    static_cast<std::size_t>(moment.Count() * this->Parts * (particles.AreTracked ? 2 : 1)));
  for (std::int64_t i = 0; i < moment.Count(); ++i)
  {
    const std::int64_t particle = moment.First() + i;
    const Point<D> centre = clouds.CentreIn(grid, i);
    for (int part = 0; part < this->Parts; ++part)
    {
      LabelVote<D> vote;
      // The number orders votes in the same way on any number of ranks.
      vote.Number = numbers ? numbers[i] : particle;
      for (int axis = 0; axis < D; ++axis)
      {
        const double length = clouds.Lengths[0] ? clouds.Length(i, axis) : 1.0;
        vote.Centre[axis] = centre[axis] + this->OffsetOf(part, axis) * length;
        vote.Lengths[axis] = static_cast<float>(this->Parts > 1 ? 0.5 * length : length);
      }
      for (std::size_t end = 0; end < 2; ++end)
      {
        // A tracked particle gives both tuples their part of the time; other particles vote only
        // for their own step.
        const double ofEnd = end == 0 ? 1.0 - moment.Part() : moment.Part();
        const bool isOwn = (particle < particles.OfFirst) == (end == 0);
        const double share = particles.AreTracked ? ofEnd : isOwn ? 1.0 : 0.0;
        vote.Mass = share * moment.Masses()[i] / this->Parts;
        vote.Tuple = this->Tuples[end][static_cast<std::size_t>(particle * this->Parts + part)];
        if (vote.Mass > 0.0)
        {
          cast.push_back(vote);
        }
      }
    }
  }
  // The votes are exchanged once and counted for every array, whose labels differ.
  const LabelVotes<D> votes(std::move(cast), grid.Size<D>(), wanted, progress.Group());
  for (std::size_t array = 0; array < equal.size(); ++array)
  {
    std::vector<std::int64_t> tuples = votes.Count(equal[array], progress);
    for (std::size_t i = 0; i < tuples.size(); ++i)
    {
      tuples[i] = tuples[i] >= 0
        ? tuples[i]
        : this->InPlace<D>(grid, wanted.CellOf(static_cast<std::int64_t>(i)), moment.Part());
    }
    take(array, tuples);
  }
}

// Returns the tuple at a place itself. The step that is nearer in time is taken if both grids
// contain the place, or neither does.
template <int D>
std::int64_t SeriesLabels::InPlace(
  const ImageGrid& grid, const GridSize<D>& cell, double part) const
{
  double centre[D];
  std::transform(cell.begin(), cell.end(), centre,
    [](std::int64_t at) { return static_cast<double>(at) + 0.5; });
  double x[3];
  grid.ToPhysical<D>(centre, x);
  double nearest[D];
  // The grids of both steps may cover different boxes.
  const bool isInFirst = this->Grids[0].NearestIndex<D>(x, nearest);
  const bool isInSecond = this->Grids[1].NearestIndex<D>(x, nearest);
  const bool isFirst = isInFirst == isInSecond ? part <= 0.5 : isInFirst;
  const ImageGrid& step = this->Grids[isFirst ? 0 : 1];
  double index[D];
  step.ToIndex<D>(x, index);
  return cellAt<D>(step, index) + (isFirst ? 0 : this->TuplesOfFirst());
}

template void SeriesLabels::Find<1>(const SeriesSnapshot&, const ImageGrid&, const LatticePart<1>&,
  const std::vector<std::vector<std::int64_t>>&, Progress&, const Take&) const;
template void SeriesLabels::Find<2>(const SeriesSnapshot&, const ImageGrid&, const LatticePart<2>&,
  const std::vector<std::vector<std::int64_t>>&, Progress&, const Take&) const;
template void SeriesLabels::Find<3>(const SeriesSnapshot&, const ImageGrid&, const LatticePart<3>&,
  const std::vector<std::vector<std::int64_t>>&, Progress&, const Take&) const;

} // namespace RectifiedTransport
