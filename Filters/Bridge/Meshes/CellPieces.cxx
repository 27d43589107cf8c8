// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Meshes/CellPieces.h"

#include "vtkCellType.h"
#include "vtkDataSet.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkOrderedTriangulator.h"
#include "vtkPoints.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport::Bridge
{

namespace
{

template <int D>
int boxType()
{
  return D == 1 ? VTK_LINE : D == 2 ? VTK_PIXEL : VTK_VOXEL;
}

template <int D>
int simplexType()
{
  return D == 1 ? VTK_LINE : D == 2 ? VTK_TRIANGLE : VTK_TETRA;
}

// Quadratic cells that VTK leaves undivided, or of which it divides a half.
bool isDividedByNodes(int type)
{
  return type == VTK_TRIQUADRATIC_HEXAHEDRON || type == VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON ||
    type == VTK_BIQUADRATIC_QUADRATIC_WEDGE || type == VTK_QUADRATIC_LINEAR_WEDGE;
}

// The tetrahedra of the nodes of all cells of a type, by its parametric coordinates.
std::vector<vtkIdType> dividedNodes(vtkCell* cell)
{
  const vtkIdType count = cell->GetNumberOfPoints();
  vtkNew<vtkOrderedTriangulator> triangulator;
  triangulator->InitTriangulation(0.0, 1.0, 0.0, 1.0, 0.0, 1.0, static_cast<int>(count));
  double* place = cell->GetParametricCoords();
  for (vtkIdType i = 0; i < count; ++i, place += 3)
  {
    triangulator->InsertPoint(i, place, place, 0);
  }
  triangulator->Triangulate();
  vtkNew<vtkIdList> ids;
  vtkNew<vtkPoints> points;
  triangulator->AddTetras(0, ids, points);
  return { ids->GetPointer(0), ids->GetPointer(0) + ids->GetNumberOfIds() };
}

} // namespace

template <int D>
CellPieces<D>::CellPieces(const BlockValues& values, const ImageGrid& grid)
  : Data(values.Data())
  , Grid(grid)
  , Values(values.Values())
  , OnPoints(values.IsOnPoints())
  , HasBoxes(D > 1)
{
  this->Corners->SetDataTypeToDouble();
}

template <int D>
CellPieces<D>::~CellPieces() = default;

// Returns whether VTK could divide the cell.
template <int D>
template <class Visit>
bool CellPieces<D>::VisitSimplices(vtkIdType cell, const Visit& visit)
{
  if (!this->Divide(cell))
  {
    return false;
  }
  LinearSimplex<D> simplex;
  for (vtkIdType s = 0; s < this->NumberOfSimplices(); ++s)
  {
    for (vtkIdType i = 0; i <= D; ++i)
    {
      const auto vertex = static_cast<std::size_t>(i);
      simplex.Vertices[vertex] = this->Vertex(s, i);
      simplex.Values[vertex] = this->Values[this->OnPoints ? this->VertexId(s, i) : cell];
    }
    visit(simplex);
  }
  return true;
}

template <int D>
void CellPieces<D>::AddTo(const GridSlab<D>& slab, vtkIdType cell)
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

template <int D>
CellSize CellPieces<D>::SizeOf(vtkIdType cell)
{
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

// As left out.
template <int D>
void CellPieces<D>::AddBoxAround(vtkIdType cell, CellSize& size)
{
  this->Data->GetCellPoints(cell, this->Ids);
  const vtkIdType count = this->Ids->GetNumberOfIds();
  Point<D> low;
  Point<D> high;
  double value = this->OnPoints ? 0.0 : this->Values[cell];
  for (vtkIdType i = 0; i < count; ++i)
  {
    double x[3];
    const vtkIdType point = this->Ids->GetId(i);
    this->Data->GetPoint(point, x);
    Point<D> index;
    this->Grid.template ToIndex<D>(x, index.data());
    for (int a = 0; a < D; ++a)
    {
      low[a] = i == 0 ? index[a] : std::min(low[a], index[a]);
      high[a] = i == 0 ? index[a] : std::max(high[a], index[a]);
    }
    value += this->OnPoints ? this->Values[point] / static_cast<double>(count) : 0.0;
  }
  double measure = count > 0 ? 1.0 : 0.0;
  for (int a = 0; a < D && count > 0; ++a)
  {
    measure *= high[a] - low[a];
  }
  size.LeftOutMeasure += measure;
  size.LeftOutIntegral += measure * value;
}

template <int D>
bool CellPieces<D>::Divide(vtkIdType cell)
{
  if (this->Data->GetCellType(cell) == simplexType<D>())
  {
    this->Data->GetCellPoints(cell, this->Ids);
    return true;
  }
  this->Data->GetCell(cell, this->Cell);
  if (this->Cell->GetNumberOfPoints() <= D) // which VTK's strips do not expect
  {
    this->Ids->Reset();
    return true;
  }
  if (D == 3 && isDividedByNodes(this->Cell->GetCellType()))
  {
    std::vector<vtkIdType>& nodes = this->DividedNodes[this->Cell->GetCellType()];
    nodes = nodes.empty() ? dividedNodes(this->Cell) : nodes;
    this->Ids->Reset();
    for (const vtkIdType node : nodes)
    {
      this->Ids->InsertNextId(this->Cell->GetPointId(static_cast<int>(node)));
    }
    return true;
  }
  const bool divided = this->Cell->Triangulate(0, this->Ids, this->Corners) != 0;
  // vtkPyramid divides itself, and then says that it has not where one diagonal is the shorter.
  return divided || (D == 3 && this->Ids->GetNumberOfIds() > 0);
}

template <int D>
vtkIdType CellPieces<D>::NumberOfSimplices() const
{
  return this->Ids->GetNumberOfIds() / (D + 1);
}

template <int D>
vtkIdType CellPieces<D>::VertexId(vtkIdType simplex, vtkIdType vertex) const
{
  return this->Ids->GetId(simplex * (D + 1) + vertex);
}

template <int D>
Point<D> CellPieces<D>::Vertex(vtkIdType simplex, vtkIdType vertex) const
{
  double x[3];
  this->Data->GetPoint(this->VertexId(simplex, vertex), x);
  Point<D> index;
  this->Grid.template ToIndex<D>(x, index.data());
  return index;
}

// Returns whether the cell is a box of the grid's axes.
template <int D>
bool CellPieces<D>::FindBox(vtkIdType cell, MultilinearBox<D>& box)
{
  if (!this->HasBoxes || this->Data->GetCellType(cell) != boxType<D>())
  {
    return false;
  }
  constexpr std::size_t corners = std::size_t{ 1 } << D;
  this->Data->GetCellPoints(cell, this->Ids);
  Point<D> index[corners];
  for (std::size_t i = 0; i < corners; ++i)
  {
    const vtkIdType point = this->Ids->GetId(static_cast<vtkIdType>(i));
    double x[3];
    this->Data->GetPoint(point, x);
    this->Grid.template ToIndex<D>(x, index[i].data());
    box.Values[i] = this->Values[this->OnPoints ? point : cell];
  }
  // A pixel's axes are in order, which need not be that of the grid's.
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

template class CellPieces<1>;
template class CellPieces<2>;
template class CellPieces<3>;

} // namespace RectifiedTransport::Bridge
