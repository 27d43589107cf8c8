// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/SurfaceSampling/SurfaceSamples.h"

#include "Core/Flow/RectifiedFlow.h"
#include "Core/Parallel/Stages.h"
#include "Core/Tables/Density.h"
#include "Surfaces/Parameterization/AreaPreservingMap.h"
#include "Surfaces/Parameterization/MassRaster.h"
#include "Surfaces/SurfaceSampling/SamplePatches.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 10;

// The sides of the rectangle of a map, the longer one being 1.
Point<2> lengthsOf(double aspectRatio)
{
  return { std::min(1.0, aspectRatio), std::min(1.0, 1.0 / aspectRatio) };
}

// A map that samples are made by: to the unit square, which is scaled to `aspectRatio`.
struct FlatMap
{
  ConstPointSpan<2> Positions;
  double AspectRatio;
};

// The density of a grid cell is the mass of the triangles there, exactly divided.
RectifiedFlow<2> flowOf(const FlatMesh& flat, const GridSize<2>& size, Progress& progress)
{
  // By cells, axis 0 fastest.
  LargeBuffer<double> masses(size[0] * size[1]);
  Stages stages(progress, { { "masses", 2 }, { "tables", 3 } });
  rasterizeMass({ flat.Positions, flat.Triangles, flat.Masses, flat.NumberOfTriangles }, size,
    masses.data(), stages["masses"]);
  return RectifiedFlow<2>(DensityArray<2, double>(masses.data(), size), stages["tables"]);
}

// Uniform seeds of the rectangle are moved by the forward flow to the density of the masses; the
// inverse of the map then takes them to the surface.
SurfaceSamples sampleMap(const DiskMesh& disk, const FlatMap& map, const double* masses,
  const SurfaceSamplingOptions& options, const Context& context)
{
  Progress progress(context);
  const TriangleSurface surface = disk.Surface();
  // The mesh in the unit square; distances are in the rectangle.
  const FlatMesh flat{ map.Positions, surface.Triangles, surface.NumberOfTriangles, masses,
    lengthsOf(map.AspectRatio) };
  const GridSize<2> size = flatGrid(map.AspectRatio, options.Resolution);
  const UnitSeeds<2> seeds = flatSeeds(map.AspectRatio, options);
  const auto count = static_cast<std::int64_t>(seeds.Count());
  SurfaceSamples samples;
  samples.Places = LargeBuffer<PlaceOnTriangle>(count);
  Stages stages(progress,
    { { "flow", 25 }, { "seeds", 5 }, { "map", 30 }, { "locator", 15 }, { "places", 20 },
      { "error", 5 } });
  // Two coordinates a particle; the flow moves them in place, and its tables are freed before the
  // locator is built.
  LargeBuffer<double> coordinates(2 * count);
  const PointSpan<2> points(coordinates.data(), count);
  {
    const RectifiedFlow<2> flow = flowOf(flat, size, stages["flow"]);
    seeds.Generate(points, stages["seeds"]);
    for (std::int64_t i = 0; i < 2 * count; ++i)
    {
      // The flow works in index space: cells have the width 1.
      coordinates.data()[i] *= static_cast<double>(size[static_cast<std::size_t>(i % 2)]);
    }
    FlowOptions integration = options.Flow;
    // The number of particles decides on automatic steps.
    integration.Particles = static_cast<double>(count);
    samples.Flow = flow.Forward(points, points, integration, stages["map"]);
  }
  const FlatLocator locator(flat, stages["locator"]);
  PlaceOnTriangle* places = samples.Places.data();
  stages["places"].ForEach(count, grain, [&](std::int64_t i) {
    // The locator has the unit square's coordinates.
    places[i] = locator.Locate(
      { points[i][0] / static_cast<double>(size[0]), points[i][1] / static_cast<double>(size[1]) });
  });
  samples.PatchError = patchError(disk, masses, samples.Places, stages["error"]);
  return samples;
}

} // namespace

GridSize<2> flatGrid(double aspectRatio, std::int64_t resolution)
{
  GridSize<2> size;
  const Point<2> lengths = lengthsOf(aspectRatio);
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    // The longer side has the length 1 and `resolution` cells.
    const double cells = lengths[axis] * static_cast<double>(resolution);
    size[axis] = std::max<std::int64_t>(1, std::llround(cells));
  }
  return size;
}

double memoryForSurfaceFlow(const GridSize<2>& grid)
{
  return numberOfCells<2>(grid) * sizeof(double) + RectifiedFlow<2>::MemoryFor(grid);
}

UnitSeeds<2> flatSeeds(double aspectRatio, const SurfaceSamplingOptions& options)
{
  return UnitSeeds<2>(
    options.Pattern, lengthsOf(aspectRatio), options.NumberOfSamples, options.RandomSeed);
}

SurfaceSamples sampleSurface(const DiskMesh& disk, const ConformalMap& map, const double* masses,
  const SurfaceSamplingOptions& options, const Context& context)
{
  if (options.Resolution < 1 || options.Resolution > AreaPreservingOptions::MaximumResolution)
  {
    throw std::invalid_argument("the resolution is " + std::to_string(options.Resolution) +
      "; it must be from 1 to " + std::to_string(AreaPreservingOptions::MaximumResolution));
  }
  if (options.NumberOfSamples < 0)
  {
    throw std::invalid_argument("the number of samples is " +
      std::to_string(options.NumberOfSamples) + "; it must be at least 0");
  }
  Progress progress(context);
  Stages stages(
    progress, { { "conformal map", 5 }, { "area-preserving map", 3 }, { "samples", 2 } });
  SurfaceSamples samples = sampleMap(
    disk, { map.Square.Positions, map.AspectRatio }, masses, options, stages["conformal map"]);
  // The conformal map squeezes masses into few cells: the area-preserving map spreads them.
  if (samples.PatchError > SurfaceSamples::AcceptableError)
  {
    samples.Places = {}; // its memory is needed now
    AreaPreservingOptions flat;
    flat.Resolution = options.Resolution;
    const AreaPreservingMap kept =
      mapAreaPreserving(disk, map.Square, flat, stages["area-preserving map"]);
    // The map is to a square: aspect ratio 1.
    samples = sampleMap(disk, { kept.Positions, 1.0 }, masses, options, stages["samples"]);
    samples.IsAreaPreserving = true;
  }
  progress.EndSlice(1);
  return samples;
}

} // namespace RectifiedTransport
