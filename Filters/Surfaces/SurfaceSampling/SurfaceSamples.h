// SPDX-License-Identifier: BSD-3-Clause
// Points of a disk that follow masses of its triangles (paper, Sections 5.1 and 5.4).
//
//   DiskMesh disk(surface);
//   ConformalMap map = mapConformally(disk, chooseCorners(disk));
//   SurfaceSamples samples = sampleSurface(disk, map, disk.AreaShares());
#ifndef RectifiedTransport_SurfaceSamples_h
#define RectifiedTransport_SurfaceSamples_h

#include "../../Core/Flow/FlowOptions.h"
#include "../../Core/Geometry/GridSize.h"
#include "../../Core/Parallel/Context.h"
#include "../../Core/Parallel/LargeBuffer.h"
#include "../../Core/Seeds/UnitSeeds.h"
#include "../Mesh/DiskMesh.h"
#include "../Parameterization/ConformalMap.h"
#include "FlatLocator.h"

#include <cstdint>

namespace RectifiedTransport
{

struct SurfaceSamplingOptions
{
  std::int64_t NumberOfSamples = 8192; // Lattice: the nearest number of a grid
  std::int64_t Resolution = 1024;      // cells along the longer side of the rectangle, 1 to 16384
  SeedPattern Pattern = SeedPattern::BlueNoise;
  std::uint64_t RandomSeed = 1;
  FlowOptions Flow;
};

struct SurfaceSamples
{
  // The largest patchError with which the conformal map is used: evenly spread samples have about
  // 0.03 to 0.05, independent ones 0.13.
  static constexpr double AcceptableError = 0.25;

  LargeBuffer<PlaceOnTriangle> Places; // in the order of the seeds
  FlowReport Flow;
  double PatchError = 0.0;       // relative L2 error of the numbers in patches
  bool IsAreaPreserving = false; // whether that map was used instead of the conformal one
};

// The grid of the rectangle of a conformal map: `resolution` cells along its longer side, as near
// to squares as whole numbers allow.
GridSize<2> flatGrid(double aspectRatio, std::int64_t resolution);

// Bytes that the flow on such a grid takes for its density and tables.
double memoryForSurfaceFlow(const GridSize<2>& grid);

// The seeds in the rectangle of a map.
UnitSeeds<2> flatSeeds(double aspectRatio, const SurfaceSamplingOptions& options);

// Moves uniform points of the rectangle that a disk is mapped to conformally by the flow of the
// triangles' masses, and puts them on the triangles. The conformal map keeps their pattern. A place
// is never on a triangle without mass: points that land there, in a grid cell that has mass from
// other triangles, go to the nearest place with mass.
//
// If the conformal map squeezes much of the surface into few cells of the grid, for example the far
// end of a long tube, the numbers of samples would be wrong. Beyond AcceptableError the
// area-preserving map in the unit square is used instead, which shears their pattern.
//
// Cost: O(Resolution^2 + triangles log triangles + samples (log triangles + steps)). Memory: 45
// bytes a cell, 80 a triangle and 48 a sample. The samples have the same bits on any number of
// threads. Throws InvalidDensity, std::invalid_argument (options), std::bad_alloc and Cancelled.
SurfaceSamples sampleSurface(const DiskMesh& disk, const ConformalMap& map, const double* masses,
  const SurfaceSamplingOptions& options = {}, const Context& context = Context());

} // namespace RectifiedTransport

#endif
