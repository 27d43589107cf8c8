// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Series/SeriesLabels.h"

#include "Core/Geometry/Dispatch.h"
#include "Core/Series/LabelVotes.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace RectifiedTransport
{

namespace
{

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
