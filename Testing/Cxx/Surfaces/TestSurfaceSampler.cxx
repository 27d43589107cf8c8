// SPDX-License-Identifier: BSD-3-Clause
// Where vtkSurfaceSampler puts particles: on the surface, as many as asked for, by area or by mass,
// and on a flat rectangle where vtkTransportSampler puts them.
#include "../../SeedPatterns.h"
#include "SurfaceSamplerTest.h"

#include "vtkCell.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkReverseSense.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

namespace
{

// Whether each particle is on the cell that its CellId names.
void expectOnCells(Checks& checks, vtkPolyData* surface, vtkPolyData* particles, int line)
{
  vtkDataArray* cells = pointArray(particles, "CellId");
  vtkDataArray* normals = pointArray(particles, "Normal");
  double farthest = 0.0;
  double steepest = 0.0;
  bool areUnit = true;
  for (vtkIdType i = 0; cells && normals && i < particles->GetNumberOfPoints(); ++i)
  {
    vtkCell* cell = surface->GetCell(static_cast<vtkIdType>(cells->GetTuple1(i)));
    double closest[3];
    int part = 0;
    double parameters[3];
    double distance = HUGE_VAL;
    double weights[3];
    cell->EvaluatePosition(particles->GetPoint(i), closest, part, parameters, distance, weights);
    farthest = std::max(farthest, distance);
    const double* n = normals->GetTuple3(i);
    areUnit = areUnit && std::abs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1.0) < 1e-14;
    for (int corner = 1; corner < 3; ++corner)
    {
      double a[3];
      double b[3];
      cell->GetPoints()->GetPoint(0, a);
      cell->GetPoints()->GetPoint(corner, b);
      steepest = std::max(
        steepest, std::abs(n[0] * (b[0] - a[0]) + n[1] * (b[1] - a[1]) + n[2] * (b[2] - a[2])));
    }
  }
  checks.That(cells && normals, "arrays", line);
  checks.That(farthest < 1e-24, "on the cells", line, std::to_string(farthest)); // squared
  checks.That(steepest < 1e-13 && areUnit, "normals", line, std::to_string(steepest));
}

void checkOutput(Checks& checks)
{
  auto hill = makeHill();
  hill->GetFieldData()->AddArray(makeArray("Own", 1, [](vtkIdType) { return 5.0; }));
  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetMethodToFlow();
  Messages messages(sampler);
  sampler->SetInputData(hill);
  for (const vtkIdType count : { 1, 2, 1000 })
  {
    sampler->SetNumberOfParticles(count);
    vtkPolyData* particles = runSampler(sampler);
    CHECK(checks, particles->GetNumberOfPoints() == count);
    CHECK(checks, particles->GetNumberOfVerts() == count && particles->GetNumberOfCells() == count);
    CHECK(checks, particles->GetPoints()->GetDataType() == VTK_DOUBLE);
    CHECK(checks, particles->GetPointData()->GetNumberOfArrays() == 4);
    CHECK(checks, particles->GetCellData()->GetNumberOfArrays() == 0);
    CHECK(checks, particles->GetPointData()->GetNormals() == pointArray(particles, "Normal"));
    for (vtkIdType i = 0; i < count; ++i)
    {
      CHECK(checks, pointArray(particles, "SeedId")->GetTuple1(i) == static_cast<double>(i));
    }
    CHECK_NEAR(checks, fieldValue(particles, "TotalMass"), areaOf(hill), 1e-12 * areaOf(hill));
    CHECK_NEAR(checks, sumOf(arrayValues(pointArray(particles, "Mass"))), areaOf(hill), 1e-10);
    CHECK(checks, fieldValue(particles, "Own") == 5.0);
    CHECK(checks, fieldValue(particles, "MovedParticles") == 0.0);
    // Own, TotalMass, MovedParticles, and of the flow StepsTaken and what it estimates.
    const bool estimates = particles->GetFieldData()->HasArray("AreaErrorEstimate") != 0;
    CHECK(checks, particles->GetFieldData()->GetNumberOfArrays() == 4 + (estimates ? 1 : 0));
    expectOnCells(checks, hill, particles, __LINE__);
  }
  for (vtkIdType i = 0; i < 1000; ++i)
  {
    CHECK(checks, pointArray(sampler->GetOutput(), "Normal")->GetComponent(i, 2) > 0.0);
  }
  // Seen from the other side.
  vtkNew<vtkReverseSense> reverse;
  reverse->SetInputData(hill);
  sampler->SetInputConnection(reverse->GetOutputPort());
  CHECK(checks, pointArray(runSampler(sampler), "Normal")->GetComponent(7, 2) < 0.0);
  CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());
}

// On a flat rectangle the seeds are those of the image, and so is all else.
void checkFlatAsImage(Checks& checks)
{
  auto image = unitCells(24, 10, 1);
  image->SetDimensions(25, 11, 1);
  vtkNew<vtkTransportSampler> expected;
  expected->SetInputData(image);
  expected->SetNumberOfParticles(700);
  expected->Update();
  for (const bool triangles : { false, true })
  {
    auto flat = makeFlatSheet(24, 10, triangles);
    const vtkIdType part = triangles ? 2 : 1;
    flat->GetCellData()->AddArray(
      makeArray("Density", flat->GetNumberOfCells(), [=](vtkIdType i) { return bumpy(i / part); }));
    vtkNew<vtkSurfaceSampler> sampler;
    sampler->SetMethodToFlow();
    sampler->SetInputData(flat);
    sampler->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Density");
    sampler->SetNumberOfParticles(700);
    sampler->SetResolution(24);
    const vtkIdType corners[4] = { 0, 24, 25 * 11 - 1, 25 * 10 };
    for (int i = 0; i < 4; ++i)
    {
      sampler->SetCorner(i, corners[i]);
    }
    vtkPolyData* particles = runSampler(sampler);
    CHECK(
      checks, largestDifference(coordinates(particles), coordinates(expected->GetOutput())) < 1e-7);
    CHECK_NEAR(checks, fieldValue(particles, "TotalMass"),
      fieldValue(expected->GetOutput(), "TotalMass"), 1e-9);
    CHECK_NEAR(checks, pointArray(particles, "Mass")->GetTuple1(3),
      pointArray(expected->GetOutput(), "Mass")->GetTuple1(3), 1e-11);
  }
}

// The mass of a linear density of any type is exact.
void checkPointDensity(Checks& checks)
{
  auto flat = makeFlatSheet(20, 10, false);
  const auto x = [&](vtkIdType i) { return flat->GetPoint(i)[0]; };
  const vtkIdType count = flat->GetNumberOfPoints();
  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetMethodToFlow();
  sampler->SetInputData(flat);
  sampler->SetNumberOfParticles(4000);
  const std::vector<vtkSmartPointer<vtkDataArray>> arrays{ makeArray("X", count, x),
    makeArray<vtkFloatArray>("X", count, x), makeArray<vtkIntArray>("X", count, x),
    makeArray<vtkUnsignedCharArray>("X", count, x) };
  for (const auto& array : arrays)
  {
    flat->GetPointData()->AddArray(array);
    flat->GetPointData()->SetActiveScalars("X");
    for (const bool active : { false, true })
    {
      if (active)
      {
        sampler->SetInputArrayToProcess(
          0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
      }
      else
      {
        sampler->SetInputArrayToProcess(
          0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, "X");
      }
      vtkPolyData* particles = runSampler(sampler);
      CHECK_NEAR(checks, fieldValue(particles, "TotalMass"), 0.5 * 400.0 * 10.0, 1e-9);
      vtkIdType left = 0;
      for (vtkIdType i = 0; i < 4000; ++i)
      {
        left += particles->GetPoint(i)[0] < 10.0;
      }
      CHECK(checks, std::abs(static_cast<double>(left) - 1000.0) < 15.0);
    }
  }
  // None, as ParaView says it, where there is no such array.
  sampler->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "None");
  CHECK_NEAR(checks, fieldValue(runSampler(sampler), "TotalMass"), 200.0, 1e-9);
  flat->GetPointData()->AddArray(makeArray("None", count, [](vtkIdType) { return 3.0; }));
  flat->Modified();
  CHECK_NEAR(checks, fieldValue(runSampler(sampler), "TotalMass"), 600.0, 1e-9);
}

void checkPatterns(Checks& checks)
{
  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetMethodToFlow();
  sampler->SetInputData(makeHill());
  sampler->SetNumberOfParticles(777);
  for (int pattern = 0; pattern < RectifiedTransport::numberOfSeedPatterns; ++pattern)
  {
    sampler->SetSeedPattern(pattern);
    const vtkIdType count = runSampler(sampler)->GetNumberOfPoints();
    const bool isLattice = pattern == vtkSurfaceSampler::LATTICE;
    CHECK(checks, isLattice ? std::abs(count - 777) < 30 && count != 777 : count == 777);
  }
  const Values before = coordinates(sampler->GetOutput());
  sampler->SetRandomSeed(2);
  CHECK(checks, largestDifference(before, coordinates(runSampler(sampler))) > 0.1);
}

// A density that is 0 on most cells, and cells that are hidden.
void checkEmptyParts(Checks& checks)
{
  auto hill = makeHill();
  const vtkIdType count = hill->GetNumberOfCells();
  const auto isDark = [](vtkIdType i) { return i / 2 % 24 < 9; };
  hill->GetCellData()->AddArray(
    makeArray<vtkIntArray>("Light", count, [&](vtkIdType i) { return isDark(i) ? 0.0 : 2.0; }));
  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetMethodToFlow();
  sampler->SetInputData(hill);
  sampler->SetNumberOfParticles(3000);
  sampler->SetResolution(37); // cells across the edge
  sampler->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Light");
  const auto countDark = [&](vtkPolyData* particles) {
    const Values cells = arrayValues(pointArray(particles, "CellId"));
    return std::count_if(
      cells.begin(), cells.end(), [&](double i) { return isDark(static_cast<vtkIdType>(i)); });
  };
  vtkPolyData* particles = runSampler(sampler);
  CHECK(checks, particles->GetNumberOfPoints() == 3000 && countDark(particles) == 0);
  expectOnCells(checks, hill, particles, __LINE__);
  const double mass = fieldValue(particles, "TotalMass");
  const Values first = coordinates(particles);

  hill->GetCellData()->AddArray(makeArray<vtkUnsignedCharArray>(
    vtkDataSetAttributes::GhostArrayName(), count, [&](vtkIdType i) {
      return isDark(i) ? static_cast<double>(vtkDataSetAttributes::HIDDENCELL) : 0.0;
    }));
  sampler->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "");
  particles = runSampler(sampler);
  CHECK(checks, countDark(particles) == 0);
  CHECK_NEAR(checks, fieldValue(particles, "TotalMass"), 0.5 * mass, 1e-10 * mass);
  CHECK(checks, coordinates(particles) == first);
  CHECK(checks, !particles->GetPointData()->HasArray(vtkDataSetAttributes::GhostArrayName()));
}

// Cells are numbered as in the input: vertices, lines, polygons, strips.
void checkPolygonsAndStrips(Checks& checks)
{
  auto quads = makeFlatSheet(8, 6, false);
  vtkNew<vtkCellArray> others;
  const vtkIdType ends[2] = { 0, 1 };
  others->InsertNextCell(2, ends);
  quads->SetLines(others);
  quads->SetVerts(others);
  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetMethodToFlow();
  sampler->SetInputData(quads);
  sampler->SetNumberOfParticles(500);
  const auto expectQuads = [&](vtkPolyData* particles, int line) {
    bool all = particles->GetNumberOfPoints() == 500;
    for (vtkIdType i = 0; all && i < 500; ++i)
    {
      const auto cell = static_cast<vtkIdType>(pointArray(particles, "CellId")->GetTuple1(i)) - 2;
      const double* x = particles->GetPoint(i);
      all = std::abs(x[0] - static_cast<double>(cell % 8) - 0.5) <= 0.5 + 1e-9 &&
        std::abs(x[1] - static_cast<double>(cell / 8) - 0.5) <= 0.5 + 1e-9;
    }
    checks.That(all, "cells of the input", line);
  };
  expectQuads(runSampler(sampler), __LINE__);
  const Values ofQuads = coordinates(sampler->GetOutput());
  // A strip for each row of quads.
  auto strips = makeFlatSheet(8, 6, false);
  vtkNew<vtkCellArray> rows;
  for (vtkIdType j = 0; j < 6; ++j)
  {
    rows->InsertNextCell(18);
    for (vtkIdType i = 0; i <= 8; ++i)
    {
      rows->InsertCellPoint((j + 1) * 9 + i);
      rows->InsertCellPoint(j * 9 + i);
    }
  }
  strips->SetPolys(vtkSmartPointer<vtkCellArray>::New());
  strips->SetStrips(rows);
  sampler->SetInputData(strips);
  vtkPolyData* particles = runSampler(sampler);
  CHECK(checks, particles->GetNumberOfPoints() == 500);
  for (vtkIdType i = 0; i < particles->GetNumberOfPoints(); ++i)
  {
    const double row = pointArray(particles, "CellId")->GetTuple1(i);
    CHECK(checks, std::abs(particles->GetPoint(i)[1] - row - 0.5) <= 0.5 + 1e-9);
  }
}

// Far from 1, and far from the origin.
void checkScales(Checks& checks)
{
  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetMethodToFlow();
  sampler->SetNumberOfParticles(300);
  sampler->SetInputData(makeHill());
  const Values expected = coordinates(runSampler(sampler));
  for (const double scale : { 0x1p-400, 0x1p+400 })
  {
    sampler->SetInputData(makeHill(true, scale));
    Values found = coordinates(runSampler(sampler));
    for (double& x : found)
    {
      x /= scale;
    }
    CHECK(checks, largestDifference(found, expected) < 1e-9);
    const double mass = fieldValue(sampler->GetOutput(), "TotalMass");
    CHECK_NEAR(checks, mass / scale / scale, areaOf(makeHill()), 1e-9);
  }
}

} // namespace

int TestSurfaceSampler(int, char*[])
{
  return runChecks({ checkOutput, checkFlatAsImage, checkPointDensity, checkPatterns,
    checkEmptyParts, checkPolygonsAndStrips, checkScales });
}
