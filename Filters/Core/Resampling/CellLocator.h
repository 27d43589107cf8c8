// SPDX-License-Identifier: BSD-3-Clause
// Where places lie among the points and cells of data sets.
#ifndef RectifiedTransport_CellLocator_h
#define RectifiedTransport_CellLocator_h

#include "Core/Geometry/Points.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Resampling/CellValues.h"
#include "Core/Resampling/RegionRows.h"

#include <vector>

namespace RectifiedTransport
{

class ImageGrid;
class Progress;

// A place is in the first cell that contains it, else in the nearest cell within a grid cell. It is
// linear between points on the simplices of the cell; in a region, between the outline to the left
// and to the right. `places` are physical, in grid cells that cells of the sets reach. Throws
// Cancelled.
LargeBuffer<MeshLocation> locateInCells(const std::vector<CellValues>& sets, const ImageGrid& grid,
  ConstPointSpan<3> places, Progress& progress);

} // namespace RectifiedTransport

#endif
