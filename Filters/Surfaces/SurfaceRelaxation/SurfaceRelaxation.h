// SPDX-License-Identifier: BSD-3-Clause
// Points spread evenly over any triangle surface, or in proportion to a density on it.
//
//   const SurfaceRelaxation relaxed = relaxOnSurface(surface);
//   for (const PlaceOnTriangle& place : relaxed.Places) ...
#ifndef RectifiedTransport_SurfaceRelaxation_h
#define RectifiedTransport_SurfaceRelaxation_h

#include "../../Core/Parallel/Context.h"
#include "../../Core/Parallel/LargeBuffer.h"
#include "../Mesh/PlaceOnTriangle.h"
#include "../Mesh/TriangleSurface.h"

#include <cstdint>

namespace RectifiedTransport
{

struct SurfaceRelaxationOptions
{
  std::int64_t NumberOfSamples = 8192;
  int Iterations = 20; // 0: the stratified start itself
  std::uint64_t RandomSeed = 1;
  // By how much coordinates may be off because of rounding; at least that of double.
  double Rounding = 0.0;
};

// A density per area: values at points (linear in triangles), or one a triangle, or neither: 1.
struct SurfaceDensityValues
{
  const double* AtPoints = nullptr;
  const double* OfTriangles = nullptr;
};

struct SurfaceRelaxation
{
  LargeBuffer<PlaceOnTriangle> Places; // near ones are often near in the order, too
  std::int64_t WeldedPoints = 0;       // at the place of another point
  std::int64_t TJunctions = 0;         // that were closed
  std::int64_t OpenEdges = 0;          // edges of one triangle
  std::int64_t NonManifoldEdges = 0;   // edges of more than two triangles
};

// Takes any triangles: closed or not, in several components, with handles, with more than two
// triangles on an edge, turned either way, intersecting each other, without area. Points with equal
// coordinates count as one. Triangles are neighbours also across T-junctions (see TJunctions.h):
// there they are cut, each with the density that it has as a whole.
//
// Samples of the surface in proportion to area times density are halved by k-d cuts, so that each
// part has its share of the dots to one. Then dots repel each other by bumps as wide as their
// distance at the local density, and walk over the triangles: straight ahead over edges, along
// boundaries. Near a boundary, each dot is also repelled by its mirror image. Sheets nearer to each
// other than the spacing share the room between them. No dot walks over an edge where the density
// jumps by a factor above 2, so that the numbers on both sides stay. The exception is noise:
// parts of one density that are narrower than the spacing, or have the mass of few dots, get the
// mean density around them. No dot is in a triangle of density 0.
//
// Cost: O(triangles log triangles + samples (log samples + iterations)). Memory:
// memoryForSurfaceRelaxation. The places have the same bits for any number of threads and any
// instruction set. Throws InvalidDensity, std::invalid_argument (options; no triangles, none with
// area, or points that do not exist or are not finite), std::bad_alloc and Cancelled.
SurfaceRelaxation relaxOnSurface(const TriangleSurface& surface,
  const SurfaceDensityValues& density = {}, const SurfaceRelaxationOptions& options = {},
  const Context& context = Context());

// Bytes that it takes at most, about, with the places.
double memoryForSurfaceRelaxation(
  std::int64_t points, std::int64_t triangles, bool hasDensity, std::int64_t samples);

} // namespace RectifiedTransport

#endif
