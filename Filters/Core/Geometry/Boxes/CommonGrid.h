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

enum class MostCells
{
  Any,
  OfTheLargest // as many as the grid with most cells has
};

// The smallest box that contains all domains, at the finest spacing along each axis, or at the
// least multiple of it that leaves no more cells than the limit: numbers of cells are rounded up,
// the box grows at its upper end. If `dimensions` is not 0 along an axis, it gives the number of
// values there. Association and directions are those of the first grid. For grids of equal
// geometry, up to the rounding of single precision, it is exactly the first grid.
// Throws Failure for grids of different axes or planes, for directions that differ by more than
// 1e-6 in an element, and for dimensions out of range.
ImageGrid commonGrid(const std::vector<NamedGrid>& grids, const int dimensions[3], MostCells limit);

// Whether two grids along the same axes have the same cells, up to the rounding of single
// precision.
bool haveSameCells(const ImageGrid& a, const ImageGrid& b);

// Throws Failure unless a grid covers the box of another one, up to the rounding of single
// precision, along the same axes in the same directions. Their numbers of cells may differ.
void requireSameBox(const NamedGrid& first, const NamedGrid& other);

} // namespace RectifiedTransport

#endif
