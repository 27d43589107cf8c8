// SPDX-License-Identifier: BSD-3-Clause
// Sums over boxes directly from a density without tables.
#ifndef RectifiedTransport_DensityShare_h
#define RectifiedTransport_DensityShare_h

#include "Core/Tables/Density.h"

namespace RectifiedTransport
{

// The sum of the density over a box, clipped to the domain; reads all its cells.
template <int Dimension>
double densityIn(const DensitySource<Dimension>& density, const Point<Dimension>& low,
  const Point<Dimension>& high);

} // namespace RectifiedTransport

#endif
