// SPDX-License-Identifier: BSD-3-Clause
// The polygons of a vtkPolyData as a disk: which cells the triangles are of, and what goes with
// them.
#include "Bridge/Triangles/TriangleInput.h"
#include "Core/Messages/Failure.h"
#include "SurfaceTest.h"

#include "vtkIdTypeArray.h"
#include "vtkStringArray.h"
#include "vtkStripper.h"

namespace
{

using RectifiedTransport::DiskTriangles;
using RectifiedTransport::Failure;
using RectifiedTransport::Bridge::TriangleInput;

class Run
{
public:
  explicit Run(vtkPolyData* input)
    : Input(input, "it must be a disk", this->Work)
    , Surface(this->Input.Disk(this->Work))
    , Triangulated(this->Input.Triangulated(this->Work))
  {
  }

  // The cell of the triangulated surface that a triangle of the disk is.
  vtkIdType CellOf(vtkIdType triangle) const
  {
    return this->Input.FirstCell() +
      static_cast<vtkIdType>(this->Surface.Repaired().GivenTriangle(triangle));
  }
  vtkIdType InputCellOf(vtkIdType triangle) const
  {
    return this->Input.CellOf(this->Surface.GivenTriangle(triangle));
  }

private:
  RectifiedTransport::Progress Work{ RectifiedTransport::Context() };
  TriangleInput Input;

public:
  const DiskTriangles Surface;
  const vtkSmartPointer<vtkPolyData> Triangulated;
};

std::string failureOf(vtkPolyData* input)
{
  try
  {
    const Run run(input);
    return "none";
  }
  catch (const Failure& failure)
  {
    return failure.what();
  }
}

// Vertices and lines that are no part of the disk.
void addOthers(vtkPolyData* surface)
{
  vtkNew<vtkCellArray> vertices;
  vertices->InsertNextCell({ 3, 1 });
  vertices->InsertNextCell({ 2 });
  surface->SetVerts(vertices);
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 0, 1, 2, 3 });
  surface->SetLines(lines);
}

void checkTriangles(Checks& checks)
{
  auto input = makeFlatSheet(4, 3);
  const Run plain(input);
  CHECK(checks, plain.Triangulated == input);
  CHECK(checks, plain.Surface.Disk().NumberOfPoints() == 20);
  CHECK(checks, plain.Surface.Disk().NumberOfTriangles() == 24);
  CHECK(checks, plain.CellOf(0) == 0 && plain.InputCellOf(23) == 23);
  addOthers(input);
  const Run run(input);
  CHECK(checks, run.Triangulated == input);
  for (vtkIdType i = 0; i < 24; ++i)
  {
    CHECK(checks, run.CellOf(i) == i + 3 && run.InputCellOf(i) == i + 3);
    vtkNew<vtkIdList> ids;
    input->GetCellPoints(run.CellOf(i), ids);
    const std::int64_t* points = run.Surface.Disk().Triangle(i);
    CHECK(checks,
      ids->GetId(0) == points[0] && ids->GetId(1) == points[1] && ids->GetId(2) == points[2]);
  }
}

// Of a pentagon, triangles, a quad between them, and a strip of two.
vtkSmartPointer<vtkPolyData> makeMixed()
{
  auto input = makePolygons({ 0, 0, 0, 1, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0, 0, 1, 0, 0, 2, 0, 1, 2,
                              0, 2, 2, 0, 0.5, -0.2, 0 },
    { 5, 0, 9, 1, 4, 5, 3, 1, 2, 3, 4, 4, 3, 8, 7, 3, 1, 3, 4 });
  vtkNew<vtkCellArray> strips;
  strips->InsertNextCell({ 5, 4, 6, 7 });
  input->SetStrips(strips);
  return input;
}

void checkPolygons(Checks& checks)
{
  auto input = makeMixed();
  addOthers(input);
  CHECK(checks, input->GetNumberOfCells() == 8); // 2 vertices, a line, 4 polygons, a strip
  input->GetCellData()->SetScalars(makeNumbers("Number", 8));
  vtkNew<vtkStringArray> names;
  names->SetName("Name");
  for (int i = 0; i < 8; ++i)
  {
    names->InsertNextValue("cell " + std::to_string(i));
  }
  input->GetCellData()->AddArray(names);
  vtkNew<vtkDoubleArray> pairs;
  pairs->SetName("Pair");
  pairs->SetNumberOfComponents(2);
  pairs->SetNumberOfTuples(8);
  for (vtkIdType i = 0; i < 8; ++i)
  {
    pairs->SetTuple2(i, static_cast<double>(i), -static_cast<double>(i));
  }
  input->GetCellData()->SetTCoords(pairs);
  auto numbers = makeNumbers("PointNumber", 10);
  input->GetPointData()->SetScalars(numbers);
  input->GetFieldData()->AddArray(names);
  const Run run(input);
  const DiskTriangles& surface = run.Surface;
  vtkPolyData* output = run.Triangulated;
  CHECK(checks, output != input && input->GetNumberOfCells() == 8);
  CHECK(checks, output->GetPoints() == input->GetPoints());
  CHECK(checks, output->GetVerts() == input->GetVerts() && output->GetLines() == input->GetLines());
  CHECK(checks, output->GetPointData()->GetScalars() == numbers);
  CHECK(checks, output->GetFieldData()->GetAbstractArray("Name") == names);
  CHECK(checks, output->GetNumberOfStrips() == 0 && output->GetNumberOfPolys() == 9);
  const std::vector<vtkIdType> cells{ 3, 3, 3, 4, 5, 5, 6, 7, 7 };
  CHECK(checks, surface.Disk().NumberOfTriangles() == 9);
  vtkCellData* data = output->GetCellData();
  CHECK(checks, data->GetScalars() && data->GetScalars()->GetNumberOfTuples() == 12);
  CHECK(checks, data->GetTCoords() && data->GetTCoords()->GetNumberOfTuples() == 12);
  auto* texts = vtkStringArray::SafeDownCast(data->GetAbstractArray("Name"));
  for (vtkIdType i = 0; i < 12; ++i)
  {
    const vtkIdType cell = i < 3 ? i : cells[static_cast<std::size_t>(i - 3)];
    const double number = static_cast<double>(cell);
    CHECK(checks, i < 3 || run.CellOf(i - 3) == i);
    CHECK(checks, i < 3 || run.InputCellOf(i - 3) == cell);
    CHECK(checks, data->GetScalars()->GetTuple1(i) == number);
    CHECK(checks, data->GetTCoords()->GetComponent(i, 1) == -number);
    CHECK(checks, texts && texts->GetValue(i) == "cell " + std::to_string(cell));
  }
}

// A global id is that of one cell.
void checkGlobalIds(Checks& checks)
{
  for (const bool triangles : { true, false })
  {
    auto input = makeFlatSheet(2, 2, triangles);
    vtkNew<vtkIdTypeArray> ids;
    ids->SetName("Id");
    for (vtkIdType i = 0; i < input->GetNumberOfCells(); ++i)
    {
      ids->InsertNextValue(10 + i);
    }
    input->GetCellData()->SetGlobalIds(ids);
    const Run run(input);
    vtkCellData* data = run.Triangulated->GetCellData();
    CHECK(checks, (data->GetGlobalIds() != nullptr) == triangles);
  }
}

void checkStrips(Checks& checks)
{
  auto input = makeFlatSheet(7, 5);
  vtkNew<vtkStripper> stripper;
  stripper->SetInputData(input);
  stripper->Update();
  vtkPolyData* strips = stripper->GetOutput();
  CHECK(checks, strips->GetNumberOfStrips() > 0);
  const Run run(strips);
  CHECK(checks, run.Surface.Disk().NumberOfTriangles() == 70);
  CHECK(checks, run.Surface.Disk().Boundary().size() == 24);
  CHECK(checks, run.Triangulated->GetNumberOfPolys() == 70);
}

void checkFailures(Checks& checks)
{
  const auto expect = [&](vtkPolyData* input, const std::string& text, int line) {
    const std::string found = failureOf(input);
    checks.That(contains(found, text), "the failure", line, found);
  };
  auto sheet = makeSheet(2, 2, [](double x, double y) {
    return std::array<double, 3>{ x, 0.0 * y, 0.0 };
  });
  addOthers(sheet);
  expect(sheet,
    "The input surface has 8 triangles without area, the first is triangle 0; move their points "
    "apart; triangle 0 is of cell 3",
    __LINE__);
  // Cut at the points of each other, they are three.
  expect(makePolygons({ 0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0 }, { 3, 0, 1, 2, 3, 0, 2, 3 }),
    "The input surface has 2 triangles without area, the first is triangle 0; move their points "
    "apart",
    __LINE__);
  sheet = makeFlatSheet(2, 2, false);
  sheet->GetPoints()->SetPoint(8, 1, 2, 0);
  sheet->GetPoints()->SetPoint(7, 2, 2, 0);
  expect(sheet,
    "The input surface has polygons that cannot be cut into triangles: 2 triangles are missing "
    "(the "
    "first of polygon 3, counted from 0); ",
    __LINE__);
  sheet = makeFlatSheet(2, 2, false);
  sheet->GetCellData()->AddArray(makeNumbers("Short", 3));
  expect(sheet,
    "The cell array 'Short' of the input surface has 3 tuples; it must have one for each of the 4 "
    "cells",
    __LINE__);
  expect(makePoints({ 0, 0, 0, 1, 0, 0 }),
    "The input surface has 2 points and no polygons; it must be a disk of polygons (lines and "
    "vertices do not count)",
    __LINE__);
  // Of two points there is no triangle.
  expect(makePolygons({ 0, 0, 0, 1, 0, 0, 1, 1, 0 }, { 2, 0, 1 }),
    "The input surface has no triangles", __LINE__);
}

} // namespace

int TestTriangleInput(int, char*[])
{
  return runChecks({ checkTriangles, checkPolygons, checkGlobalIds, checkStrips, checkFailures });
}
