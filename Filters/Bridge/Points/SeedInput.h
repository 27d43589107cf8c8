// SPDX-License-Identifier: BSD-3-Clause
// Seeds that the user gives: points in physical space.
#ifndef RectifiedTransport_SeedInput_h
#define RectifiedTransport_SeedInput_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/Progress.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkPointSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

class CountedPoints;

// Writes the points of a set that are not ghosts in index space, clamped to the domain, in the
// order of their numbers; and all points in physical space (coordinates inside stay bitwise the
// same). Ghosts keep their coordinates. Returns how many were moved by more than a millionth of the
// domain's size, the error of single precision. Throws Failure for coordinates that are not finite,
// naming the input as `what`, and Cancelled.
template <int D>
std::int64_t readSeeds(vtkPointSet* points, const CountedPoints& counted, const std::string& what,
  const ImageGrid& grid, Progress& progress, PointSpan<D> indexSeeds, PointSpan<3> physicalSeeds);

} // namespace RectifiedTransport::Bridge

#endif
