// SPDX-License-Identifier: BSD-3-Clause
// Moves the borders of regions so that their areas are in proportion to masses: passes of the
// rectified flow from a raster of the regions' densities to the uniform measure, after Gastner,
// Seguy and More (2018), "Fast flow-based algorithm for creating density-equalizing map
// projections", PNAS 115(10), with another flow.
#ifndef RectifiedTransport_Cartogram_h
#define RectifiedTransport_Cartogram_h

#include "../Flow/FlowOptions.h"
#include "../Geometry/Points.h"
#include "../Parallel/Context.h"
#include "RegionMap.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace RectifiedTransport
{

class RegionRaster;

// The least density of a region, relative to the mean density of all regions.
constexpr double leastRegionDensity = 1e-4;

// Regions that overlap by less than this part of their total area count as adjacent.
constexpr double leastOverlap = 1e-4;

// The density of the ground around the regions.
enum class SeaDensity
{
  Mean,    // of the regions, in every pass: they keep their area
  Minimum, // of the regions' densities
  Value,   // a given one, in the map as it is
  Zero     // 1e-7 of the mean: regions take all of the box
};

struct CartogramOptions
{
  std::int64_t Resolution = 1024; // cells along a side of the square box, at least 16
  double Margin = 0.1;            // on each side, of the longest side of the map
  SeaDensity Sea = SeaDensity::Mean;
  double SeaValue = 1.0;   // mass per area
  double Tolerance = 0.01; // relative error of the areas
  int MaximumPasses = 10;
  FlowOptions Flow; // its AreaTolerance is half of Tolerance
};

// The square about a map, and its index space.
struct CartogramBox
{
  Point<2> Low;
  double Cell; // its side
  std::int64_t Side;

  Point<2> ToIndex(const Point<2>& place) const
  {
    return { (place[0] - this->Low[0]) / this->Cell, (place[1] - this->Low[1]) / this->Cell };
  }
  Point<2> ToPlace(const Point<2>& index) const
  {
    return { this->Low[0] + this->Cell * index[0], this->Low[1] + this->Cell * index[1] };
  }
};
CartogramBox boxAround(const RegionMap& map, const CartogramOptions& options);

// Points that move along, in index space. A point beyond the box moves as the nearest point of its
// border.
using OverlayPoints = std::vector<Point<2>>;

struct CartogramPass
{
  double LargestError = 0.0; // relative, of a region's share of the area
  std::int32_t Worst = 0;    // the region that has it
  double PredictedError = 0.0;
  int NumberOfSteps = 0; // 0: Adaptive
};

struct CartogramResult
{
  // Regions whose outlines cross themselves, so that their areas are not clear: nothing is moved.
  std::vector<std::int32_t> Crossing;
  std::vector<CartogramPass> Passes;
  std::vector<double> Errors; // relative errors of the regions' areas, with sign
  // Regions whose least density is too much for them at this resolution, and which therefore miss
  // the tolerance. Those that lie on others are not among them.
  std::vector<std::int32_t> OutOfReach;
  std::int64_t Folded = 0;      // rings that turned over in a pass that was left out; 0 else
  std::int32_t FirstFolded = 0; // the region of the first of them
  double Growth = 1.0;          // what the area of all regions is to be multiplied by
  double Overlap = 0.0;         // overlap of the regions before, relative to their total area
  std::int32_t Overlapping = 0; // a region with most of it
  std::vector<double> Overlaps; // overlap of each region, relative to its area
  // Points that divide the map's edges, as it numbers them, and the places of all points before.
  std::vector<DividingPoint> Added;
  std::vector<Point<2>> Before;
};

// The part of a map that does not depend on masses: the raster of the map itself.
struct CartogramStart
{
  std::shared_ptr<const RegionRaster> Raster;
};

// `map` has its points in the index space of the box, and areas above 0; `masses` of its regions
// are above 0. The map's points are moved, and the overlays. Runs passes until each region's error
// is within the tolerance, until what is out of reach does not get better, or until MaximumPasses;
// a pass that turns rings over is done again with twice as many steps, up to 4096, and left out in
// the end. Throws InvalidDensity, std::bad_alloc and Cancelled.
CartogramResult runCartogram(RegionMap& map, const std::vector<double>& masses,
  const CartogramBox& box, const CartogramOptions& options, OverlayPoints& overlays,
  CartogramStart& start, const Context& context = Context());

// Raises masses below a share of their sum to it, or to an equal one if that is less. Returns how
// many.
std::int32_t raiseMasses(std::vector<double>& masses, double leastShare);

} // namespace RectifiedTransport

#endif
