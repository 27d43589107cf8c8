// SPDX-License-Identifier: BSD-3-Clause
// The functions of triangle surfaces in one header: what most programs need, one call each.
//
//   #include <RectifiedTransport/Surfaces/Surfaces.h>
//   using namespace RectifiedTransport;
//
//   const std::vector<Point<3>> points = ...;
//   const std::vector<std::int64_t> triangles = ...;  // three points each
//   const TriangleSurface surface{ points, triangles.data(), 1200 };
//   const Parameterization flat = parameterize(surface);             // in [0,1]^2, areas kept
//   const std::vector<PlaceOnTriangle> dots = sample(surface, 5000); // spaced evenly
//   const SolidCells volume = solid(surface, 64);                    // what it encloses
//   const std::vector<Point<3>> cloud = inside(surface, 5000);       // points in it, spaced evenly
//
// What they have in common with Core/Transport.h: a result has the same bits for every number of
// threads; they throw std::invalid_argument (options; triangles with points that do not exist),
// std::bad_alloc, and Cancelled if the context's IsCancelled returns true.
#ifndef RectifiedTransport_Surfaces_h
#define RectifiedTransport_Surfaces_h

#include "../Core/Geometry/GridSize.h"
#include "../Core/Geometry/Points.h"
#include "../Core/Parallel/Context.h"
#include "Mesh/PlaceOnTriangle.h"
#include "Mesh/TriangleSurface.h"
#include "Parameterization/AreaPreservingMap.h"
#include "Parameterization/MapDistortion.h"
#include "Seams/CutSurface.h"
#include "SurfaceRelaxation/SurfaceRelaxation.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

struct ParameterizationOptions
{
  AreaPreservingOptions Map;
  SeamOptions Seams; // for surfaces that are no disk
};

// A surface laid flat into the unit square. Its points are the given ones, and then copies of those
// on seams.
struct Parameterization
{
  std::vector<Point<2>> Positions;     // by points, in [0,1]^2; 0 0 for points of no triangle
  std::vector<std::int64_t> Origins;   // by points: the given point
  std::vector<std::int64_t> Triangles; // by given triangles: three points
  std::vector<std::int64_t> Disks;     // by given triangles: from 0; -1 for those without area
  MapDistortion Distortion;
  double Coverage = 0.0; // the share of the unit square that the surface covers
};

// Maps a surface of any topology to the unit square with areas kept (paper, Section 5.4). What is
// no disk is cut along short seams into disks. Each disk fills a square of its own; all have the
// same area in the unit square per area of the surface. Triangles are neighbours if they share an
// edge, also along points with equal coordinates. Cost and memory: those of CutSurface and
// mapCutSurface. Also throws NotADisk if points are not finite or no triangle has an area.
Parameterization parameterize(const TriangleSurface& surface,
  const ParameterizationOptions& options = {}, const Context& context = Context());

struct SurfaceSampleOptions
{
  int Iterations = 20; // how often points repel each other; 0: only a stratified start
  std::uint64_t RandomSeed = 1;
};

// `count` points on a surface of any topology, spaced evenly, or in proportion to a density per
// area. Cost, memory and errors: those of relaxOnSurface.
std::vector<PlaceOnTriangle> sample(const TriangleSurface& surface, std::int64_t count,
  const SurfaceDensityValues& density = {}, const SurfaceSampleOptions& options = {},
  const Context& context = Context());

struct SolidOptions
{
  double Padding = 0.05; // room on each side, as a part of the longest one; 0 and more
  int Supersampling = 2; // lines along each axis of a cell where bodies intersect; 1 and more
  // Whether a surface may have holes: inside is then where its generalized winding number is a half
  // or more (see coverPartOfOpenSolid).
  bool MayBeOpen = false;
};

// What a solid covers of the cubic cells of a box.
struct SolidCells
{
  Point<3> Low{};             // the lowest corner of the box
  double CellSide = 0.0;      // a length, in the unit of the surface's points
  GridSize<3> Cells{};        // along each axis
  std::vector<double> Values; // the covered fraction of each cell, 0 to 1, axis 0 fastest
};

// The cells of a box around a closed surface that are inside it (paper, Section 5.2), with
// `resolution` cells along its longest side, 1 and more. Gaps of rounding and T-junctions are
// closed as ClosedMesh does. Throws std::invalid_argument, which says why, for a surface that stays
// open, unless it may, or is not orientable.
SolidCells solid(const TriangleSurface& surface, int resolution, const SolidOptions& options = {},
  const Context& context = Context());

struct InsideOptions
{
  int Resolution = 256; // cells along the longest side of the surface's box, 1 and more
  std::uint64_t RandomSeed = 1;
  bool MayBeOpen = false; // as of SolidOptions
};

// `count` points inside a closed surface, spaced evenly: samples of what it covers of the cells of
// its box. Those that this puts outside, into cells that are covered in part, are moved within
// their cell. Memory: 40 bytes a cell. Throws as `solid` does.
std::vector<Point<3>> inside(const TriangleSurface& surface, std::int64_t count,
  const InsideOptions& options = {}, const Context& context = Context());

} // namespace RectifiedTransport

#endif
