// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Surface/TriangulatedSurface.h"

#include "Bridge/Points/CopiedTuples.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Surface/PolygonInput.h"
#include "Core/Mesh/SplitSurface.h"
#include "Core/Parallel/Stages.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr std::int64_t Grain = std::int64_t{ 1 } << 13;

} // namespace

TriangulatedSurface::TriangulatedSurface(vtkPolyData* input, Progress& progress)
  : Surface(input)
  , FirstPolygon(input->GetNumberOfVerts() + input->GetNumberOfLines())
{
  if (isAllTriangles(input))
  {
    return;
  }
  Stages stages(progress, { { "triangles", 5 }, { "cells", 2 }, { "arrays", 3 } });
  const vtkSmartPointer<vtkCellArray> triangles =
    triangulate(input->GetPoints(), input->GetPolys(), input->GetStrips(), stages["triangles"]);
  this->Surface = this->WithTriangles(triangles);
  const auto count = static_cast<std::int64_t>(triangles->GetNumberOfCells());
  withMemory("the cells of the surface's " + std::to_string(count) + " triangles",
    static_cast<double>(count) * sizeof(vtkIdType), [&]() {
      this->InputCells = LargeBuffer<vtkIdType>(count);
      this->FindInputCells(input, stages["cells"]);
    });
  this->CopyCellData(input, stages["arrays"]);
}

// What the surface is, but for the cell data and for its polygons.
vtkSmartPointer<vtkPolyData> TriangulatedSurface::WithTriangles(vtkCellArray* triangles) const
{
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(this->Surface->GetPoints());
  surface->SetVerts(this->Surface->GetVerts());
  surface->SetLines(this->Surface->GetLines());
  surface->SetPolys(triangles);
  surface->GetPointData()->PassData(this->Surface->GetPointData());
  surface->GetFieldData()->PassData(this->Surface->GetFieldData());
  return surface;
}

void TriangulatedSurface::Cut(const SplitSurface& parts, Progress& progress)
{
  const std::int64_t count = parts.NumberOfTriangles();
  withMemory("the cells of the surface's " + std::to_string(count) + " triangles",
    static_cast<double>(count) * 5.0 * sizeof(vtkIdType), [&]() {
      vtkNew<vtkCellArray> triangles;
      triangles->AllocateExact(static_cast<vtkIdType>(count), static_cast<vtkIdType>(3 * count));
      LargeBuffer<vtkIdType> inputCells(count);
      progress.ForInOrder(count, Grain, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t triangle = first; triangle < last; ++triangle)
        {
          const std::int64_t* ids = parts.Triangles() + 3 * triangle;
          triangles->InsertNextCell({ static_cast<vtkIdType>(ids[0]),
            static_cast<vtkIdType>(ids[1]), static_cast<vtkIdType>(ids[2]) });
          inputCells.data()[triangle] = this->InputCellOf(parts.GivenTriangle(triangle));
        }
      });
      const vtkSmartPointer<vtkPolyData> whole = this->Surface;
      this->Surface = this->WithTriangles(triangles);
      this->InputCells = std::move(inputCells);
      copyTuples(
        { whole->GetCellData(), whole->GetNumberOfCells(), "cell", "input surface" },
        this->Surface->GetNumberOfCells(),
        [this, &parts](vtkIdType cell) {
          return cell < this->FirstPolygon
            ? cell
            : this->CellOf(parts.GivenTriangle(cell - this->FirstPolygon));
        },
        this->Surface->GetCellData(), progress);
    });
}

std::int64_t TriangulatedSurface::NumberOfTriangles() const
{
  return this->Surface->GetPolys()->GetNumberOfCells();
}

LargeBuffer<std::int64_t> TriangulatedSurface::Corners(Progress& progress) const
{
  LargeBuffer<std::int64_t> corners(3 * this->NumberOfTriangles());
  std::int64_t* copy = corners.data();
  visitTriangles(this->Surface->GetPolys(), progress,
    [copy](std::int64_t triangle, const std::array<std::int64_t, 3>& ids) {
      std::copy_n(ids.data(), 3, copy + 3 * triangle);
    });
  return corners;
}

// triangulate() returns all triangles, in the order of the polygons and then the strips.
void TriangulatedSurface::FindInputCells(vtkPolyData* input, Progress& progress)
{
  vtkIdType* next = this->InputCells.data();
  vtkIdType before = this->FirstPolygon;
  for (vtkCellArray* cells : { input->GetPolys(), input->GetStrips() })
  {
    progress.ForInOrder(
      cells->GetNumberOfCells(), Grain,
      [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t cell = first; cell < last; ++cell)
        {
          next = std::fill_n(next, trianglesOf(cells, cell), before + static_cast<vtkIdType>(cell));
        }
      },
      RandomAccessUnits);
    before += cells->GetNumberOfCells();
  }
}

void TriangulatedSurface::CopyCellData(vtkPolyData* input, Progress& progress)
{
  copyTuples(
    { input->GetCellData(), input->GetNumberOfCells(), "cell", "input surface" },
    this->Surface->GetNumberOfCells(),
    [this](vtkIdType cell) {
      return cell < this->FirstPolygon ? cell : this->InputCells.data()[cell - this->FirstPolygon];
    },
    this->Surface->GetCellData(), progress);
}

} // namespace RectifiedTransport::Bridge
