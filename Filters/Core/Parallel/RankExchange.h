// SPDX-License-Identifier: BSD-3-Clause
// Exchanges of values between ranks. All are collective.
#ifndef RectifiedTransport_RankExchange_h
#define RectifiedTransport_RankExchange_h

#include "Core/Parallel/Ranks.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

template <class T>
Bytes toBytes(const T* values, std::size_t count)
{
  static_assert(std::is_trivially_copyable_v<T>, "bytes are all there is of it");
  Bytes bytes(count * sizeof(T));
  if (count > 0)
  {
    std::memcpy(bytes.data(), values, bytes.size());
  }
  return bytes;
}

template <class T>
Bytes toBytes(const std::vector<T>& values)
{
  return toBytes(values.data(), values.size());
}

template <class T>
std::vector<T> fromBytes(const Bytes& bytes)
{
  static_assert(std::is_trivially_copyable_v<T>, "bytes are all there is of it");
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!values.empty())
  {
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  }
  return values;
}

// One value from each rank, in their order.
template <class T>
std::vector<T> gatherValues(const Ranks& ranks, const T& own)
{
  std::vector<T> values;
  for (const Bytes& bytes : ranks.Gather(toBytes(&own, 1)))
  {
    values.push_back(fromBytes<T>(bytes).front());
  }
  return values;
}

// One text from each rank, in their order.
inline std::vector<std::string> gatherTexts(const Ranks& ranks, const std::string& own)
{
  std::vector<std::string> texts;
  for (const Bytes& bytes : ranks.Gather(Bytes(own.begin(), own.end())))
  {
    texts.emplace_back(bytes.begin(), bytes.end());
  }
  return texts;
}

// How many ranks before this one run on a machine of the same name.
inline int placeOnMachine(const Ranks& ranks, const std::string& machine)
{
  const std::vector<std::string> all = gatherTexts(ranks, machine);
  return static_cast<int>(std::count(all.begin(), all.begin() + ranks.Own(), machine));
}

// Sends values to each rank, including this one, and returns those that each sent here.
template <class T>
std::vector<std::vector<T>> exchangeValues(const Ranks& ranks, std::vector<std::vector<T>> given)
{
  std::vector<Bytes> parts;
  for (std::vector<T>& values : given)
  {
    parts.push_back(toBytes(values));
    values = {};
  }
  std::vector<std::vector<T>> received;
  for (Bytes& bytes : ranks.Exchange(std::move(parts)))
  {
    received.push_back(fromBytes<T>(bytes));
    bytes = {};
  }
  return received;
}

// How many values each rank may send at a time, so that none receives more than 16 MB.
template <class T>
std::int64_t valuesAtOnce(const Ranks& ranks)
{
  constexpr std::int64_t bytes = std::int64_t{ 1 } << 24;
  return std::max<std::int64_t>(1, bytes / (ranks.Count() * static_cast<std::int64_t>(sizeof(T))));
}

// Sends the values valueOf(i) of [0, count) to the ranks rankOf(i), in messages of bounded size,
// and calls take(rank, value) for those that arrive here, in the order of each sender.
template <class RankOf, class ValueOf, class Take>
void exchangeInRounds(const Ranks& ranks, std::int64_t count, const RankOf& rankOf,
  const ValueOf& valueOf, const Take& take)
{
  using T = std::decay_t<decltype(valueOf(count))>;
  const std::int64_t most = valuesAtOnce<T>(ranks);
  const std::vector<std::int64_t> counts = gatherValues(ranks, count);
  const std::int64_t longest = *std::max_element(counts.begin(), counts.end());
  for (std::int64_t done = 0; done < longest; done += most)
  {
    std::vector<std::vector<T>> given(counts.size());
    for (std::int64_t i = done; i < std::min(done + most, count); ++i)
    {
      given[static_cast<std::size_t>(rankOf(i))].push_back(valueOf(i));
    }
    const std::vector<std::vector<T>> received = exchangeValues(ranks, std::move(given));
    for (std::size_t rank = 0; rank < received.size(); ++rank)
    {
      for (const T& value : received[rank])
      {
        take(rank, value);
      }
    }
  }
}

// The sum over all ranks, of integers or exact sums.
template <class Sum>
Sum sumOverRanks(const Ranks& ranks, const Sum& own)
{
  Sum all{};
  for (const Sum& part : gatherValues(ranks, own))
  {
    if constexpr (std::is_arithmetic_v<Sum>)
    {
      static_assert(std::is_integral_v<Sum>, "sums of doubles depend on their order");
      all += part;
    }
    else
    {
      all.Add(part);
    }
  }
  return all;
}

// Whether a condition holds on all ranks.
inline bool onAllRanks(const Ranks& ranks, bool condition)
{
  return sumOverRanks<std::int64_t>(ranks, condition ? 0 : 1) == 0;
}

// Gathers on all ranks one array of which rank r has the part [starts[r], starts[r + 1]), in
// messages of bounded size.
template <class T>
void gatherParts(const Ranks& ranks, const std::vector<std::int64_t>& starts, T* all)
{
  if (!ranks.AreSeveral())
  {
    return;
  }
  const std::int64_t most = valuesAtOnce<T>(ranks);
  std::int64_t longest = 0;
  for (std::size_t rank = 0; rank + 1 < starts.size(); ++rank)
  {
    longest = std::max(longest, starts[rank + 1] - starts[rank]);
  }
  const auto own = static_cast<std::size_t>(ranks.Own());
  for (std::int64_t done = 0; done < longest; done += most)
  {
    const std::int64_t count =
      std::clamp<std::int64_t>(starts[own + 1] - starts[own] - done, 0, most);
    const std::vector<Bytes> parts =
      ranks.Gather(toBytes(all + starts[own] + done, static_cast<std::size_t>(count)));
    for (std::size_t rank = 0; rank < parts.size(); ++rank)
    {
      if (rank != own && !parts[rank].empty())
      {
        std::memcpy(all + starts[rank] + done, parts[rank].data(), parts[rank].size());
      }
    }
  }
}

} // namespace RectifiedTransport

#endif
