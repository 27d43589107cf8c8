// SPDX-License-Identifier: BSD-3-Clause
// Which region contains a place, and between which points of its outline the place lies.
#ifndef RectifiedTransport_RegionRows_h
#define RectifiedTransport_RegionRows_h

#include "Core/Geometry/PointBounds.h"
#include "Core/Resampling/RegionShapes.h"

#include <cstdint>

namespace RectifiedTransport
{

// Points of cells around a place.
struct MeshLocation
{
  double Distance; // squared, in grid cells; infinite while there is none
  std::int64_t Cell;
  std::int64_t Points[4];
  double Weights[4];
  int Set;
};

// The edges of one region in a slab, by rows of grid cells.
class RegionRows
{
public:
  using Edges = Bins<RegionBatch::Edge>::Range;

  // Places are in rows [low, high).
  RegionRows(const RegionBatch& batch, const Edges& edges, std::int64_t low, std::int64_t high);

  const Bounds<2>& Extent() const { return this->Box; }

  // A place in the region is between the outline to its left and to its right. Any other place is
  // at the nearest point of the outline; infinitely far if that is farther than the diagonal of a
  // grid cell.
  MeshLocation Find(const Point<2>& x) const;

private:
  std::size_t RowOf(double y) const;
  void SetEnds(
    const RegionBatch::Edge& edge, double part, double weight, int at, MeshLocation& found) const;
  bool FindInside(const Point<2>& x, MeshLocation& found) const;
  void FindNearest(const Point<2>& x, MeshLocation& found) const;

  const RegionBatch& Batch;
  Bounds<2> Box; // bounds of the edges
  std::int64_t FirstRow;
  std::int64_t LastRow;
  Bins<RegionBatch::Edge> Rows; // by rows of grid cells
};

} // namespace RectifiedTransport

#endif
