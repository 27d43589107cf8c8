// SPDX-License-Identifier: BSD-3-Clause
// The vtkCells that a move of the points turns over.
#ifndef RectifiedTransport_TurnedCells_h
#define RectifiedTransport_TurnedCells_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/ExactSum.h"
#include "Core/Parallel/Progress.h"

#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN
class vtkPointSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

struct TurnedCells
{
  std::int64_t Turned = 0;
  std::int64_t All = 0; // that have an orientation
  // The sums of their measures, as they are moved.
  ExactSum TurnedArea{};
  ExactSum Area{};

  void Add(const TurnedCells& other)
  {
    this->Turned += other.Turned;
    this->All += other.All;
    this->TurnedArea.Add(other.TurnedArea);
    this->Area.Add(other.Area);
  }
};

// Of the cells of as many dimensions as the grid: lines, polygons seen along the grid's normal, or
// volumes, by the lines between their corners. A cell counts if its signed length, area or volume
// is not 0 before, and has the other sign or is 0 after; a strip or a line of several pieces if one
// of its pieces does. Ghost cells do not count. `before` has the cells, `after` the moved points.
// Throws Failure and Cancelled.
TurnedCells countTurnedCells(
  const ImageGrid& grid, vtkPointSet* before, vtkPointSet* after, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
