// SPDX-License-Identifier: BSD-3-Clause
// Counts as text for messages.
#ifndef RectifiedTransport_CountText_h
#define RectifiedTransport_CountText_h

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

} // namespace RectifiedTransport

#endif
