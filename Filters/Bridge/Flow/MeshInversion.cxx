// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Flow/MeshInversion.h"

#include "Bridge/Data/GhostFlags.h"
#include "Core/Geometry/Dispatch.h"

#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr int triquadraticPyramid = 37; // VTK's name of it is newer than the oldest VTK
constexpr int allCorners = 0;

// The corners of a cell are the first of its points.
struct TypesOfShape
{
  OrientedShape Shape;
  int Corners;
  std::initializer_list<int> Types;
};

const TypesOfShape shapes[] = {
  { OrientedShape::Line, allCorners,
    { VTK_LINE, VTK_QUADRATIC_EDGE, VTK_CUBIC_LINE, VTK_LAGRANGE_CURVE, VTK_BEZIER_CURVE } },
  { OrientedShape::PolyLine, allCorners, { VTK_POLY_LINE } },
  { OrientedShape::Polygon, 3,
    { VTK_TRIANGLE, VTK_QUADRATIC_TRIANGLE, VTK_BIQUADRATIC_TRIANGLE, VTK_LAGRANGE_TRIANGLE,
      VTK_BEZIER_TRIANGLE } },
  { OrientedShape::Polygon, 4,
    { VTK_QUAD, VTK_QUADRATIC_QUAD, VTK_QUADRATIC_LINEAR_QUAD, VTK_BIQUADRATIC_QUAD,
      VTK_LAGRANGE_QUADRILATERAL, VTK_BEZIER_QUADRILATERAL } },
  { OrientedShape::Pixel, allCorners, { VTK_PIXEL } },
  { OrientedShape::Polygon, allCorners, { VTK_POLYGON, VTK_QUADRATIC_POLYGON } },
  { OrientedShape::TriangleStrip, allCorners, { VTK_TRIANGLE_STRIP } },
  { OrientedShape::Tetrahedron, allCorners,
    { VTK_TETRA, VTK_QUADRATIC_TETRA, VTK_LAGRANGE_TETRAHEDRON, VTK_BEZIER_TETRAHEDRON } },
  { OrientedShape::Voxel, allCorners, { VTK_VOXEL } },
  { OrientedShape::Hexahedron, allCorners,
    { VTK_HEXAHEDRON, VTK_QUADRATIC_HEXAHEDRON, VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON,
      VTK_TRIQUADRATIC_HEXAHEDRON, VTK_LAGRANGE_HEXAHEDRON, VTK_BEZIER_HEXAHEDRON } },
  { OrientedShape::Wedge, allCorners,
    { VTK_WEDGE, VTK_QUADRATIC_WEDGE, VTK_QUADRATIC_LINEAR_WEDGE, VTK_BIQUADRATIC_QUADRATIC_WEDGE,
      VTK_LAGRANGE_WEDGE, VTK_BEZIER_WEDGE } },
  { OrientedShape::Pyramid, allCorners,
    { VTK_PYRAMID, VTK_QUADRATIC_PYRAMID, triquadraticPyramid, VTK_LAGRANGE_PYRAMID,
      VTK_BEZIER_PYRAMID } },
  { OrientedShape::PentagonalPrism, allCorners, { VTK_PENTAGONAL_PRISM } },
  { OrientedShape::HexagonalPrism, allCorners, { VTK_HEXAGONAL_PRISM } },
};

template <int D>
std::vector<OrientedPiece> piecesOfType(int type, vtkIdType points)
{
  const auto* found =
    std::find_if(std::begin(shapes), std::end(shapes), [type](const TypesOfShape& shape) {
      return std::find(shape.Types.begin(), shape.Types.end(), type) != shape.Types.end();
    });
  if (found == std::end(shapes))
  {
    return {};
  }
  const vtkIdType corners = type == VTK_QUADRATIC_POLYGON ? points / 2
    : found->Corners != allCorners                        ? found->Corners
                                                          : points;
  return orientedPieces<D>(found->Shape, corners);
}

// The cells of one range: most are of the same type as the one before.
template <int D>
class CellReader
{
public:
  explicit CellReader(vtkPointSet* cells)
    : Cells(cells)
  {
  }

  void Read(vtkIdType cell)
  {
    const int type = this->Cells->GetCellType(cell);
    if (D == 3 && type == VTK_POLYHEDRON)
    {
      this->Type = type;
      this->ReadFaces(cell);
      return;
    }
    this->Cells->GetCellPoints(cell, this->Ids);
    const vtkIdType points = this->Ids->GetNumberOfIds();
    if (type != this->Type || points != this->Points)
    {
      this->Type = type;
      this->Points = points;
      this->Pieces = piecesOfType<D>(type, points);
    }
  }
  const std::vector<OrientedPiece>& PiecesOfCell() const { return this->Pieces; }
  // Its points in index space.
  void ReadPlaces(vtkDataArray* points, const ImageGrid& grid, std::vector<Point<D>>& places) const
  {
    places.resize(static_cast<std::size_t>(this->Ids->GetNumberOfIds()));
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      double x[3];
      points->GetTuple(this->Ids->GetId(static_cast<vtkIdType>(i)), x);
      grid.ToIndex<D>(x, places[i].data());
    }
  }

private:
  // The points of all faces, one face after the other.
  void ReadFaces(vtkIdType cell)
  {
    vtkNew<vtkIdList> stream;
    vtkUnstructuredGrid::SafeDownCast(this->Cells)->GetFaceStream(cell, stream);
    this->Pieces.assign(1, OrientedPiece(static_cast<std::size_t>(stream->GetId(0))));
    this->Ids->Reset();
    vtkIdType place = 1;
    for (PieceOutline& outline : this->Pieces[0])
    {
      const vtkIdType end = place + 1 + stream->GetId(place);
      for (++place; place < end; ++place)
      {
        outline.push_back(this->Ids->InsertNextId(stream->GetId(place)));
      }
    }
  }

  vtkPointSet* const Cells;
  vtkNew<vtkIdList> Ids;
  std::vector<OrientedPiece> Pieces;
  int Type = -1;
  vtkIdType Points = -1;
};

template <int D>
InvertedCells count(
  const ImageGrid& grid, vtkPointSet* before, vtkPointSet* after, Progress& progress)
{
  auto* surface = vtkPolyData::SafeDownCast(before);
  if (surface && surface->NeedToBuildCells())
  {
    surface->BuildCells(); // afterwards threads may read cells
  }
  const unsigned char* ghosts = ghostFlags(before, vtkDataObject::CELL, "input");
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
      CellReader<D> reader(before);
      std::vector<Point<D>> places;
      std::vector<Point<D>> moved;
      for (vtkIdType cell = first; cell < last; ++cell)
      {
        if (ghosts && (ghosts[cell] & ghostCell))
        {
          continue;
        }
        reader.Read(cell);
        if (!reader.PiecesOfCell().empty())
        {
          reader.ReadPlaces(before->GetPoints()->GetData(), grid, places);
          reader.ReadPlaces(after->GetPoints()->GetData(), grid, moved);
          found.AddCell<D>(reader.PiecesOfCell(), places, moved, offset);
        }
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
