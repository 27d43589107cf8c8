// SPDX-License-Identifier: BSD-3-Clause
// One component of a surface, cut open along short seams to a disk.
#ifndef RectifiedTransport_CutOpenComponent_h
#define RectifiedTransport_CutOpenComponent_h

#include "Core/Geometry/Points.h"
#include "Core/Parallel/Context.h"
#include "Surfaces/Mesh/DiskMesh.h"
#include "Surfaces/Seams/CutSurface.h"
#include "Surfaces/Seams/SeamMesh.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

class Progress;

struct PeakLimits
{
  double Squeeze = 20.0;   // a point's share of the surface / its share of the square
  double Prominence = 4.0; // least quotient of a peak and the pass to a higher one
  double AreaShare = 2e-3; // least share of the surface that is squeezed so about a peak
};

struct DistortionPeak
{
  double Key; // minus the squeeze
  std::int64_t Point;
  double AreaShare; // share of the surface that is squeezed about it
};

// The inner points where areas are squeezed most, the worst first: peaks of the density of area in
// the square that are prominent, as the tips of fingers are. O(points log points). Memory: 60 bytes
// a point. Throws std::bad_alloc and Cancelled.
std::vector<DistortionPeak> findDistortionPeaks(const DiskMesh& disk,
  const std::vector<Point<2>>& positions, const PeakLimits& limits,
  const Context& context = Context());

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
