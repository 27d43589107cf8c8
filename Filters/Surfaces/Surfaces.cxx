// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Surfaces.h"

#include "Core/Geometry/Boxes/SolidGrid.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Geometry/PointBounds.h"
#include "Core/Messages/Failure.h"
#include "Core/Parallel/Stages.h"
#include "Core/Transport.h"
#include "Surfaces/Seams/CutOpenSurface.h"
#include "Surfaces/Seams/CutSurfaceMap.h"
#include "Surfaces/Solid/ClosedMesh.h"
#include "Surfaces/Solid/SolidCoverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

namespace
{

// The bounds of the triangles' points: points of no triangle do not count. Throws
// std::invalid_argument for points that are not finite or do not exist.
std::array<double, 6> boundsOf(const TriangleSurface& surface)
{
  for (std::int64_t i = 0; i < surface.Points.size(); ++i)
  {
    const double* point = surface.Points[i];
    if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2]))
    {
      throw std::invalid_argument("point " + std::to_string(i) + " is not finite");
    }
  }
  if (surface.NumberOfTriangles < 1)
  {
    throw std::invalid_argument("the surface has no triangles");
  }
  Bounds<3> bounds;
  for (std::int64_t corner = 0; corner < 3 * surface.NumberOfTriangles; ++corner)
  {
    bounds.Add(surface.Points[cornerPoint(surface, corner)]);
  }
  return { bounds.Low[0], bounds.High[0], bounds.Low[1], bounds.High[1], bounds.Low[2],
    bounds.High[2] };
}

// A mesh in the index space of its cells, and these.
struct FilledMesh
{
  ClosedMesh Mesh;
  SolidCells Cells;
};

// The density of a solid (paper, Section 5.2): a closed mesh, oriented, covers cells in part.
FilledMesh fill(
  const TriangleSurface& surface, int resolution, const SolidOptions& options, Progress& progress)
{
  if (options.Supersampling < 1)
  {
    throw std::invalid_argument(
      "Supersampling is " + std::to_string(options.Supersampling) + "; it must be 1 or more");
  }
  Stages stages(
    progress, { { "points", 20 }, { "edges", 20 }, { "orientation", 10 }, { "coverage", 50 } });
  const std::array<double, 6> bounds = boundsOf(surface);
  ImageGrid grid;
  try
  {
    grid = solidGrid(bounds, resolution, options.Padding);
  }
  catch (const Failure& failure)
  {
    throw std::invalid_argument(failure.what()); // an error of the options
  }
  const std::int64_t corners = 3 * surface.Points.size();
  // The mesh owns and moves its points, so that it gets a copy: three coordinates a point.
  LargeBuffer<double> coordinates(corners);
  std::copy_n(surface.Points.data(), corners, coordinates.data());
  ClosedMesh mesh(std::move(coordinates), stages["points"]);
  // The points are doubles: distances for coordinates rounded to float are not tried.
  const std::string problem = mesh.Close(surface, ClosingDistances(bounds, false), stages["edges"]);
  const bool isOpen = !problem.empty() && options.MayBeOpen && mesh.Surface().NumberOfTriangles > 0;
  if (!problem.empty() && !isOpen)
  {
    throw std::invalid_argument("the surface " + problem);
  }
  // Coverage needs index coordinates and one orientation. Points are moved first, because moving
  // rounds them: orientations then follow from the same bits as volumes.
  mesh.MoveToCells(grid, bounds, stages["orientation"]);
  if (isOpen)
  {
    mesh.OrientOpen(stages["orientation"]);
  }
  else if (!mesh.Orient(stages["orientation"]))
  {
    throw std::invalid_argument("the surface has one side only, so that it has no inside");
  }
  FilledMesh filled{ std::move(mesh), {} };
  SolidCells& covered = filled.Cells;
  std::copy_n(grid.Origin().data(), 3, covered.Low.begin());
  covered.CellSide = grid.Spacing()[0];
  covered.Cells = grid.Size<3>();
  // One value a cell, axis 0 fastest; coverSolid writes all of them.
  covered.Values.resize(static_cast<std::size_t>(numberOfCells<3>(covered.Cells)));
  double* values = covered.Values.data();
  if (isOpen)
  {
    coverPartOfOpenSolid(filled.Mesh.Surface(), covered.Cells,
      LatticePart<3>::WholeOf(covered.Cells), options.Supersampling, values, stages["coverage"]);
    return filled;
  }
  coverSolid(filled.Mesh.Solid(), covered.Cells, options.Supersampling, values, stages["coverage"]);
  return filled;
}

} // namespace

// The map of the paper's Section 5.4 for any topology: seams make disks, each disk is mapped to a
// square with areas kept, and the distortion of the result is measured. The weights of the stages
// are estimates of their time.
Parameterization parameterize(
  const TriangleSurface& surface, const ParameterizationOptions& options, const Context& context)
{
  Progress progress(context);
  Stages stages(progress, { { "seams", 40 }, { "map", 55 }, { "distortion", 5 } });
  CutOpenSurface opened(surface, options.Seams, stages["seams"]);
  const CutSurfaceMap map = mapCutSurface(opened.Cut(), options.Map, stages["map"]);
  // Triangles without area are in no disk. They get those copies of their points that are nearest
  // to each other in the map. This may add copies, and precedes all that is read from `opened`.
  opened.PlaceDegenerate(map.Positions);

  Parameterization flat;
  flat.Coverage = map.Coverage;
  for (std::int64_t i = 0; i < opened.NumberOfPoints(); ++i)
  {
    // This is the point in the cut surface; -1 if no triangle with area is there, so that the map
    // has no place for it.
    const std::int64_t point = opened.PointOf(i);
    flat.Origins.push_back(opened.OriginOf(i));
    flat.Positions.push_back(
      point < 0 ? Point<2>{} : map.Positions[static_cast<std::size_t>(point)]);
  }
  flat.Triangles.assign(opened.Triangles(), opened.Triangles() + 3 * surface.NumberOfTriangles);
  for (std::int64_t triangle = 0; triangle < surface.NumberOfTriangles; ++triangle)
  {
    flat.Disks.push_back(opened.Cut().DiskOf(triangle));
  }
  // Distortions compare shares of the surface with shares of the square that it covers.
  const CutTriangles triangles(opened.Cut(), surface);
  flat.Distortion =
    measureDistortion(triangles.Measured(), scaledToUnitArea(map), stages["distortion"]);
  return flat;
}

// relaxOnSurface checks the options. Its rounding stays that of double, as the coordinates are
// doubles.
std::vector<PlaceOnTriangle> sample(const TriangleSurface& surface, std::int64_t count,
  const SurfaceDensityValues& density, const SurfaceSampleOptions& options, const Context& context)
{
  SurfaceRelaxationOptions relaxation;
  relaxation.NumberOfSamples = count;
  relaxation.Iterations = options.Iterations;
  relaxation.RandomSeed = options.RandomSeed;
  const SurfaceRelaxation relaxed = relaxOnSurface(surface, density, relaxation, context);
  return { relaxed.Places.data(), relaxed.Places.data() + relaxed.Places.size() };
}

std::vector<Point<3>> inside(const TriangleSurface& surface, std::int64_t count,
  const InsideOptions& options, const Context& context)
{
  Progress progress(context);
  Stages stages(progress, { { "solid", 2 }, { "points", 7 }, { "inside", 1 } });
  const FilledMesh filled =
    fill(surface, options.Resolution, { 0.0, 2, options.MayBeOpen }, stages["solid"]);
  const SolidCells& box = filled.Cells;
  Point<3> sides; // in cells, so that points are in index space
  std::copy(box.Cells.begin(), box.Cells.end(), sides.begin());
  SampleOptions samples;
  samples.RandomSeed = options.RandomSeed;
  std::vector<Point<3>> points =
    sample<3>({ box.Values.data(), box.Cells, sides }, count, samples, stages["points"]);
  moveInside(filled.Mesh.Surface(), points, stages["inside"]);
  for (Point<3>& point : points)
  {
    for (std::size_t a = 0; a < 3; ++a)
    {
      point[a] = box.Low[a] + box.CellSide * point[a];
    }
  }
  return points;
}

SolidCells solid(const TriangleSurface& surface, int resolution, const SolidOptions& options,
  const Context& context)
{
  Progress progress(context);
  return fill(surface, resolution, options, progress).Cells;
}

} // namespace RectifiedTransport
