// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Parameterization/ParameterizationReport.h"

#include <sstream>

namespace RectifiedTransport
{

namespace
{

// A deviation of 95 % of the area that is worth a warning; the goal is 3 %.
constexpr double AcceptableDeviation = 0.05;

} // namespace

std::vector<std::string> ParameterizationReport::Warnings() const
{
  std::vector<std::string> warnings;
  if (!this->Repair.empty())
  {
    warnings.push_back(this->Repair);
  }
  const std::int64_t flipped = this->Distortion.Flipped;
  if (flipped > this->Collapsed || (this->Polish && this->Distortion.Area95 > AcceptableDeviation))
  {
    std::ostringstream text;
    text.precision(3);
    text << flipped << " of " << this->Triangles
         << " triangles are flipped and 95 % of the area is within "
         << 100.0 * this->Distortion.Area95 << " % of its share of the square; "
         << (!this->Polish ? "Polish is off"
                : this->IsCut
                ? "smaller triangles help"
                : "a longer boundary helps where the surface is nearly closed, smaller "
                  "triangles help elsewhere");
    const std::int64_t needles = this->Distortion.FlippedNeedles;
    if (needles > 0)
    {
      text << "; " << needles
           << (needles == 1 ? " of the flipped is a needle" : " of the flipped are needles")
           << ", lower than " << MapDistortion::NeedleHeight
           << " of the length: Clean with a Tolerance merges points so near to each other";
    }
    warnings.push_back(text.str());
  }
  if (this->Collapsed > 0)
  {
    warnings.push_back(collapsedWarning(this->Collapsed, this->Triangles, this->IsCut));
  }
  return warnings;
}

std::string collapsedWarning(std::int64_t collapsed, std::int64_t triangles, bool isCut)
{
  return std::to_string(collapsed) + " of " + std::to_string(triangles) +
    " triangles have all points on one side of the square and so no area there; subdivide the "
    "surface" +
    (isCut ? "" : ", or give Corners between these points");
}

} // namespace RectifiedTransport
