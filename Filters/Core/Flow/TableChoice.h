// SPDX-License-Identifier: BSD-3-Clause
// Which tables the flow of a density has, by the property Tables and by its use.
#ifndef RectifiedTransport_TableChoice_h
#define RectifiedTransport_TableChoice_h

#include "Core/Flow/FlowTables.h"
#include "Core/Geometry/Points.h"
#include "Core/Parallel/MemoryPlan.h"

#include <string>

namespace RectifiedTransport
{

enum class TableSetting
{
  Auto,
  Whole,
  Tiled
};

// What the choice of tables depends on in an advection.
struct TableUse
{
  FlowOptions Options;
  FlowDirection Direction;
  double Particles;
  bool IsLattice;
  std::string WholeFor; // what only whole tables give; empty for nothing
};

// For WholeFor.
constexpr const char* EqualAreas = "equal areas (EqualizeAreas)";

struct TableChoice
{
  FlowTables Tables = FlowTables::Whole;
  MemoryPlan Memory; // for tiles, to check before the work
};

// The tables of a density of this size. Auto means tiles above 2^26 grid cells if they support the
// use. Throws Failure if Tiled is set and tiles do not support the use.
template <int D>
TableChoice chooseTables(TableSetting setting, const GridSize<D>& size, const TableUse& use);

// The same for MeasuresOfShares of this number of boxes.
template <int D>
TableChoice chooseTablesForShares(
  TableSetting setting, const GridSize<D>& size, const Point<D>& aspect, double boxes);

} // namespace RectifiedTransport

#endif
