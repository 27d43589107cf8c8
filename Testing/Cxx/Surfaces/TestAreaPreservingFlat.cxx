// SPDX-License-Identifier: BSD-3-Clause
// The second output of vtkAreaPreservingParameterization: the surface in the unit square.
#include "BlocksTest.h"
#include "ParameterizationTest.h"

#include "vtkFloatArray.h"
#include "vtkPolyDataNormals.h"

namespace
{

void expectFlat(Checks& checks, vtkPolyData* surface, vtkPolyData* flat, int line)
{
  const Values square = arrayValues(surface->GetPointData()->GetArray("AreaPreservingExact"));
  Values wanted;
  for (std::size_t i = 0; i < square.size(); i += 2)
  {
    wanted.insert(wanted.end(), { square[i], square[i + 1], 0.0 });
  }
  const auto expect = [&](bool holds, const char* what) { checks.That(holds, what, line); };
  expect(!wanted.empty() && coordinates(flat) == wanted, "points in the square");
  expect(flat->GetPoints()->GetDataType() == VTK_DOUBLE, "points in double");
  expect(flat->GetPolys() == surface->GetPolys() && flat->GetLines() == surface->GetLines() &&
      flat->GetVerts() == surface->GetVerts(),
    "the same cells");
  for (const int kind : { vtkDataObject::POINT, vtkDataObject::CELL, vtkDataObject::FIELD })
  {
    vtkFieldData* arrays = flat->GetAttributesAsFieldData(kind);
    vtkFieldData* own = surface->GetAttributesAsFieldData(kind);
    expect(arrays->GetNumberOfArrays() == own->GetNumberOfArrays(), "as many arrays");
    for (int i = 0; i < own->GetNumberOfArrays(); ++i)
    {
      expect(
        arrays->GetAbstractArray(own->GetArrayName(i)) == own->GetAbstractArray(i), "an array");
    }
  }
  expect(flat->GetPointData()->GetTCoords() == surface->GetPointData()->GetTCoords(),
    "texture coordinates");
}

void expectFlat(Checks& checks, Parameterization* filter, int line)
{
  expectFlat(checks, filter->GetOutput(), filter->GetFlat(), line);
}

// All arrays and cells are those of the surface, which keeps its own points.
void checkWhatIsShared(Checks& checks)
{
  auto input = makeHills(6, 5);
  vtkNew<vtkCellArray> vertices;
  vertices->InsertNextCell({ 4, 2 });
  input->SetVerts(vertices);
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 3, 7, 9 });
  input->SetLines(lines);
  input->GetPointData()->SetScalars(makeNumbers("Number", input->GetNumberOfPoints()));
  input->GetCellData()->SetScalars(makeNumbers("Number", input->GetNumberOfCells()));
  input->GetFieldData()->AddArray(makeNumbers("Own", 3));
  auto filter = makeParameterization(input);
  filter->Update(1);
  expectFlat(checks, filter, __LINE__);
  CHECK(checks, filter->GetOutput()->GetPoints() == input->GetPoints());
  vtkPolyData* flat = filter->GetFlat();
  CHECK(checks, flat->GetPointData()->GetScalars() == input->GetPointData()->GetScalars());
  CHECK(checks, flat->GetCellData()->GetScalars() == input->GetCellData()->GetScalars());
  double bounds[6];
  flat->GetBounds(bounds);
  CHECK(checks, (Values(bounds, bounds + 6) == Values{ 0, 1, 0, 1, 0, 0 }));
}

// Normals and tangents are those of the surface: kept, but not used to shade the square.
void checkNormals(Checks& checks)
{
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(makeHills(5, 4));
  normals->ComputeCellNormalsOn();
  normals->SplittingOff();
  normals->Update();
  vtkPolyData* input = normals->GetOutput();
  vtkNew<vtkFloatArray> tangents;
  tangents->SetName("Tangents");
  tangents->SetNumberOfComponents(3);
  tangents->SetNumberOfTuples(input->GetNumberOfPoints());
  tangents->Fill(1.0);
  input->GetPointData()->SetTangents(tangents);
  CHECK(checks, input->GetPointData()->GetNormals() && input->GetCellData()->GetNormals());
  auto filter = makeParameterization(input);
  filter->Update();
  expectFlat(checks, filter, __LINE__);
  vtkPolyData* surface = filter->GetOutput();
  CHECK(checks, surface->GetPointData()->GetNormals() && surface->GetCellData()->GetNormals());
  CHECK(checks, surface->GetPointData()->GetTangents() == tangents);
  vtkPolyData* flat = filter->GetFlat();
  CHECK(checks, !flat->GetPointData()->GetNormals() && !flat->GetCellData()->GetNormals());
  CHECK(checks, !flat->GetPointData()->GetTangents());
  CHECK(
    checks, flat->GetPointData()->GetArray("Normals") && flat->GetCellData()->GetArray("Normals"));
}

// Polygons are cut in both outputs; a point in no polygon is at the origin.
void checkRepairs(Checks& checks)
{
  auto sheet = makeFlatSheet(5, 4, false);
  const vtkIdType unused = sheet->GetPoints()->InsertNextPoint(7, 8, 9);
  auto filter = makeParameterization(sheet);
  Messages messages(filter);
  filter->Update();
  CHECK(checks, messages.Errors.empty() && messages.Warnings.size() == 1);
  expectFlat(checks, filter, __LINE__);
  CHECK(checks, filter->GetFlat()->GetNumberOfPolys() == 40);
  double x[3];
  filter->GetFlat()->GetPoint(unused, x);
  CHECK(checks, x[0] == 0.0 && x[1] == 0.0 && x[2] == 0.0);
}

void checkBlocks(Checks& checks)
{
  vtkNew<Parameterization> filter;
  filter->SetResolution(32);
  filter->SetInputData(makeBlocks({ makeFlatSheet(4, 3), makeCap(5, 0.5) }));
  filter->Update();
  auto* blocks = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(1));
  CHECK(checks, blocks && blocks->GetNumberOfBlocks() == 2);
  for (const unsigned int block : { 0u, 1u })
  {
    auto* surface = outputBlock<vtkPolyData>(filter, block);
    auto* flat = blocks ? vtkPolyData::SafeDownCast(blocks->GetBlock(block)) : nullptr;
    CHECK(checks, surface && flat);
    if (surface && flat)
    {
      expectFlat(checks, surface, flat, __LINE__);
    }
  }
}

// It follows the first output, also to nothing. Errors, aborts and pieces are tested for both.
void checkRuns(Checks& checks)
{
  auto filter = makeParameterization(makeHills(5, 4));
  filter->Update();
  expectFlat(checks, filter, __LINE__);
  const Values first = coordinates(filter->GetFlat());
  filter->PolishOff();
  filter->Update(1);
  expectFlat(checks, filter, __LINE__);
  CHECK(checks, coordinates(filter->GetFlat()) != first);
  filter->SetInputData(makeCap(4, 0.5));
  filter->Update();
  expectFlat(checks, filter, __LINE__);
  filter->SetInputData(vtkSmartPointer<vtkPolyData>::New());
  filter->Update();
  CHECK(checks, isEmpty(filter->GetFlat()));
}

} // namespace

int TestAreaPreservingFlat(int, char*[])
{
  return runChecks({ checkWhatIsShared, checkNormals, checkRepairs, checkBlocks, checkRuns });
}
