// SPDX-License-Identifier: BSD-3-Clause
// The seams that open a component of any topology to one disk.
#ifndef RectifiedTransport_CutGraph_h
#define RectifiedTransport_CutGraph_h

#include "Surfaces/Seams/SeamMesh.h"

namespace RectifiedTransport
{

class Progress;

// Sets seams of a component that is no disk, and has none yet. A sphere: a shortest path between
// two points far apart. Otherwise the edges that a spanning tree of the triangles does not cross,
// less those that lead nowhere; the tree crosses the edges that are farthest from the boundary, or
// from a first point, first (Erickson and Whittlesey 2005; Gu, Gortler and Hoppe 2002,
// doi:10.1145/566654.566589). Near-linear. Memory: 60 bytes a triangle, 60 a point. Throws
// std::bad_alloc and Cancelled.
void openToDisk(SeamMesh& mesh, Progress& progress);

// Makes the seams shorter one by one. The surface without one of its seams has two boundaries; a
// shortest path joins them again, which opens the surface as well. Throws std::bad_alloc and
// Cancelled.
void shortenSeams(SeamMesh& mesh, Progress& progress);

} // namespace RectifiedTransport

#endif
