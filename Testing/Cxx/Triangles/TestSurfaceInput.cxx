// SPDX-License-Identifier: BSD-3-Clause
// Grids of polygons as surfaces, and polygons that vtkTriangleFilter drops.
#include "Bridge/Triangles/SurfaceInput.h"
#include "Bridge/Triangles/TriangleInput.h"
#include "Core/Messages/Failure.h"
#include "SurfaceTest.h"

#include "vtkStructuredGrid.h"
#include "vtkTriangle.h"
#include "vtkUnstructuredGrid.h"

namespace
{

using RectifiedTransport::DiskTriangles;
using RectifiedTransport::Failure;
using RectifiedTransport::Bridge::SurfaceInput;
using RectifiedTransport::Bridge::TriangleInput;

SurfaceInput read(vtkDataObject* data)
{
  RectifiedTransport::Progress progress{ RectifiedTransport::Context() };
  return { data, progress };
}

std::string failureOf(vtkDataObject* data)
{
  try
  {
    read(data);
    return "none";
  }
  catch (const Failure& failure)
  {
    return failure.what();
  }
}

// A triangle, a line, a quad, a vertex, a pixel and a strip, in this order, and a point of none.
vtkSmartPointer<vtkUnstructuredGrid> makeGrid()
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(makePoints(
    { 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0, 0, 2, 0, 1, 2, 0, 2, 2, 0, 7, 7, 7 })
                    ->GetPoints());
  const auto insert = [&grid](int type, const std::vector<vtkIdType>& ids) {
    grid->InsertNextCell(type, static_cast<vtkIdType>(ids.size()), ids.data());
  };
  insert(VTK_TRIANGLE, { 0, 1, 4 });
  insert(VTK_LINE, { 0, 1 });
  insert(VTK_QUAD, { 1, 2, 5, 4 });
  insert(VTK_VERTEX, { 8 });
  insert(VTK_PIXEL, { 3, 4, 6, 7 });
  insert(VTK_TRIANGLE, { 0, 4, 3 });
  insert(VTK_TRIANGLE_STRIP, { 4, 5, 7, 8 });
  grid->GetCellData()->SetScalars(makeNumbers("Number", 7));
  grid->GetPointData()->SetScalars(makeNumbers("PointNumber", 10));
  grid->GetFieldData()->AddArray(makeNumbers("Own", 2));
  return grid;
}

void checkGrid(Checks& checks)
{
  auto grid = makeGrid();
  const SurfaceInput input = read(grid);
  vtkPolyData* surface = input.Get();
  CHECK(checks, surface->GetPoints() == grid->GetPoints());
  CHECK(checks, surface->GetNumberOfVerts() == 1 && surface->GetNumberOfLines() == 1);
  CHECK(checks, surface->GetNumberOfPolys() == 4 && surface->GetNumberOfStrips() == 1);
  CHECK(checks, surface->GetPointData()->GetScalars() == grid->GetPointData()->GetScalars());
  CHECK(checks, surface->GetFieldData()->GetArray("Own") != nullptr);
  const std::vector<vtkIdType> cells{ 3, 1, 0, 2, 4, 5, 6 };
  vtkDataArray* numbers = surface->GetCellData()->GetScalars();
  for (vtkIdType cell = 0; cell < 7; ++cell)
  {
    const vtkIdType wanted = cells[static_cast<std::size_t>(cell)];
    CHECK(checks, input.InputCellOf(cell) == wanted);
    CHECK(checks, numbers && numbers->GetTuple1(cell) == static_cast<double>(wanted));
  }
  RectifiedTransport::Progress progress{ RectifiedTransport::Context() };
  TriangleInput triangles(surface, "it must be a disk", progress);
  const DiskTriangles disk = triangles.Disk(progress);
  CHECK(checks, disk.Disk().NumberOfTriangles() == 8);
  CHECK(checks, disk.Disk().NumberOfPoints() == 9);
  CHECK(checks, disk.IsRepaired());
  CHECK(checks,
    triangles.RepairWarning(disk.Repaired().Repairs()) ==
      "The input surface was repaired: 1 point in no polygon left out");
  checks.Near(
    disk.Disk().Area() * disk.Disk().Unit() * disk.Disk().Unit(), 4.0, 1e-12, "area", __LINE__);
}

void checkOthers(Checks& checks)
{
  vtkNew<vtkStructuredGrid> sheet;
  sheet->SetDimensions(3, 1, 2);
  sheet->SetPoints(
    makePoints({ 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 0, 1, 1, 0, 1, 2, 0, 1 })->GetPoints());
  CHECK(checks, read(sheet).Get()->GetNumberOfPolys() == 2);
  auto polygons = makeFlatSheet(2, 2);
  CHECK(checks, read(polygons).Get() == polygons && read(polygons).InputCellOf(5) == 5);
  CHECK(checks, !read(nullptr).Get() && !read(vtkSmartPointer<vtkPolyData>::New()).Get());

  // With a tetrahedron: its faces, too.
  auto grid = makeGrid();
  const std::vector<vtkIdType> corners{ 0, 1, 4, 9 };
  grid->InsertNextCell(VTK_TETRA, 4, corners.data());
  grid->GetCellData()->SetScalars(makeNumbers("Number", 8));
  const SurfaceInput outer = read(grid);
  vtkIdType faces = 0;
  for (vtkIdType cell = 0; cell < outer.Get()->GetNumberOfCells(); ++cell)
  {
    faces += outer.InputCellOf(cell) == 7 ? 1 : 0;
  }
  CHECK(checks, faces == 4 && outer.Get()->GetNumberOfPolys() >= 8);
  CHECK(checks,
    outer.Get()->GetCellData()->GetNumberOfArrays() == grid->GetCellData()->GetNumberOfArrays());
  grid->GetCellData()->SetScalars(makeNumbers("Number", 7));
  CHECK(checks, contains(failureOf(grid), "The cell array 'Number' of the input has 7 tuples"));
  grid = makeGrid();
  const std::vector<vtkIdType> wrong{ 0, 1, 10 };
  grid->InsertNextCell(VTK_TRIANGLE, 3, wrong.data());
  grid->GetCellData()->SetScalars(makeNumbers("Number", 8));
  CHECK(checks,
    failureOf(grid) == "Cell 7 of the input surface has the point 10; there are points 0 to 9");
  CHECK(checks,
    contains(failureOf(vtkSmartPointer<vtkImageData>::New()),
      "has a block of type vtkImageData; it must be a vtkPolyData or a grid"));
}

vtkIdType trianglesWithArea(vtkPolyData* surface)
{
  vtkIdType count = 0;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    auto* triangle = vtkTriangle::SafeDownCast(surface->GetCell(cell));
    count += triangle && triangle->ComputeArea() > 1e-12 ? 1 : 0;
  }
  return count;
}

// Corners at one place and on one line: as many triangles as there are corners beyond the second,
// and the area of the polygon. A corner on a line has a triangle with area.
void checkCorners(Checks& checks)
{
  struct Polygon
  {
    Values Points;
    vtkIdType WithArea;
  };
  const std::vector<Polygon> polygons{
    { { 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0 }, 2 },                       // twice
    { { 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 0 }, 2 },                       // the last
    { { 0, 0, 0, 0.5, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 0 }, 3 },            // on a line, too
    { { 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 1, 0, 1, 1, 0, 0, 1, 0 }, 2 },     // often
    { { 0, 0, 0, 0.5, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0.5, 0, 1, 1, 0, 0, 1, 0 }, 4 }, // and on lines
    { { 0, 0, 0, 0.5, 0, 0, 1, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 0 }, 3 },
    { { 0, 0, 0, 2, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0 }, 2 }, // a spike
  };
  for (const Polygon& polygon : polygons)
  {
    const auto corners = static_cast<vtkIdType>(polygon.Points.size() / 3);
    std::vector<vtkIdType> cell{ corners };
    for (vtkIdType i = 0; i < corners; ++i)
    {
      cell.push_back(i);
    }
    RectifiedTransport::Progress progress{ RectifiedTransport::Context() };
    const vtkSmartPointer<vtkPolyData> given = makePolygons(polygon.Points, cell);
    TriangleInput input(given, "it must be a disk", progress);
    const DiskTriangles disk = input.Disk(progress);
    const vtkSmartPointer<vtkPolyData> triangulated = input.Triangulated(progress);
    CHECK(checks, triangulated->GetNumberOfPolys() == corners - 2);
    CHECK(checks, trianglesWithArea(triangulated) == polygon.WithArea);
    const RectifiedTransport::DiskMesh& mesh = disk.Disk();
    checks.Near(mesh.Area() * mesh.Unit() * mesh.Unit(), 1.0, 1e-12, "area", __LINE__);
    CHECK(checks, disk.IsRepaired());
  }
}

} // namespace

int TestSurfaceInput(int, char*[])
{
  return runChecks({ checkGrid, checkOthers, checkCorners });
}
