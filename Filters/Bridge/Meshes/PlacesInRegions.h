// SPDX-License-Identifier: BSD-3-Clause
// Which region contains a place, and between which points of its outline the place lies.
#ifndef RectifiedTransport_PlacesInRegions_h
#define RectifiedTransport_PlacesInRegions_h

#include "Bridge/Meshes/RegionShapes.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// The edges of one region in a slab, by rows of grid cells.
class RegionRows
{
public:
  // Edges [first, last) of the batch are those of one region; places are in rows [low, high).
  RegionRows(const RegionBatch& batch, std::size_t first, std::size_t last, std::int64_t low,
    std::int64_t high);

  Point<2> Low() const { return this->Lower; }
  Point<2> High() const { return this->Upper; }

  // Points of the outline around a place, and its distance, squared.
  struct Found
  {
    double Distance;
    vtkIdType Cell;
    vtkIdType Points[4];
    double Weights[4];
  };
  // A place in the region is between the outline to its left and to its right. Any other place is
  // at the nearest point of the outline; infinitely far if that is farther than the diagonal of a
  // grid cell.
  Found Find(const Point<2>& x) const;

private:
  std::int64_t RowOf(double y) const;
  void SetEnds(
    const RegionBatch::Edge& edge, double part, double weight, int at, Found& found) const;
  bool FindInside(const Point<2>& x, Found& found) const;
  void FindNearest(const Point<2>& x, Found& found) const;

  const RegionBatch& Batch;
  Point<2> Lower;
  Point<2> Upper;
  std::int64_t FirstRow;
  std::vector<std::size_t> Begin;
  std::vector<RegionBatch::Edge> Sorted;
};

} // namespace RectifiedTransport

#endif
