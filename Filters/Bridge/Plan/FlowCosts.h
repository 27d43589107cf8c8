// SPDX-License-Identifier: BSD-3-Clause
// Estimated times of the tables and the optimal map of a density, in the units of CostModel.h.
#ifndef RectifiedTransport_FlowCosts_h
#define RectifiedTransport_FlowCosts_h

#include "Bridge/Plan/FlowCache.h"
#include "Bridge/Run/CostModel.h"

namespace RectifiedTransport::Bridge
{

namespace Cost
{

inline double tables(const FlowCache& cache, const InputDensity& density)
{
  constexpr double cell = 10.0;
  return cache.IsOutdated(density) ? cell * static_cast<double>(density.Grid().NumberOfCells())
                                   : 0.0;
}

// The cost of the optimal map, where it has to be solved.
inline double optimal(
  const FlowCache& cache, const InputDensity& density, const OptimalSetting& setting)
{
  const bool mustSolve =
    cache.MustSolve(setting) || (setting.NeedsMap() && cache.IsOutdated(density));
  return mustSolve ? OptimalCell * static_cast<double>(density.Grid().NumberOfCells()) : 0.0;
}

} // namespace Cost

} // namespace RectifiedTransport::Bridge

#endif
