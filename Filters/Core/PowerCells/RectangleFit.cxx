// SPDX-License-Identifier: BSD-3-Clause
#include "Core/PowerCells/RectangleFit.h"

#include <algorithm>
#include <limits>

namespace RectifiedTransport
{

RectangleFit::RectangleFit(ConstPointSpan<2> sites, const Point<2>& lengths)
  : Scale(std::numeric_limits<double>::infinity())
  , IsInside(true)
{
  constexpr double margin = 0.1; // fraction of the lengths, for both sides together
  for (std::size_t a = 0; a < 2; ++a)
  {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (std::int64_t i = 0; i < sites.size(); ++i)
    {
      low = std::min(low, sites[i][a]);
      high = std::max(high, sites[i][a]);
    }
    this->IsInside = this->IsInside && low >= 0.0 && high <= lengths[a];
    this->Middle[a] = low + 0.5 * (high - low);
    // A box of no width scales infinitely; then the other axis determines the scale.
    this->Scale = std::min(this->Scale, (1.0 - margin) * lengths[a] / (high - low));
  }
}

} // namespace RectifiedTransport
