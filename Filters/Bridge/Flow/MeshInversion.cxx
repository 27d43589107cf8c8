// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Flow/MeshInversion.h"

#include "Bridge/Data/Cells/MeshCells.h"
#include "Core/Geometry/Dispatch.h"

#include "vtkCellType.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

// Adds the triangles at a polygon's first corner, or the tetrahedra of these and an apex. Their
// signed measures have the same sum as those of any others.
template <class Iterator>
void addFan(Iterator first, Iterator end, const CellReader::Ids& apex, CellReader::Ids& vertices)
{
  for (Iterator corner = first; end - corner > 2; ++corner)
  {
    vertices.insert(vertices.end(), apex.begin(), apex.end());
    vertices.insert(vertices.end(), { *first, corner[1], corner[2] });
  }
}

// Adds tetrahedra between the faces of a polyhedron, which all point outwards, and one corner.
void addFaces(vtkPointSet* cells, vtkIdType cell, CellReader::Ids& vertices)
{
  vtkNew<vtkIdList> stream;
  vtkUnstructuredGrid::SafeDownCast(cells)->GetFaceStream(cell, stream);
  const vtkIdType* face = stream->GetPointer(0) + 1;
  const CellReader::Ids apex{ face[1] };
  for (vtkIdType faces = stream->GetId(0); faces > 0; --faces)
  {
    const vtkIdType* end = face + 1 + *face;
    addFan(face + 1, end, apex, vertices);
    face = end;
  }
}

// Finds the vertices of the simplices that a cell consists of. Returns whether it can be divided.
// VTK takes a time for polygons that grows as the square of their corners, and 70 times as long as
// this for polyhedra.
bool findSimplices(
  vtkPointSet* cells, CellReader& reader, vtkIdType cell, CellReader::Ids& vertices)
{
  vertices.clear();
  const CellShape shape = reader.ShapeOf(cell);
  if (shape == CellShape::Quad || shape == CellShape::Polygon)
  {
    const CellReader::Ids& corners = reader.PointsOf(cell);
    addFan(corners.begin(), corners.end(), {}, vertices);
    return true;
  }
  if (cells->GetCellType(cell) == VTK_POLYHEDRON)
  {
    addFaces(cells, cell, vertices);
    return true;
  }
  return reader.Divide(cell, vertices);
}

template <int D>
InvertedCells count(
  const ImageGrid& grid, vtkPointSet* before, vtkPointSet* after, Progress& progress)
{
  auto* surface = vtkPolyData::SafeDownCast(before);
  if (surface && surface->NeedToBuildCells())
  {
    surface->BuildCells(); // afterwards threads may read cells
  }
  const MeshCells cells(before, "input");
  const double origin[3] = { 0.0, 0.0, 0.0 };
  Point<D> index;
  grid.ToIndex<D>(origin, index.data());
  double offset = 0.0; // how far the origin of index space is from that of the coordinates
  for (const double x : index)
  {
    offset = std::max(offset, std::abs(x));
  }
  constexpr std::int64_t grain = 1024;
  return sumExactly<InvertedCells>(progress, before->GetNumberOfCells(), grain,
    [&](std::int64_t first, std::int64_t last, InvertedCells& found) {
      const auto reader = cells.Read();
      CellReader::Ids vertices;
      std::vector<Point<D>> places;
      std::vector<Point<D>> moved;
      for (vtkIdType cell = first; cell < last; ++cell)
      {
        if (cells.HiddenCells.Has(cell) || reader->DimensionOf(cell) != D ||
          !findSimplices(before, *reader, cell, vertices) || vertices.empty())
        {
          continue;
        }
        places.resize(vertices.size());
        moved.resize(vertices.size());
        for (std::size_t i = 0; i < vertices.size(); ++i)
        {
          double x[3];
          reader->GetPosition(vertices[i], x);
          grid.ToIndex<D>(x, places[i].data());
          after->GetPoint(static_cast<vtkIdType>(vertices[i]), x);
          grid.ToIndex<D>(x, moved[i].data());
        }
        const int type = before->GetCellType(cell);
        const bool hasPieces = type == VTK_POLY_LINE || type == VTK_TRIANGLE_STRIP;
        const auto simplices = static_cast<std::int64_t>(vertices.size() / (D + 1));
        found.AddCell<D>(places, moved, hasPieces ? simplices : 1, offset);
      }
    });
}

} // namespace

InvertedCells countInvertedCells(
  const ImageGrid& grid, vtkPointSet* before, vtkPointSet* after, Progress& progress)
{
  if (before->GetNumberOfCells() == 0 || before->GetNumberOfPoints() == 0)
  {
    return {};
  }
  return dispatchDimension(grid.Dimension(), count<1>, count<2>, count<3>)(
    grid, before, after, progress);
}

} // namespace RectifiedTransport::Bridge
