// SPDX-License-Identifier: BSD-3-Clause
// How much more pairs of points cost than the bound of a solver's potentials allows for.
#ifndef RectifiedTransport_PairSlack_h
#define RectifiedTransport_PairSlack_h

#include "Core/OptimalMap/PotentialSolver.h"

namespace RectifiedTransport
{

class Progress;

// Of points in the index space of the source and images in that of the target, as many as points:
// |x - y|^2 / 2 less both potentials, which are interpolated. At least 0. Throws Cancelled.
template <int Dimension>
void findSlack(const PotentialSolver<Dimension>& solver, ConstPointSpan<Dimension> points,
  ConstPointSpan<Dimension> images, double* slack, Progress& progress);

} // namespace RectifiedTransport

#endif
