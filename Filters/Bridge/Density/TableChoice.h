// SPDX-License-Identifier: BSD-3-Clause
// Which tables the flow of a density has, by the property Tables and by its use.
#ifndef RectifiedTransport_TableChoice_h
#define RectifiedTransport_TableChoice_h

#include "Bridge/Run/Settings/TableSettings.h"
#include "Core/Flow/FlowTables.h"
#include "Core/Geometry/Points.h"

#include <string>

namespace RectifiedTransport::Bridge
{

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

// The tables of a density of this size, for a value in range. Auto means tiles above 2^26 grid
// cells if they support the use. Throws Failure if Tiled is set and tiles do not support the use or
// do not fit in memory.
template <int D>
FlowTables chooseTables(TableSetting setting, const GridSize<D>& size, const TableUse& use);

// The same for MeasuresOfShares of this number of boxes.
template <int D>
FlowTables chooseTablesForShares(
  TableSetting setting, const GridSize<D>& size, const Point<D>& aspect, double boxes);

} // namespace RectifiedTransport::Bridge

#endif
