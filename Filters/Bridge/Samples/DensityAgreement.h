// SPDX-License-Identifier: BSD-3-Clause
// What to say where particles are dense where a density is low.
#ifndef RectifiedTransport_DensityAgreement_h
#define RectifiedTransport_DensityAgreement_h

#include <sstream>
#include <string>

namespace RectifiedTransport::Bridge
{

// A warning for a correlation below 0, as of a stippling whose photograph is not inverted here;
// else empty.
inline std::string disagreementWarning(double correlation, bool isInverted)
{
  if (!(correlation < 0.0))
  {
    return {};
  }
  std::ostringstream text;
  text.precision(2);
  text << "The points are dense where the density is low (correlation " << correlation
       << "): if they were made from it, switch InvertDensity " << (isInverted ? "off" : "on")
       << ", as it was then, or choose the DensityArray of then";
  return text.str();
}

} // namespace RectifiedTransport::Bridge

#endif
