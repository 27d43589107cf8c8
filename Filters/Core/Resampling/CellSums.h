// SPDX-License-Identifier: BSD-3-Clause
// The densities of data sets, resampled to a grid by exact overlap.
#ifndef RectifiedTransport_CellSums_h
#define RectifiedTransport_CellSums_h

#include "Core/Geometry/ImageGrid.h"
#include "Core/Resampling/CellPieces.h"
#include "Core/Resampling/CellValues.h"

#include <vector>

namespace RectifiedTransport
{

class Progress;

// Writes the mean over each cell of the grid, 0 outside the sets. Point values are linear on the
// simplices of a cell; a region has one value. Returns what all cells contain. Throws Cancelled.
CellSize resampleCells(
  const std::vector<CellValues>& sets, const ImageGrid& grid, Progress& progress, double* density);

// The integral of the densities, in cells of the grid. Throws Cancelled.
double integralOf(const std::vector<CellValues>& sets, const ImageGrid& grid, Progress& progress);

} // namespace RectifiedTransport

#endif
