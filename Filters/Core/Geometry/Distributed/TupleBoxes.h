// SPDX-License-Identifier: BSD-3-Clause
// Extents of images, and boxes of the tuples of their arrays.
#ifndef RectifiedTransport_TupleBoxes_h
#define RectifiedTransport_TupleBoxes_h

#include "Core/Geometry/ImageGrid.h"
#include "Core/Geometry/LatticePart.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace RectifiedTransport
{

// The points of an image along its axes, as in vtkImageData; {0, -1, ...} for none.
using Extent = std::array<int, 6>;

constexpr Extent emptyExtent = { 0, -1, 0, -1, 0, -1 };

inline bool isEmpty(const Extent& extent)
{
  return extent[0] > extent[1] || extent[2] > extent[3] || extent[4] > extent[5];
}
// The empty extent if they have none in common.
Extent intersectionOf(const Extent& a, const Extent& b);

// With a layer of cells: where an extent is one layer of points along an axis of a whole one, it
// gets the layer next to it.
Extent withCells(const Extent& extent, const Extent& whole);
// "0 4 0 3 7 7".
std::string textOfExtent(const int* extent);
// Whether no axis ends before it begins, or has more points than VTK can count. The empty extent is
// readable.
bool isReadable(const int* extent);

// What tuples belong to, numbered as by vtkDataObject.
enum TupleOwner : int
{
  OfPoints,
  OfCells
};

// Tuples of an image along its axes, from those of index 0 on.
using TupleBox = LatticePart<3>;

// The tuples of the points or cells (`owner`) of an extent in a whole one. Along an axis without
// cells in the whole image, there is one layer of cells.
TupleBox tuplesOf(const Extent& extent, int owner, const Extent& whole);
// The extent whose tuples these are.
Extent extentOf(const TupleBox& box, int owner, const Extent& whole);
// The cells, or dual cells, of a grid that have the tuples of a box.
template <int D>
LatticePart<D> latticePartOf(const TupleBox& box, const ImageGrid& grid)
{
  LatticePart<D> part{ {}, {} };
  int axis = 0;
  for (std::size_t a = 0; a < 3 && !box.IsEmpty(); ++a)
  {
    if (grid.IsAxis(a))
    {
      part.Low[axis] = box.Low[a] - grid.Extent()[2 * a];
      part.Cells[axis] = box.Cells[a];
      ++axis;
    }
  }
  return part;
}
// Removes a box from what boxes cover.
void subtract(const TupleBox& box, std::vector<TupleBox>& from);
// "[0, 4] x [2, 2] x [0, 9]".
std::string describe(const TupleBox& box);

} // namespace RectifiedTransport

#endif
