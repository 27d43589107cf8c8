// SPDX-License-Identifier: BSD-3-Clause
// Particles that blend densities by maps of least cost: from the first of two densities to the
// second, or from the barycenter of several densities to each of them.
#ifndef RectifiedTransport_OptimalBlend_h
#define RectifiedTransport_OptimalBlend_h

#include "../Geometry/ImageGrid.h"
#include "../Geometry/LengthScale.h"
#include "../Parallel/Context.h"
#include "../Parallel/LargeBuffer.h"
#include "../Plan/TransportPlan.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

// One of the densities, and this rank's particles in it by a map that all densities have in common,
// such as the flow from a pivot.
template <int Dimension>
struct BlendedDensity
{
  PlanEnd<Dimension> End; // PlanEnd::In of the geometry and the grid
  ImageGrid Grid;
  double Weight;               // at least 0; all sum to 1
  ConstPointSpan<3> Positions; // physical
};

struct OptimalBlendOptions
{
  bool IsOptimal = false; // else positions stay, and there are the bound and the slack alone
  double Tolerance = 1e-3;
  bool IsPair = false; // else a barycenter
  ImageGrid Geometry;  // on which barycenters are found
};

// Coordinates of physical points, interleaved.
using PointBuffer = std::shared_ptr<LargeBuffer<double>>;

struct OptimalPositions
{
  // By the densities; nullptr where particles stay.
  std::vector<PointBuffer> Moved;
  // For each particle, half of what its displacements cost more than the bound allows for, as a
  // weighted mean over the densities. In squared physical lengths.
  LargeBuffer<double> Slack;
  double Bound =
    0.0; // bounds the cost between two densities, or the weighted mean from the barycenter
  double Cost = 0.0; // with a barycenter: the cost that Bound bounds
  // If IsOptimal, from the barycenter: the weighted mean of the bounds, for each iteration.
  std::vector<double> Functional;
  // If the optimal map does not reach a density, whose particles then stay: its number, and the
  // reason.
  std::vector<std::pair<std::size_t, std::string>> Warnings;
};

// With two densities, the particles of the first one move to their images in the second one. With
// more, the particles move to the mean of their images until that does not lower the functional any
// more (Alvarez-Esteban, del Barrio, Cuesta-Albertos and Matran, "A fixed-point approach to
// barycenters in Wasserstein space", Journal of Mathematical Analysis and Applications 441, 2016).
// Collective. Throws InvalidDensity, std::overflow_error (LengthScale), std::bad_alloc and
// Cancelled.
template <int Dimension>
OptimalPositions blendOptimally(const std::vector<BlendedDensity<Dimension>>& densities,
  const OptimalBlendOptions& options, const Context& context = Context());

} // namespace RectifiedTransport

#endif
