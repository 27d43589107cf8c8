// SPDX-License-Identifier: BSD-3-Clause
// Site cells of least cost in a plane: the power diagram whose cells have equal areas, or equal
// masses of a density. It is the optimal transport, for the squared distance, from the uniform
// measure or the density to equal masses at the sites.
//
//   const PowerSiteCells cells(sites, grid);                // of two dimensions
//   const PowerSiteCells cells(sites, grid, density, mass); // the same for a density
//   std::vector<std::int64_t> labels(grid.NumberOfCells());
//   cells.Label(labels.data());
#ifndef RectifiedTransport_PowerSiteCells_h
#define RectifiedTransport_PowerSiteCells_h

#include "../Geometry/ImageGrid.h"
#include "../Geometry/Points.h"
#include "../Parallel/Context.h"
#include "../Tables/Density.h"
#include "SiteCellOutlines.h"
#include "SiteCellPolygons.h"
#include "SiteCellStatistics.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace RectifiedTransport
{

class EqualMassPartition;

class PowerSiteCells
{
public:
  // There is at least one site; coordinates are finite. Sites outside the domain are used at their
  // positions. If sites are nearer to each other than 1e-5 of the mean spacing, all except one move
  // apart by that distance, only for the cells. Throws std::invalid_argument if the grid's axes are
  // not at right angles, std::runtime_error if the areas do not become equal to 5e-7 (a site is
  // away from the others by many millions of the domain's lengths), std::bad_alloc and Cancelled.
  PowerSiteCells(
    ConstPointSpan<3> sites, const ImageGrid& grid, const Context& context = Context());
  // The same for a density of mass `mass` on the domain of the grid, with any number of cells. Also
  // throws InvalidDensity, and std::runtime_error if the sites are distributed too differently from
  // the density.
  PowerSiteCells(ConstPointSpan<3> sites, const ImageGrid& grid, const DensitySource<2>& density,
    double mass, const Context& context = Context());

  std::int64_t NumberOfSites() const { return static_cast<std::int64_t>(this->Costs.size()); }
  std::int64_t NumberOutside() const { return this->Outside; }

  // Writes the number of the site of each pixel, axis 0 fastest: the site whose cell contains the
  // pixel's centre. Throws std::bad_alloc and Cancelled.
  void Label(std::int64_t* labels, const Context& context = Context()) const;
  // Writes the areas (or masses), centroids and costs of the cells: integrals over the polygons.
  // Returns the cost: the mean of |x - site|^2 over all points x of the domain, or over the mass.
  // Throws std::overflow_error for a cost or an area beyond the largest double.
  double Measure(const SiteCellStatistics& statistics) const;
  // The sides of the polygons; each cell has its own points. Throws std::bad_alloc.
  SiteCellOutlines<2> Outlines() const;
  // One convex polygon for each site, with points of its own. Throws std::bad_alloc.
  SiteCellPolygons Polygons() const;

private:
  void Solve(ConstPointSpan<3> sites, const DensitySource<2>& density, const Context& context);
  std::vector<Point<3>> PhysicalCorners() const;
  void Keep(const EqualMassPartition& partition, const std::vector<Point<2>>& sites);

  ImageGrid Place;
  std::optional<double> DensityMass; // mass of the density, if there is one
  Point<2> PixelSides{};             // in units of the sites' mean spacing
  double Unit = 0.0;                 // that spacing
  std::vector<double> Heights;       // squared distances of the sites from the plane
  std::int64_t Outside = 0;
  std::vector<Point<2>> Corners; // corners of the cells, counter-clockwise, in index space
  // The first corner of each site's cell, and the number of all corners.
  std::vector<std::int64_t> First;
  std::vector<double> Shares;      // shares of the area or of the mass
  std::vector<Point<2>> Centroids; // in index space
  std::vector<double> Costs; // each site's part of the mean squared distance, in squared units
};

} // namespace RectifiedTransport

#endif
