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
  std::vector<double> Densities;    // of the regions
  std::vector<double> Errors;       // relative, of the masses that regions have in the raster
  std::vector<unsigned char> Least; // whether a region has the least density and still too much
};

// `masses` and `around`, the density of the rest, in cells; areas in cells, positive. Densities are
// at least `least` of `around`, or the mass by the area if that is less, and at most 4 times that.
// Projected Gauss-Seidel on M d = masses - what the rest gives, where M_ij is the sum over cells of
// the product of the parts that i and j cover. Throws std::bad_alloc and Cancelled.
RegionValues findRegionValues(const RegionRaster& raster, const std::vector<double>& masses,
  const std::vector<double>& areas, double around, double least,
  const Context& context = Context());

} // namespace RectifiedTransport

#endif
