// SPDX-License-Identifier: BSD-3-Clause
// A part of a whole as text.
#ifndef RectifiedTransport_PercentText_h
#define RectifiedTransport_PercentText_h

#include <sstream>
#include <string>

namespace RectifiedTransport
{

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

} // namespace RectifiedTransport

#endif
