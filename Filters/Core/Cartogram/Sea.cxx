// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Cartogram/Sea.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace RectifiedTransport
{

namespace
{

constexpr double nothing = 1e-7; // relative to the mean density: the ground with SeaDensity Zero

// Returns the density of the sea in the given map, at least 1e-7 of the mean.
double densityBefore(const CartogramOptions& options, const CartogramBox& box, double mean,
  const std::vector<double>& masses, const std::vector<double>& areas)
{
  double density = 0.0;
  if (options.Sea == SeaDensity::Minimum)
  {
    density = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < masses.size(); ++i)
    {
      density = std::min(density, masses[i] / areas[i]);
    }
  }
  else if (options.Sea == SeaDensity::Value)
  {
    // From mass per area to mass per cell.
    density = options.SeaValue * box.Cell * box.Cell;
  }
  return std::max(density, nothing * mean);
}

} // namespace

Sea::Sea(const CartogramOptions& options, const CartogramBox& box, const RegionRaster& raster,
  const std::vector<double>& masses, const std::vector<double>& areas)
  : Options(options)
  , Mean(sumAll(masses) / sumAll(areas))
{
  if (options.Sea == SeaDensity::Mean)
  {
    return;
  }
  // The area of the box in cells, and the part that regions cover.
  const double all = static_cast<double>(box.Side) * static_cast<double>(box.Side);
  const double rest = raster.UncoveredArea();
  const double covered = all - rest;
  this->Land = sumAll(areas);
  this->Mass = rest * densityBefore(options, box, this->Mean, masses, areas);
  // At the uniform measure, areas are in proportion to masses: land gets (its mass) / (all mass) of
  // the box.
  this->GrowthOfLand = this->Mean * covered / (this->Mean * covered + this->Mass) * all / covered;
}

double Sea::DensityOf(const RegionRaster& raster, const std::vector<double>& masses,
  const std::vector<double>& areas, bool takesRoots) const
{
  const double mean = sumAll(masses) / sumAll(areas);
  const double rest = this->Options.Sea == SeaDensity::Mean ? 0.0 : raster.UncoveredArea();
  if (!(rest > 0.0))
  {
    return mean;
  }
  // With roots, the sea's mass is halfway on a logarithmic scale, too.
  const double plain = rest * this->Mean;
  const double mass = takesRoots ? plain * std::sqrt(this->Mass / plain) : this->Mass;
  return std::max(mass / rest, nothing * mean);
}

// With the mean density the sea keeps its area, so the land does, too.
bool Sea::LeavesLand(const std::vector<double>& areas) const
{
  return this->Options.Sea == SeaDensity::Mean ||
    std::abs(sumAll(areas) / (this->Land * this->GrowthOfLand) - 1.0) <= this->Options.Tolerance;
}

} // namespace RectifiedTransport
