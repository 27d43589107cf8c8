// SPDX-License-Identifier: BSD-3-Clause
// The arrays of the surface at the particles of vtkSurfaceSampler.
#include "SurfaceSamplerTest.h"

#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkShortArray.h"
#include "vtkStringArray.h"

namespace
{

double linear(const double* x)
{
  return 2.0 * x[0] - 3.0 * x[1] + 0.5 * x[2] + 7.0;
}

// Linear functions of the position, of any type and number of components.
void checkPointArrays(Checks& checks)
{
  auto hill = makeHill(false);
  const vtkIdType count = hill->GetNumberOfPoints();
  const auto value = [&](vtkIdType i) { return linear(hill->GetPoint(i)); };
  vtkPointData* data = hill->GetPointData();
  data->AddArray(makeArray("Linear", count, value));
  data->AddArray(makeArray<vtkFloatArray>("Single", count, value));
  data->AddArray(
    makeArray<vtkShortArray>("Whole", count, [&](vtkIdType i) { return 100.0 * value(i); }));
  vtkNew<vtkDoubleArray> places;
  places->SetName("Places");
  places->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < count; ++i)
  {
    places->InsertNextTuple(hill->GetPoint(i));
  }
  data->SetVectors(places);
  data->SetActiveScalars("Single");
  vtkNew<vtkStringArray> text;
  text->SetName("Text");
  text->SetNumberOfValues(count);
  data->AddArray(text);
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("Ids");
  ids->SetNumberOfTuples(count);
  data->SetGlobalIds(ids);
  data->AddArray(makeArray<vtkIdTypeArray>("Others", count, value));

  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetMethodToFlow();
  sampler->SetInputData(hill);
  sampler->SetNumberOfParticles(900);
  vtkPolyData* particles = runSampler(sampler);
  vtkDataArray* doubles = pointArray(particles, "Linear");
  vtkDataArray* singles = pointArray(particles, "Single");
  vtkDataArray* shorts = pointArray(particles, "Whole");
  vtkDataArray* vectors = pointArray(particles, "Places");
  CHECK(checks, doubles && singles && shorts && vectors);
  CHECK(checks, doubles->GetDataType() == VTK_DOUBLE && singles->GetDataType() == VTK_FLOAT);
  CHECK(checks, shorts->GetDataType() == VTK_SHORT && vectors->GetNumberOfComponents() == 3);
  for (vtkIdType i = 0; i < 900; ++i)
  {
    const double* x = particles->GetPoint(i);
    CHECK_NEAR(checks, doubles->GetTuple1(i), linear(x), 1e-12);
    CHECK_NEAR(checks, singles->GetTuple1(i), linear(x), 1e-5);
    CHECK_NEAR(checks, shorts->GetTuple1(i), 100.0 * linear(x), 1.51); // rounded twice
    for (int r = 0; r < 3; ++r)
    {
      CHECK_NEAR(checks, vectors->GetComponent(i, r), x[r], 1e-13);
    }
  }
  CHECK(checks, particles->GetPointData()->GetScalars() == singles);
  CHECK(checks, particles->GetPointData()->GetVectors() == vectors);
  vtkAbstractArray* texts = particles->GetPointData()->GetAbstractArray("Text");
  CHECK(checks, texts && texts->GetNumberOfTuples() == 900);
  // Names of points, not numbers.
  CHECK(checks, !particles->GetPointData()->HasArray("Ids"));
  CHECK(checks, !particles->GetPointData()->HasArray("Others"));
}

void checkCellArrays(Checks& checks)
{
  for (const bool triangles : { true, false })
  {
    auto hill = makeHill(triangles);
    vtkNew<vtkCellArray> vertex;
    const vtkIdType first = 0;
    vertex->InsertNextCell(1, &first);
    hill->SetVerts(vertex);
    const vtkIdType count = hill->GetNumberOfCells();
    vtkCellData* data = hill->GetCellData();
    data->SetScalars(
      makeArray<vtkIntArray>("Number", count, [](vtkIdType i) { return static_cast<double>(i); }));
    vtkNew<vtkStringArray> names;
    names->SetName("Name");
    for (vtkIdType i = 0; i < count; ++i)
    {
      names->InsertNextValue(std::to_string(i));
    }
    data->AddArray(names);
    vtkNew<vtkSurfaceSampler> sampler;
    sampler->SetMethodToFlow();
    sampler->SetInputData(hill);
    sampler->SetNumberOfParticles(300);
    vtkPolyData* particles = runSampler(sampler);
    vtkDataArray* numbers = pointArray(particles, "Number");
    auto* texts = vtkStringArray::SafeDownCast(particles->GetPointData()->GetAbstractArray("Name"));
    CHECK(checks, numbers && numbers->GetDataType() == VTK_INT && texts);
    CHECK(checks, particles->GetPointData()->GetScalars() == pointArray(particles, "Mass"));
    for (vtkIdType i = 0; i < 300; ++i)
    {
      const double cell = pointArray(particles, "CellId")->GetTuple1(i);
      CHECK(checks, cell >= 1.0 && numbers->GetTuple1(i) == cell);
      CHECK(checks, texts->GetValue(i) == std::to_string(static_cast<vtkIdType>(cell)));
    }
    CHECK(checks, particles->GetCellData()->GetNumberOfArrays() == 0);
  }
}

// The output's own arrays come first, then those of the points.
void checkNames(Checks& checks)
{
  auto hill = makeHill();
  const auto seven = [](vtkIdType) { return 7.0; };
  for (const char* name : { "Mass", "SeedId", "CellId", "Normal", "Both" })
  {
    hill->GetPointData()->AddArray(makeArray(name, hill->GetNumberOfPoints(), seven));
    hill->GetCellData()->AddArray(
      makeArray(name, hill->GetNumberOfCells(), [](vtkIdType) { return 9.0; }));
  }
  auto normals = makeArray<vtkFloatArray>("Normals", 3 * hill->GetNumberOfPoints(), seven);
  normals->SetNumberOfComponents(3);
  hill->GetPointData()->SetNormals(normals);
  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetMethodToFlow();
  sampler->SetInputData(hill);
  sampler->SetNumberOfParticles(50);
  vtkPolyData* particles = runSampler(sampler);
  CHECK(checks, particles->GetPointData()->GetNumberOfArrays() == 6);
  CHECK(checks, pointArray(particles, "Mass")->GetTuple1(0) != 7.0);
  CHECK(checks, pointArray(particles, "SeedId")->GetTuple1(49) == 49.0);
  CHECK(checks, pointArray(particles, "Normal")->GetNumberOfComponents() == 3);
  CHECK_NEAR(checks, pointArray(particles, "Both")->GetTuple1(3), 7.0, 1e-14);
  CHECK_NEAR(checks, pointArray(particles, "Normals")->GetComponent(3, 1), 7.0, 1e-6);
  CHECK(checks, particles->GetPointData()->GetNormals() == pointArray(particles, "Normal"));
}

void checkShortArrays(Checks& checks)
{
  for (const bool triangles : { true, false })
  {
    auto hill = makeHill(triangles);
    const vtkIdType points = hill->GetNumberOfPoints();
    const vtkIdType cells = hill->GetNumberOfCells();
    vtkNew<vtkSurfaceSampler> sampler;
    sampler->SetMethodToFlow();
    sampler->SetInputData(hill);
    sampler->SetNumberOfParticles(10);
    hill->GetPointData()->AddArray(makeArray("Short", points - 1, [](vtkIdType) { return 1.0; }));
    ErrorTest(checks, sampler)
      .Expect("The point array 'Short' of the input surface has " + std::to_string(points - 1) +
          " tuples; it must have one for each of the " + std::to_string(points) + " points",
        __LINE__);
    hill->GetPointData()->RemoveArray("Short");
    hill->GetCellData()->AddArray(makeArray("Short", cells - 1, [](vtkIdType) { return 1.0; }));
    ErrorTest(checks, sampler)
      .Expect("The cell array 'Short' of the input surface has " + std::to_string(cells - 1) +
          " tuples; it must have one for each of the " + std::to_string(cells) + " cells",
        __LINE__);
  }
}

} // namespace

int TestSurfaceSamplerArrays(int, char*[])
{
  return runChecks({ checkPointArrays, checkCellArrays, checkNames, checkShortArrays });
}
