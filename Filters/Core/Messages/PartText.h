// SPDX-License-Identifier: BSD-3-Clause
// A count and a part of a whole as text, and when the part is worth a warning.
#ifndef RectifiedTransport_PartText_h
#define RectifiedTransport_PartText_h

#include <cstdint>
#include <sstream>
#include <string>

namespace RectifiedTransport
{

// All digits of a count.
inline std::string describeCount(double count)
{
  std::ostringstream text;
  constexpr int allDigits = 17;
  text.precision(allDigits);
  text << count;
  return text.str();
}

// "0.41 %", "8.1 %", "810 %": never with an exponent.
inline std::string percentText(double part)
{
  const double percent = 100.0 * part;
  std::ostringstream text;
  text.setf(std::ios::fixed);
  text.precision(percent < 1.0 ? 2 : percent < 10.0 ? 1 : 0);
  text << percent << " %";
  return text.str();
}

// "12 of 8192 cells (0.146 %)".
inline std::string describePart(std::int64_t count, std::int64_t all, const char* what)
{
  std::ostringstream text;
  text.precision(3);
  text << count << " of " << all << ' ' << what << " ("
       << 100.0 * static_cast<double>(count) / static_cast<double>(all) << " %)";
  return text.str();
}

// Whether a count, or an area, of what was moved or left out is worth a warning. Less than one in a
// thousand is in the field data alone: hosts show a warning in a window of its own.
template <class Number>
bool isWorthWarning(Number part, Number all)
{
  return part > 0 && 1000 * part >= all;
}

} // namespace RectifiedTransport

#endif
