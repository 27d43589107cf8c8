// SPDX-License-Identifier: BSD-3-Clause
// What points are splat onto.
#ifndef RectifiedTransport_SplatTarget_h
#define RectifiedTransport_SplatTarget_h

#include "Core/Geometry/ImageGrid.h"
#include "Core/Splat/Splat.h"

namespace RectifiedTransport
{

// The grid and the options of a splat.
struct SplatTarget
{
  const ImageGrid& Geometry;
  SplatOptions Options;
  bool DivideByVolume; // densities, else masses

  // The factor of the masses.
  double Scale() const { return this->DivideByVolume ? 1.0 / this->Geometry.CellMeasure() : 1.0; }
};

} // namespace RectifiedTransport

#endif
