// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Cartogram/DistinctPlaces.h"

#include "Core/Mesh/MergePoints.h"

#include <cstddef>

namespace RectifiedTransport
{

DistinctPlaces::DistinctPlaces(const std::vector<Point<2>>& points, const Context& context)
  : PlaceOf(points.size())
{
  mergePoints(points, this->PlaceOf.data(), context);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const auto first = static_cast<std::size_t>(this->PlaceOf[i]);
    if (first == i)
    {
      this->PlaceOf[i] = static_cast<std::int64_t>(this->Found.size());
      this->Found.push_back(points[i]);
    }
    else
    {
      this->PlaceOf[i] = this->PlaceOf[first];
    }
  }
}

void DistinctPlaces::Move(const std::vector<Point<2>>& moved, std::vector<Point<2>>& points) const
{
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i] = moved[static_cast<std::size_t>(this->PlaceOf[i])];
  }
}

} // namespace RectifiedTransport
