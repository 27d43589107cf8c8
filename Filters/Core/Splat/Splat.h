// SPDX-License-Identifier: BSD-3-Clause
// The mass of particles on a grid: each particle distributes its mass over the grid cells around it
// by a kernel that is a product of one-dimensional kernels.
#ifndef RectifiedTransport_Splat_h
#define RectifiedTransport_Splat_h

#include "../Geometry/GridSize.h"
#include "../Geometry/IndexMap.h"
#include "../Geometry/LatticePart.h"
#include "../Parallel/Context.h"

#include <cstdint>

namespace RectifiedTransport
{

// Hockney and Eastwood, "Computer Simulation Using Particles", 1988, Section 5-3: constant, linear
// and quadratic B-splines, over 1, 2 and 3 cells an axis. All except NearestCell keep the centroid.
enum class SplatKernel
{
  CloudInCell,
  NearestCell, // for a point on a face, the upper cell
  TriangularShapedCloud,
  // Truncated at three standard deviations. Its values at the cells' centres are multiplied by the
  // linear function that makes their sum 1 and keeps the centroid.
  Gaussian
};

enum class SplatBoundary
{
  Renormalize, // weights of cells beyond the border are distributed to those inside, axis by axis
  Drop         // they are dropped
};

struct SplatOptions
{
  SplatKernel Kernel = SplatKernel::CloudInCell;
  // The Gaussian's standard deviation in grid cells, above 0 and at most LargestRadius. Up to a
  // third of a cell, its support has at most two cells an axis, and it is CloudInCell.
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
  // Particles outside the grid: Renormalize moves them to the nearest point of the border, Drop
  // omits them.
  std::int64_t Outside = 0;
};

// Writes `scale` times the mass of the grid cells of a part, axis 0 fastest, at most 2^30 cells an
// axis; the bits are those of the whole grid. Particles that reach none of the cells may be left
// out. Terms are added to a cell in the order of the particles, so that the result has the bits of
// a serial loop for every executor. Throws std::bad_alloc and Cancelled.
template <int Dimension, class Real>
SplatReport splatMass(const SplatParticles<Dimension, Real>& particles,
  const GridSize<Dimension>& size, const LatticePart<Dimension>& part, const SplatOptions& options,
  double scale, double* cells, const Context& context = Context());

// The same for the whole grid.
template <int Dimension, class Real>
SplatReport splatMass(const SplatParticles<Dimension, Real>& particles,
  const GridSize<Dimension>& size, const SplatOptions& options, double scale, double* cells,
  const Context& context = Context())
{
  return splatMass<Dimension, Real>(
    particles, size, LatticePart<Dimension>::WholeOf(size), options, scale, cells, context);
}

} // namespace RectifiedTransport

#endif
