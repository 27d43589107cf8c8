// SPDX-License-Identifier: BSD-3-Clause
// The bounds of some points and the largest of a number that each has. For kernels, too: without
// functions.
#ifndef RectifiedTransport_BlockBounds_h
#define RectifiedTransport_BlockBounds_h

namespace RectifiedTransport
{

template <int Dimension>
struct BlockBounds
{
  double Low[Dimension];
  double High[Dimension];
  double Largest; // such as how far a point reaches
};

} // namespace RectifiedTransport

#endif
