// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Mesh/MergePoints.h"

#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cstring>

namespace RectifiedTransport
{

namespace
{

// A power of two, for a load factor of at most 1/2.
std::int64_t tableSize(std::int64_t count)
{
  std::int64_t size = 2;
  while (size < 2 * count)
  {
    size *= 2;
  }
  return size;
}

std::uint64_t mix(std::uint64_t bits)
{
  bits ^= bits >> 32;
  bits *= 0xd6e8feb86659fd93u;
  bits ^= bits >> 32;
  bits *= 0xd6e8feb86659fd93u;
  return bits ^ bits >> 32;
}

std::uint64_t hash(const double* point)
{
  std::uint64_t mixed = 0;
  for (int i = 0; i < 3; ++i)
  {
    const double coordinate = point[i] + 0.0; // -0 is 0
    std::uint64_t bits = 0;
    std::memcpy(&bits, &coordinate, sizeof(bits));
    mixed = mix(mixed ^ bits);
  }
  return mixed;
}

} // namespace

void mergePoints(ConstPointSpan<3> points, std::int64_t* firsts, const Context& context)
{
  LargeBuffer<std::int64_t> memory(tableSize(points.size()));
  std::int64_t* table = memory.data(); // indices of points, -1 where it is free
  const auto mask = static_cast<std::uint64_t>(memory.size() - 1);
  constexpr std::int64_t grain = std::int64_t{ 1 } << 16;
  Progress progress(context);
  progress.BeginStage(0.1);
  progress.ForInOrder(memory.size(), grain, [table](std::int64_t first, std::int64_t last) {
    std::fill(table + first, table + last, std::int64_t{ -1 });
  });
  progress.BeginStage(1.0);
  progress.ForInOrder(
    points.size(), grain,
    [=](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i)
      {
        const double* point = points[i];
        std::uint64_t place = hash(point) & mask;
        while (table[place] >= 0 && !std::equal(point, point + 3, points[table[place]]))
        {
          place = (place + 1) & mask;
        }
        if (table[place] < 0)
        {
          table[place] = i;
        }
        firsts[i] = table[place];
      }
    },
    grain);
}

} // namespace RectifiedTransport
