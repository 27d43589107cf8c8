// SPDX-License-Identifier: BSD-3-Clause
// The mean squared displacement of particles on all ranks: the cost of their transport.
#ifndef RectifiedTransport_MeanSquare_h
#define RectifiedTransport_MeanSquare_h

#include "Core/Geometry/LengthScale.h"
#include "Core/Geometry/Points.h"

namespace RectifiedTransport
{

class Progress;

// The mean of |to - from|^2, in physical units, over particles of all ranks, by their parts
// masses[i] / all; for null, over `all` particles of equal masses. Collective. Throws
// std::overflow_error and Cancelled.
double meanSquare(const LengthScale& scale, ConstPointSpan<3> from, ConstPointSpan<3> to,
  const double* masses, double all, Progress& progress);

} // namespace RectifiedTransport

#endif
