// SPDX-License-Identifier: BSD-3-Clause
// How sites are scaled to fill a rectangle.
#ifndef RectifiedTransport_RectangleFit_h
#define RectifiedTransport_RectangleFit_h

#include "Core/Geometry/Points.h"

namespace RectifiedTransport
{

// Sites scaled by Scale about Middle, which becomes the centre of the rectangle [0, lengths], lie
// in the rectangle with a margin along each border. The scale is infinite if all sites are at one
// point.
struct RectangleFit
{
  RectangleFit(ConstPointSpan<2> sites, const Point<2>& lengths);

  Point<2> Middle;
  double Scale;
  bool IsInside; // all sites are in the rectangle as they are
};

} // namespace RectifiedTransport

#endif
