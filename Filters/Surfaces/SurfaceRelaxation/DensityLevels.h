// SPDX-License-Identifier: BSD-3-Clause
// The densities that dots have on each triangle, and where they jump.
#ifndef RectifiedTransport_DensityLevels_h
#define RectifiedTransport_DensityLevels_h

#include "Surfaces/SurfaceRelaxation/GeodesicTracer.h"
#include "Surfaces/SurfaceRelaxation/SurfaceDensity.h"

#include <cstdint>

namespace RectifiedTransport
{

class Progress;

// Triangles that are neighbours without a jump, a factor above 2, are a part. A part is wide if it
// has the mass of several dots, and is about as wide as their spacing; else its density is noise,
// and dots there have the mean density around. Closes the surface's sides where densities of wide
// parts jump, as walls, and around wide parts of density 0, as boundaries.
//
// The levels: 0 on triangles of density 0; the mean density, above 0, where it is noise; `Given`
// where the density itself counts. Throws std::bad_alloc and Cancelled.
class DensityLevels
{
public:
  static constexpr double Given = -1.0;

  DensityLevels(
    GeodesicTracer& tracer, const SurfaceDensity& density, double massOfDot, Progress& progress);
  static double MemoryFor(std::int64_t triangles);

  const double* data() const { return this->Levels.data(); }

private:
  LargeBuffer<double> Levels;
};

} // namespace RectifiedTransport

#endif
