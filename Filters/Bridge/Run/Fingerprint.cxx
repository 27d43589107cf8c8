// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/Fingerprint.h"

#include "Core/Parallel/Progress.h"

#include "vtkDataArray.h"
#include "vtkType.h"

#include <algorithm>
#include <cstring>

namespace RectifiedTransport::Bridge
{

namespace
{

// Not cryptographic. Four independent lanes hide the latency of the multiplications.
std::uint64_t mixBytes(const unsigned char* bytes, std::int64_t count)
{
  constexpr std::uint64_t odd = 0x9e3779b97f4a7c15; // 2^64 over the golden ratio
  const auto mix = [](std::uint64_t state, std::uint64_t word) {
    state = (state ^ word) * odd;
    return state ^ (state >> 32);
  };
  constexpr std::int64_t lanes = 4;
  std::uint64_t words[lanes];
  std::uint64_t state[lanes] = { 1, 2, 3, 4 };
  std::int64_t at = 0;
  for (; at + std::int64_t{ sizeof(words) } <= count; at += sizeof(words))
  {
    std::memcpy(words, bytes + at, sizeof(words));
    for (std::int64_t lane = 0; lane < lanes; ++lane)
    {
      state[lane] = mix(state[lane], words[lane]);
    }
  }
  std::uint64_t mixed = static_cast<std::uint64_t>(count);
  for (const std::uint64_t lane : state)
  {
    mixed = mix(mixed, lane);
  }
  for (; at < count; ++at)
  {
    mixed = mix(mixed, bytes[at]);
  }
  return mixed;
}

// The number of bytes of the values; -1 if they are not contiguous in memory. The unused bits of a
// bit array count: at worst equal arrays differ.
std::int64_t bytesOf(vtkDataArray* array)
{
  constexpr std::int64_t bitsAByte = 8;
  const std::int64_t values = array->GetNumberOfValues();
  if (array->GetDataType() == VTK_BIT) // whose GetDataTypeSize() is 0
  {
    return (values + bitsAByte - 1) / bitsAByte;
  }
  const int size = array->GetDataTypeSize();
  return array->HasStandardMemoryLayout() && size > 0 ? values * size : -1;
}

} // namespace

std::uint64_t fingerprint(const std::vector<vtkDataArray*>& arrays, Progress& progress)
{
  constexpr std::int64_t chunk = std::int64_t{ 1 } << 16;
  struct Piece
  {
    const unsigned char* Bytes;
    std::int64_t Count;
  };
  std::vector<Piece> pieces;
  for (vtkDataArray* array : arrays)
  {
    if (!array)
    {
      continue;
    }
    const std::int64_t count = bytesOf(array);
    if (count < 0)
    {
      return 0;
    }
    const auto* bytes = static_cast<const unsigned char*>(array->GetVoidPointer(0));
    for (std::int64_t begin = 0; begin < count; begin += chunk)
    {
      pieces.push_back({ bytes + begin, std::min(chunk, count - begin) });
    }
  }
  // One loop over all arrays, as they are one stage of the progress.
  std::vector<std::uint64_t> parts(pieces.size());
  const auto all = static_cast<std::int64_t>(pieces.size()) * chunk;
  progress.For(all, chunk, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first / chunk; i < last / chunk; ++i)
    {
      const Piece& piece = pieces[static_cast<std::size_t>(i)];
      parts[static_cast<std::size_t>(i)] = mixBytes(piece.Bytes, piece.Count);
    }
  });
  const std::uint64_t mixed = mixBytes(reinterpret_cast<const unsigned char*>(parts.data()),
    static_cast<std::int64_t>(parts.size() * sizeof(std::uint64_t)));
  return mixed == 0 ? 1 : mixed;
}

} // namespace RectifiedTransport::Bridge
