// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Resampling/CellPieces.h"

#include "Core/Geometry/PointBounds.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{

// Calls visit(simplex) for the simplices of a cell, in index space, with the density at their
// vertices. Returns whether the cell can be divided.
template <int D>
template <class Visit>
bool CellPieces<D>::VisitSimplices(std::int64_t cell, const Visit& visit)
{
  if (!this->Divide(cell))
  {
    return false;
  }
  // Cells are divided by their reader, as VTK does; the density at a vertex is that of the point
  // or, for cell values, of the cell.
  LinearSimplex<D> simplex;
  for (std::int64_t s = 0; s < this->NumberOfSimplices(); ++s)
  {
    for (std::int64_t i = 0; i <= D; ++i)
    {
      const auto vertex = static_cast<std::size_t>(i);
      simplex.Vertices[vertex] = this->Vertex(s, i);
      simplex.Values[vertex] = this->Density.At(this->VertexId(s, i), cell);
    }
    visit(simplex);
  }
  return true;
}

// A box of the grid's axes has an exact integral of its multilinear function; other cells are
// linear on simplices.
template <int D>
void CellPieces<D>::AddTo(const GridSlab<D>& slab, std::int64_t cell)
{
  MultilinearBox<D> box;
  if (this->FindBox(cell, box))
  {
    addOverlaps<D>(box, slab);
    return;
  }
  this->VisitSimplices(
    cell, [&](const LinearSimplex<D>& simplex) { addOverlaps<D>(simplex, slab); });
}

// The mean of a linear function over a simplex, and of a multilinear one over a box, is the mean at
// the vertices.
template <int D>
CellSize CellPieces<D>::SizeOf(std::int64_t cell)
{
  // The mean at the vertices or corners.
  const auto meanOf = [](const auto& values) {
    double sum = 0.0;
    for (const double value : values)
    {
      sum += value;
    }
    return sum / static_cast<double>(values.size());
  };
  CellSize size;
  MultilinearBox<D> box;
  if (this->FindBox(cell, box))
  {
    size.Measure = 1.0;
    for (int a = 0; a < D; ++a)
    {
      size.Measure *= box.High[a] - box.Low[a];
    }
    // In grid cells, as the vertices are in index space.
    size.Integral = size.Measure * meanOf(box.Values);
    return size;
  }
  const bool divided = this->VisitSimplices(cell, [&](const LinearSimplex<D>& simplex) {
    const double measure = measureOf<D>(simplex);
    size.Measure += measure;
    size.Integral += measure * meanOf(simplex.Values);
  });
  if (!divided)
  {
    size = {};
    size.LeftOut = 1;
    size.FirstLeftOut = cell;
    this->AddBoxAround(cell, size);
  }
  return size;
}

// Adds the box around a cell as left out: no more than that is lost.
template <int D>
void CellPieces<D>::AddBoxAround(std::int64_t cell, CellSize& size)
{
  const CellReader::Ids& points = this->Reader->PointsOf(cell);
  const auto count = static_cast<double>(points.size());
  Bounds<D> bounds;
  const bool onPoints = this->Density.IsOnPoints();
  double value = onPoints ? 0.0 : this->Density.At(cell);
  for (const std::int64_t point : points)
  {
    bounds.Add(this->At(point).data());
    value += onPoints ? this->Density.At(point) / count : 0.0;
  }
  // The measure of the bounds is at least that of the cell.
  double measure = count > 0 ? 1.0 : 0.0;
  for (int a = 0; a < D && count > 0; ++a)
  {
    measure *= bounds.Length(a);
  }
  size.LeftOutMeasure += measure;
  size.LeftOutIntegral += measure * value;
}

// Returns whether the cell is a box of the grid's axes. Its corners are then in VTK's order for
// voxels and pixels: bit a of a corner's number is its side along axis a.
template <int D>
bool CellPieces<D>::FindBox(std::int64_t cell, MultilinearBox<D>& box)
{
  constexpr CellShape boxShape = D == 3 ? CellShape::Voxel : CellShape::Pixel;
  if (!this->HasBoxes || this->Reader->ShapeOf(cell) != boxShape)
  {
    return false;
  }
  constexpr std::size_t corners = std::size_t{ 1 } << D;
  const CellReader::Ids& points = this->Reader->PointsOf(cell);
  Point<D> index[corners];
  for (std::size_t i = 0; i < corners; ++i)
  {
    index[i] = this->At(points[i]);
    box.Values[i] = this->Density.At(points[i], cell);
  }
  // A pixel's axes are in order, which need not be that of the grid's. One box that does not fit
  // ends the search for boxes in this set: voxels and pixels of a set have the same axes.
  // Corners are compared relative to the box's longest side, because index space has any scale.
  constexpr double rounding = 1e-9;
  double longest = 0.0;
  for (int a = 0; a < D; ++a)
  {
    longest = std::max(longest, std::abs(index[corners - 1][a] - index[0][a]));
  }
  for (std::size_t i = 0; i < corners; ++i)
  {
    for (int a = 0; a < D; ++a)
    {
      // Corner i has the high coordinate of axis a if bit a of i is set.
      const double straight = index[(i >> a & 1) != 0 ? corners - 1 : 0][a];
      if (std::abs(index[i][a] - straight) > rounding * longest)
      {
        this->HasBoxes = false;
        return false;
      }
    }
  }
  for (int a = 0; a < D; ++a)
  {
    box.Low[a] = index[0][a];
    box.High[a] = index[corners - 1][a];
    if (!(box.Low[a] < box.High[a])) // flipped or without a measure
    {
      return false;
    }
  }
  return true;
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(CellPieces);

} // namespace RectifiedTransport
