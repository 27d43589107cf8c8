// SPDX-License-Identifier: BSD-3-Clause
// Points that several ranks have, as at the borders of a mesh whose cells are divided among them.
#ifndef RectifiedTransport_RepeatedPoints_h
#define RectifiedTransport_RepeatedPoints_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Ranks.h"

#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkPointSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class CountedPoints;

// For each counted point of this rank whether a lower rank counts it, too: one of its global id, or
// else one at the same place. Empty for points that no line, face or cell connects on any rank:
// these are particles, of which two may be at one place. Called by all ranks. Throws
// std::bad_alloc.
std::vector<unsigned char> repeatedPoints(
  vtkPointSet* own, const CountedPoints& counted, const Ranks& ranks);

} // namespace RectifiedTransport

#endif
