// SPDX-License-Identifier: BSD-3-Clause
// W2 between two densities from below and above, by the potentials of OptimalMap.h.
#ifndef RectifiedTransport_CertifiedDistance_h
#define RectifiedTransport_CertifiedDistance_h

#include "../Parallel/Context.h"
#include "../Tables/Density.h"

namespace RectifiedTransport
{

// Of the squared distance, in squared lengths. Both are certified, up to rounding.
struct SquaredBracket
{
  double Lower = 0.0;
  double Upper = 0.0;
};

// Of two densities with the same number of cells, each divided by its mass, that fill a box of
// these sides. Takes one iteration on the finest nodes: the lower bound is then mostly within 1 %
// of that of many. Exchanging the densities changes both by some of their errors. Throws
// InvalidDensity, std::invalid_argument (numbers of cells), std::bad_alloc and Cancelled.
template <int Dimension>
SquaredBracket bracketDistance(const DensitySource<Dimension>& a, const DensitySource<Dimension>& b,
  const Point<Dimension>& sides, const Context& context = Context());

// The most bytes that it takes.
template <int Dimension>
double memoryForBracket(const GridSize<Dimension>& cells);

} // namespace RectifiedTransport

#endif
