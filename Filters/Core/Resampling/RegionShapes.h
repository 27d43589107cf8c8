// SPDX-License-Identifier: BSD-3-Clause
// Cells of a plane that are filled by the even-odd rule: polygons of any shape, and the closed
// lines of a set together.
#ifndef RectifiedTransport_RegionShapes_h
#define RectifiedTransport_RegionShapes_h

#include "Core/Geometry/ImageGrid.h"
#include "Core/Overlap/RegionOutlines.h"
#include "Core/Resampling/CellValues.h"
#include "Core/Resampling/GridSlabs.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// Marks the cells that are regions instead of being divided: polygons other than triangles and
// convex quadrilaterals. With point values, polygons that their set divides into triangles of the
// same area stay divided. Throws Cancelled.
void markRegions(std::vector<CellValues>& sets, const ImageGrid& grid, Progress& progress);

// The regions of one polygon, or of the closed lines of a set; in index space. Read once.
struct RegionShape
{
  int Set;
  Rings Outline;
  std::vector<std::int64_t> Points; // one for each point of the rings
  std::vector<double> PointValues;  // if the density is on points
  std::vector<std::int64_t> Cells;  // cells, by rings
  std::vector<double> Values;       // densities of the rings' regions
  std::vector<OutlineEdge> Edges;   // result of regionOutlines

  // Calls visit(ring, first, last) with the edges of the region of each ring that has one.
  template <class Visit>
  void VisitRegions(const Visit& visit) const
  {
    const OutlineEdge* end = this->Edges.data() + this->Edges.size();
    for (const OutlineEdge* first = this->Edges.data(); first != end;)
    {
      const std::int32_t ring = first->Ring;
      const OutlineEdge* last =
        std::find_if(first, end, [=](const OutlineEdge& edge) { return edge.Ring != ring; });
      visit(ring, first, last);
      first = last;
    }
  }
};

// Shapes that are processed together.
struct RegionBatch
{
  struct Edge
  {
    std::int32_t Shape;
    std::int32_t Edge;
  };
  std::vector<RegionShape> Shapes;
  Bins<Edge> Slabs; // the edges that reach each, in the order of the shapes and their edges

  const RegionShape& ShapeOf(const Edge& edge) const
  {
    return this->Shapes[static_cast<std::size_t>(edge.Shape)];
  }
  const OutlineEdge& At(const Edge& edge) const
  {
    return this->ShapeOf(edge).Edges[static_cast<std::size_t>(edge.Edge)];
  }
  // Whether two edges are of the same region.
  bool IsSame(const Edge& a, const Edge& b) const
  {
    return a.Shape == b.Shape && this->At(a).Ring == this->At(b).Ring;
  }
};

// Calls use(batch) for all regions in their order. Edges reach slabs that are nearer than `margin`
// grid cells. Throws Cancelled.
void visitRegions(const std::vector<CellValues>& sets, const ImageGrid& grid,
  const GridSlabs<2>& slabs, double margin, Progress& progress,
  const std::function<void(const RegionBatch&)>& use);

} // namespace RectifiedTransport

#endif
