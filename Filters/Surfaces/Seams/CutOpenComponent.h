// SPDX-License-Identifier: BSD-3-Clause
// One component of a surface, cut open along short seams to a disk.
#ifndef RectifiedTransport_CutOpenComponent_h
#define RectifiedTransport_CutOpenComponent_h

#include "Surfaces/Seams/CutSurface.h"
#include "Surfaces/Seams/SeamMesh.h"

#include <cstdint>

namespace RectifiedTransport
{

class Progress;

// A component's triangles, cut along seams.
struct CutOpenDisk
{
  CutDisk Disk;
  SeamMesh::Cut Cut;
  double Distortion; // compared between cuts: of the conformal map, plus its collapsed triangles
};

// Sets the seams of a component that is no disk, and cuts it there. Its triangles from `given` on
// close holes. Seams grow up to `rounds` times to where the conformal map squeezes areas most.
// Throws as mapConformally does, std::bad_alloc and Cancelled.
CutOpenDisk cutComponent(SeamMesh& mesh, std::int64_t given, int rounds, Progress& progress);

} // namespace RectifiedTransport

#endif
