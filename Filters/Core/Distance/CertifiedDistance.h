// SPDX-License-Identifier: BSD-3-Clause
// W2 between two densities from below and above, by the potentials of OptimalMap.h.
#ifndef RectifiedTransport_CertifiedDistance_h
#define RectifiedTransport_CertifiedDistance_h

#include "../Parallel/Context.h"
#include "../Tables/Density.h"

namespace RectifiedTransport
{

// Bounds of the squared distance, in squared lengths. Both are certified, up to rounding.
struct SquaredBracket
{
  double Lower = 0.0;
  double Upper = 0.0;
};

// Brackets the squared W2 of two densities with the same number of cells, each divided by its mass,
// on a box of these sides. Takes one iteration on the finest nodes: the lower bound is then mostly
// within 1 % of the one after many iterations. Exchanging the densities changes both bounds by
// some of their errors. Throws InvalidDensity, std::invalid_argument (numbers of cells),
// std::bad_alloc and Cancelled.
template <int Dimension>
SquaredBracket bracketDistance(const DensitySource<Dimension>& a, const DensitySource<Dimension>& b,
  const Point<Dimension>& sides, const Context& context = Context());

// Returns the most bytes that bracketDistance takes.
template <int Dimension>
double memoryForBracket(const GridSize<Dimension>& cells);

} // namespace RectifiedTransport

#endif
