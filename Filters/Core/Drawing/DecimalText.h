// SPDX-License-Identifier: BSD-3-Clause
// Numbers as short decimal text, the same in every locale.
#ifndef RectifiedTransport_DecimalText_h
#define RectifiedTransport_DecimalText_h

#include <cmath>
#include <cstdint>
#include <string>

namespace RectifiedTransport
{

// Appends a number below 10^12 with up to 6 decimals, without trailing zeros.
inline void appendDecimal(std::string& text, double value, int decimals)
{
  std::int64_t unit = 1;
  for (int i = 0; i < decimals; ++i)
  {
    unit *= 10;
  }
  std::int64_t rounded = std::llround(std::abs(value) * static_cast<double>(unit));
  if (value < 0.0 && rounded > 0)
  {
    text += '-';
  }
  text += std::to_string(rounded / unit);
  rounded %= unit;
  if (rounded > 0)
  {
    text += '.';
  }
  while (rounded > 0)
  {
    unit /= 10;
    text += static_cast<char>('0' + rounded / unit);
    rounded %= unit;
  }
}

} // namespace RectifiedTransport

#endif
