// SPDX-License-Identifier: BSD-3-Clause
// The density of sites on a grid of pixels: mass 1 for each site in its pixel (paper, Section 4.2).
#ifndef RectifiedTransport_SiteDensity_h
#define RectifiedTransport_SiteDensity_h

#include "../Tables/Density.h"
#include "SiteGroups.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// The pixels that hold sites, in ascending order, and the sites of each. Pixels are numbered with
// axis 0 fastest.
template <int Dimension>
class SiteDensity final : public DensityValues
{
public:
  // The sites lie in the box [0, size].
  SiteDensity(const GridSize<Dimension>& size, ConstPointSpan<Dimension> sites);

  operator DensitySource<Dimension>() const { return { this->Grid, *this }; }
  const GridSize<Dimension>& Size() const { return this->Grid; }
  void Read(std::int64_t first, std::int64_t count, double* values) const override;

  // The groups of sites that share a pixel, in the order of the pixels; sites ascend.
  const SiteGroups& Groups() const { return this->Grouped; }
  std::int64_t NumberOfSites() const { return this->Grouped.NumberOfSites(); }
  std::int64_t NumberOfPixels() const { return static_cast<std::int64_t>(this->Pixels.size()); }
  std::int64_t Pixel(std::int64_t k) const { return this->Pixels[k]; }
  // Returns the k for which Pixel(k) is `pixel`, which must hold a site.
  std::int64_t Find(std::int64_t pixel) const;
  std::int64_t SitesIn(std::int64_t k) const { return this->Grouped.SitesIn(k); }
  // Returns site i of those in pixel k; they ascend.
  std::int64_t Site(std::int64_t k, std::int64_t i) const { return this->Grouped.Site(k, i); }

private:
  GridSize<Dimension> Grid;
  std::vector<std::int64_t> Pixels;
  SiteGroups Grouped;
};

} // namespace RectifiedTransport

#endif
