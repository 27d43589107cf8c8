// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Tables/Density.h"

#include <cmath>
#include <string>

namespace RectifiedTransport
{

namespace
{

std::string describe(const DensitySummary& summary)
{
  if (summary.NotFinite > 0)
  {
    return "the density has " + std::to_string(summary.NotFinite) +
      " values that are not finite, the first at index " + std::to_string(summary.FirstNotFinite);
  }
  if (summary.Negative > 0)
  {
    return "the density has " + std::to_string(summary.Negative) +
      " negative values, the first at index " + std::to_string(summary.FirstNegative);
  }
  if (std::isinf(summary.Total))
  {
    return "the density's total is past the largest double";
  }
  return "the density's total is zero";
}

} // namespace

InvalidDensity::InvalidDensity(const DensitySummary& summary)
  : std::runtime_error(describe(summary))
  , Found(summary)
{
}

} // namespace RectifiedTransport
