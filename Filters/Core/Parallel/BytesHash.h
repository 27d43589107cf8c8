// SPDX-License-Identifier: BSD-3-Clause
// Hashes of bytes, by which data are compared. They are not cryptographic.
#ifndef RectifiedTransport_BytesHash_h
#define RectifiedTransport_BytesHash_h

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace RectifiedTransport
{

struct ByteRange
{
  const unsigned char* First;
  std::int64_t Count;
};

inline std::uint64_t mixWord(std::uint64_t state, std::uint64_t word)
{
  constexpr std::uint64_t odd = 0x9e3779b97f4a7c15; // 2^64 over the golden ratio
  state = (state ^ word) * odd;
  return state ^ (state >> 32);
}

// Four independent lanes hide the latency of the multiplications.
inline std::uint64_t mixBytes(const ByteRange& bytes)
{
  constexpr std::int64_t lanes = 4;
  std::uint64_t words[lanes];
  std::uint64_t state[lanes] = { 1, 2, 3, 4 };
  std::int64_t at = 0;
  for (; at + std::int64_t{ sizeof(words) } <= bytes.Count; at += sizeof(words))
  {
    std::memcpy(words, bytes.First + at, sizeof(words));
    for (std::int64_t lane = 0; lane < lanes; ++lane)
    {
      state[lane] = mixWord(state[lane], words[lane]);
    }
  }
  std::uint64_t mixed = static_cast<std::uint64_t>(bytes.Count);
  for (const std::uint64_t lane : state)
  {
    mixed = mixWord(mixed, lane);
  }
  for (; at < bytes.Count; ++at)
  {
    mixed = mixWord(mixed, bytes.First[at]);
  }
  return mixed;
}

// A hash of all ranges in their order, never 0. Throws Cancelled.
inline std::uint64_t hashBytes(const std::vector<ByteRange>& ranges, Progress& progress)
{
  constexpr std::int64_t chunk = std::int64_t{ 1 } << 16;
  std::vector<ByteRange> pieces;
  for (const ByteRange& range : ranges)
  {
    for (std::int64_t begin = 0; begin < range.Count; begin += chunk)
    {
      pieces.push_back({ range.First + begin, std::min(chunk, range.Count - begin) });
    }
  }
  // One loop over all ranges, as they are one stage of the progress.
  std::vector<std::uint64_t> parts(pieces.size());
  const auto all = static_cast<std::int64_t>(pieces.size()) * chunk;
  progress.For(all, chunk, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first / chunk; i < last / chunk; ++i)
    {
      parts[static_cast<std::size_t>(i)] = mixBytes(pieces[static_cast<std::size_t>(i)]);
    }
  });
  const std::uint64_t mixed = mixBytes({ reinterpret_cast<const unsigned char*>(parts.data()),
    static_cast<std::int64_t>(parts.size() * sizeof(std::uint64_t)) });
  return mixed == 0 ? 1 : mixed;
}

// FNV-1a, of values that are added one by one.
class ValueHash
{
public:
  template <class Value>
  void Add(Value value)
  {
    unsigned char bytes[sizeof(Value)];
    std::memcpy(bytes, &value, sizeof(Value));
    for (const unsigned char byte : bytes)
    {
      this->State = (this->State ^ byte) * 0x100000001b3;
    }
  }
  std::uint64_t Mixed() const { return this->State; }

private:
  std::uint64_t State = 0xcbf29ce484222325;
};

} // namespace RectifiedTransport

#endif
