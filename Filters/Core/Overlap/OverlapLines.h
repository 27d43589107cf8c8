// SPDX-License-Identifier: BSD-3-Clause
// The integrals of linear functions on tetrahedra over grid cells, along lines. For meshes whose
// tetrahedra are at least as large as grid cells; dividing them at all cells takes ten times as
// long.
#ifndef RectifiedTransport_OverlapLines_h
#define RectifiedTransport_OverlapLines_h

#include "Core/Overlap/Overlap.h"

namespace RectifiedTransport
{

// Whether the shadow along axis 0 is wider than half a grid cell, so that several lines cross it.
bool isWideAlongLines(const LinearSimplex<3>& simplex);

// Adds the integrals along 4 x 4 lines through each grid cell of the slab. They are exact along
// axis 0 and meet those of a neighbour at a shared face: the tetrahedra of a mesh leave neither
// gaps nor overlaps among themselves, but next to tetrahedra of addOverlaps they may.
void addAlongLines(const LinearSimplex<3>& simplex, const GridSlab<3>& slab);

} // namespace RectifiedTransport

#endif
