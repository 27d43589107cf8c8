// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/CoincidentPoints.h"

#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace RectifiedTransport
{

namespace
{

// Hashes the bits of the coordinates. Adding 0 makes -0 the same as 0, as they are equal.
template <int Dimension>
std::uint64_t hash(const double* point)
{
  std::uint64_t mixed = 0;
  for (int i = 0; i < Dimension; ++i)
  {
    const double coordinate = point[i] + 0.0; // -0 is 0
    std::uint64_t bits = 0;
    std::memcpy(&bits, &coordinate, sizeof(bits));
    mixed = mixBits(mixed ^ bits);
  }
  return mixed;
}

} // namespace

template <int Dimension>
void mergePoints(ConstPointSpan<Dimension> points, std::int64_t* firsts, const Context& context)
{
  LargeBuffer<std::int64_t> memory(hashTableSize(points.size()));
  // O(1) a point: a slot of the table has the first point of a place.
  std::int64_t* table = memory.data(); // indices of points, -1 where it is free
  const auto mask = static_cast<std::uint64_t>(memory.size() - 1);
  constexpr std::int64_t grain = std::int64_t{ 1 } << 16;
  Progress progress(context);
  Stages stages(progress, { { "table", 1 }, { "points", 9 } });
  stages["table"].ForInOrder(memory.size(), grain, [table](std::int64_t first, std::int64_t last) {
    std::fill(table + first, table + last, std::int64_t{ -1 });
  });
  stages["points"].ForEachInOrder(
    points.size(), grain,
    [=](std::int64_t i) {
      const double* point = points[i];
      // Open addressing with linear probing; the load of at most 1/2 keeps probes short.
      std::uint64_t place = hash<Dimension>(point) & mask;
      while (table[place] >= 0 && !std::equal(point, point + Dimension, points[table[place]]))
      {
        place = (place + 1) & mask;
      }
      if (table[place] < 0)
      {
        table[place] = i;
      }
      firsts[i] = table[place];
    },
    grain);
}

template <int Dimension>
DistinctPoints<Dimension>::DistinctPoints(
  const std::vector<Point<Dimension>>& points, const Context& context)
  : PlaceOf(points.size())
{
  mergePoints<Dimension>(points, this->PlaceOf.data(), context);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    // mergePoints has written the first point of the place.
    const auto first = static_cast<std::size_t>(this->PlaceOf[i]);
    if (first == i)
    {
      this->PlaceOf[i] = static_cast<std::int64_t>(this->Found.size());
      this->Found.push_back(points[i]);
    }
    else
    {
      // The first point of the place has its number already, as it comes before.
      this->PlaceOf[i] = this->PlaceOf[first];
    }
  }
}

// Points of one place stay at one place.
template <int Dimension>
void DistinctPoints<Dimension>::Move(
  const std::vector<Point<Dimension>>& moved, std::vector<Point<Dimension>>& points) const
{
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i] = moved[static_cast<std::size_t>(this->PlaceOf[i])];
  }
}

template void mergePoints<3>(ConstPointSpan<3>, std::int64_t*, const Context&);
template class DistinctPoints<1>;
template class DistinctPoints<2>;
template class DistinctPoints<3>;

} // namespace RectifiedTransport
