// SPDX-License-Identifier: BSD-3-Clause
// One image for what lies between several.
#ifndef RectifiedTransport_CommonFrame_h
#define RectifiedTransport_CommonFrame_h

#include "Bridge/Image/ImageFrame.h"

#include <string>
#include <vector>

namespace RectifiedTransport
{

struct FramePart
{
  ImageFrame Frame; // not empty
  bool OnPoints;
  std::string Name; // as messages call it
};

// The smallest box that holds the domains of all parts, at the finest spacing along each axis
// (numbers of cells rounded up, the box grown at its upper end), or with `dimensions` values along
// an axis where that is not 0. Values are on points or cells as in the first part, and parts of
// one geometry have exactly that. Throws Failure for parts of different axes, planes or directions,
// and for dimensions that are out of range.
ImageFrame commonFrame(const std::vector<FramePart>& parts, const int dimensions[3]);

} // namespace RectifiedTransport

#endif
