// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/TableChoice.h"

#include "Core/Flow/FlowMapShape.h"
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Geometry/Boxes/GridResolution.h"
#include "Core/Messages/Failure.h"

namespace RectifiedTransport
{

namespace
{

// Messages continue "Tables is Tiled, which".
constexpr const char* oneAxis = "takes densities of two or three axes";

// Why tiles do not serve; empty if they do.
template <int D>
std::string refusal(const GridSize<D>& size, const TableUse& use)
{
  if (D == 1)
  {
    return oneAxis;
  }
  if (!use.WholeFor.empty())
  {
    return "does not give " + use.WholeFor;
  }
  if (!takesFlowMaps(use.Options))
  {
    return "needs Integrator Multistep and TableLookup Interpolated";
  }
  return servesTiles<D>(size, use.Options, use.Direction)
    ? ""
    : "takes more than the NumberOfSteps " + std::to_string(use.Options.NumberOfSteps) +
      " for a density of " + describeSize<D>(size) + " cells";
}

template <int D>
bool wantsTiles(TableSetting setting, const GridSize<D>& size)
{
  constexpr double large = 1 << 26; // grid cells: 2.1 GB of whole tables in 3D
  return setting == TableSetting::Tiled ||
    (setting == TableSetting::Auto && numberOfCells<D>(size) > large);
}

// For a density that wants tiles. `refusal`: why they do not serve, empty if they do. findMemory()
// is what they take.
template <int D, class FindMemory>
TableChoice choose(TableSetting setting, const GridSize<D>& size, const std::string& refusal,
  const FindMemory& findMemory)
{
  if (refusal.empty())
  {
    return { FlowTables::Tiled,
      { "the tiles of a density of " + describeSize<D>(size) + " cells", findMemory() } };
  }
  if (setting == TableSetting::Tiled)
  {
    throw Failure("Tables is Tiled, which " + refusal + "; Tables = Whole does, or Auto");
  }
  return {};
}

} // namespace

template <int D>
TableChoice chooseTables(TableSetting setting, const GridSize<D>& size, const TableUse& use)
{
  if (!wantsTiles<D>(setting, size))
  {
    return {};
  }
  // The estimate of memory is made only if tiles are taken.
  return choose<D>(setting, size, refusal<D>(size, use), [&]() {
    return RectifiedFlow<D>::TiledMemoryFor(
      size, use.Options, use.Direction, use.Particles, use.IsLattice);
  });
}

template <int D>
TableChoice chooseTablesForShares(
  TableSetting setting, const GridSize<D>& size, const Point<D>& aspect, double boxes)
{
  if (!wantsTiles<D>(setting, size))
  {
    return {};
  }
  return choose<D>(setting, size, D == 1 ? oneAxis : "",
    [&]() { return RectifiedFlow<D>::TiledSharesMemoryFor(size, aspect, boxes); });
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(chooseTables);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(chooseTablesForShares);

} // namespace RectifiedTransport
