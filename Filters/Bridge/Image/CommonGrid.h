// SPDX-License-Identifier: BSD-3-Clause
// One image for what lies between several.
#ifndef RectifiedTransport_CommonGrid_h
#define RectifiedTransport_CommonGrid_h

#include "Core/Geometry/ImageGrid.h"

#include <string>
#include <vector>

namespace RectifiedTransport
{

struct NamedGrid
{
  ImageGrid Grid;   // not empty
  std::string Name; // as messages call it
};

// The smallest box that holds the domains of all, at the finest spacing along each axis (numbers of
// cells rounded up, the box grown at its upper end), or with `dimensions` values along an axis
// where that is not 0. Values are on points or cells as in the first grid, and grids of one
// geometry have exactly that. Throws Failure for grids of different axes, planes or directions, and
// for dimensions that are out of range.
ImageGrid commonGrid(const std::vector<NamedGrid>& grids, const int dimensions[3]);

} // namespace RectifiedTransport

#endif
