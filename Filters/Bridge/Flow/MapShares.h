// SPDX-License-Identifier: BSD-3-Clause
// The masses in the cells of a lattice of samples.
#ifndef RectifiedTransport_MapShares_h
#define RectifiedTransport_MapShares_h

#include "Core/Flow/RectifiedFlow.h"
#include "Core/Geometry/LatticePart.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace RectifiedTransport::Bridge
{

// Prepares them for a part of the lattice. Collective.
template <int D>
void prepareShares(
  const RectifiedFlow<D>& flow, const GridSize<D>& lattice, const LatticePart<D>& part)
{
  const Point<D> step = latticeStep<D>(lattice, flow.Size());
  GridSize<D> low{};
  GridSize<D> high{};
  for (int a = 0; a < D && part.Count() > 0; ++a)
  {
    low[a] = static_cast<std::int64_t>(static_cast<double>(part.Low[a]) * step[a]);
    const double end = std::ceil(static_cast<double>(part.Low[a] + part.Cells[a]) * step[a]);
    high[a] = std::min(flow.Size()[a], static_cast<std::int64_t>(end) + 1);
  }
  flow.PrepareShares(low, high);
}

} // namespace RectifiedTransport::Bridge

#endif
