// SPDX-License-Identifier: BSD-3-Clause
// Text with numbers as short decimals, the same in every locale.
#ifndef RectifiedTransport_DecimalText_h
#define RectifiedTransport_DecimalText_h

#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <type_traits>

namespace RectifiedTransport
{

// Appends texts and characters as they are, and doubles rounded to 4 decimals without trailing
// zeros. A rounded double below 10^11 has at most 15 digits, and to_chars then gives just them: no
// shorter text reads as the same double.
template <class Part>
void appendPart(std::string& text, const Part& part)
{
  if constexpr (std::is_same_v<Part, double>)
  {
    constexpr double unit = 1e4;
    const double rounded = std::round(part * unit) / unit + 0.0; // without the sign of -0
    std::array<char, 320> digits; // as many as the largest double has
    char* const begin = digits.data();
    text.append(
      begin, std::to_chars(begin, begin + digits.size(), rounded, std::chars_format::fixed).ptr);
  }
  else
  {
    text += part;
  }
}

template <class... Parts>
void appendAll(std::string& text, const Parts&... parts)
{
  (appendPart(text, parts), ...);
}

} // namespace RectifiedTransport

#endif
