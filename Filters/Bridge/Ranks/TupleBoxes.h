// SPDX-License-Identifier: BSD-3-Clause
// Boxes of the tuples of an image's arrays, and their exchange between ranks.
#ifndef RectifiedTransport_TupleBoxes_h
#define RectifiedTransport_TupleBoxes_h

#include "Bridge/Ranks/CommonArrays.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Geometry/LatticePart.h"
#include "Core/Parallel/Ranks.h"

#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// The points of an image along its axes, as in vtkImageData; {0, -1, ...} for none.
using Extent = std::array<int, 6>;

inline bool isEmpty(const Extent& extent)
{
  return extent[0] > extent[1] || extent[2] > extent[3] || extent[4] > extent[5];
}
// {0, -1, ...} if they have none in common.
Extent intersectionOf(const Extent& a, const Extent& b);
// The pieces into which VTK divides an extent; points at their faces are in both.
std::vector<Extent> dividedExtent(const Extent& whole, int ranks);

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

// The tuples that each rank holds, and those that each wants. Tuples of several ranks come from the
// lowest one; tuples of none are left as they are.
class BoxExchange
{
public:
  // `held`: the boxes that all ranks hold; `wanted`: the box that this rank wants. Collective.
  BoxExchange(std::vector<TupleBox> held, const TupleBox& wanted, const Ranks& ranks);

  // Appends to the parts for the other ranks what they want of a contiguous array with the tuples
  // of the box `all`; nullptr for zeros of one byte.
  void Append(vtkDataArray* from, const TupleBox& all, std::vector<Bytes>& parts) const;
  // Reads what another rank sent, for an array with the tuples of the box `all`; returns where the
  // next array begins. Call it for the ranks in descending order, with CopyOwn for this rank, to an
  // array of the wanted tuples.
  const char* Take(const char* from, std::size_t rank, vtkDataArray* to, const TupleBox& all) const;
  void CopyOwn(vtkDataArray* from, const TupleBox& all, vtkDataArray* to) const;
  const TupleBox& OwnWanted() const { return this->Wanted[this->Own]; }
  bool IsOwn(std::size_t rank) const { return rank == this->Own; }

private:
  TupleBox PartOf(std::size_t rank, const TupleBox& wanted) const;

  const std::vector<TupleBox> Held;
  const std::vector<TupleBox> Wanted;
  const std::size_t Own;
};

// An array with the tuples of the box `All`, and one for the wanted tuples of an exchange.
struct BoxArrays
{
  const BoxExchange* Boxes;
  vtkSmartPointer<vtkDataArray> From; // nullptr for zeros of one byte
  TupleBox All;
  vtkSmartPointer<vtkDataArray> To;
};
// Exchanges several arrays together. Collective; every rank gives the same arrays.
void exchangeArrays(const std::vector<BoxArrays>& arrays, const Ranks& ranks);
// Exchanges one array with the tuples that this rank holds.
void exchangeBoxes(const std::vector<TupleBox>& held, const TupleBox& wanted, const Ranks& ranks,
  vtkDataArray* from, vtkDataArray* to);
// Within one array with the tuples of the box `all`: this rank has those that it holds and gets the
// wanted ones.
void completeBoxes(const std::vector<TupleBox>& held, const TupleBox& wanted, const TupleBox& all,
  const Ranks& ranks, vtkDataArray* array);

} // namespace RectifiedTransport::Bridge

#endif
