// SPDX-License-Identifier: BSD-3-Clause
// The mean and the covariance of densities, and what they say of their distance.
#ifndef RectifiedTransport_DensityMoments_h
#define RectifiedTransport_DensityMoments_h

#include "../Parallel/Context.h"
#include "../Tables/Density.h"

#include <array>

namespace RectifiedTransport
{

// The moments of a density, divided by its mass, that is constant on its cells. Entries of axes
// beyond its dimension are 0.
struct DensityMoments
{
  std::array<double, 3> Mean{};                      // in lengths from the box's corner
  std::array<std::array<double, 3>, 3> Covariance{}; // in squared lengths
};

// Computes the moments of a density in this process, with a positive mass, on a box of these sides.
// Throws Cancelled.
template <int Dimension>
DensityMoments momentsOf(const DensityValues& density, const GridSize<Dimension>& cells,
  const Point<Dimension>& sides, const Context& context = Context());

// The squared W2 between the two Gaussians of these moments. No two measures with these moments are
// nearer: M. Gelbrich, "On a formula for the L2 Wasserstein metric between measures on Euclidean
// and Hilbert spaces", Mathematische Nachrichten 147, 1990, doi:10.1002/mana.19901470121. At least
// 0.
double leastSquaredDistance(const DensityMoments& a, const DensityMoments& b);

} // namespace RectifiedTransport

#endif
