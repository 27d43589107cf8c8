// SPDX-License-Identifier: BSD-3-Clause
// The affine map from physical space to the index space of a grid, in plain arrays for kernels.
#ifndef RectifiedTransport_IndexMap_h
#define RectifiedTransport_IndexMap_h

namespace RectifiedTransport
{

// Coordinate a in index space of a physical point x is Matrix[a] . (x - Origin). In 1D and 2D the
// other rows give the distances from the line or plane of the grid, in any unit.
template <int Dimension>
struct IndexMap
{
  double Origin[3];
  double Matrix[3][3];
  // A point farther than this from [0, size], or for the other rows from 0, is outside.
  double Tolerance[3];
};

} // namespace RectifiedTransport

#endif
