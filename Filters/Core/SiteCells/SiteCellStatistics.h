// SPDX-License-Identifier: BSD-3-Clause
// Mass, centroid and transport cost of site cells.
#ifndef RectifiedTransport_SiteCellStatistics_h
#define RectifiedTransport_SiteCellStatistics_h

#include "DensitySiteCells.h"
#include "SiteCells.h"

#include <cstdint>

namespace RectifiedTransport
{

// |x|_p^q in physical space.
struct CostNorm
{
  double Norm = 2.0;     // p, at least 1; may be infinite
  double Exponent = 2.0; // q, above 0
};

// Output arrays of one value for each site.
struct SiteCellStatistics
{
  double* Mass;
  PointSpan<3> Centroid; // in physical space
  double* Cost;          // the site cell's part of the cost
};

// Measures the site cells of `labels`, without the pixels of label -1. Sites in the same pixel
// share their mass, to the last bit. Returns the cost: the mean of |x - site|_p^q over the pixels'
// centres x, with the given positions of sites outside the domain. Throws std::overflow_error for a
// cost or a domain beyond the largest double, std::bad_alloc and Cancelled.
template <int Dimension>
double measureSiteCells(const SiteCells<Dimension>& cells, const std::int64_t* labels,
  const CostNorm& norm, const SiteCellStatistics& statistics, const Context& context = Context());

// The same for a density of mass `totalMass`: masses are those of the pixels, and centroids and the
// cost weight pixels by them. The centroid of a site cell without mass is its site.
template <int Dimension>
double measureSiteCells(const DensitySiteCells<Dimension>& cells, const std::int64_t* labels,
  double totalMass, const CostNorm& norm, const SiteCellStatistics& statistics,
  const Context& context = Context());

} // namespace RectifiedTransport

#endif
