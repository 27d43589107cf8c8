// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Distance/DistanceSet.h"

#include "Core/Geometry/Dispatch.h"
#include "Core/Geometry/LengthScale.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <set>

namespace RectifiedTransport
{

namespace
{

// So many maps are made at the same time, each by one thread.
constexpr std::size_t mapsAtOnce = 16;
// Larger densities are mapped one after the other, each by all threads.
constexpr double mostCellsOfThread = 0x1p18;

// Returns the first D of three numbers of cells.
template <int D>
GridSize<D> sizeOf(const GridSize<3>& cells)
{
  GridSize<D> size;
  std::copy_n(cells.begin(), D, size.begin());
  return size;
}

// Returns the sides of a box, in its LengthScale.
template <int D>
Point<D> sidesOf(const ImageGrid& box)
{
  const LengthScale scale(box);
  Point<D> sides = box.Lengths<D>();
  std::transform(sides.begin(), sides.end(), sides.begin(),
    [&](double length) { return scale.ToUnits(length); });
  return sides;
}

// Each rank has made one of the maps first, first + 1, ...; this gives all of them to all ranks.
// Collective.
void shareMaps(
  std::vector<std::shared_ptr<ReferenceImages>>& maps, std::size_t first, const Ranks& ranks)
{
  const std::size_t own = first + static_cast<std::size_t>(ranks.Own());
  // A rank beyond the last map sends nothing.
  const bool hasOne = own < maps.size();
  const std::vector<Bytes> all =
    ranks.Gather(hasOne ? toBytes(maps[own]->Coordinates.data(),
                            static_cast<std::size_t>(maps[own]->Coordinates.size()))
                        : Bytes());
  for (std::size_t i = first; i < std::min(maps.size(), first + all.size()); ++i)
  {
    const Bytes& bytes = all[i - first];
    if (i != own)
    {
      maps[i] = std::make_shared<ReferenceImages>();
      maps[i]->Coordinates =
        LargeBuffer<double>(static_cast<std::int64_t>(bytes.size() / sizeof(double)));
      std::memcpy(maps[i]->Coordinates.data(), bytes.data(), bytes.size());
    }
  }
}

// Orders a pair, so that a result does not depend on the order of the densities.
template <class Name>
std::pair<Name, Name> ordered(const Name& a, const Name& b)
{
  return b < a ? std::make_pair(b, a) : std::make_pair(a, b);
}

// The mass, mean and covariance of a density, in units of the box: they give the lower bound of W2
// by Gelbrich.
template <int D>
DensityMoments momentsIn(
  const double* values, const GridSize<3>& cells, const ImageGrid& box, const Context& context)
{
  const GridSize<D> size = sizeOf<D>(cells);
  return momentsOf<D>(DensityArray<D, double>(values, size), size, sidesOf<D>(box), context);
}

template <int D>
double memoryOfMap(const GridSize<3>& cells, const ImageGrid& box)
{
  return memoryForReference<D>(sizeOf<D>(cells), sidesOf<D>(box));
}

template <int D>
double memoryOfPair(const GridSize<3>& cells)
{
  return memoryForBracket<D>(sizeOf<D>(cells));
}

// Calls work(item, context) for all items on this rank: small ones in parallel, each on one thread,
// large ones in turn with all threads.
template <class Work>
void forItems(std::int64_t count, double cells, Progress& progress, const Work& work)
{
  if (cells <= mostCellsOfThread)
  {
    // One map a thread: its context has no threads of its own, but can be cancelled.
    static const SerialExecutor serial;
    progress.ForEach(
      count, 1,
      [&](
        std::int64_t i) { work(i, Context(serial, {}, [&]() { return progress.ShouldStop(); })); },
      1);
    return;
  }
  Parts parts(progress, count);
  for (std::int64_t i = 0; i < count; ++i)
  {
    Context context = parts[i];
    // Each rank works on another item, so that the work is not collective.
    context.Group = &SoloRanks::Get();
    work(i, context);
  }
}

// Returns the items of [0, count) that this rank does: every n-th, because neighbouring items may
// take similar time.
std::vector<std::int64_t> itemsOfRank(std::int64_t count, const Ranks& ranks)
{
  std::vector<std::int64_t> items;
  for (std::int64_t i = ranks.Own(); i < count; i += ranks.Count())
  {
    items.push_back(i);
  }
  return items;
}

} // namespace

// Maps and pairs stay: KeepOnlyGiven forgets those of densities that are not given again.
void DistanceSet::Begin(DistanceMethod method)
{
  this->Method = method;
  this->Given.clear();
  this->Waiting.clear();
}

bool DistanceSet::Add(Name name, const ImageGrid& grid, Values values, const Context& context)
{
  // The first density determines the box and so the unit of length.
  this->Box = this->Given.empty() ? grid : this->Box;
  GridSize<3> cells = grid.Size<3>();
  // A density's key has its name, its cells and the sides of its box: equal keys have equal maps.
  std::fill(cells.begin() + grid.Dimension(), cells.end(), 1);
  name.insert(name.end(), cells.begin(), cells.end());
  const Point<3> sides = sidesOf<3>(this->Box);
  for (int axis = 0; axis < this->Dimension(); ++axis)
  {
    std::memcpy(&name.emplace_back(), &sides[axis], sizeof(double));
  }
  Density density{ std::move(name), cells, std::move(values), {} };
  const auto ranks = static_cast<std::size_t>(context.Group->Count());
  if (this->Method == DistanceMethod::Linearized)
  {
    density.Moments = dispatchDimension(this->Dimension(), momentsIn<1>, momentsIn<2>,
      momentsIn<3>)(density.Cell.get(), cells, this->Box, *context.Threads);
    const bool waits = std::any_of(this->Waiting.begin(), this->Waiting.end(),
      [&](std::size_t other) { return this->Given[other].Key == density.Key; });
    // Equal densities share a map. A density that waits keeps its values on the rank that makes its
    // map only.
    const bool isNew = !waits && this->Maps.count(density.Key) == 0;
    // Maps are assigned to ranks in turn.
    const auto place = static_cast<int>(this->Waiting.size() % ranks);
    if (!isNew || place != context.Group->Own())
    {
      density.Cell = nullptr;
    }
    if (isNew)
    {
      this->Waiting.push_back(this->Given.size());
    }
  }
  this->Given.push_back(std::move(density));
  // Enough densities wait to give each thread of every rank a map.
  return this->Waiting.size() >= mapsAtOnce * ranks;
}

double DistanceSet::CellsOfMaps() const
{
  // The largest density decides whether maps are made one a thread or in turn.
  double cells = 0.0;
  for (const std::size_t waiting : this->Waiting)
  {
    cells = std::max(cells, numberOfCells<3>(this->Given[waiting].Cells));
  }
  return cells;
}

double DistanceSet::MemoryForMaps() const
{
  double bytes = 0.0;
  for (const std::size_t waiting : this->Waiting)
  {
    const auto memory =
      dispatchDimension(this->Dimension(), memoryOfMap<1>, memoryOfMap<2>, memoryOfMap<3>);
    bytes = std::max(bytes, memory(this->Given[waiting].Cells, this->Box));
  }
  return bytes;
}

void DistanceSet::MakeMaps(const Context& context)
{
  Progress progress(context);
  const auto make = dispatchDimension(this->Dimension(), &DistanceSet::MakeMapsIn<1>,
    &DistanceSet::MakeMapsIn<2>, &DistanceSet::MakeMapsIn<3>);
  (this->*make)(progress);
}

template <int D>
void DistanceSet::MakeMapsIn(Progress& progress)
{
  const Ranks& ranks = progress.Group();
  const auto count = static_cast<std::int64_t>(this->Waiting.size());
  const std::vector<std::int64_t> own = itemsOfRank(count, ranks);
  const Point<D> sides = sidesOf<D>(this->Box);
  // This rank's maps now, all maps after the exchange.
  std::vector<std::shared_ptr<ReferenceImages>> made(this->Waiting.size());
  // Each item is a density that waits for its map; its values are released as soon as the map is
  // made.
  forItems(static_cast<std::int64_t>(own.size()), this->CellsOfMaps(), progress,
    [&](std::int64_t item, const Context& context) {
      const auto place = static_cast<std::size_t>(own[static_cast<std::size_t>(item)]);
      Density& density = this->Given[this->Waiting[place]];
      const DensityArray<D, double> values(density.Cell.get(), sizeOf<D>(density.Cells));
      made[place] = std::make_shared<ReferenceImages>(mapReference<D>(values, sides, context));
      density.Cell = nullptr;
    });
  // Maps are exchanged in rounds of one a rank, so that memory for messages stays small.
  for (std::size_t first = 0; first < made.size() && ranks.AreSeveral();
       first += static_cast<std::size_t>(ranks.Count()))
  {
    shareMaps(made, first, ranks);
  }
  for (std::size_t i = 0; i < made.size(); ++i)
  {
    this->Maps[this->Given[this->Waiting[i]].Key] = made[i];
  }
  this->Solutions += count;
  this->Waiting.clear();
}

double DistanceSet::MemoryForPairs() const
{
  // Linearized distances are sums over the maps' samples, which are there already.
  const bool isCertified = this->Method == DistanceMethod::Certified;
  return isCertified && !this->MissingPairs().empty()
    ? dispatchDimension(this->Dimension(), memoryOfPair<1>, memoryOfPair<2>, memoryOfPair<3>)(
        this->Given.front().Cells)
    : 0.0;
}

// Linearized, the maps' samples bound W2 from above and the moments from below. Certified, a
// solution of the pair gives both bounds.
std::vector<DistancePair> DistanceSet::Find(const Context& context)
{
  Progress progress(context);
  const auto find = dispatchDimension(this->Dimension(), &DistanceSet::FindMissing<1>,
    &DistanceSet::FindMissing<2>, &DistanceSet::FindMissing<3>);
  (this->*find)(progress);
  this->KeepOnlyGiven();
  // Squares were computed in units of the box; they neither overflow nor vanish.
  const LengthScale scale(this->Box);
  const auto lengthOf = [&](double square) { return scale.LengthFromUnits(std::sqrt(square)); };
  const bool isLinearized = this->Method == DistanceMethod::Linearized;
  std::vector<DistancePair> all;
  for (std::size_t i = 0; i < this->Given.size(); ++i)
  {
    for (std::size_t j = i + 1; j < this->Given.size(); ++j)
    {
      // Zero for equal densities, which have no entry.
      SquaredBracket pair;
      const auto found = this->Known().find(ordered(this->Given[i].Key, this->Given[j].Key));
      if (found != this->Known().end()) // otherwise both are the same
      {
        pair = found->second;
      }
      if (isLinearized)
      {
        pair.Lower = leastSquaredDistance(this->Given[i].Moments, this->Given[j].Moments);
        // If both bounds meet, the errors of the maps may exchange them.
        pair.Upper = std::max(pair.Upper, pair.Lower);
      }
      const double lower = lengthOf(pair.Lower);
      const double upper = lengthOf(pair.Upper);
      all.push_back({ isLinearized ? upper : lower, lower, upper });
    }
  }
  return all;
}

std::vector<DistanceSet::NamePair> DistanceSet::MissingPairs() const
{
  // Linearized and certified distances are kept apart.
  const auto& known = this->Pairs[static_cast<std::size_t>(this->Method)];
  // Each pair once, even if several given densities are equal.
  std::set<NamePair> missing;
  for (std::size_t i = 0; i < this->Given.size(); ++i)
  {
    for (std::size_t j = i + 1; j < this->Given.size(); ++j)
    {
      const NamePair pair = ordered(this->Given[i].Key, this->Given[j].Key);
      if (!(pair.first == pair.second) && known.count(pair) == 0)
      {
        missing.insert(pair);
      }
    }
  }
  return { missing.begin(), missing.end() };
}

template <int D>
SquaredBracket DistanceSet::FindPair(const NamePair& pair, const Context& context) const
{
  if (this->Method == DistanceMethod::Linearized)
  {
    return { 0.0, meanSquaredDistance<D>(*this->Maps.at(pair.first), *this->Maps.at(pair.second)) };
  }
  // Any of the given densities with this key has the values.
  const auto valuesOf = [this](const Name& name) -> DensityArray<D, double> {
    const auto density = std::find_if(this->Given.begin(), this->Given.end(),
      [&](const Density& given) { return given.Key == name; });
    return { density->Cell.get(), sizeOf<D>(density->Cells) };
  };
  return bracketDistance<D>(
    valuesOf(pair.first), valuesOf(pair.second), sidesOf<D>(this->Box), context);
}

template <int D>
void DistanceSet::FindMissing(Progress& progress)
{
  const Ranks& ranks = progress.Group();
  // Missing pairs are sorted, so that all ranks divide the same list.
  const std::vector<NamePair> missing = this->MissingPairs();
  const std::vector<std::int64_t> own =
    itemsOfRank(static_cast<std::int64_t>(missing.size()), ranks);
  // A bracket for each pair of this rank, in the order of `own`.
  std::vector<SquaredBracket> found(own.size());
  const bool isCertified = this->Method == DistanceMethod::Certified;
  forItems(static_cast<std::int64_t>(own.size()),
    isCertified ? numberOfCells<3>(this->Given.front().Cells) : 0.0, progress,
    [&](std::int64_t item, const Context& context) {
      const auto place = static_cast<std::size_t>(item);
      found[place] = this->FindPair<D>(missing[static_cast<std::size_t>(own[place])], context);
    });
  this->Solutions += isCertified ? static_cast<std::int64_t>(missing.size()) : 0;
  // All ranks get the brackets of all pairs.
  const std::vector<Bytes> all = ranks.Gather(toBytes(found));
  for (std::size_t rank = 0; rank < all.size(); ++rank)
  {
    const std::vector<SquaredBracket> theirs = fromBytes<SquaredBracket>(all[rank]);
    for (std::size_t i = 0; i < theirs.size(); ++i)
    {
      // Rank r did the pairs r, r + n, r + 2 n, ... of the list.
      this->Known()[missing[rank + i * all.size()]] = theirs[i];
    }
  }
}

// Forgets all results of densities that were not given, so that memory does not grow with each
// change of the inputs.
void DistanceSet::KeepOnlyGiven()
{
  std::set<Name> given;
  for (const Density& density : this->Given)
  {
    given.insert(density.Key);
  }
  for (auto map = this->Maps.begin(); map != this->Maps.end();)
  {
    map = given.count(map->first) == 0 ? this->Maps.erase(map) : std::next(map);
  }
  for (auto& pairs : this->Pairs)
  {
    for (auto pair = pairs.begin(); pair != pairs.end();)
    {
      const bool isUsed = given.count(pair->first.first) > 0 && given.count(pair->first.second) > 0;
      pair = isUsed ? std::next(pair) : pairs.erase(pair);
    }
  }
}

} // namespace RectifiedTransport
