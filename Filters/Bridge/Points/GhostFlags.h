// SPDX-License-Identifier: BSD-3-Clause
// Which points and cells of an input are ghosts: duplicates of another piece's, or blanked.
#ifndef RectifiedTransport_GhostFlags_h
#define RectifiedTransport_GhostFlags_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/LargeBuffer.h"

#include "vtkDataSetAttributes.h"

#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// The flags of points and cells that do not count.
constexpr unsigned char ghostPoint =
  vtkDataSetAttributes::DUPLICATEPOINT | vtkDataSetAttributes::HIDDENPOINT;
constexpr unsigned char ghostCell = vtkDataSetAttributes::DUPLICATECELL |
  vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::REFINEDCELL;

// The flags of the points or cells (vtkDataObject::POINT or CELL), one for each; nullptr where
// there are none. Throws Failure for a ghost array of another length; `what` names the input.
const unsigned char* ghostFlags(vtkDataSet* data, int owner, const char* what);

// The points of a set that are no ghosts, numbered anew, in their order.
class CountedPoints
{
public:
  // Throws Failure as above, and for memory that is not there.
  CountedPoints(vtkDataSet* points, const char* what);

  std::int64_t Count() const { return this->Number; }
  // The number of a point among those that count; -1 for a ghost.
  std::int64_t NumberOf(std::int64_t point) const
  {
    return this->Numbers.data() ? this->Numbers.data()[point] : point;
  }
  // The index of one that counts.
  std::int64_t Point(std::int64_t number) const
  {
    return this->Indices.data() ? this->Indices.data()[number] : number;
  }

private:
  std::int64_t Number;
  LargeBuffer<std::int64_t> Numbers; // none if there are no ghosts
  LargeBuffer<std::int64_t> Indices;
};

} // namespace RectifiedTransport

#endif
