// SPDX-License-Identifier: BSD-3-Clause
// A point set that lies on several ranks, as one.
#ifndef RectifiedTransport_GatheredPoints_h
#define RectifiedTransport_GatheredPoints_h

#include "Bridge/Ranks/GatheredParts.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Ranks.h"

#include "vtkSmartPointer.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkPointSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// What counts of a point set: all of its points, or those of its cells.
enum class PointSetKind
{
  Points,
  Surface,
  Polygons // a surface whose points the caller merges
};

// The points and cells of rank 0 first, with the arrays that all have. What is the same on several
// ranks counts once, and duplicates that ghost arrays mark not at all; of Points those that
// countedPoints gives. Points of a Surface that several ranks have at one place become one, so that
// it is whole.
class GatheredPoints
{
public:
  // Called by all ranks; `own` may be nullptr. Throws Failure for types that differ, and
  // std::bad_alloc.
  GatheredPoints(vtkPointSet* own, const Ranks& ranks, Receivers receivers, PointSetKind kind);

  // nullptr where this rank is no receiver, or no rank has points.
  vtkPointSet* All() const { return this->Gathered; }

private:
  vtkSmartPointer<vtkPointSet> Gathered;
};

} // namespace RectifiedTransport

#endif
