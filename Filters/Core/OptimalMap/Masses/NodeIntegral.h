// SPDX-License-Identifier: BSD-3-Clause
// Integrals of functions that are given at nodes.
#ifndef RectifiedTransport_NodeIntegral_h
#define RectifiedTransport_NodeIntegral_h

#include "Core/Grid/NodeGrid.h"
#include "Core/OptimalMap/Masses/CellDensity.h"
#include "Core/OptimalMap/Masses/NodeMasses.h"

namespace RectifiedTransport
{

class Progress;

// The integral over a density of the multilinear interpolant of values at nodes: the sum of the
// products of these and hatMasses, which needs no memory for the nodes. The same bits for every
// number of threads. Throws std::bad_alloc and Cancelled.
template <int Dimension>
double integrateOver(const CellDensity<Dimension>& density,
  const CellPlacement<Dimension>& placement, const NodeGrid<Dimension>& grid, const double* values,
  Progress& progress);

} // namespace RectifiedTransport

#endif
