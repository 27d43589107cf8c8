// SPDX-License-Identifier: BSD-3-Clause
// Values at nodes on other nodes of the same box.
#ifndef RectifiedTransport_Prolongation_h
#define RectifiedTransport_Prolongation_h

#include "Core/Grid/NodeGrid.h"

namespace RectifiedTransport
{

class Progress;

// The multilinear interpolant at the nodes of another grid. Throws std::bad_alloc and Cancelled.
template <int Dimension>
NodeValues prolong(const NodeValues& values, const GridSize<Dimension>& from,
  const GridSize<Dimension>& to, Progress& progress);

} // namespace RectifiedTransport

#endif
