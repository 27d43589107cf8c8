// SPDX-License-Identifier: BSD-3-Clause
// The areas within closed lines, such as the countries of a map.
#ifndef RectifiedTransport_OutlinedRegions_h
#define RectifiedTransport_OutlinedRegions_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/Points.h"

#include "vtkRectifiedTransportModule.h" // for the export macro
#include "vtkType.h"

#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

struct Outline
{
  vtkIdType Cell;
  std::vector<vtkIdType> Points; // with the region on the left, seen against the normal
};

struct OutlinedRegions
{
  std::vector<std::vector<Outline>> Regions;
  Point<3> Normal; // of the plane of all outlines
};

// Lines that end where they begin are outlines. Those with the same cell data, global ids and
// arrays of VTK's own (vtk...) aside, are one region: an outline within an odd number of others of
// its region is a hole. Lines without area and ghost cells are left out. Exported for the plugin.
// Throws Failure for a ghost array of another length and cells with points that do not exist.
VTKRECTIFIEDTRANSPORT_EXPORT OutlinedRegions findOutlinedRegions(vtkPolyData* data);

} // namespace RectifiedTransport

#endif
