// SPDX-License-Identifier: BSD-3-Clause
// The integrals of linear functions on tetrahedra over grid cells, along lines: for meshes whose
// tetrahedra are as large as grid cells or larger, where dividing them at all of these takes ten
// times the time.
#ifndef RectifiedTransport_OverlapLines_h
#define RectifiedTransport_OverlapLines_h

#include "Core/Overlap/Overlap.h"

namespace RectifiedTransport
{

// Whether the shadow along axis 0 is wider than half a grid cell, so that several lines cross it.
bool isWideAlongLines(const LinearSimplex<3>& simplex);

// Adds the integrals along 4 x 4 lines through each grid cell of the slab. They are exact along
// axis 0, and meet those of a neighbour where it shares a face: what all tetrahedra of a mesh add
// has neither gaps nor overlaps, but not beside what addOverlaps adds.
void addAlongLines(const LinearSimplex<3>& simplex, const GridSlab<3>& slab);

} // namespace RectifiedTransport

#endif
