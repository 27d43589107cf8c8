// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Solid/MergePoints.h"

#include <algorithm>
#include <cstring>

namespace RectifiedTransport
{

namespace
{

// A power of two, at most half full.
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

} // namespace

MergePoints::MergePoints(const double* points, std::int64_t count)
  : Points(points)
  , Firsts(count)
  , Table(tableSize(count))
  , Mask(static_cast<std::uint64_t>(this->Table.size() - 1))
{
  std::fill_n(this->Table.data(), this->Table.size(), std::int64_t{ -1 });
}

std::uint64_t MergePoints::PlaceOf(const double* point) const
{
  std::uint64_t place = 0;
  for (int i = 0; i < 3; ++i)
  {
    const double coordinate = point[i] + 0.0; // -0 is 0
    std::uint64_t bits;
    std::memcpy(&bits, &coordinate, sizeof(bits));
    place = mix(place ^ bits);
  }
  return place & this->Mask;
}

void MergePoints::Enter(std::int64_t first, std::int64_t last)
{
  std::int64_t* table = this->Table.data();
  for (std::int64_t i = first; i < last; ++i)
  {
    const double* point = this->Points + 3 * i;
    std::uint64_t place = this->PlaceOf(point);
    while (table[place] >= 0 && !std::equal(point, point + 3, this->Points + 3 * table[place]))
    {
      place = (place + 1) & this->Mask;
    }
    if (table[place] < 0)
    {
      table[place] = i;
    }
    this->Firsts.data()[i] = table[place];
  }
}

} // namespace RectifiedTransport
