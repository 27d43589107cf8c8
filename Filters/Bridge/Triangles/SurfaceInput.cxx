// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Triangles/SurfaceInput.h"

#include "Bridge/Data/Cells/CellCheck.h"
#include "Bridge/Data/TupleCopy.h"
#include "Bridge/Run/Inputs/InputBlock.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Triangles/PolygonInput.h"
#include "Core/Parallel/Stages.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataObject.h"
#include "vtkGeometryFilter.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <string>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

// Cells between two polls for abort.
constexpr std::int64_t Grain = std::int64_t{ 1 } << 13;

enum Part
{
  Vertices,
  Lines,
  Polygons,
  Strips,
  NoPart // cells of three dimensions, or with curved sides
};

// The cell array of vtkPolyData that takes cells of a type. Curved cells, such as quadratic
// triangles, have none: vtkPolyData would take their points for corners.
Part partOf(int cellType)
{
  switch (cellType)
  {
    case VTK_VERTEX:
    case VTK_POLY_VERTEX:
      return Vertices;
    case VTK_LINE:
    case VTK_POLY_LINE:
      return Lines;
    case VTK_TRIANGLE:
    case VTK_QUAD:
    case VTK_PIXEL:
    case VTK_POLYGON:
      return Polygons;
    case VTK_TRIANGLE_STRIP:
      return Strips;
    default:
      return NoPart;
  }
}

// Whether a grid holds only cells that vtkPolyData can have. Clip and Threshold make unstructured
// grids of surfaces, which keep their points here, so that no array has to be interpolated.
bool isFlat(vtkPointSet* grid, Progress& progress)
{
  bool isFlat = true;
  progress.ForInOrder(
    grid->GetNumberOfCells(), Grain,
    [&](std::int64_t first, std::int64_t last) {
      for (auto cell = static_cast<vtkIdType>(first); cell < last && isFlat; ++cell)
      {
        // The first cell that is not flat ends the search.
        const int type = grid->GetCellType(cell);
        isFlat = type == VTK_EMPTY_CELL || partOf(type) != NoPart; // that or one that is blanked
      }
    },
    RandomAccessUnits);
  return isFlat;
}

// The cells of one part, appended to `ids`.
vtkSmartPointer<vtkCellArray> cellsOf(
  vtkPointSet* grid, Part part, std::vector<vtkIdType>& ids, Progress& progress)
{
  // One pass over all cells for each part: cell data of vtkPolyData are in the order of the parts,
  // so that `ids` must be, too.
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  vtkNew<vtkIdList> points;
  progress.ForInOrder(
    grid->GetNumberOfCells(), Grain,
    [&](std::int64_t first, std::int64_t last) {
      for (auto cell = static_cast<vtkIdType>(first); cell < last; ++cell)
      {
        const int type = grid->GetCellType(cell);
        if (partOf(type) != part)
        {
          continue;
        }
        grid->GetCellPoints(cell, points);
        // The points of a pixel run in rows, those of a polygon around it: the last two change
        // places.
        if (type == VTK_PIXEL && points->GetNumberOfIds() == 4)
        {
          std::swap(points->GetPointer(0)[2], points->GetPointer(0)[3]);
        }
        cells->InsertNextCell(points);
        ids.push_back(cell);
      }
    },
    RandomAccessUnits);
  return cells;
}

// Flat cells on all points of the grid; `ids` are theirs.
vtkSmartPointer<vtkPolyData> surfaceOf(
  vtkPointSet* grid, std::vector<vtkIdType>& ids, Progress& progress)
{
  Parts parts(progress, NoPart + 1);
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  // Points and their arrays are shared with the input, also points that no cell uses.
  surface->SetPoints(grid->GetPoints());
  surface->SetVerts(cellsOf(grid, Vertices, ids, parts[Vertices]));
  surface->SetLines(cellsOf(grid, Lines, ids, parts[Lines]));
  surface->SetPolys(cellsOf(grid, Polygons, ids, parts[Polygons]));
  surface->SetStrips(cellsOf(grid, Strips, ids, parts[Strips]));
  surface->GetPointData()->PassData(grid->GetPointData());
  surface->GetFieldData()->PassData(grid->GetFieldData());
  vtkCellData* data = surface->GetCellData();
  // vtkDataSetAttributes leaves out global ids by default; here each cell stays one cell.
  data->CopyAllOn();
  copyTuples(
    { grid->GetCellData(), grid->GetNumberOfCells(), "cell", "input" },
    static_cast<std::int64_t>(ids.size()),
    [&ids](vtkIdType cell) { return ids[static_cast<std::size_t>(cell)]; }, data, parts[NoPart]);
  return surface;
}

// The outer surface of cells of three dimensions, and flat pieces of curved ones. `ids` are the
// cells that they are of.
vtkSmartPointer<vtkPolyData> outerSurfaceOf(vtkPointSet* grid, std::vector<vtkIdType>& ids)
{
  // A name that arrays of an input hardly have.
  constexpr const char* name = "RectifiedTransportCellIds";
  // vtkGeometryFilter copies tuples without a look at the lengths of arrays.
  requireTuples(grid, "input");
  vtkNew<vtkGeometryFilter> filter;
  filter->SetInputData(grid);
  filter->PassThroughCellIdsOn();
  filter->SetOriginalCellIdsName(name);
  filter->Update();
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  // A data object of its own, which is not the output of the filter any more.
  surface->ShallowCopy(filter->GetOutput());
  vtkCellData* data = surface->GetCellData();
  auto* found = vtkIdTypeArray::SafeDownCast(data->GetAbstractArray(name));
  // The filter reports no error to its caller: an output without ids is the sign.
  if (!found)
  {
    throw Failure(
      "The outer surface of the input could not be taken; take it with Extract Surface");
  }
  ids.assign(found->GetPointer(0), found->GetPointer(0) + found->GetNumberOfValues());
  // The ids serve InputCellOf alone; outputs must not have the array.
  data->RemoveArray(name);
  return surface;
}

} // namespace

SurfaceInput::SurfaceInput(vtkDataObject* input, Progress& progress)
{
  // In a composite input, a block may have any type, as the executive checks only the whole.
  auto* set = requireBlock<vtkPointSet>(
    input, "The input", "a vtkPolyData or a grid, or what Extract Surface makes of it");
  if (!set || set->GetNumberOfPoints() == 0)
  {
    return;
  }
  this->Surface = vtkPolyData::SafeDownCast(set);
  if (this->Surface)
  {
    return;
  }
  const vtkIdType cells = set->GetNumberOfCells();
  // About 16 ids a cell: its corners, its offset and the cell of the input, with a reserve.
  requireMemory({ "the surface of " + std::to_string(cells) + " cells of the input",
    16.0 * sizeof(vtkIdType) * static_cast<double>(cells) });
  // VTK reads cells of damaged files past the end of their arrays.
  requireReadableCells(set, "input surface");
  Stages stages(progress, { { "types", 1 }, { "cells", 9 } });
  if (isFlat(set, stages["types"]))
  {
    this->Surface = surfaceOf(set, this->Cells, stages["cells"]);
    return;
  }
  this->Surface = outerSurfaceOf(set, this->Cells);
  // vtkGeometryFilter does not poll for abort: one poll follows it.
  progress.Check();
}

} // namespace RectifiedTransport::Bridge
