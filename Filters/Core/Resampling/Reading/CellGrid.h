// SPDX-License-Identifier: BSD-3-Clause
// The grid for the density of cells.
#ifndef RectifiedTransport_CellGrid_h
#define RectifiedTransport_CellGrid_h

#include "Core/Geometry/ImageGrid.h"
#include "Core/Resampling/MassCells.h"

namespace RectifiedTransport
{

class Progress;

// Values on cells, `resolution` cells along the longest axis, as near to cubes as whole numbers
// allow. The axes are those of space, or axes in an oblique plane or line of cells. Throws
// Cancelled, and Failure for sets without cells of positive measure, for surfaces that are not
// plane, for lines that are not straight, for points of cells that are not finite, and for a
// resolution out of range.
ImageGrid gridOfCells(
  const CellSets& sets, const MassCells& mass, int resolution, Progress& progress);

} // namespace RectifiedTransport

#endif
