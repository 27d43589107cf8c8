// SPDX-License-Identifier: BSD-3-Clause
// The integrals of a linear function on a tetrahedron over grid cells, along lines: for tetrahedra
// of several grid cells, where dividing them at each of these takes ten times the time.
#ifndef RectifiedTransport_OverlapLines_h
#define RectifiedTransport_OverlapLines_h

#include "Core/Overlap/Overlap.h"

namespace RectifiedTransport
{

// Whether the shadow along axis 0 is wider than a grid cell, so that many lines cross it.
bool isWideAlongLines(const LinearSimplex<3>& simplex);

// Adds the integrals along 4 x 4 lines through each grid cell of the slab.
void addAlongLines(const LinearSimplex<3>& simplex, const GridSlab<3>& slab);

} // namespace RectifiedTransport

#endif
