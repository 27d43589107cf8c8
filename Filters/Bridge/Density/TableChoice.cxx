// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/TableChoice.h"

#include "Bridge/Run/Memory.h"
#include "Core/Flow/FlowMapShape.h"
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Geometry/Boxes/SizedGrids.h"
#include "Core/Messages/Failure.h"

namespace RectifiedTransport::Bridge
{

namespace
{

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

// findRefusal() is why tiles do not serve, empty if they do; findMemory() what they take.
template <int D, class FindRefusal, class FindMemory>
FlowTables choose(TableSetting setting, const GridSize<D>& size, const FindRefusal& findRefusal,
  const FindMemory& findMemory)
{
  constexpr double large = 1 << 26; // grid cells: 2.1 GB of whole tables in 3D
  const bool isAsked = setting == TableSetting::Tiled;
  if (!isAsked && (setting != TableSetting::Auto || numberOfCells<D>(size) <= large))
  {
    return FlowTables::Whole;
  }
  const std::string reason = findRefusal();
  if (!reason.empty())
  {
    if (isAsked)
    {
      throw Failure("Tables is Tiled, which " + reason + "; Tables = Whole does, or Auto");
    }
    return FlowTables::Whole;
  }
  requireMemory({ "the tiles of a density of " + describeSize<D>(size) + " cells", findMemory() });
  return FlowTables::Tiled;
}

} // namespace

template <int D>
FlowTables chooseTables(TableSetting setting, const GridSize<D>& size, const TableUse& use)
{
  return choose<D>(
    setting, size, [&]() { return refusal<D>(size, use); },
    [&]() {
      return RectifiedFlow<D>::TiledMemoryFor(
        size, use.Options, use.Direction, use.Particles, use.IsLattice);
    });
}

template <int D>
FlowTables chooseTablesForShares(
  TableSetting setting, const GridSize<D>& size, const Point<D>& aspect, double boxes)
{
  return choose<D>(
    setting, size, []() { return std::string(D == 1 ? oneAxis : ""); },
    [&]() { return RectifiedFlow<D>::TiledSharesMemoryFor(size, aspect, boxes); });
}

template FlowTables chooseTables<1>(TableSetting, const GridSize<1>&, const TableUse&);
template FlowTables chooseTables<2>(TableSetting, const GridSize<2>&, const TableUse&);
template FlowTables chooseTables<3>(TableSetting, const GridSize<3>&, const TableUse&);
template FlowTables chooseTablesForShares<1>(
  TableSetting, const GridSize<1>&, const Point<1>&, double);
template FlowTables chooseTablesForShares<2>(
  TableSetting, const GridSize<2>&, const Point<2>&, double);
template FlowTables chooseTablesForShares<3>(
  TableSetting, const GridSize<3>&, const Point<3>&, double);

} // namespace RectifiedTransport::Bridge
