// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Flow/TurnedCells.h"

#include "Bridge/Points/GhostFlags.h"
#include "Core/Geometry/Dispatch.h"

#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkHexagonalPrism.h"
#include "vtkHexahedron.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPentagonalPrism.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPyramid.h"
#include "vtkTetra.h"
#include "vtkUnstructuredGrid.h"
#include "vtkWedge.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr int triquadraticPyramid = 37; // VTK's name of it is newer than the oldest VTK

// Points of a cell by their numbers in its list: a line, the outline of a polygon or of a face.
using Outline = std::vector<vtkIdType>;

// What has an orientation of its own: one line, one polygon, or the faces of one volume.
using Piece = std::vector<Outline>;

Outline firstPoints(vtkIdType count)
{
  Outline outline;
  for (vtkIdType i = 0; i < count; ++i)
  {
    outline.push_back(i);
  }
  return outline;
}

template <class Cell>
Piece facesOf()
{
  Piece faces;
  for (int face = 0; face < Cell::NumberOfFaces; ++face)
  {
    const vtkIdType* points = Cell::GetFaceArray(face);
    Outline outline;
    for (int i = 0; i < Cell::MaximumFaceSize && points[i] >= 0; ++i)
    {
      outline.push_back(points[i]);
    }
    faces.push_back(outline);
  }
  return faces;
}

Piece facesOfVoxel()
{
  constexpr vtkIdType order[8] = { 0, 1, 3, 2, 4, 5, 7, 6 };
  Piece faces = facesOf<vtkHexahedron>();
  for (Outline& face : faces)
  {
    for (vtkIdType& point : face)
    {
      point = order[point];
    }
  }
  return faces;
}

// The pieces of a line of several lines.
std::vector<Piece> linesOf(vtkIdType points)
{
  std::vector<Piece> lines;
  for (vtkIdType i = 0; i + 1 < points; ++i)
  {
    lines.push_back({ { i, i + 1 } });
  }
  return lines;
}

// Every other triangle of a strip runs the other way round.
std::vector<Piece> trianglesOf(vtkIdType points)
{
  std::vector<Piece> triangles;
  for (vtkIdType i = 0; i + 2 < points; ++i)
  {
    const vtkIdType odd = i % 2;
    triangles.push_back({ { i + odd, i + 1 - odd, i + 2 } });
  }
  return triangles;
}

// Of cells of the type with so many points; none of other dimensions.
template <int D>
std::vector<Piece> piecesOf(int type, vtkIdType points);

template <>
std::vector<Piece> piecesOf<1>(int type, vtkIdType points)
{
  switch (type)
  {
    case VTK_LINE:
    case VTK_QUADRATIC_EDGE:
    case VTK_CUBIC_LINE:
    case VTK_LAGRANGE_CURVE:
    case VTK_BEZIER_CURVE:
      return linesOf(2);
    case VTK_POLY_LINE:
      return linesOf(points);
    default:
      return {};
  }
}

template <>
std::vector<Piece> piecesOf<2>(int type, vtkIdType points)
{
  switch (type)
  {
    case VTK_TRIANGLE:
    case VTK_QUADRATIC_TRIANGLE:
    case VTK_BIQUADRATIC_TRIANGLE:
    case VTK_LAGRANGE_TRIANGLE:
    case VTK_BEZIER_TRIANGLE:
      return { { firstPoints(3) } };
    case VTK_QUAD:
    case VTK_QUADRATIC_QUAD:
    case VTK_QUADRATIC_LINEAR_QUAD:
    case VTK_BIQUADRATIC_QUAD:
    case VTK_LAGRANGE_QUADRILATERAL:
    case VTK_BEZIER_QUADRILATERAL:
      return { { firstPoints(4) } };
    case VTK_PIXEL:
      return { { { 0, 1, 3, 2 } } };
    case VTK_POLYGON:
      return { { firstPoints(points) } };
    case VTK_QUADRATIC_POLYGON:
      return { { firstPoints(points / 2) } };
    case VTK_TRIANGLE_STRIP:
      return trianglesOf(points);
    default:
      return {};
  }
}

template <>
std::vector<Piece> piecesOf<3>(int type, vtkIdType /*points*/)
{
  switch (type)
  {
    case VTK_TETRA:
    case VTK_QUADRATIC_TETRA:
    case VTK_LAGRANGE_TETRAHEDRON:
    case VTK_BEZIER_TETRAHEDRON:
      return { facesOf<vtkTetra>() };
    case VTK_VOXEL:
      return { facesOfVoxel() };
    case VTK_HEXAHEDRON:
    case VTK_QUADRATIC_HEXAHEDRON:
    case VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON:
    case VTK_TRIQUADRATIC_HEXAHEDRON:
    case VTK_LAGRANGE_HEXAHEDRON:
    case VTK_BEZIER_HEXAHEDRON:
      return { facesOf<vtkHexahedron>() };
    case VTK_WEDGE:
    case VTK_QUADRATIC_WEDGE:
    case VTK_QUADRATIC_LINEAR_WEDGE:
    case VTK_BIQUADRATIC_QUADRATIC_WEDGE:
    case VTK_LAGRANGE_WEDGE:
    case VTK_BEZIER_WEDGE:
      return { facesOf<vtkWedge>() };
    case VTK_PYRAMID:
    case VTK_QUADRATIC_PYRAMID:
    case triquadraticPyramid:
    case VTK_LAGRANGE_PYRAMID:
    case VTK_BEZIER_PYRAMID:
      return { facesOf<vtkPyramid>() };
    case VTK_PENTAGONAL_PRISM:
      return { facesOf<vtkPentagonalPrism>() };
    case VTK_HEXAGONAL_PRISM:
      return { facesOf<vtkHexagonalPrism>() };
    default:
      return {};
  }
}

// The pieces of the last cell of each type, as most cells are of the same.
template <int D>
class PieceTable
{
public:
  const std::vector<Piece>& Of(int type, vtkIdType points)
  {
    if (type != this->Type || points != this->Points)
    {
      this->Type = type;
      this->Points = points;
      this->Pieces = piecesOf<D>(type, points);
    }
    return this->Pieces;
  }

private:
  int Type = -1;
  vtkIdType Points = -1;
  std::vector<Piece> Pieces;
};

void addCross(const double* a, const double* b, double* sum)
{
  sum[0] += a[1] * b[2] - a[2] * b[1];
  sum[1] += a[2] * b[0] - a[0] * b[2];
  sum[2] += a[0] * b[1] - a[1] * b[0];
}

// A signed length, area or volume, and what rounding may make of 0.
struct Measure
{
  double Value;
  double Rounding;
};

// Of points in index space. `offset` is how far its origin is from that of the coordinates.
template <int D>
Measure measure(const Piece& piece, const std::vector<Point<D>>& points, double offset)
{
  const Point<D>& first = points.front();
  double largest = offset;
  double extent = 0.0;
  for (const Outline& outline : piece)
  {
    for (const vtkIdType id : outline)
    {
      for (int a = 0; a < D; ++a)
      {
        const double x = points[static_cast<std::size_t>(id)][a];
        largest = std::max(largest, std::abs(x));
        extent = std::max(extent, std::abs(x - first[a]));
      }
    }
  }
  double value = 0.0;
  for (const Outline& outline : piece)
  {
    if (outline.size() < 2)
    {
      continue;
    }
    // Relative to the first point of all.
    double area[3] = { 0.0, 0.0, 0.0 };
    double centre[3] = { 0.0, 0.0, 0.0 };
    const auto at = [&](std::size_t i, double* x) {
      const Point<D>& point = points[static_cast<std::size_t>(outline[i % outline.size()])];
      for (int a = 0; a < D; ++a)
      {
        x[a] = point[a] - first[a];
      }
    };
    double x[3] = { 0.0, 0.0, 0.0 };
    double next[3] = { 0.0, 0.0, 0.0 };
    at(0, x);
    for (std::size_t i = 0; i < outline.size(); ++i)
    {
      at(i + 1, next);
      addCross(x, next, area);
      for (int a = 0; a < 3; ++a)
      {
        centre[a] += x[a] / static_cast<double>(outline.size());
      }
      std::copy_n(next, 3, x);
    }
    if constexpr (D == 1)
    {
      at(1, next);
      value = next[0];
    }
    else if constexpr (D == 2)
    {
      value = 0.5 * area[2];
    }
    else
    {
      value += (centre[0] * area[0] + centre[1] * area[1] + centre[2] * area[2]) / 6.0;
    }
  }
  constexpr double steps = 64.0;
  double rounding = steps * std::numeric_limits<double>::epsilon() * largest;
  for (int a = 1; a < D; ++a)
  {
    rounding *= extent;
  }
  return { value, rounding };
}

template <int D>
class TurnedCellsRun
{
public:
  TurnedCellsRun(const ImageGrid& grid, vtkPointSet* before, vtkPointSet* after)
    : Grid(grid)
    , Cells(before)
    , Blanked(before, "input")
    , Before(before->GetPoints()->GetData())
    , After(after->GetPoints()->GetData())
  {
    // Afterwards threads may read cells.
    if (auto* surface = vtkPolyData::SafeDownCast(before))
    {
      if (surface->NeedToBuildCells())
      {
        surface->BuildCells();
      }
    }
    const double origin[3] = { 0.0, 0.0, 0.0 };
    Point<D> index;
    grid.template ToIndex<D>(origin, index.data());
    for (const double x : index)
    {
      this->Offset = std::max(this->Offset, std::abs(x));
    }
  }

  TurnedCells Count(Progress& progress) const
  {
    constexpr std::int64_t grain = 1024;
    return sumExactly<TurnedCells>(progress, this->Cells->GetNumberOfCells(), grain,
      [this](std::int64_t first, std::int64_t last, TurnedCells& found) {
        Scratch scratch;
        for (vtkIdType cell = first; cell < last; ++cell)
        {
          if (!this->Blanked.Has(cell))
          {
            this->Add(cell, scratch, found);
          }
        }
      });
  }

private:
  struct Scratch
  {
    vtkNew<vtkIdList> Ids;
    PieceTable<D> Table;
    std::vector<Piece> Polyhedron{ 1 };
    std::vector<Point<D>> Before;
    std::vector<Point<D>> After;
  };

  void Add(vtkIdType cell, Scratch& scratch, TurnedCells& found) const
  {
    const int type = this->Cells->GetCellType(cell);
    if (D == 3 && type == VTK_POLYHEDRON)
    {
      this->ReadFaces(cell, scratch.Ids, scratch.Polyhedron[0]);
      this->AddPieces(scratch.Polyhedron, scratch, found);
      return;
    }
    this->Cells->GetCellPoints(cell, scratch.Ids);
    this->AddPieces(scratch.Table.Of(type, scratch.Ids->GetNumberOfIds()), scratch, found);
  }

  // The points of all faces, one face after the other.
  void ReadFaces(vtkIdType cell, vtkIdList* ids, Piece& faces) const
  {
    vtkNew<vtkIdList> stream;
    vtkUnstructuredGrid::SafeDownCast(this->Cells)->GetFaceStream(cell, stream);
    faces.assign(static_cast<std::size_t>(stream->GetId(0)), {});
    ids->Reset();
    vtkIdType place = 1;
    for (Outline& outline : faces)
    {
      const vtkIdType end = place + 1 + stream->GetId(place);
      for (++place; place < end; ++place)
      {
        outline.push_back(ids->InsertNextId(stream->GetId(place)));
      }
    }
  }

  void AddPieces(const std::vector<Piece>& pieces, Scratch& scratch, TurnedCells& found) const
  {
    const auto isEmpty = [](const Piece& piece) {
      return std::all_of(
        piece.begin(), piece.end(), [](const Outline& outline) { return outline.empty(); });
    };
    if (std::all_of(pieces.begin(), pieces.end(), isEmpty))
    {
      return;
    }
    this->Read(this->Before, scratch.Ids, scratch.Before);
    this->Read(this->After, scratch.Ids, scratch.After);
    bool isOriented = false;
    bool isTurned = false;
    for (const Piece& piece : pieces)
    {
      const Measure old = measure<D>(piece, scratch.Before, this->Offset);
      const Measure moved = measure<D>(piece, scratch.After, this->Offset);
      if (std::abs(old.Value) > old.Rounding)
      {
        isOriented = true;
        const bool isPieceTurned = std::copysign(1.0, old.Value) * moved.Value <= moved.Rounding;
        isTurned = isTurned || isPieceTurned;
        found.Area.Add(std::abs(moved.Value));
        found.TurnedArea.Add(isPieceTurned ? std::abs(moved.Value) : 0.0);
      }
    }
    found.All += isOriented ? 1 : 0;
    found.Turned += isTurned ? 1 : 0;
  }

  void Read(vtkDataArray* points, vtkIdList* ids, std::vector<Point<D>>& index) const
  {
    const vtkIdType count = ids->GetNumberOfIds();
    index.resize(static_cast<std::size_t>(count));
    for (vtkIdType i = 0; i < count; ++i)
    {
      double x[3];
      points->GetTuple(ids->GetId(i), x);
      this->Grid.template ToIndex<D>(x, index[static_cast<std::size_t>(i)].data());
    }
  }

  const ImageGrid& Grid;
  vtkPointSet* const Cells;
  const BlankedCells Blanked;
  vtkDataArray* const Before;
  vtkDataArray* const After;
  double Offset = 0.0;
};

template <int D>
TurnedCells count(
  const ImageGrid& grid, vtkPointSet* before, vtkPointSet* after, Progress& progress)
{
  return TurnedCellsRun<D>(grid, before, after).Count(progress);
}

} // namespace

TurnedCells countTurnedCells(
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
