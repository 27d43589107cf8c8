// SPDX-License-Identifier: BSD-3-Clause
// The grid of the output that interpolates several images.
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
  std::string Name; // in messages
};

// The smallest box that contains all domains, at the finest spacing along each axis (numbers of
// cells rounded up, the box extended at its upper end), or with `dimensions` values along an axis
// where that is not 0. Values are point or cell data as in the first grid. For grids of equal
// geometry it is exactly that. Throws Failure for grids of different axes, planes or directions,
// and for dimensions out of range.
ImageGrid commonGrid(const std::vector<NamedGrid>& grids, const int dimensions[3]);

} // namespace RectifiedTransport

#endif
