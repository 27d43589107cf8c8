// SPDX-License-Identifier: BSD-3-Clause
#include "Core/SiteCells/PowerSiteCells.h"

#include "Core/Parallel/Stages.h"
#include "Core/PowerCells/EqualMassPartition.h"
#include "Core/PowerCells/RectangleFit.h"
#include "Core/PowerCells/SeparateSites.h"
#include "Core/SiteCells/LabelPolygons.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace RectifiedTransport
{

namespace
{

// The uniform density, for cells of equal areas.
class Ones final : public DensityValues
{
public:
  void Read(std::int64_t, std::int64_t count, double* values) const override
  {
    std::fill_n(values, count, 1.0);
  }
};

// Power diagrams need Euclidean distances in the plane, so the axes must be perpendicular.
bool hasRightAngles(const ImageGrid& grid)
{
  // The cosine of the angle between the axes is below this.
  constexpr double rounding = 1e-9;
  const double axes[2][2] = { { 1.0, 0.0 }, { 0.0, 1.0 } };
  double a[3];
  double b[3];
  grid.VectorToPhysical<2>(axes[0], a);
  grid.VectorToPhysical<2>(axes[1], b);
  const double first = std::hypot(a[0], a[1], a[2]);
  const double second = std::hypot(b[0], b[1], b[2]);
  double cosine = 0.0;
  for (std::size_t r = 0; r < 3; ++r)
  {
    cosine += a[r] / first * (b[r] / second);
  }
  return std::abs(cosine) < rounding;
}

double squaredLength(const Point<2>& x)
{
  return x[0] * x[0] + x[1] * x[1];
}

// Scales and moves sites that are not in the domain, or crowded in it, so that they fill it. The
// cells do not change: |x - centre - scale * y|^2 / scale and |x - y|^2 differ by terms that depend
// on x alone or on y alone, and these cost the same in all partitions into equal masses.
double moveIntoDomain(const Point<2>& sides, std::vector<Point<2>>& sites)
{
  // A smaller scale would gain no digits.
  constexpr double crowded = 2.0;
  // The bounds of the sites, compared with the rectangle.
  const RectangleFit fit(sites, sides);
  if (fit.IsInside && fit.Scale < crowded)
  {
    return 1.0;
  }
  const double scale = std::isfinite(fit.Scale) ? fit.Scale : 1.0;
  for (Point<2>& site : sites)
  {
    for (std::size_t a = 0; a < 2; ++a)
    {
      site[a] = 0.5 * sides[a] + scale * (site[a] - fit.Middle[a]);
    }
  }
  return scale;
}

} // namespace

PowerSiteCells::PowerSiteCells(
  ConstPointSpan<3> sites, const ImageGrid& grid, const Context& context)
  : Place(grid)
{
  this->Solve(sites, { { 1, 1 }, Ones() }, context);
}

PowerSiteCells::PowerSiteCells(ConstPointSpan<3> sites, const ImageGrid& grid,
  const DensitySource<2>& density, double mass, const Context& context)
  : Place(grid)
  , DensityMass(mass)
{
  this->Solve(sites, density, context);
}

void PowerSiteCells::Solve(
  ConstPointSpan<3> sites, const DensitySource<2>& density, const Context& context)
{
  const ImageGrid& grid = this->Place;
  this->Heights.resize(static_cast<std::size_t>(sites.size()));
  if (!hasRightAngles(grid))
  {
    throw std::invalid_argument("The axes of the domain are not at right angles");
  }
  Progress progress(context);
  Stages stages(progress, { { "sites", 2 }, { "cells", 98 } });
  // The unit is the mean spacing of the sites, the square root of area / sites; roots of each side
  // cannot overflow.
  const Point<2> lengths = grid.Lengths<2>();
  this->Unit =
    std::sqrt(lengths[0]) * std::sqrt(lengths[1]) / std::sqrt(static_cast<double>(sites.size()));
  // Sides of the domain and of a pixel, in mean spacings.
  const GridSize<2> size = grid.Size<2>();
  Point<2> sides;
  for (std::size_t a = 0; a < 2; ++a)
  {
    sides[a] = lengths[a] / this->Unit;
    this->PixelSides[a] = sides[a] / static_cast<double>(size[a]);
  }
  std::vector<Point<2>> flat(this->Heights.size());
  for (std::size_t i = 0; i < flat.size(); ++i)
  {
    const double* x = sites[static_cast<std::int64_t>(i)];
    Point<2> index;
    // Sites outside the domain are counted, but used at their places.
    this->Outside += grid.NearestIndex<2>(x, index.data()) ? 0 : 1;
    // The squared height over the plane adds a constant to a site's distances: it changes the cost,
    // not the cells.
    grid.ToIndex<2>(x, index.data());
    double foot[3];
    grid.ToPhysical<2>(index.data(), foot);
    for (std::size_t r = 0; r < 3; ++r)
    {
      const double part = (x[r] - foot[r]) / this->Unit;
      this->Heights[i] += part * part;
    }
    flat[i] = { index[0] * this->PixelSides[0], index[1] * this->PixelSides[1] };
  }
  // The cost refers to the given places, however sites are moved for the diagram.
  const std::vector<Point<2>> given = flat;
  // A site far outside the domain leaves little room to the others, so they are separated by less.
  // The distance that separates sites is scaled like the sites, within bounds.
  const double scale = std::clamp(moveIntoDomain(sides, flat), 1e-5, 1.0);
  separateSites(flat, leastSiteDistance * scale, SiteBounds(), stages["sites"]);
  moveIntoDomain(sides, flat); // those that were at one point are still crowded

  // The density with the mass `sites`, in units of the mean spacing: every cell has the mass 1.
  EqualMassPartition partition(RowMoments(density,
                                 { sides[0] / static_cast<double>(density.Size[0]),
                                   sides[1] / static_cast<double>(density.Size[1]) },
                                 static_cast<double>(flat.size()), stages["cells"]),
    sites.size());
  if (!partition.Solve(flat, stages["cells"]))
  {
    throw std::runtime_error(this->DensityMass
        ? "The masses of the sites' cells do not become equal: the sites are too far from "
          "distributed like the density, or many of them nearly at one point"
        : "The areas of the sites' cells do not become equal: many sites are nearly at one "
          "point, or as good as that beside one that is very far away");
  }
  this->Keep(partition, given);
}

void PowerSiteCells::Keep(const EqualMassPartition& partition, const std::vector<Point<2>>& sites)
{
  // Sides shorter than this part of the domain's length are points.
  constexpr double rounding = 1e-13;
  const GridSize<2> size = this->Place.Size<2>();
  const auto count = static_cast<double>(sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i)
  {
    const auto site = static_cast<std::int64_t>(i);
    const PowerDiagram::Cell cell = partition.Diagram()[site];
    this->First.push_back(static_cast<std::int64_t>(this->Corners.size()));
    for (std::int64_t k = 0; k < cell.Count; ++k)
    {
      const Point<2>& a = cell[k].X;
      const Point<2>& b = cell.After(k).X;
      // The lengths of the domain are about sqrt(count) in these units.
      if (std::max(std::abs(a[0] - b[0]), std::abs(a[1] - b[1])) <= rounding * std::sqrt(count))
      {
        continue;
      }
      Point<2> index;
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        index[axis] =
          std::clamp(a[axis] / this->PixelSides[axis], 0.0, static_cast<double>(size[axis]));
      }
      this->Corners.push_back(index);
    }
    // Mass, centroid and spread of the cell, in mean spacings.
    const EqualMassPartition::CellIntegrals& integrals = partition.Integrals(site);
    const Point<2>& centroid = integrals.Centroid;
    // From masses that sum to the number of sites to shares that sum to 1.
    this->Shares.push_back(integrals.Mass / count);
    this->Centroids.push_back(
      { centroid[0] / this->PixelSides[0], centroid[1] / this->PixelSides[1] });
    // The spread about the centroid, and the squared distance from it to the given place of the
    // site: the parallel axis theorem.
    const Point<2> offset = { sites[i][0] - centroid[0], sites[i][1] - centroid[1] };
    this->Costs.push_back(
      (integrals.Spread + (squaredLength(offset) + this->Heights[i]) * integrals.Mass) / count);
  }
  this->First.push_back(static_cast<std::int64_t>(this->Corners.size()));
  this->Heights = {};
}

void PowerSiteCells::Label(std::int64_t* labels, const Context& context) const
{
  Progress progress(context);
  labelPolygons(this->Corners, this->First, this->Place.Size<2>(), labels, progress);
}

// Shares and costs are per unit of mass; here they get the units of the density and of physical
// space.
double PowerSiteCells::Measure(const SiteCellStatistics& statistics) const
{
  const double all = this->DensityMass
    ? *this->DensityMass
    : numberOfCells<2>(this->Place.Size<2>()) * this->Place.CellMeasure();
  if (!std::isfinite(all))
  {
    throw std::overflow_error("The domain's area passes the largest double; scale the sites");
  }
  // The cost is the sum of the cells' parts.
  double total = 0.0;
  for (std::size_t i = 0; i < this->Costs.size(); ++i)
  {
    const auto site = static_cast<std::int64_t>(i);
    statistics.Mass[site] = this->Shares[i] * all;
    this->Place.ToPhysical<2>(this->Centroids[i].data(), statistics.Centroid[site]);
    statistics.Cost[site] = this->Costs[i] * this->Unit * this->Unit;
    total += statistics.Cost[site];
  }
  if (!std::isfinite(total))
  {
    throw std::overflow_error("The cost passes the largest double; scale the sites");
  }
  return total;
}

std::vector<Point<3>> PowerSiteCells::PhysicalCorners() const
{
  std::vector<Point<3>> corners(this->Corners.size());
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    this->Place.ToPhysical<2>(this->Corners[k].data(), corners[k].data());
  }
  return corners;
}

// Each polygon has corners of its own; neighbours do not share points.
SiteCellPolygons PowerSiteCells::Polygons() const
{
  SiteCellPolygons polygons;
  polygons.Points = this->PhysicalCorners();
  polygons.CornerIds.resize(this->Corners.size());
  std::iota(polygons.CornerIds.begin(), polygons.CornerIds.end(), std::int64_t{ 0 });
  polygons.First = this->First;
  polygons.SiteIds.resize(this->Costs.size());
  std::iota(polygons.SiteIds.begin(), polygons.SiteIds.end(), std::int64_t{ 0 });
  return polygons;
}

// Writes the sides of the same polygons, two corners each, cell by cell.
SiteCellOutlines<2> PowerSiteCells::Outlines() const
{
  SiteCellOutlines<2> outlines;
  outlines.Points = this->PhysicalCorners();
  outlines.CornerIds.reserve(2 * this->Corners.size());
  outlines.SiteIds.reserve(this->Corners.size());
  for (std::int64_t site = 0; site < this->NumberOfSites(); ++site)
  {
    const std::int64_t first = this->First[static_cast<std::size_t>(site)];
    const std::int64_t last = this->First[static_cast<std::size_t>(site) + 1];
    for (std::int64_t k = first; k < last; ++k)
    {
      outlines.CornerIds.push_back(k);
      outlines.CornerIds.push_back(k + 1 < last ? k + 1 : first);
      outlines.SiteIds.push_back(site);
    }
  }
  return outlines;
}

} // namespace RectifiedTransport
