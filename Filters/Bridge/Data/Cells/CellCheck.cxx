// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/Cells/CellCheck.h"

#include "Bridge/Data/Cells/CellTypes.h"
#include "Bridge/Data/GhostFlags.h"
#include "Bridge/Data/IntegerArrays.h"
#include "Core/Messages/Failure.h"

#include "vtkCell.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkExplicitStructuredGrid.h"
#include "vtkGenericCell.h"
#include "vtkIdTypeArray.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkSmartPointer.h"
#include "vtkStructuredGrid.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace RectifiedTransport::Bridge
{

namespace
{

// The beginning of messages. Cells have the numbers that the data set gives them.
std::string cellOf(vtkIdType cell, const std::string& name)
{
  return "Cell " + std::to_string(cell) + " of the " + name;
}

[[noreturn]] void failPoint(
  vtkIdType cell, std::int64_t point, std::int64_t points, const std::string& name)
{
  throw Failure(cellOf(cell, name) + " has the point " + std::to_string(point) + "; there are " +
    (points > 0 ? "points 0 to " + std::to_string(points - 1) : std::string("no points")));
}

// Checks the point ids of cells that are numbered from `first` on.
void requireIds(vtkCellArray* cells, std::int64_t points, vtkIdType first, const std::string& name)
{
  if (!cells || cells->GetNumberOfCells() <= 0)
  {
    return;
  }
  // Offsets are cells + 1 places in the connectivity, of 32 or 64 bits: cell i has the ids from
  // offset i up to offset i + 1. They come first, as the second check looks for cells by them.
  const std::int64_t ids = cells->GetConnectivityArray()->GetNumberOfValues();
  visitIntegers(cells->GetOffsetsArray(), [&](const auto& offsets) {
    std::int64_t before = 0;
    vtkIdType cell = first - 1;
    for (const auto offset : offsets)
    {
      const auto end = static_cast<std::int64_t>(offset);
      if (end < before || end > ids)
      {
        throw Failure(cellOf(std::max(cell, first), name) + " has its points from place " +
          std::to_string(before) + " to " + std::to_string(end) + " of " + std::to_string(ids) +
          " of the cells; the offsets must not descend, nor be past the end");
      }
      before = end;
      ++cell;
    }
  });
  visitIntegers(cells->GetConnectivityArray(), [&](const auto& connectivity) {
    // One pass over all ids, without a look at the cells. Only a wrong id makes it necessary to
    // find its cell.
    const auto isWrong = [points](const auto id) {
      return static_cast<std::int64_t>(id) < 0 || static_cast<std::int64_t>(id) >= points;
    };
    // Those between the cells are not read.
    for (auto found = std::find_if(connectivity.begin(), connectivity.end(), isWrong);
         found != connectivity.end(); found = std::find_if(found + 1, connectivity.end(), isWrong))
    {
      const auto place = static_cast<std::int64_t>(found - connectivity.begin());
      visitIntegers(cells->GetOffsetsArray(), [&](const auto& offsets) {
        // The first offset beyond the place ends the cell that has it. A place before the first
        // offset, or behind the last one, is in no cell.
        const auto after = std::upper_bound(
          offsets.begin(), offsets.end(), place, [](std::int64_t value, const auto offset) {
            return value < static_cast<std::int64_t>(offset);
          });
        if (after != offsets.begin() && after != offsets.end())
        {
          const auto cell = static_cast<vtkIdType>(after - offsets.begin()) - 1;
          failPoint(first + cell, static_cast<std::int64_t>(*found), points, name);
        }
      });
    }
  });
}

// The number of points of every cell type: 0 where that is not fixed and -1 where VTK has no such
// type.
using PointsOfTypes = std::array<vtkIdType, 256>;

// VTK has no table of these numbers, but an instance of each type knows its own. A type is one
// byte.
PointsOfTypes pointsOfTypes()
{
  PointsOfTypes counts;
  for (int type = 0; type < 256; ++type)
  {
    vtkIdType& count = counts[static_cast<std::size_t>(type)];
    const auto cell = vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(type));
    count = cell ? cell->GetNumberOfPoints() : -1;
    // VTK's numbers of types have gaps between linear, quadratic, and convex or higher-order cells.
    const bool isFixed = (type >= VTK_TRIANGLE && type <= VTK_HEXAGONAL_PRISM) ||
      (type >= VTK_QUADRATIC_EDGE && type < VTK_CONVEX_POINT_SET) || type == VTK_VERTEX ||
      type == VTK_LINE;
    const bool isOfAnyNumber =
      type == VTK_TRIANGLE_STRIP || type == VTK_POLYGON || type == VTK_QUADRATIC_POLYGON;
    count = count >= 0 && (!isFixed || isOfAnyNumber) ? 0 : count;
  }
  // An empty cell may have points, which nobody reads.
  counts[VTK_EMPTY_CELL] = 0;
  return counts;
}

// Whether Lagrange and Bezier cells of this type can have so many points.
bool isOfSomeOrder(int type, vtkIdType points)
{
  // Whether some order n gives the number count(n), which grows with n, so that the loop ends. VTK
  // finds the order from the number of points and reads past the end for others.
  const auto isAny = [points](const auto& count) {
    vtkIdType order = 1;
    while (count(order) < points)
    {
      ++order;
    }
    return count(order) == points;
  };
  switch (type)
  {
    case VTK_LAGRANGE_CURVE:
    case VTK_BEZIER_CURVE:
      return points >= 2;
    // The numbers 7, 15 and 21 are those of quadratic cells with further nodes in the middles of
    // their faces and of the cell.
    case VTK_LAGRANGE_TRIANGLE:
    case VTK_BEZIER_TRIANGLE:
      return points == 7 || isAny([](vtkIdType n) { return (n + 1) * (n + 2) / 2; });
    case VTK_LAGRANGE_TETRAHEDRON:
    case VTK_BEZIER_TETRAHEDRON:
      return points == 15 || isAny([](vtkIdType n) { return (n + 1) * (n + 2) * (n + 3) / 6; });
    case VTK_LAGRANGE_WEDGE:
    case VTK_BEZIER_WEDGE:
      return points == 21 || isAny([](vtkIdType n) { return (n + 1) * (n + 1) * (n + 2) / 2; });
    case VTK_LAGRANGE_QUADRILATERAL:
    case VTK_BEZIER_QUADRILATERAL:
      return isAny([](vtkIdType n) { return (n + 1) * (n + 1); });
    case VTK_LAGRANGE_HEXAHEDRON:
    case VTK_BEZIER_HEXAHEDRON:
      return isAny([](vtkIdType n) { return (n + 1) * (n + 1) * (n + 1); });
    default:
      return true;
  }
}

// Faces are a number, and of each a number of points and these.
void requireFaces(vtkUnstructuredGrid* grid, vtkIdType cell, const std::string& name)
{
#ifdef RECTIFIEDTRANSPORT_VTK_HAS_FACE_STREAMS
  const std::int64_t points = grid->GetNumberOfPoints();
  vtkIdTypeArray* faces = grid->GetFaces();
  vtkIdTypeArray* places = grid->GetFaceLocations();
  const vtkIdType size = faces ? faces->GetNumberOfValues() : 0;
  vtkIdType place = places && cell < places->GetNumberOfValues() ? places->GetValue(cell) : -1;
  // Reads the stream value by value, so that a damaged number of faces or corners ends at its end.
  const auto next = [&]() {
    if (place < 0 || place >= size)
    {
      throw Failure(cellOf(cell, name) + " is a polyhedron whose faces are not there");
    }
    return faces->GetValue(place++);
  };
  const vtkIdType count = next();
  for (vtkIdType face = 0; face < count; ++face)
  {
    const vtkIdType corners = next();
    for (vtkIdType i = 0; i < corners; ++i)
    {
      const vtkIdType point = next();
      if (point < 0 || point >= points)
      {
        failPoint(cell, point, points, name);
      }
    }
  }
#else
  vtkCellArray* places = grid->GetPolyhedronFaceLocations();
  vtkCellArray* faces = grid->GetPolyhedronFaces();
  // In this version faces are cells of an array of their own, whose ids the caller checks.
  if (!faces || !places || cell >= places->GetNumberOfCells() || places->GetCellSize(cell) == 0)
  {
    throw Failure(cellOf(cell, name) + " is a polyhedron whose faces are not there");
  }
#endif
}

// Types and connectivity come from different parts of a file. A cell with fewer points than its
// type needs would make VTK read those of the next cell, or beyond the end.
void requireTypes(vtkUnstructuredGrid* grid, const std::string& name)
{
  static const PointsOfTypes pointsOfType = pointsOfTypes();
  const vtkIdType cells = grid->GetNumberOfCells();
  const vtkDataArray* types = cells > 0 ? cellTypesOf(grid) : nullptr;
  if (cells > 0 && (!types || types->GetNumberOfValues() < cells))
  {
    throw Failure("The " + name + " has types of " +
      std::to_string(types ? types->GetNumberOfValues() : 0) + " cells, but " +
      std::to_string(cells) + " cells; there must be one for each");
  }
  // With this attribute a cell may have another order along each axis, and more numbers are
  // possible.
  const bool hasDegrees = grid->GetCellData()->GetHigherOrderDegrees() != nullptr;
  for (vtkIdType cell = 0; cell < cells; ++cell)
  {
    const int type = grid->GetCellType(cell);
    const vtkIdType needed = pointsOfType[static_cast<std::size_t>(type)];
    const vtkIdType points = grid->GetCells()->GetCellSize(cell);
    if (needed < 0)
    {
      throw Failure(
        cellOf(cell, name) + " is of type " + std::to_string(type) + ", which VTK does not have");
    }
    if (needed > points || (!hasDegrees && !isOfSomeOrder(type, points)))
    {
      throw Failure(cellOf(cell, name) + " is of type " + std::to_string(type) + " and has " +
        std::to_string(points) + " points; it must have " +
        (needed > 0 ? std::to_string(needed) : std::string("as many as its order asks")));
    }
    if (type == VTK_POLYHEDRON)
    {
      requireFaces(grid, cell, name);
    }
  }
}

// The extent of a structured grid says how many points it has, but readers may deliver fewer.
void requirePlaces(std::int64_t places, std::int64_t found, const std::string& name)
{
  if (places > found)
  {
    throw Failure("The " + name + " has " + std::to_string(found) +
      " points, but its extent is of " + std::to_string(places) + "; there must be one for each");
  }
}

// A rectilinear grid needs a coordinate for each layer of points along each axis.
void requireCoordinates(vtkRectilinearGrid* grid, const std::string& name)
{
  int size[3];
  grid->GetDimensions(size);
  vtkDataArray* coordinates[3] = { grid->GetXCoordinates(), grid->GetYCoordinates(),
    grid->GetZCoordinates() };
  for (int axis = 0; axis < 3; ++axis)
  {
    const vtkIdType found = coordinates[axis] ? coordinates[axis]->GetNumberOfTuples() : 0;
    if (found < size[axis])
    {
      throw Failure("The " + name + " has " + std::to_string(found) + " coordinates along axis " +
        std::to_string(axis) + ", but " + std::to_string(size[axis]) +
        " points; there must be one for each");
    }
  }
}

} // namespace

void requireReadableCells(vtkDataSet* data, const std::string& name)
{
  const std::int64_t points = data ? data->GetNumberOfPoints() : 0;
  if (auto* surface = vtkPolyData::SafeDownCast(data))
  {
    // Cells of a vtkPolyData are numbered kind by kind, in this order.
    vtkIdType first = 0;
    for (vtkCellArray* cells :
      { surface->GetVerts(), surface->GetLines(), surface->GetPolys(), surface->GetStrips() })
    {
      requireIds(cells, points, first, name);
      first += cells ? std::max<vtkIdType>(cells->GetNumberOfCells(), 0) : 0;
    }
  }
  else if (auto* grid = vtkUnstructuredGrid::SafeDownCast(data))
  {
    // Ids before types, as the check of types reads the sizes of cells from the offsets.
    requireIds(grid->GetCells(), points, 0, name);
#ifndef RECTIFIEDTRANSPORT_VTK_HAS_FACE_STREAMS
    vtkCellArray* faces = grid->GetPolyhedronFaces();
    requireIds(faces, points, 0, "polyhedra's faces of the " + name);
    requireIds(grid->GetPolyhedronFaceLocations(), faces ? faces->GetNumberOfCells() : 0, 0, name);
#endif
    requireTypes(grid, name);
  }
  else if (auto* hexahedra = vtkExplicitStructuredGrid::SafeDownCast(data))
  {
    requireIds(hexahedra->GetCells(), points, 0, name);
  }
  else if (auto* structured = vtkStructuredGrid::SafeDownCast(data))
  {
    // A structured grid has no ids, but must have a point for each place of its extent. Images have
    // neither points nor coordinates to check.
    int size[3];
    structured->GetDimensions(size);
    requirePlaces(std::int64_t{ size[0] } * size[1] * size[2], points, name);
  }
  else if (auto* lattice = vtkRectilinearGrid::SafeDownCast(data))
  {
    requireCoordinates(lattice, name);
  }
  // VTK reads them for the types of the cells of lattices.
  for (const int owner : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    if (data)
    {
      ghostFlags(data, owner, name.c_str());
    }
  }
}

} // namespace RectifiedTransport::Bridge
