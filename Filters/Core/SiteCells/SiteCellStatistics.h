// SPDX-License-Identifier: BSD-3-Clause
// What the cells of sites weigh, where their middles are, and what the way to the sites costs.
#ifndef RectifiedTransport_SiteCellStatistics_h
#define RectifiedTransport_SiteCellStatistics_h

#include "Core/SiteCells/SiteCells.h"

#include <cstdint>

namespace RectifiedTransport
{

// |x|_p^q in physical space.
struct CostNorm
{
  double Norm = 2.0;     // p, at least 1; may be infinite
  double Exponent = 2.0; // q, above 0
};

// What is written of each cell, in memory with room for all sites.
struct SiteCellStatistics
{
  double* Mass;          // sites in one pixel share their mass, to the last bit
  PointSpan<3> Centroid; // in physical space
  double* Cost;          // the cell's part of the cost
};

// Measures the cells of which these are the labels. Returns the cost: the mean of |x - site|_p^q
// over the pixels' centres x, of sites outside of the domain from where they are. Throws
// std::overflow_error for a cost or a domain past the largest double, std::bad_alloc and Cancelled.
template <int Dimension>
double measureSiteCells(const SiteCells<Dimension>& cells, const std::int64_t* labels,
  const CostNorm& norm, const SiteCellStatistics& statistics, const Context& context = Context());

} // namespace RectifiedTransport

#endif
