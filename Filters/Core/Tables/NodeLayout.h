// SPDX-License-Identifier: BSD-3-Clause
// Where the nodes of a table lie in memory.
#ifndef RectifiedTransport_NodeLayout_h
#define RectifiedTransport_NodeLayout_h

#include "Core/Geometry/GridSize.h"

#include <cstdint>

namespace RectifiedTransport
{

// A box with at most this share of the mass counts as empty: the rounding of the sums.
constexpr double voidShare = 2e-15;

// Sets the strides, in doubles, for this number of nodes an axis. Returns the number of doubles.
template <int Dimension>
std::int64_t layOutNodes(const GridSize<Dimension>& nodes, std::int64_t (&stride)[Dimension]);

} // namespace RectifiedTransport

#endif
