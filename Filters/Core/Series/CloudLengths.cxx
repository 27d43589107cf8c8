// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Series/CloudLengths.h"

#include "Core/Parallel/RankExchange.h"

#include <cmath>
#include <iterator>

namespace RectifiedTransport
{

namespace
{

// Returns the length of one particle's share of a lattice cell, relative to the cell: n^(-1/D) for
// n particles a cell.
template <int D>
double shareOfCell(const PivotLattice<D>& lattice)
{
  return std::pow(static_cast<double>(lattice.Places.size()), -1.0 / D);
}

// Returns the values of all ranks, in the order of the ranks.
template <class T>
std::vector<T> ofAllRanks(const Ranks& ranks, const T* own, std::int64_t count)
{
  if (!ranks.AreSeveral())
  {
    return std::vector<T>(own, own + count);
  }
  // The first entry of each rank in the common array, and the end.
  std::vector<std::int64_t> starts = { 0 };
  for (const std::int64_t part : gatherValues(ranks, count))
  {
    starts.push_back(starts.back() + part);
  }
  std::vector<T> all(static_cast<std::size_t>(starts.back()));
  std::copy_n(own, count, all.data() + starts[static_cast<std::size_t>(ranks.Own())]);
  gatherParts(ranks, starts, all.data());
  return all;
}

// Returns the spacing from the distances to both neighbours; a negative distance means that there
// is no neighbour. Where mass comes apart, one distance is much larger and is ignored.
double spacingOf(double before, double after, double alone)
{
  if (before < 0.0 || after < 0.0)
  {
    return before >= 0.0 ? before : after >= 0.0 ? after : alone;
  }
  const double less = std::min(before, after);
  const double more = std::max(before, after);
  return more < 2.0 * less ? 0.5 * (less + more) : less;
}

} // namespace

template <int D>
void addCloudsInCells(const PivotLattice<D>& lattice, const ImageGrid& grid, std::int64_t count,
  std::vector<float>& lengths)
{
  const Point<D> side = latticeStep<D>(lattice.Lattice, grid.Size<D>());
  const double share = shareOfCell<D>(lattice);
  lengths.reserve(lengths.size() + static_cast<std::size_t>(D * count));
  for (std::int64_t i = 0; i < count; ++i)
  {
    std::transform(side.begin(), side.end(), std::back_inserter(lengths),
      [share](double length) { return static_cast<float>(length * share); });
  }
}

template <int D>
void addCloudsAtImages(const PivotLattice<D>& lattice, const ImageGrid& here,
  const ImageGrid& there, const std::vector<std::int64_t>& numbers, ConstPointSpan<D> images,
  Progress& progress, std::vector<float>& lengths)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 12;
  const Ranks& ranks = progress.Group();
  const std::vector<std::int64_t> allNumbers =
    ofAllRanks(ranks, numbers.data(), static_cast<std::int64_t>(numbers.size()));
  const std::vector<double> all = ofAllRanks(ranks, images.data(), D * images.size());
  constexpr std::int64_t none = -1;
  // The place of each particle number among the images, -1 for particles without mass.
  std::vector<std::int64_t> where(static_cast<std::size_t>(lattice.NumberOfParticles()), none);
  for (std::size_t i = 0; i < allNumbers.size(); ++i)
  {
    where[static_cast<std::size_t>(allNumbers[i])] = static_cast<std::int64_t>(i);
  }
  const GridSize<D>& size = lattice.Lattice;
  // Images are in cells of `there`, lengths in cells of `here`.
  const Point<D> unit = cellsInCells<D>(there, here);
  const Point<D> side = latticeStep<D>(size, here.Size<D>());
  const double share = shareOfCell<D>(lattice);
  const std::size_t before = lengths.size();
  lengths.resize(before + static_cast<std::size_t>(D * images.size()));
  float* added = lengths.data() + before;
  progress.ForEach(images.size(), grain, [&](std::int64_t i) {
    const std::int64_t number = numbers[static_cast<std::size_t>(i)];
    // The neighbours along an axis are the particles at the same place of the neighbouring lattice
    // cells.
    std::int64_t rest = number % static_cast<std::int64_t>(numberOfCells<D>(size));
    std::int64_t step = 1;
    for (int axis = 0; axis < D; ++axis)
    {
      const auto distanceTo = [&](bool isInside, std::int64_t neighbour) {
        const std::int64_t found = isInside ? where[static_cast<std::size_t>(neighbour)] : none;
        return found == none
          ? -1.0
          : std::abs(all[static_cast<std::size_t>(D * found + axis)] - images[i][axis]) *
            unit[axis];
      };
      const std::int64_t at = rest % size[axis];
      const double spacing = spacingOf(distanceTo(at > 0, number - step),
        distanceTo(at + 1 < size[axis], number + step), side[axis]);
      added[D * i + axis] = static_cast<float>(spacing * share);
      rest /= size[axis];
      step *= size[axis];
    }
  });
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(addCloudsInCells);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(addCloudsAtImages);

} // namespace RectifiedTransport
