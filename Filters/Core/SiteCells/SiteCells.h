// SPDX-License-Identifier: BSD-3-Clause
// Site cells of equal mass: every pixel of a domain is assigned to one of the given sites, equally
// many to each. The rectified flow transports the pixels to the sites (paper, Section 4.2, Figure
// 5). Then the site cells are made equal to one pixel, and sites in the same pixel divide its cell.
//
//   const ImageGrid grid = ...;                            // its cells are the pixels
//   const std::vector<Point<3>> sites = ...;               // in physical space
//   const auto labels = labelSiteCells<2>(sites, grid);    // one-off
//
//   SiteCells<2> cells(sites, grid);                       // for more figures of the cells, see
//   cells.Label(labels.data());                            // SiteCellStatistics.h
#ifndef RectifiedTransport_SiteCells_h
#define RectifiedTransport_SiteCells_h

#include "../Flow/FlowOptions.h"
#include "../Geometry/ImageGrid.h"
#include "../Parallel/Context.h"
#include "SiteDensity.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace RectifiedTransport
{

template <int Dimension>
class SiteCells
{
public:
  // There is at least one site; coordinates are finite. Sites outside the domain count as the
  // nearest points of its border. Throws std::invalid_argument for more sites than pixels,
  // std::bad_alloc and Cancelled.
  SiteCells(ConstPointSpan<3> sites, const ImageGrid& grid, const Context& context = Context());

  const ImageGrid& Grid() const { return this->Place; }
  ConstPointSpan<3> Sites() const { return this->Given; }
  // The pixels that hold sites.
  const SiteDensity<Dimension>& Pixels() const { return *this->Density; }
  std::int64_t NumberOfSites() const { return this->Pixels().NumberOfSites(); }
  std::int64_t NumberOutside() const { return this->Outside; }

  // Writes the number of the site of each pixel, axis 0 fastest. Temporarily takes about 21, 34 and
  // 33 bytes a pixel in 1D, 2D and 3D. Reports the way of the pixels to the sites. Throws
  // std::invalid_argument for options, std::bad_alloc and Cancelled.
  FlowReport Label(std::int64_t* labels, const FlowOptions& options = {},
    const Context& context = Context()) const;

private:
  ImageGrid Place;
  std::vector<Point<3>> Given;
  std::vector<Point<Dimension>> Inside; // in index space
  std::optional<SiteDensity<Dimension>> Density;
  std::int64_t Outside = 0;
};

// One-off: only the labels. Throws what the constructor and Label throw.
template <int Dimension>
std::vector<std::int64_t> labelSiteCells(ConstPointSpan<3> sites, const ImageGrid& grid,
  const FlowOptions& options = {}, const Context& context = Context());

} // namespace RectifiedTransport

#endif
