// SPDX-License-Identifier: BSD-3-Clause
// From physical space to the index space of a grid, as kernels take it.
#ifndef RectifiedTransport_IndexMap_h
#define RectifiedTransport_IndexMap_h

namespace RectifiedTransport
{

// What places a point x of physical space: coordinate a of index space is Matrix[a] . (x - Origin).
// In 1D and 2D the further rows give the distances from the line or plane of the grid, in any unit.
template <int Dimension>
struct IndexMap
{
  double Origin[3];
  double Matrix[3][3];
  // A point is outside if it is further than this from [0, size], or for the further rows from 0.
  double Tolerance[3];
};

} // namespace RectifiedTransport

#endif
