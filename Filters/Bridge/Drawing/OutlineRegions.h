// SPDX-License-Identifier: BSD-3-Clause
// The areas within closed lines, such as the countries of a map.
#ifndef RectifiedTransport_OutlineRegions_h
#define RectifiedTransport_OutlineRegions_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/PlaneFrame.h"

#include "vtkType.h"

#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

struct Outline
{
  vtkIdType Cell;
  std::vector<vtkIdType> Points; // the first one not again at the end
};

struct OutlineRegions
{
  std::vector<std::vector<Outline>> Regions;
  PlaneFrame Plane{ { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 } }; // the plane that all outlines lie in
};

// Lines that end where they begin are outlines. Those with the same cell data, global ids and
// arrays of VTK's own (vtk...) aside, are one region: what is inside an odd number of its outlines.
// Lines without area, with points that are not finite, and ghost cells are left out. Throws Failure
// for cell arrays with too few tuples, a ghost array of another length and cells with points that
// do not exist.
OutlineRegions findOutlineRegions(vtkPolyData* data);

} // namespace RectifiedTransport::Bridge

#endif
