// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/GatheredParts.h"

#include "Bridge/Ranks/DataSetBytes.h"
#include "Bridge/Run/SampledFingerprint.h"
#include "Core/Parallel/RankExchange.h"

#include "vtkDataSet.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace RectifiedTransport
{

namespace
{

struct Key
{
  std::int64_t Number;
  std::uint64_t Fingerprint;

  bool operator==(const Key& other) const
  {
    return this->Number == other.Number && this->Fingerprint == other.Fingerprint;
  }
};

using Keys = std::vector<Key>; // of the parts of a rank

// Whether a part is one that no lower rank has.
bool isFirst(const std::vector<Keys>& all, std::size_t rank, const Key& key)
{
  return std::none_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(rank),
    [&](const Keys& lower) { return std::find(lower.begin(), lower.end(), key) != lower.end(); });
}

void append(const DataPart& part, Bytes& to)
{
  const Bytes data = bytesOfDataSet(part.Data);
  const std::uint64_t lengths[2] = { part.Name.size(), data.size() };
  const Bytes head = toBytes(lengths, 2);
  to.insert(to.end(), head.begin(), head.end());
  to.insert(to.end(), part.Name.begin(), part.Name.end());
  to.insert(to.end(), data.begin(), data.end());
}

std::vector<DataPart> partsFrom(const Bytes& bytes)
{
  std::vector<DataPart> parts;
  for (const char* at = bytes.data(); at != bytes.data() + bytes.size();)
  {
    constexpr std::size_t head = 2 * sizeof(std::uint64_t);
    const auto lengths = fromBytes<std::uint64_t>(Bytes(at, at + head));
    at += head;
    DataPart part;
    part.Name.assign(at, at + lengths[0]);
    at += lengths[0];
    part.Data = dataSetOfBytes(at, lengths[1]);
    at += lengths[1];
    parts.push_back(std::move(part));
  }
  return parts;
}

// Sends the parts of this rank that count.
std::vector<Bytes> exchange(Bytes own, const Ranks& ranks, Receivers receivers)
{
  if (receivers == Receivers::All)
  {
    return ranks.Gather(own);
  }
  std::vector<Bytes> parts(static_cast<std::size_t>(ranks.Count()));
  parts.front() = std::move(own);
  return ranks.Exchange(std::move(parts));
}

} // namespace

GatheredParts gatherDataParts(
  const std::vector<DataPart>& own, const Ranks& ranks, Receivers receivers)
{
  Keys keys;
  for (const DataPart& part : own)
  {
    keys.push_back({ part.Number, sampledFingerprint({ part.Data.Get() }) });
  }
  std::vector<Keys> all;
  for (const Bytes& bytes : ranks.Gather(toBytes(keys)))
  {
    all.push_back(fromBytes<Key>(bytes));
  }
  const auto self = static_cast<std::size_t>(ranks.Own());
  GatheredParts gathered;
  const bool receives = receivers == Receivers::All || self == 0;
  gathered.AreWhole =
    std::all_of(all.begin(), all.end(), [&](const Keys& keysThere) { return keysThere == all[0]; });
  if (gathered.AreWhole)
  {
    gathered.Parts = receives ? own : std::vector<DataPart>();
    return gathered;
  }
  Bytes sent;
  for (std::size_t i = 0; i < own.size() && (self > 0 || receivers == Receivers::All); ++i)
  {
    if (isFirst(all, self, keys[i]))
    {
      append(own[i], sent);
    }
  }
  std::vector<Bytes> received = exchange(std::move(sent), ranks, receivers);
  for (std::size_t rank = 0; rank < received.size() && receives; ++rank)
  {
    std::vector<DataPart> parts = rank == self ? own : partsFrom(received[rank]);
    received[rank] = Bytes();
    std::size_t next = 0;
    for (std::size_t i = 0; i < all[rank].size(); ++i)
    {
      if (isFirst(all, rank, all[rank][i]))
      {
        DataPart& part = parts[rank == self ? i : next++];
        part.Number = all[rank][i].Number;
        gathered.Parts.push_back(part);
      }
    }
  }
  std::stable_sort(gathered.Parts.begin(), gathered.Parts.end(),
    [](const DataPart& a, const DataPart& b) { return a.Number < b.Number; });
  return gathered;
}

} // namespace RectifiedTransport
