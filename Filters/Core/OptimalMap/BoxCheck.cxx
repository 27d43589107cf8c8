// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/BoxCheck.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

template <int Dimension>
void checkBox(const Point<Dimension>& low, const Point<Dimension>& high)
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double side = high[axis] - low[axis];
    if (!(side > 0.0 && std::isfinite(side * side)))
    {
      throw std::invalid_argument("the box of a density has a side of " + std::to_string(side) +
        ", it must be positive, with a finite square");
    }
  }
}

template <int Dimension>
void checkSides(const Point<Dimension>& sides)
{
  constexpr double most = 1e120;
  const auto [shortest, longest] = std::minmax_element(sides.begin(), sides.end());
  if (!(*longest <= most * *shortest))
  {
    std::ostringstream text;
    text << "The longest side of the domain is " << *longest / *shortest
         << " times the shortest one; an optimal map needs one that is at most " << most
         << " times as long";
    throw std::invalid_argument(text.str());
  }
}

template void checkBox<1>(const Point<1>&, const Point<1>&);
template void checkBox<2>(const Point<2>&, const Point<2>&);
template void checkBox<3>(const Point<3>&, const Point<3>&);
template void checkSides<1>(const Point<1>&);
template void checkSides<2>(const Point<2>&);
template void checkSides<3>(const Point<3>&);

} // namespace RectifiedTransport
