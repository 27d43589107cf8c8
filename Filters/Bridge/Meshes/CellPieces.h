// SPDX-License-Identifier: BSD-3-Clause
// Cells of a data set as simplices and boxes, in the index space of a grid.
#ifndef RectifiedTransport_CellPieces_h
#define RectifiedTransport_CellPieces_h

#include "Bridge/Blocks/BlockValues.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Overlap/Overlap.h"

#include "vtkNew.h"
#include "vtkType.h"

#include <cstdint>
#include <map>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataSet;
class vtkGenericCell;
class vtkIdList;
class vtkPoints;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// What cells contain, in grid cells.
struct CellSize
{
  double Integral = 0.0; // of the density
  double Measure = 0.0;
  std::int64_t LeftOut = 0;     // cells that VTK could not divide into simplices
  double LeftOutIntegral = 0.0; // at most: of the boxes around these
  double LeftOutMeasure = 0.0;
  vtkIdType FirstLeftOut = -1; // and its block
  std::size_t Block = 0;
};

inline CellSize operator+(const CellSize& a, const CellSize& b)
{
  const CellSize& first = a.LeftOut > 0 ? a : b;
  return { a.Integral + b.Integral, a.Measure + b.Measure, a.LeftOut + b.LeftOut,
    a.LeftOutIntegral + b.LeftOutIntegral, a.LeftOutMeasure + b.LeftOutMeasure, first.FirstLeftOut,
    first.Block };
}

// For one thread.
template <int D>
class CellPieces
{
public:
  CellPieces(const BlockValues& values, const ImageGrid& grid);
  ~CellPieces();
  CellPieces(const CellPieces&) = delete;
  CellPieces& operator=(const CellPieces&) = delete;

  // Adds the integrals over a cell of dimension D.
  void AddTo(const GridSlab<D>& slab, vtkIdType cell);

  CellSize SizeOf(vtkIdType cell);

  // Divides a cell of dimension D into simplices. Returns whether VTK could.
  bool Divide(vtkIdType cell);
  // The number of simplices of the last Divide.
  vtkIdType NumberOfSimplices() const;
  // The data set's point at a vertex of a simplex, and its position in index space.
  vtkIdType VertexId(vtkIdType simplex, vtkIdType vertex) const;
  Point<D> Vertex(vtkIdType simplex, vtkIdType vertex) const;

private:
  bool FindBox(vtkIdType cell, MultilinearBox<D>& box);
  void AddBoxAround(vtkIdType cell, CellSize& size);
  template <class Visit>
  bool VisitSimplices(vtkIdType cell, const Visit& visit);

  vtkDataSet* Data;
  const ImageGrid& Grid;
  const double* Values;
  const bool OnPoints;
  bool HasBoxes; // pixels and voxels are boxes of the grid's axes
  vtkNew<vtkGenericCell> Cell;
  vtkNew<vtkIdList> Ids;
  vtkNew<vtkPoints> Corners;
  std::map<int, std::vector<vtkIdType>> DividedNodes; // of types of cells
};

} // namespace RectifiedTransport::Bridge

#endif
