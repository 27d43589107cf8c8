// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Parallel/RankOrder.h"

#include "Core/Parallel/KeySort.h"
#include "Core/Parallel/RankShare.h"

#include <limits>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// The least and largest key of some elements, and their number.
struct KeyRange
{
  std::int64_t Least = std::numeric_limits<std::int64_t>::max();
  std::int64_t Largest = std::numeric_limits<std::int64_t>::min();
  std::int64_t Count = 0;
};

// What all ranks know about the keys of all: one small gather. Without keys on every rank with
// elements, elements keep their order by ranks.
struct AllKeys
{
  AllKeys(std::int64_t count, const std::int64_t* keys, const Ranks& ranks)
  {
    KeyRange own;
    own.Count = count;
    for (std::int64_t i = 0; i < count && keys; ++i)
    {
      own.Least = std::min(own.Least, keys[i]);
      own.Largest = std::max(own.Largest, keys[i]);
    }
    int rank = 0;
    for (const KeyRange& range : gatherValues(ranks, own))
    {
      this->HaveKeys = this->HaveKeys && (range.Count == 0 || range.Least <= range.Largest);
      this->Range.Least = std::min(this->Range.Least, range.Least);
      this->Range.Largest = std::max(this->Range.Largest, range.Largest);
      this->Range.Count += range.Count;
      this->Before += rank++ < ranks.Own() ? range.Count : 0;
    }
    this->HaveKeys = this->HaveKeys && this->Range.Count > 0;
  }

  KeyRange Range;
  bool HaveKeys = true;
  std::int64_t Before = 0; // elements of lower ranks
};

// Which rank sorts a key: equal intervals of the range, ascending with the key. This is a bucket
// sort over ranks; keys of Morton order are spread evenly enough.
class Sorters
{
public:
  // Unsigned differences do not overflow.
  Sorters(const KeyRange& range, int ranks)
    : Least(static_cast<std::uint64_t>(range.Least))
    , Span(static_cast<double>(static_cast<std::uint64_t>(range.Largest) - this->Least) + 1.0)
    , Count(ranks)
  {
  }
  std::size_t Of(std::int64_t key) const
  {
    const auto above = static_cast<double>(static_cast<std::uint64_t>(key) - this->Least);
    const int sorter = static_cast<int>(above / this->Span * this->Count);
    return static_cast<std::size_t>(std::min(this->Count - 1, sorter));
  }

private:
  std::uint64_t Least;
  double Span;
  int Count;
};

// A key at its sorter, and where it came from.
struct SortedKey
{
  std::int64_t Key;
  std::size_t Rank; // the rank that sent it
  std::size_t Number;
};

using Lists = std::vector<std::vector<std::int64_t>>; // a list for each rank

// The places, among the keys of all ranks, of those that each rank sent here: this rank's keys
// follow those of all lower sorters.
Lists placesOf(const Lists& keys, const Ranks& ranks, Progress& progress)
{
  std::vector<SortedKey> sorted;
  Lists places;
  for (std::size_t rank = 0; rank < keys.size(); ++rank)
  {
    for (std::size_t i = 0; i < keys[rank].size(); ++i)
    {
      sorted.push_back({ keys[rank][i], rank, i });
    }
    places.emplace_back(keys[rank].size());
  }
  sortByKey(sorted, progress);
  std::int64_t place = 0;
  const std::vector<std::size_t> counts = gatherValues(ranks, sorted.size());
  for (int rank = 0; rank < ranks.Own(); ++rank)
  {
    place += static_cast<std::int64_t>(counts[static_cast<std::size_t>(rank)]);
  }
  for (const SortedKey& key : sorted)
  {
    places[key.Rank][key.Number] = place++;
  }
  return places;
}

// The places of this rank's elements among those of all. Keys go to their sorters and places come
// back: two all-to-all exchanges.
std::vector<std::int64_t> locateKeys(
  std::int64_t count, const std::int64_t* keys, const Ranks& ranks, Progress& progress)
{
  const AllKeys all(count, keys, ranks);
  std::vector<std::int64_t> places(static_cast<std::size_t>(count));
  if (!all.HaveKeys)
  {
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      places[i] = all.Before + static_cast<std::int64_t>(i);
    }
    return places;
  }
  const Sorters sorters(all.Range, ranks.Count());
  Lists given(static_cast<std::size_t>(ranks.Count()));
  for (std::int64_t i = 0; i < count; ++i)
  {
    given[sorters.Of(keys[i])].push_back(keys[i]);
  }
  const Lists answers =
    exchangeValues(ranks, placesOf(exchangeValues(ranks, std::move(given)), ranks, progress));
  // Answers come in the order of the questions.
  std::vector<std::size_t> taken(answers.size());
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const std::size_t sorter = sorters.Of(keys[i]);
    places[i] = answers[sorter][taken[sorter]++];
  }
  return places;
}

} // namespace

// Elements in the order of their keys are divided into chunks of `grain`, and each rank receives
// the elements of its share of the chunks. The chunks, and hence sums by chunks, are the same for
// any number of ranks.
RankOrder::RankOrder(std::int64_t count, const std::int64_t* keys, std::int64_t grain,
  const Ranks& ranks, Progress& progress)
  : Group(ranks)
{
  const std::vector<std::int64_t> places = locateKeys(count, keys, ranks, progress);
  const std::int64_t all = sumOverRanks(ranks, count);
  const std::int64_t chunks = (all + grain - 1) / grain;
  // Ranks share whole chunks, nearly evenly.
  const RankShare share(chunks, ranks);
  const std::int64_t first = share.First * grain;
  this->ShareCount = std::min(all, first + share.Count * grain) - std::min(all, first);
  Lists given(static_cast<std::size_t>(ranks.Count()));
  this->Receiver.reserve(places.size());
  for (const std::int64_t place : places)
  {
    this->Receiver.push_back(RankShare::Of(place / grain, chunks, ranks.Count()));
    given[static_cast<std::size_t>(this->Receiver.back())].push_back(place);
  }
  // Where in its share this rank puts what it receives.
  // Every rank takes part in the exchange, also one without elements.
  this->Slots = exchangeValues(ranks, std::move(given));
  for (std::vector<std::int64_t>& slots : this->Slots)
  {
    for (std::int64_t& slot : slots)
    {
      slot -= first;
    }
  }
}

} // namespace RectifiedTransport
