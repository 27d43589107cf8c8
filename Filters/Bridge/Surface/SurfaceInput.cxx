// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Surface/SurfaceInput.h"

#include "Bridge/Points/CellCheck.h"
#include "Bridge/Points/CopiedTuples.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Inputs/InputBlock.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Surface/PolygonInput.h"

#include "vtkAlgorithm.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataObject.h"
#include "vtkGeometryFilter.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationStringVectorKey.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr std::int64_t Grain = std::int64_t{ 1 } << 13;

enum Part
{
  Vertices,
  Lines,
  Polygons,
  Strips,
  NoPart // of three dimensions, or with curved sides
};

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

// Cells of a grid that a vtkPolyData can have, in its order.
struct PolyDataCells
{
  std::array<vtkSmartPointer<vtkCellArray>, NoPart> Parts;
  std::array<std::vector<vtkIdType>, NoPart> Ids; // in the grid
  std::int64_t Others = 0;
};

PolyDataCells cellsOf(vtkPointSet* grid, Progress& progress)
{
  PolyDataCells cells;
  for (vtkSmartPointer<vtkCellArray>& part : cells.Parts)
  {
    part = vtkSmartPointer<vtkCellArray>::New();
  }
  vtkNew<vtkIdList> points;
  progress.ForInOrder(
    grid->GetNumberOfCells(), Grain,
    [&](std::int64_t first, std::int64_t last) {
      for (auto cell = static_cast<vtkIdType>(first); cell < last; ++cell)
      {
        const int type = grid->GetCellType(cell);
        const Part part = partOf(type);
        if (part == NoPart)
        {
          cells.Others += type == VTK_EMPTY_CELL ? 0 : 1; // that or one that is blanked
          continue;
        }
        grid->GetCellPoints(cell, points);
        if (type == VTK_PIXEL && points->GetNumberOfIds() == 4)
        {
          std::swap(points->GetPointer(0)[2], points->GetPointer(0)[3]);
        }
        cells.Parts[part]->InsertNextCell(points);
        cells.Ids[part].push_back(cell);
      }
    },
    RandomAccessUnits);
  return cells;
}

LargeBuffer<vtkIdType> joined(const std::array<std::vector<vtkIdType>, NoPart>& parts)
{
  std::size_t count = 0;
  for (const std::vector<vtkIdType>& part : parts)
  {
    count += part.size();
  }
  LargeBuffer<vtkIdType> all(static_cast<std::int64_t>(count));
  vtkIdType* next = all.data();
  for (const std::vector<vtkIdType>& part : parts)
  {
    next = std::copy(part.begin(), part.end(), next);
  }
  return all;
}

vtkSmartPointer<vtkPolyData> surfaceOf(vtkPointSet* grid, const PolyDataCells& cells,
  const LargeBuffer<vtkIdType>& ids, Progress& progress)
{
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(grid->GetPoints());
  surface->SetVerts(cells.Parts[Vertices]);
  surface->SetLines(cells.Parts[Lines]);
  surface->SetPolys(cells.Parts[Polygons]);
  surface->SetStrips(cells.Parts[Strips]);
  surface->GetPointData()->PassData(grid->GetPointData());
  surface->GetFieldData()->PassData(grid->GetFieldData());
  vtkCellData* data = surface->GetCellData();
  data->CopyAllOn();
  copyTuples(
    { grid->GetCellData(), grid->GetNumberOfCells(), "cell", "input" }, ids.size(),
    [&ids](vtkIdType cell) { return ids.data()[cell]; }, data, progress);
  return surface;
}

// The outer surface of cells of three dimensions, and flat pieces of curved ones. `ids` are the
// cells that they are of.
vtkSmartPointer<vtkPolyData> outerSurfaceOf(vtkPointSet* grid, LargeBuffer<vtkIdType>& ids)
{
  constexpr const char* name = "RectifiedTransportCellIds";
  requireTuples(grid, "input");
  vtkNew<vtkGeometryFilter> filter;
  filter->SetInputData(grid);
  filter->PassThroughCellIdsOn();
  filter->SetOriginalCellIdsName(name);
  filter->Update();
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->ShallowCopy(filter->GetOutput());
  vtkCellData* data = surface->GetCellData();
  auto* found = vtkIdTypeArray::SafeDownCast(data->GetAbstractArray(name));
  if (!found)
  {
    throw Failure(
      "The outer surface of the input could not be taken; take it with Extract Surface");
  }
  ids = LargeBuffer<vtkIdType>(found->GetNumberOfValues());
  std::copy_n(found->GetPointer(0), ids.size(), ids.data());
  data->RemoveArray(name);
  return surface;
}

} // namespace

void SurfaceInput::Require(vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkStructuredGrid");
}

SurfaceInput::SurfaceInput(vtkDataObject* input, Progress& progress)
{
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
  const auto cells = static_cast<double>(set->GetNumberOfCells());
  const std::string purpose =
    "the surface of " + std::to_string(set->GetNumberOfCells()) + " cells of the input";
  constexpr double bytesOfCell = 16.0 * sizeof(vtkIdType);
  requireMemory(purpose, cells * bytesOfCell);
  requireReadableCells(set, "input surface");
  const PolyDataCells found = cellsOf(set, progress);
  if (found.Others > 0)
  {
    this->Surface = outerSurfaceOf(set, this->Cells);
    progress.Check();
    return;
  }
  this->Cells = joined(found.Ids);
  this->Surface = surfaceOf(set, found, this->Cells, progress);
}

} // namespace RectifiedTransport::Bridge
