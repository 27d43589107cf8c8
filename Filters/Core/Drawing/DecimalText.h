// SPDX-License-Identifier: BSD-3-Clause
// Numbers as short decimal text, the same in every locale.
#ifndef RectifiedTransport_DecimalText_h
#define RectifiedTransport_DecimalText_h

#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace RectifiedTransport
{

// Appends a number rounded to decimals, without trailing zeros. The rounded number has at most 15
// digits, so that the shortest text that a double is read from again has no others.
inline void appendDecimal(std::string& text, double value, int decimals)
{
  std::array<char, 320> digits; // as many as the largest double has
  const double unit = std::pow(10.0, decimals);
  const double rounded = std::round(value * unit) / unit + 0.0; // without the sign of -0
  char* const begin = digits.data();
  text.append(
    begin, std::to_chars(begin, begin + digits.size(), rounded, std::chars_format::fixed).ptr);
}

} // namespace RectifiedTransport

#endif
