// SPDX-License-Identifier: BSD-3-Clause
// Iterative blue noise for a density (paper, Section 5.1, "Accelerating existing methods with fast
// initialization"): two methods that improve any start, best that of the flow.
//
//   std::vector<Point<2>> particles = transportPoints<2>(density, seeds);
//   const RelaxationReport report = relaxByTransport(density, { 1.0, 1.0 }, particles);
#ifndef RectifiedTransport_BlueNoiseRelaxation_h
#define RectifiedTransport_BlueNoiseRelaxation_h

#include "../Flow/RectifiedFlow.h"
#include "../Geometry/Points.h"
#include "../Parallel/Context.h"
#include "../Tables/Density.h"

#include <stdexcept>
#include <vector>

namespace RectifiedTransport
{

struct RelaxationOptions
{
  int MaximumIterations = 50; // 0 and more
  // Ends after an iteration that lowers the energy by at most this part of it; 0: where none does.
  double Tolerance = 0.0;
};

struct RelaxationReport
{
  // That of the points as they were given, then that after each iteration: never more than before.
  std::vector<double> Energy;
};

// Points for which no cells of equal masses were found.
class NoEqualMasses : public std::runtime_error
{
public:
  NoEqualMasses();
};

// Points are in index space, where grid cell i is [i, i + 1], and `spacing` has the lengths of a
// grid cell's sides. Points outside the domain are moved to its border first, and of coincident
// points all but one by a small part of the mean spacing. The results have the same bits for any
// number of threads. Throws InvalidDensity, std::invalid_argument (options, spacing),
// std::bad_alloc and Cancelled; the points are then undefined.

// Gaussian blue noise (Ahmed, Ren and Wonka, "Gaussian Blue Noise", ACM TOG 41(6), 2022): points
// repel each other by Gaussians as wide as their distance at the local density, and the density
// attracts them, so that its mass and theirs cancel. `flow` has the tables of `density`. 2D and 3D.
// The energy is the squared norm of the difference of both, blurred: 1 on the average for
// independent random points of the density, near 0 at best. Points that are far from distributed
// like the density, such as uniform ones for one with large holes, take many iterations, and n
// points in a spot the time of n^2 for each: start from those of the flow. Also throws
// std::invalid_argument for points that are not finite.
template <int Dimension>
RelaxationReport relaxByRepulsion(const DensitySource<Dimension>& density,
  const RectifiedFlow<Dimension>& flow, const Point<Dimension>& spacing,
  PointSpan<Dimension> points, const RelaxationOptions& options = {},
  const Context& context = Context());

// Blue noise through optimal transport (de Goes, Breeden, Ostromoukhov and Desbrun, "Blue Noise
// through Optimal Transport", ACM TOG 31(6), 2012): the weights of a power diagram that give all
// points equal masses, then the points to the centroids of their cells. The energy is
// N / (M A) times the integral of density * |x - point of x|^2 over the cells, for N points, the
// density's mass M and the domain's area A. Masses are equal to 1e-6 of each other. Points that an
// iteration moves stay where the density has mass, at the nearest place to where they should go;
// those that begin where it has none leave as soon as that does not raise the energy. Points far
// from distributed like a density with large holes or narrow peaks take long before the first
// iteration, up to minutes where they are thousands; where no cells of equal masses are found, that
// is a NoEqualMasses. Also throws std::invalid_argument for points that are not finite.
RelaxationReport relaxByTransport(const DensitySource<2>& density, const Point<2>& spacing,
  PointSpan<2> points, const RelaxationOptions& options = {}, const Context& context = Context());

} // namespace RectifiedTransport

#endif
