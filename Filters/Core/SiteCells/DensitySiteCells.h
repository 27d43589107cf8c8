// SPDX-License-Identifier: BSD-3-Clause
// Site cells of equal mass of a density: as SiteCells, but every site gets an equal share of the
// mass, not of the pixels. The flow of the density takes pixels and sites to the uniform measure.
// There the pixels flow to the sites.
//
//   const RectifiedFlow<2> flow(density);                         // density: a DensitySource<2>
//   const DensitySiteCells<2> cells(sites, grid, density, flow.Total()); // grid: on its domain
//   std::vector<std::int64_t> labels(grid.NumberOfCells());
//   cells.Label(flow, labels.data());
#ifndef RectifiedTransport_DensitySiteCells_h
#define RectifiedTransport_DensitySiteCells_h

#include "../Flow/FlowOptions.h"
#include "../Geometry/ImageGrid.h"
#include "../Parallel/Context.h"
#include "../Tables/Density.h"
#include "PixelMasses.h"
#include "SiteGroups.h"

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

namespace RectifiedTransport
{

template <int Dimension>
class RectifiedFlow;

// Thrown if there are more sites than pixels with mass.
class TooFewPixels : public std::invalid_argument
{
public:
  TooFewPixels(std::int64_t sites, std::int64_t pixels);
  std::int64_t PixelsWithMass() const { return this->Pixels; }

private:
  std::int64_t Pixels;
};

// With fewer steps sites would catch too many pixels that are not theirs, as isolated ones; the way
// from the uniform measure to the sites has as many.
constexpr int leastStepsOfSiteCells = 128;

template <int Dimension>
class DensitySiteCells
{
public:
  // `grid` has the domain of the density and any number of cells, which are the pixels. `total` is
  // the sum of the density's values, which must be valid, as those of a RectifiedFlow. There is at
  // least one site; coordinates are finite. Sites outside the domain count as the nearest points of
  // its border. Takes 8 bytes a pixel. Throws TooFewPixels, std::bad_alloc and Cancelled.
  DensitySiteCells(ConstPointSpan<3> sites, const ImageGrid& grid,
    const DensitySource<Dimension>& density, double total, const Context& context = Context());

  const ImageGrid& Grid() const { return this->Place; }
  const PixelMasses<Dimension>& Masses() const { return *this->Pixels; }
  ConstPointSpan<3> Sites() const { return this->Given; }
  // The sites in the index space of the grid, moved into the domain.
  ConstPointSpan<Dimension> IndexSites() const { return this->Inside; }
  std::int64_t NumberOfSites() const { return static_cast<std::int64_t>(this->Given.size()); }
  std::int64_t NumberOutside() const { return this->Outside; }

  // Writes the number of the site of each pixel, axis 0 fastest, and -1 for pixels without mass;
  // `flow` is that of the density. Masses are equal to about that of the heaviest pixel. What is
  // cut off from its site cell has more than a tenth of a site's mass. In 1D, cells are intervals
  // in the order of the sites, and the flow is not used. Temporarily takes about 50 and 57 bytes a
  // pixel in 2D and 3D. Reports the way of the sites to the uniform measure. Throws
  // std::invalid_argument for options, std::bad_alloc and Cancelled.
  FlowReport Label(const RectifiedFlow<Dimension>& flow, std::int64_t* labels,
    const FlowOptions& options = {}, const Context& context = Context()) const;

private:
  void LabelIntervals(std::int64_t* labels) const;
  SiteGroups LabelGroups(const RectifiedFlow<Dimension>& flow, std::int64_t* labels,
    const FlowOptions& options, const Context& context, FlowReport& report) const;
  void MergeGroups(const RectifiedFlow<Dimension>& flow, const std::vector<Point<Dimension>>& even,
    SiteGroups& groups, std::int64_t* labels, const FlowOptions& options,
    const Context& context) const;

  ImageGrid Place;
  std::vector<Point<3>> Given;
  std::vector<Point<Dimension>> Inside;
  std::optional<PixelMasses<Dimension>> Pixels;
  std::int64_t Outside = 0;
};

} // namespace RectifiedTransport

#endif
