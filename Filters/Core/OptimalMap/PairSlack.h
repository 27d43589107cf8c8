// SPDX-License-Identifier: BSD-3-Clause
// The slack of pairs of points in the constraint of the dual.
#ifndef RectifiedTransport_PairSlack_h
#define RectifiedTransport_PairSlack_h

#include "Core/OptimalMap/PotentialSolver.h"

namespace RectifiedTransport
{

class Progress;

// slack = |x - y|^2 / 2 - phi(x) - psi(y) for each pair of a point x, in the index space of the
// source, and an image y, in that of the target, as many as points. Potentials are interpolated
// multilinearly. It is at least 0, and 0 for pairs of an optimal plan. Throws Cancelled.
template <int Dimension>
void findSlack(const PotentialSolver<Dimension>& solver, ConstPointSpan<Dimension> points,
  ConstPointSpan<Dimension> images, double* slack, Progress& progress);

} // namespace RectifiedTransport

#endif
