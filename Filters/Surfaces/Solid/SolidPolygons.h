// SPDX-License-Identifier: BSD-3-Clause
// The polygons and strips of a closed surface.
#ifndef RectifiedTransport_SolidPolygons_h
#define RectifiedTransport_SolidPolygons_h

namespace RectifiedTransport
{

class ClosedMesh;
class Progress;
struct PolygonSource;

// Reserves memory in a mesh and adds the triangles of all, as PolygonCutter::CutThin cuts. Drops
// consecutive corners at the same point, as at the poles of a sphere of quads, and polygons with
// fewer than three corners left. Polygons of more than four corners follow the others. Throws
// std::bad_alloc and Cancelled.
void addPolygons(const PolygonSource& source, ClosedMesh& mesh, Progress& progress);

} // namespace RectifiedTransport

#endif
