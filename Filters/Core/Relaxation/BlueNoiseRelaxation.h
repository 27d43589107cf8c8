// SPDX-License-Identifier: BSD-3-Clause
// Iterative blue noise for a density (paper, Section 5.1, "Accelerating existing methods with fast
// initialization"): two methods that improve any start; the best start is that of the flow.
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
  // Ends after an iteration that lowers the energy by at most this fraction of it. 0: goes on while
  // any iteration lowers it.
  double Tolerance = 0.0;
};

struct RelaxationReport
{
  // The energy of the given points, then the energy after each iteration, which never grows.
  std::vector<double> Energy;
};

// Points for which no cells of equal masses were found.
class NoEqualMasses : public std::runtime_error
{
public:
  NoEqualMasses();
};

// Points are in index space, where grid cell i is [i, i + 1]; `spacing` has the lengths of a grid
// cell's sides. Points outside the domain are moved to its border first. Of coincident points, all
// except one are moved by a small part of the mean spacing. The results have the same bits for any
// number of threads. Throws InvalidDensity, std::invalid_argument (options, spacing),
// std::bad_alloc and Cancelled; the points are then undefined.

// Gaussian blue noise (Ahmed, Ren and Wonka, "Gaussian Blue Noise", ACM TOG 41(6), 2022): points
// repel each other by Gaussians as wide as their distance at the local density, and the density
// attracts them, so that its mass and theirs cancel. `flow` has the tables of `density`. 2D and 3D.
// The energy is the squared norm of the blurred difference of both: 1 on average for independent
// random points of the density, near 0 at best. Points distributed very differently from the
// density, such as uniform points for a density with large holes, take many iterations, and n
// points in one spot take n^2 time in each: start with those of the flow. Also throws
// std::invalid_argument for points that are not finite.
template <int Dimension>
RelaxationReport relaxByRepulsion(const DensitySource<Dimension>& density,
  const RectifiedFlow<Dimension>& flow, const Point<Dimension>& spacing,
  PointSpan<Dimension> points, const RelaxationOptions& options = {},
  const Context& context = Context());

// Blue noise through optimal transport (de Goes, Breeden, Ostromoukhov and Desbrun, "Blue Noise
// through Optimal Transport", ACM TOG 31(6), 2012): finds the weights of a power diagram that give
// all points equal masses, then moves the points to the centroids of their cells. The energy is N /
// (M A) times the integral of density * |x - point of x|^2 over the cells, for N points, the
// density's mass M and the domain's area A. Masses are equal to 1e-6 of each other. Points that an
// iteration moves stay where the density has mass, at the nearest place to where they should go.
// Points that begin where it has none leave as soon as that does not raise the energy. If the
// density has large holes or narrow peaks and the points are distributed very differently, the
// first iteration takes long, up to minutes for thousands of points. Throws NoEqualMasses if no
// cells of equal masses are found, and std::invalid_argument for points that are not finite.
RelaxationReport relaxByTransport(const DensitySource<2>& density, const Point<2>& spacing,
  PointSpan<2> points, const RelaxationOptions& options = {}, const Context& context = Context());

} // namespace RectifiedTransport

#endif
