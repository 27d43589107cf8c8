// SPDX-License-Identifier: BSD-3-Clause
// The dots before their relaxation.
#ifndef RectifiedTransport_StratifiedSampling_h
#define RectifiedTransport_StratifiedSampling_h

#include "Surfaces/SurfaceRelaxation/GeodesicTracer.h"
#include "Surfaces/SurfaceRelaxation/SurfaceDensity.h"

#include <cstdint>

namespace RectifiedTransport
{

class Progress;

// Several samples a dot, in proportion to mass, are halved by k-d cuts with whole numbers of dots.
// The sample in the middle of a dot's samples stands for the dot. `total` is the surface's mass.
// The order of the dots is that of the cuts (DotTree.h). Throws std::bad_alloc and Cancelled.
LargeBuffer<SurfacePlace> drawDots(const GeodesicTracer& tracer, const SurfaceDensity& density,
  double total, const SurfaceRelaxationOptions& options, Progress& progress);

// Bytes that it takes at most, about, with the dots.
double memoryForDots(std::int64_t triangles, std::int64_t dots);

} // namespace RectifiedTransport

#endif
