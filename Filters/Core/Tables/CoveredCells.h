// SPDX-License-Identifier: BSD-3-Clause
// The grid cells that a side of a box covers.
#ifndef RectifiedTransport_CoveredCells_h
#define RectifiedTransport_CoveredCells_h

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace RectifiedTransport
{

// The outer cells are covered in part.
struct CoveredCells
{
  CoveredCells(double low, double high, std::int64_t size)
    : Low(std::clamp(low, 0.0, static_cast<double>(size)))
    , High(std::clamp(high, 0.0, static_cast<double>(size)))
    , First(std::min(static_cast<std::int64_t>(this->Low), size - 1))
    , End(std::max(this->First + 1, static_cast<std::int64_t>(std::ceil(this->High))))
  {
  }
  double PartOf(std::int64_t cell) const
  {
    const auto from = static_cast<double>(cell);
    return std::max(0.0, std::min(this->High, from + 1.0) - std::max(this->Low, from));
  }

  const double Low;
  const double High;
  const std::int64_t First;
  const std::int64_t End;
};

} // namespace RectifiedTransport

#endif
