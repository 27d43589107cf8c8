// SPDX-License-Identifier: BSD-3-Clause
// What to put into regions so that the density of a raster, in whose cells along borders regions
// mix, has each region's mass within the region.
#ifndef RectifiedTransport_RegionValues_h
#define RectifiedTransport_RegionValues_h

#include "Core/Cartogram/RegionRaster.h"

#include <vector>

namespace RectifiedTransport
{

struct RegionValues
{
  std::vector<double> Densities; // densities of the regions
  // The exponents for RegionRaster::Scale; empty if densities alone suffice.
  std::vector<double> Exponents;
  std::vector<double> Errors;       // relative, of the masses that regions have in the raster
  std::vector<unsigned char> Least; // whether a region has as little as it can and still too much
};

struct RegionTargets
{
  const std::vector<double>& Masses; // in cells, as are densities
  const std::vector<double>& Areas;  // in cells, positive
  double Around;                     // the density of the rest
  double Least;                      // the least density of a cell
  double Tolerance;                  // relative error of the masses
};

// Densities are at least `Least`, or the mass by the area if that is less, and at most 4 times the
// mass by the area: projected Gauss-Seidel on M d = masses - what the rest gives, where M_ij is the
// sum over cells of the product of the parts that i and j cover. A thin region may have more than
// its mass from its neighbours' parts of border cells. Where errors exceed the tolerance, cells get
// the factors closest to 1, by relative entropy, with which they do not. Throws std::bad_alloc and
// Cancelled.
RegionValues findRegionValues(
  const RegionRaster& raster, const RegionTargets& targets, const Context& context = Context());

} // namespace RectifiedTransport

#endif
