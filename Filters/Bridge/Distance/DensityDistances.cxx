// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Distance/DensityDistances.h"

#include "Bridge/Image/CommonGrid.h"
#include "Bridge/Image/GridText.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Geometry/LengthScale.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <set>
#include <string>
#include <type_traits>

namespace RectifiedTransport::Bridge
{

namespace
{

// Of as many maps as are made together: each thread makes one by itself.
constexpr std::size_t mapsAtOnce = 16;
// Larger densities are mapped one after the other, each by all threads.
constexpr double mostCellsOfThread = 0x1p18;

template <int D>
GridSize<D> sizeOf(const DensityKey& key)
{
  GridSize<D> size;
  std::copy_n(key.Cells.begin(), D, size.begin());
  return size;
}

template <int D>
DensityArray<D, double> valuesOf(const DistanceInput& input)
{
  return { input.Values->GetPointer(0), sizeOf<D>(input.Key) };
}

template <int D>
DensityMoments momentsOfInput(const DistanceInput& input, Progress& progress)
{
  Point<D> sides;
  std::copy_n(input.Key.Sides.begin(), D, sides.begin());
  return momentsOf<D>(valuesOf<D>(input), sizeOf<D>(input.Key), sides, progress.Threads());
}

std::string gridText(const DistanceInput& input)
{
  const auto size = [&](auto dimension) {
    return describeSize<decltype(dimension)::value>(sizeOf<decltype(dimension)::value>(input.Key));
  };
  const int dimension = input.Grid.Dimension();
  return dimension == 1 ? size(std::integral_constant<int, 1>())
    : dimension == 2    ? size(std::integral_constant<int, 2>())
                        : size(std::integral_constant<int, 3>());
}

// Of the maps first, first + 1 ... each rank has made one; gives all to all.
void shareMaps(
  std::vector<std::shared_ptr<ReferenceImages>>& maps, std::size_t first, const Ranks& ranks)
{
  const std::size_t own = first + static_cast<std::size_t>(ranks.Own());
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

// So that a result does not depend on the order of the densities.
std::pair<DensityKey, DensityKey> ordered(const DensityKey& a, const DensityKey& b)
{
  return b < a ? std::make_pair(b, a) : std::make_pair(a, b);
}

// work(item, context) for all items, on this rank.
template <class Work>
void forItems(std::int64_t count, double cells, Progress& progress, const Work& work)
{
  if (cells <= mostCellsOfThread)
  {
    static const SerialExecutor serial;
    progress.For(
      count, 1,
      [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t i = first; i < last; ++i)
        {
          work(i, Context(serial, {}, [&]() { return progress.ShouldStop(); }));
        }
      },
      1);
    return;
  }
  Parts parts(progress, count);
  for (std::int64_t i = 0; i < count; ++i)
  {
    Context context = parts[i];
    context.Group = &SoloRanks::Get();
    work(i, context);
  }
}

// The items of [0, count) that this rank does: every so many, as neighbours may be alike.
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

void DensityDistances::Begin(DistanceMethod method)
{
  this->Method = method;
  this->Given.clear();
  this->Waiting.clear();
}

template <int D>
std::array<double, D> DensityDistances::Sides() const
{
  std::array<double, D> sides;
  std::copy_n(this->Given.front().Key.Sides.begin(), D, sides.begin());
  return sides;
}

void DensityDistances::Add(DistanceInput input, Progress& progress)
{
  if (this->Given.empty())
  {
    const LengthScale scale(input.Grid);
    const Point<3> lengths = input.Grid.Lengths<3>();
    for (int axis = 0; axis < input.Grid.Dimension(); ++axis)
    {
      input.Key.Sides[static_cast<std::size_t>(axis)] =
        scale.ToUnits(lengths[static_cast<std::size_t>(axis)]);
    }
  }
  else
  {
    const DistanceInput& first = this->Given.front();
    requireSameBox({ first.Grid, first.Title }, { input.Grid, input.Title });
    if (this->Method == DistanceMethod::Certified && input.Key.Cells != first.Key.Cells)
    {
      fail("Method Certified needs densities with the same number of cells along each axis; ",
        first.Title, " has ", gridText(first), ", ", input.Title, " ", gridText(input),
        " (Linearized takes both)");
    }
    input.Key.Sides = first.Key.Sides;
  }
  if (this->Method == DistanceMethod::Linearized)
  {
    input.Moments = dispatchDimension(input.Grid.Dimension(), momentsOfInput<1>, momentsOfInput<2>,
      momentsOfInput<3>)(input, progress);
    const bool waits = std::any_of(this->Waiting.begin(), this->Waiting.end(),
      [&](std::size_t other) { return this->Given[other].Key == input.Key; });
    const Ranks& ranks = progress.Group();
    const auto place =
      static_cast<int>(this->Waiting.size() % static_cast<std::size_t>(ranks.Count()));
    const bool isNew = !waits && this->Maps.count(input.Key) == 0;
    if (!isNew || place != ranks.Own())
    {
      input.Values = nullptr;
    }
    if (isNew)
    {
      this->Waiting.push_back(this->Given.size());
    }
  }
  this->Given.push_back(std::move(input));
  if (this->Waiting.size() >= mapsAtOnce * static_cast<std::size_t>(progress.Group().Count()))
  {
    const int dimension = this->Given.front().Grid.Dimension();
    const auto make = dispatchDimension(dimension, &DensityDistances::MakeMaps<1>,
      &DensityDistances::MakeMaps<2>, &DensityDistances::MakeMaps<3>);
    (this->*make)(progress);
  }
}

template <int D>
void DensityDistances::MakeMaps(Progress& progress)
{
  const Ranks& ranks = progress.Group();
  const auto count = static_cast<std::int64_t>(this->Waiting.size());
  const std::vector<std::int64_t> own = itemsOfRank(count, ranks);
  const Point<D> sides = this->Sides<D>();
  double cells = 0.0;
  double bytes = 0.0;
  for (const std::size_t waiting : this->Waiting)
  {
    const GridSize<D> size = sizeOf<D>(this->Given[waiting].Key);
    cells = std::max(cells, numberOfCells<D>(size));
    bytes = std::max(bytes, memoryForReference<D>(size, sides));
  }
  const std::string purpose = "the optimal map to a density of " +
    std::to_string(static_cast<std::int64_t>(cells)) + " cells (a coarser image takes less)";
  requireMemory(purpose, bytes);
  std::vector<std::shared_ptr<ReferenceImages>> made(this->Waiting.size());
  withMemory(purpose, bytes, [&]() {
    forItems(static_cast<std::int64_t>(own.size()), cells, progress,
      [&](std::int64_t item, const Context& context) {
        const auto place = static_cast<std::size_t>(own[static_cast<std::size_t>(item)]);
        DistanceInput& input = this->Given[this->Waiting[place]];
        made[place] =
          std::make_shared<ReferenceImages>(mapReference<D>(valuesOf<D>(input), sides, context));
        input.Values = nullptr;
      });
  });
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

std::vector<DistancePair> DensityDistances::Find(Progress& progress)
{
  const int dimension = this->Given.front().Grid.Dimension();
  const auto find = dispatchDimension(dimension, &DensityDistances::FindAll<1>,
    &DensityDistances::FindAll<2>, &DensityDistances::FindAll<3>);
  return (this->*find)(progress);
}

template <int D>
std::vector<DistancePair> DensityDistances::FindAll(Progress& progress)
{
  Stages stages(progress, { { "maps", this->Waiting.empty() ? 0.0 : 9.0 }, { "pairs", 1 } });
  if (!this->Waiting.empty())
  {
    this->MakeMaps<D>(stages["maps"]);
  }
  this->FindMissing<D>(stages["pairs"]);
  this->KeepOnlyGiven();
  const LengthScale scale(this->Given.front().Grid);
  const bool isCertified = this->Method == DistanceMethod::Certified;
  const auto& known = this->Pairs[static_cast<std::size_t>(this->Method)];
  std::vector<DistancePair> all;
  for (std::size_t i = 0; i < this->Given.size(); ++i)
  {
    for (std::size_t j = i + 1; j < this->Given.size(); ++j)
    {
      DistancePair& pair = all.emplace_back();
      const auto found = known.find(ordered(this->Given[i].Key, this->Given[j].Key));
      if (found != known.end()) // else both are the same
      {
        pair.Lower = scale.LengthFromUnits(std::sqrt(found->second.Lower));
        pair.Upper = scale.LengthFromUnits(std::sqrt(found->second.Upper));
      }
      if (!isCertified)
      {
        const double least = leastSquaredDistance(this->Given[i].Moments, this->Given[j].Moments);
        pair.Lower = scale.LengthFromUnits(std::sqrt(least));
        // Where both meet, the errors of the maps may part them the wrong way.
        pair.Upper = std::max(pair.Upper, pair.Lower);
      }
      pair.Distance = isCertified ? pair.Lower : pair.Upper;
    }
  }
  return all;
}

std::vector<DensityDistances::KeyPair> DensityDistances::MissingPairs() const
{
  const auto& known = this->Pairs[static_cast<std::size_t>(this->Method)];
  std::set<KeyPair> missing;
  for (std::size_t i = 0; i < this->Given.size(); ++i)
  {
    for (std::size_t j = i + 1; j < this->Given.size(); ++j)
    {
      const KeyPair pair = ordered(this->Given[i].Key, this->Given[j].Key);
      if (!(pair.first == pair.second) && known.count(pair) == 0)
      {
        missing.insert(pair);
      }
    }
  }
  return { missing.begin(), missing.end() };
}

template <int D>
SquaredBracket DensityDistances::FindPair(const KeyPair& pair, const Context& context) const
{
  if (this->Method == DistanceMethod::Linearized)
  {
    const double square =
      meanSquaredDistance<D>(*this->Maps.at(pair.first), *this->Maps.at(pair.second));
    return { 0.0, square };
  }
  const auto inputOf = [this](const DensityKey& key) -> const DistanceInput& {
    return *std::find_if(this->Given.begin(), this->Given.end(),
      [&](const DistanceInput& input) { return input.Key == key; });
  };
  return bracketDistance<D>(
    valuesOf<D>(inputOf(pair.first)), valuesOf<D>(inputOf(pair.second)), this->Sides<D>(), context);
}

template <int D>
void DensityDistances::FindMissing(Progress& progress)
{
  const Ranks& ranks = progress.Group();
  const std::vector<KeyPair> missing = this->MissingPairs();
  const std::vector<std::int64_t> own =
    itemsOfRank(static_cast<std::int64_t>(missing.size()), ranks);
  std::vector<SquaredBracket> found(own.size());
  const bool isCertified = this->Method == DistanceMethod::Certified;
  const GridSize<D> size = sizeOf<D>(this->Given.front().Key);
  const double bytes = isCertified && !missing.empty() ? memoryForBracket<D>(size) : 0.0;
  const std::string purpose = "the bounds of a distance (Method Linearized takes less)";
  requireMemory(purpose, bytes);
  auto& known = this->Pairs[static_cast<std::size_t>(this->Method)];
  withMemory(purpose, bytes, [&]() {
    forItems(static_cast<std::int64_t>(own.size()), isCertified ? numberOfCells<D>(size) : 0.0,
      progress, [&](std::int64_t item, const Context& context) {
        const auto place = static_cast<std::size_t>(item);
        found[place] = this->FindPair<D>(missing[static_cast<std::size_t>(own[place])], context);
      });
  });
  this->Solutions += isCertified ? static_cast<std::int64_t>(missing.size()) : 0;
  const std::vector<Bytes> all = ranks.Gather(toBytes(found));
  for (std::size_t rank = 0; rank < all.size(); ++rank)
  {
    const std::vector<SquaredBracket> theirs = fromBytes<SquaredBracket>(all[rank]);
    for (std::size_t i = 0; i < theirs.size(); ++i)
    {
      known[missing[rank + i * all.size()]] = theirs[i];
    }
  }
}

// So that memory does not grow with each change of the inputs.
void DensityDistances::KeepOnlyGiven()
{
  std::set<DensityKey> given;
  for (const DistanceInput& input : this->Given)
  {
    given.insert(input.Key);
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

} // namespace RectifiedTransport::Bridge
