// SPDX-License-Identifier: BSD-3-Clause
// The cells of a vtkPolyData in the order in which they are drawn.
#ifndef RectifiedTransport_PolyDataShapes_h
#define RectifiedTransport_PolyDataShapes_h

#include "Bridge/Data/Cells/CellCheck.h"
#include "Bridge/Data/GhostFlags.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Progress.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <string>

namespace RectifiedTransport::Bridge
{

enum class ShapeKind
{
  Polygon, // or a triangle of a strip
  Line,
  Dot // one point
};

struct Shape
{
  ShapeKind Kind;
  const vtkIdType* Points;
  vtkIdType Count; // the number of points, at least 1
  vtkIdType Cell;  // -1 for a point of data without cells
};

// Polygons first, then strips, lines, and on top the points of vertices; without any cells, all
// points. Without cells of no points, and what ghost arrays mark as duplicate or hidden.
class PolyDataShapes
{
public:
  // Throws Failure if cells have points that do not exist; `name` is what messages call the data.
  PolyDataShapes(vtkPolyData* data, const std::string& name)
    : Input(data)
    , HasCells(data->GetNumberOfCells() > 0)
    , GhostPoints(ghostFlags(data, vtkDataObject::POINT, name.c_str()))
    , GhostCells(ghostFlags(data, vtkDataObject::CELL, name.c_str()))
  {
    requireReadableCells(data, name);
  }

  vtkPolyData* Data() const { return this->Input; }
  // An upper bound, as units of work.
  std::int64_t Count() const
  {
    return this->HasCells ? this->Input->GetNumberOfCells() : this->Input->GetNumberOfPoints();
  }

  // Calls visit(shape) for all of them. Throws Cancelled.
  template <class Visit>
  void ForEach(Progress& progress, const Visit& visit) const
  {
    vtkPolyData* data = this->Input;
    const vtkIdType lines = data->GetNumberOfVerts();
    const vtkIdType polygons = lines + data->GetNumberOfLines();
    const vtkIdType strips = polygons + data->GetNumberOfPolys();
    this->OfCells(data->GetPolys(), polygons, ShapeKind::Polygon, progress, visit);
    const auto visitStrip = [&](const Shape& strip) {
      for (vtkIdType i = 0; i + 2 < strip.Count; ++i)
      {
        visit(Shape{ strip.Kind, strip.Points + i, 3, strip.Cell });
      }
    };
    this->OfCells(data->GetStrips(), strips, ShapeKind::Polygon, progress, visitStrip);
    this->OfCells(data->GetLines(), lines, ShapeKind::Line, progress, visit);
    const auto visitVertices = [&](const Shape& cell) {
      for (vtkIdType i = 0; i < cell.Count; ++i)
      {
        this->Dot(cell.Points[i], cell.Cell, visit);
      }
    };
    this->OfCells(data->GetVerts(), 0, ShapeKind::Dot, progress, visitVertices);
    for (vtkIdType point = 0; !this->HasCells && point < data->GetNumberOfPoints(); ++point)
    {
      this->Dot(point, -1, visit);
      progress.Add(1);
    }
  }

private:
  template <class Visit>
  void OfCells(vtkCellArray* cells, vtkIdType cell, ShapeKind kind, Progress& progress,
    const Visit& visit) const
  {
    if (!cells)
    {
      return;
    }
    const auto iterator = vtkSmartPointer<vtkCellArrayIterator>::Take(cells->NewIterator());
    for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
    {
      Shape shape{ kind, nullptr, 0, cell++ };
      iterator->GetCurrentCell(shape.Count, shape.Points);
      const bool isGhost = this->GhostCells && (this->GhostCells[shape.Cell] & ghostCell);
      if (shape.Count > 0 && !isGhost)
      {
        visit(shape);
      }
      progress.Add(1);
    }
  }

  template <class Visit>
  void Dot(vtkIdType point, vtkIdType cell, const Visit& visit) const
  {
    if (!this->GhostPoints || !(this->GhostPoints[point] & ghostPoint))
    {
      visit(Shape{ ShapeKind::Dot, &point, 1, cell });
    }
  }

  vtkPolyData* Input;
  bool HasCells;
  const unsigned char* GhostPoints;
  const unsigned char* GhostCells;
};

} // namespace RectifiedTransport::Bridge

#endif
