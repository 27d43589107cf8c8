// SPDX-License-Identifier: BSD-3-Clause
// Particles to a grid: every particle spreads its mass over the cells around it by a kernel that is
// a product of one-dimensional ones.
#ifndef RectifiedTransport_Splat_h
#define RectifiedTransport_Splat_h

#include "Core/Geometry/GridSize.h"
#include "Core/Geometry/IndexMap.h"
#include "Core/Parallel/Context.h"

#include <cstdint>

namespace RectifiedTransport
{

// Hockney and Eastwood, "Computer Simulation Using Particles", 1988, Section 5-3: constant, linear
// and quadratic B-splines, over 1, 2 and 3 cells an axis. All but NearestCell keep the centroid.
enum class SplatKernel
{
  CloudInCell,
  NearestCell, // of a point on a face, the upper cell
  TriangularShapedCloud,
  // Cut at three standard deviations, and its values at the cells' centres multiplied by the linear
  // function that makes their sum 1 and keeps the centroid.
  Gaussian
};

enum class SplatBoundary
{
  Renormalize, // what a kernel has beyond the border goes to its cells inside, axis by axis
  Drop         // it is lost
};

struct SplatOptions
{
  SplatKernel Kernel = SplatKernel::CloudInCell;
  // The Gaussian's standard deviation in cells, above 0 and at most LargestRadius. Up to a third of
  // a cell no more than two cells an axis are reached, and the Gaussian is the CloudInCell.
  double Radius = 1.0;
  SplatBoundary Boundary = SplatBoundary::Renormalize;

  static constexpr double LargestRadius = 10000.0;
};

template <int Dimension, class Real>
struct SplatParticles
{
  ConstPointSpan<3, Real> Points; // finite
  const double* Masses;           // any finite numbers; null: Mass each
  double Mass;
  IndexMap<Dimension> ToIndex;
};

struct SplatReport
{
  // Particles that are outside: Renormalize moves them to the nearest point of the border, Drop
  // leaves them out.
  std::int64_t Outside = 0;
};

// Writes `scale` times the mass of every cell, axis 0 fastest, of at most 2^30 cells an axis. The
// shares of a cell are added in the order of the particles, so that the result is that of a loop
// over them, to the last bit, whoever runs it. Throws std::bad_alloc and Cancelled.
template <int Dimension, class Real>
SplatReport splatMass(const SplatParticles<Dimension, Real>& particles,
  const GridSize<Dimension>& size, const SplatOptions& options, double scale, double* cells,
  const Context& context = Context());

} // namespace RectifiedTransport

#endif
