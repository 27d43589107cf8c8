// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Mesh/Repair/RepairText.h"

#include <sstream>

namespace RectifiedTransport
{

std::string repairWarning(const RepairCounts& counts)
{
  std::string text;
  const auto add = [&text](std::int64_t count, const char* what, const std::string& rest) {
    if (count > 0)
    {
      text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + what +
        (count == 1 ? "" : "s") + rest;
    }
  };
  add(counts.UnusedPoints, "point", " in no polygon left out");
  add(counts.FlatTriangles, "triangle", " without area left out");
  add(counts.MergedPoints, "point", " merged with others at their places");
  add(counts.Repeated, "repeated triangle", " left out");
  std::ostringstream closed;
  closed << " closed";
  if (counts.Gap > 0.0)
  {
    closed << " that gape by up to " << counts.Gap;
  }
  add(counts.TJunctions, "T-junction", closed.str());
  add(counts.PartedEdges, "edge", " of more than two triangles parted");
  return text.empty() ? text : "The input surface was repaired: " + text;
}

} // namespace RectifiedTransport
