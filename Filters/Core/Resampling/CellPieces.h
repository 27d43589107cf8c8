// SPDX-License-Identifier: BSD-3-Clause
// Cells of a data set as simplices and boxes, in the index space of a grid.
#ifndef RectifiedTransport_CellPieces_h
#define RectifiedTransport_CellPieces_h

#include "Core/Geometry/ImageGrid.h"
#include "Core/Overlap/Overlap.h"
#include "Core/Resampling/CellValues.h"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace RectifiedTransport
{

// What cells contain, in grid cells.
struct CellSize
{
  double Integral = 0.0;        // the cells' mass
  double Measure = 0.0;         // volume, area or length
  std::int64_t LeftOut = 0;     // cells that cannot be divided into simplices
  double LeftOutIntegral = 0.0; // at most, from the boxes around these
  double LeftOutMeasure = 0.0;
  std::int64_t FirstLeftOut = -1; // and its set
  std::size_t Set = 0;
};

inline CellSize operator+(const CellSize& a, const CellSize& b)
{
  const CellSize& first = a.LeftOut > 0 ? a : b;
  return { a.Integral + b.Integral, a.Measure + b.Measure, a.LeftOut + b.LeftOut,
    a.LeftOutIntegral + b.LeftOutIntegral, a.LeftOutMeasure + b.LeftOutMeasure, first.FirstLeftOut,
    first.Set };
}

// For one thread.
template <int D>
class CellPieces
{
public:
  CellPieces(const CellValues& values, const ImageGrid& grid)
    : Density(values)
    , Grid(grid)
    , Reader(values.Cells().Read())
  {
  }

  // Adds the integrals over a cell of dimension D.
  void AddTo(const GridSlab<D>& slab, std::int64_t cell);

  CellSize SizeOf(std::int64_t cell);

  // Divides a cell of dimension D into simplices. Returns whether that is possible.
  bool Divide(std::int64_t cell) { return this->Reader->Divide(cell, this->Simplices); }
  // The number of simplices of the last Divide.
  std::int64_t NumberOfSimplices() const
  {
    return static_cast<std::int64_t>(this->Simplices.size()) / (D + 1);
  }
  // The point at a vertex of a simplex, and its position in index space.
  std::int64_t VertexId(std::int64_t simplex, std::int64_t vertex) const
  {
    return this->Simplices[static_cast<std::size_t>(simplex * (D + 1) + vertex)];
  }
  Point<D> Vertex(std::int64_t simplex, std::int64_t vertex) const
  {
    return this->At(this->VertexId(simplex, vertex));
  }

private:
  Point<D> At(std::int64_t point) const
  {
    double x[3];
    this->Reader->GetPosition(point, x);
    Point<D> index;
    this->Grid.template ToIndex<D>(x, index.data());
    return index;
  }
  bool FindBox(std::int64_t cell, MultilinearBox<D>& box);
  void AddBoxAround(std::int64_t cell, CellSize& size);
  template <class Visit>
  bool VisitSimplices(std::int64_t cell, const Visit& visit);

  const CellValues& Density;
  const ImageGrid& Grid;
  const std::unique_ptr<CellReader> Reader;
  CellReader::Ids Simplices;
  bool HasBoxes = D > 1; // pixels and voxels are boxes of the grid's axes
};

} // namespace RectifiedTransport

#endif
