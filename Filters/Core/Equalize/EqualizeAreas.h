// SPDX-License-Identifier: BSD-3-Clause
// Moves the corners of a lattice of cells so that the area (in 3D, the volume) of each cell comes
// close to the mass of the density in it: a correction of the map from a density to the uniform
// measure, which has errors of its steps. One linearized step of Moser's construction (On the
// Volume Elements on a Manifold, 1965): Poisson's equation for the missing areas, on the images of
// the cells.
#ifndef RectifiedTransport_EqualizeAreas_h
#define RectifiedTransport_EqualizeAreas_h

#include "../Parallel/Context.h"
#include "../Tables/Density.h"

#include <cstdint>

namespace RectifiedTransport
{

struct EqualizeOptions
{
  int Passes = 2; // at most: a pass that does not make the errors smaller is not applied
  // The residual of each pass's linear system, relative to the right-hand side.
  double Tolerance = 0.05;
};

struct EqualizeReport
{
  int Passes = 0;        // those that made the errors smaller; no further one was tried
  int Iterations = 0;    // in all passes' linear systems
  double Residual = 0.0; // the largest of them, relative; may be above the Tolerance
  // Cells with mass whose images have no positive area: they never become more.
  std::int64_t FoldedBefore = 0;
  std::int64_t FoldedAfter = 0;
  // The most cells of a pass whose corners were moved less far, as they would have lost their area.
  std::int64_t Limited = 0;
};

// `corners` are the images of the corners of the density's cells, axis 0 fastest, in index space;
// `total` is the sum of the density's cells. Corners on a side of the box stay on it. In 1D the
// result is exact. What the corners are moved by is added to `moves`, interleaved, if it is not
// null: the caller sets them to zero first. Every result has the same bits on any number of
// threads. Throws std::invalid_argument, std::bad_alloc and Cancelled.
template <int Dimension>
EqualizeReport equalizeAreas(const DensityValues& density, const GridSize<Dimension>& size,
  double total, PointSpan<Dimension> corners, const EqualizeOptions& options = {},
  const Context& context = Context(), float* moves = nullptr);

// About the bytes that it takes besides the corners.
template <int Dimension>
double equalizeAreasMemory(const GridSize<Dimension>& size);

} // namespace RectifiedTransport

#endif
