// SPDX-License-Identifier: BSD-3-Clause
// The ground around the regions of a map, as a density of a raster.
#ifndef RectifiedTransport_Sea_h
#define RectifiedTransport_Sea_h

#include "Core/Cartogram/Cartogram.h"
#include "Core/Cartogram/RegionRaster.h"

#include <numeric>
#include <vector>

namespace RectifiedTransport
{

// The mass or the area of all regions together.
inline double sumAll(const std::vector<double>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// The sea keeps the mass that its density gives it in the given map, and the land gets the other
// part of the box. With the mean density, which each pass computes anew, both keep their areas.
class Sea
{
public:
  // The raster is of the map as it is; `masses` and `areas`, in cells, are the regions'.
  Sea(const CartogramOptions& options, const CartogramBox& box, const RegionRaster& raster,
    const std::vector<double>& masses, const std::vector<double>& areas);

  // Returns the factor by which the area of all regions is to grow.
  double Growth() const { return this->GrowthOfLand; }
  // The density of a pass, in mass per cell; `takesRoots` if its masses are plain masses times
  // roots of what they are to be.
  double DensityOf(const RegionRaster& raster, const std::vector<double>& masses,
    const std::vector<double>& areas, bool takesRoots) const;
  // Whether all regions together have the area that the sea leaves.
  bool LeavesLand(const std::vector<double>& areas) const;

private:
  const CartogramOptions& Options;
  double Mean;       // the density of all regions
  double Mass = 0.0; // mass of the sea
  double Land = 0.0; // area of the land before
  double GrowthOfLand = 1.0;
};

} // namespace RectifiedTransport

#endif
