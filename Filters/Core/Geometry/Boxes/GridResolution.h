// SPDX-License-Identifier: BSD-3-Clause
// Grids of given numbers of cells, the checks of these numbers, and sizes as text for messages.
#ifndef RectifiedTransport_GridResolution_h
#define RectifiedTransport_GridResolution_h

#include "Core/Geometry/ImageGrid.h"

#include <algorithm>
#include <cstdint>
#include <string>

namespace RectifiedTransport
{

// Throws Failure for a number of cells along an axis that is out of range.
void requireResolution(const char* property, int resolution);

// An axis-aligned box, {x0, x1, y0, y1, z0, z1}, as one cell. Sides shorter than a billionth of the
// longest one are no axes.
ImageGrid gridOfBox(const double (&bounds)[6]);

// Throws Failure for an image that has no axis, or whose cells have no measure.
void requireCells(const ImageGrid& grid);

// The grid with other numbers of values on the same domain; 0 keeps the number along an axis.
// Throws Failure, which names `property`.
ImageGrid gridWithValues(const ImageGrid& grid, const int values[3], const char* property);

// The grid on the same domain with `resolution` cells along its longest axis; the numbers along the
// others make the cells as near to cubes as possible. Throws Failure, which names `property`.
ImageGrid gridWithResolution(const ImageGrid& grid, int resolution, const char* property);

// How many cells `margin` times the longest axis takes along each axis of index space, rounded up.
// Throws Failure if the grid, grown by them on both sides of its axes, has too many cells.
GridSize<3> cellsOfMargin(const ImageGrid& grid, double margin);

// A double, because it may exceed every integer.
double numberOfValues(const ImageGrid& grid);
// "8 x 4", without the axes of one point.
std::string describeValues(const ImageGrid& grid);

// The size in three axes, with `cells` along those that are added.
template <int Dimension>
GridSize<3> inSpace(const GridSize<Dimension>& size, std::int64_t cells)
{
  GridSize<3> all;
  all.fill(cells);
  std::copy(size.begin(), size.end(), all.begin());
  return all;
}

// "8 x 4".
template <int D>
std::string describeSize(const GridSize<D>& size)
{
  std::string text;
  for (int a = 0; a < D; ++a)
  {
    text += (a == 0 ? "" : " x ") + std::to_string(size[a]);
  }
  return text;
}

} // namespace RectifiedTransport

#endif
