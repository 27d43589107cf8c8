// SPDX-License-Identifier: BSD-3-Clause
// vtkSurfaceSampler with Method Relaxation on surfaces that are no disks, and what it says of wrong
// input.
#include "ProgressTest.h"
#include "SolidTest.h"
#include "SurfaceSamplerTest.h"
#include "ThreadsTest.h"

#include "vtkStaticPointLocator.h"
#include "vtkTetra.h"
#include "vtkUnstructuredGrid.h"

#include <limits>

namespace
{

vtkSmartPointer<vtkSurfaceSampler> makeSampler(vtkDataObject* surface, vtkIdType particles = 600)
{
  auto sampler = vtkSmartPointer<vtkSurfaceSampler>::New();
  sampler->SetInputDataObject(surface);
  sampler->SetNumberOfParticles(particles);
  return sampler;
}

// The mean distance of the nearest other particle, by the largest that a plane allows.
double spacingOf(vtkPolyData* particles, double area)
{
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(particles);
  locator->BuildLocator();
  const vtkIdType count = particles->GetNumberOfPoints();
  vtkNew<vtkIdList> two;
  double sum = 0.0;
  for (vtkIdType i = 0; i < count; ++i)
  {
    double x[3];
    double y[3];
    particles->GetPoint(i, x);
    locator->FindClosestNPoints(2, x, two);
    particles->GetPoint(two->GetId(0) == i ? two->GetId(1) : two->GetId(0), y);
    sum += std::sqrt(vtkMath::Distance2BetweenPoints(x, y));
  }
  const auto n = static_cast<double>(count);
  return sum / n / std::sqrt(2.0 * area / (std::sqrt(3.0) * n));
}

// Each particle is in the polygon of its cell, and there are as many as were asked for.
void expectOnCells(Checks& checks, vtkSurfaceSampler* sampler, vtkPolyData* surface, int line)
{
  Messages messages(sampler);
  vtkPolyData* particles = runSampler(sampler);
  checks.That(messages.Errors.empty() && messages.Warnings.empty(), "no message", line);
  checks.That(particles->GetNumberOfPoints() == sampler->GetNumberOfParticles(), "count", line);
  vtkDataArray* cells = particles->GetPointData()->GetArray("CellId");
  double farthest = 0.0;
  for (vtkIdType i = 0; cells && i < particles->GetNumberOfPoints(); ++i)
  {
    double x[3];
    double near[3];
    double coordinates[3];
    double weights[100];
    double distance = 1.0;
    int part = 0;
    particles->GetPoint(i, x);
    surface->GetCell(static_cast<vtkIdType>(cells->GetTuple1(i)))
      ->EvaluatePosition(x, near, part, coordinates, distance, weights);
    farthest = std::max(farthest, distance);
  }
  checks.That(cells && farthest < 1e-20, "on cells", line, std::to_string(farthest));
}

void checkShapes(Checks& checks)
{
  const auto sphere = makeSphere(0, 0, 0, 1);
  const auto box = makeBox(0, 1, 0, 2, 0, 3);
  for (const auto& surface :
    { sphere, box, together(sphere, makeSphere(0.5, 0, 0, 1)),
      together(sphere, makeBox(5, 6, 5, 6, 5, 6)), together(box, turned(box)), makeCap(12, 0.5) })
  {
    auto sampler = makeSampler(surface);
    expectOnCells(checks, sampler, surface, __LINE__);
    const double total = sampler->GetOutput()->GetFieldData()->GetArray("TotalMass")->GetTuple1(0);
    checks.Near(total, areaOf(surface), 1e-9 * total, "area", __LINE__);
  }
  auto sampler = makeSampler(sphere, 2000);
  CHECK(checks, spacingOf(runSampler(sampler), areaOf(sphere)) > 0.88);
  const Values relaxed = coordinates(sampler->GetOutput());
  sampler->SetRelaxationIterations(0);
  const double start = spacingOf(runSampler(sampler), areaOf(sphere));
  CHECK(checks, start > 0.6 && start < 0.8);
  sampler->SetRelaxationIterations(20);
  sampler->SetRandomSeed(2);
  CHECK(checks, largestDifference(relaxed, coordinates(runSampler(sampler))) > 0.1);
  sampler->SetRandomSeed(1);
  CHECK(checks, coordinates(runSampler(sampler)) == relaxed);
}

// Three squares on one edge, and the triangles of a box that share no points.
void checkHardShapes(Checks& checks)
{
  auto leaves =
    makePolygons({ 0, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0, 1, -1, 1, 0, -1, 1, 1, -1, -1, 0, -1, -1, 1 },
      { 4, 0, 2, 3, 1, 4, 0, 4, 5, 1, 4, 0, 6, 7, 1 });
  expectOnCells(checks, makeSampler(leaves, 300), leaves, __LINE__);

  const auto box = makeBox(0, 1, 0, 1, 0, 1);
  Values points;
  std::vector<vtkIdType> faces;
  for (vtkIdType cell = 0; cell < box->GetNumberOfCells(); ++cell)
  {
    faces.push_back(4);
    for (int corner = 0; corner < 4; ++corner)
    {
      const double* x = box->GetPoint(box->GetCell(cell)->GetPointId(corner));
      faces.push_back(static_cast<vtkIdType>(points.size() / 3));
      points.insert(points.end(), x, x + 3);
    }
  }
  const auto apart = makePolygons(points, faces);
  auto sampler = makeSampler(apart, 1000);
  expectOnCells(checks, sampler, apart, __LINE__);
  CHECK(checks, spacingOf(sampler->GetOutput(), 6.0) > 0.86);
}

void checkFew(Checks& checks)
{
  const auto box = makeBox(0, 1, 0, 1, 0, 1);
  for (const vtkIdType count : { 1, 2, 3, 60000 })
  {
    expectOnCells(checks, makeSampler(box, count), box, __LINE__);
  }
}

// The number of particles on each cell.
std::vector<vtkIdType> countsOf(vtkPolyData* particles, vtkIdType cells)
{
  std::vector<vtkIdType> counts(static_cast<std::size_t>(cells));
  vtkDataArray* on = particles->GetPointData()->GetArray("CellId");
  for (vtkIdType i = 0; i < particles->GetNumberOfPoints(); ++i)
  {
    ++counts[static_cast<std::size_t>(on->GetTuple1(i))];
  }
  return counts;
}

void checkDensity(Checks& checks)
{
  const auto box = makeBox(0, 1, 0, 1, 0, 1);
  const Values densities{ 0, 1, 2, 3, 4, 0 };
  box->GetCellData()->AddArray(
    makeArray("Density", 6, [&](vtkIdType i) { return densities[static_cast<std::size_t>(i)]; }));
  auto sampler = makeSampler(box, 5000);
  sampler->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Density");
  const std::vector<vtkIdType> counts = countsOf(runSampler(sampler), 6);
  for (std::size_t cell = 0; cell < 6; ++cell)
  {
    const double right = 500.0 * densities[cell];
    checks.Near(static_cast<double>(counts[cell]), right, 0.03 * right, "count", __LINE__);
  }
  vtkDataArray* mass = sampler->GetOutput()->GetPointData()->GetArray("Mass");
  checks.Near(mass->GetTuple1(7), 10.0 / 5000.0, 1e-12, "Mass", __LINE__);

  const auto sphere = makeSphere(0, 0, 0, 1);
  sphere->GetPointData()->AddArray(makeArray("Height", sphere->GetNumberOfPoints(),
    [&](vtkIdType i) { return std::max(0.0, sphere->GetPoint(i)[2]); }));
  sampler = makeSampler(sphere, 2000);
  sampler->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Height");
  vtkPolyData* particles = runSampler(sampler);
  vtkIdType high = 0;
  bool isAbove = true;
  for (vtkIdType i = 0; i < particles->GetNumberOfPoints(); ++i)
  {
    high += particles->GetPoint(i)[2] > 0.5 ? 1 : 0;
    isAbove = isAbove && particles->GetPoint(i)[2] > -0.1; // less than a triangle below
  }
  CHECK(checks, isAbove);
  // The mass above a height z is 1 - z^2 of all.
  checks.Near(static_cast<double>(high), 1500.0, 15.0, "above one half", __LINE__);
}

void checkGhosts(Checks& checks)
{
  const auto box = makeBox(0, 1, 0, 1, 0, 1);
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  for (const int flag : { 0, 1, 0, 32, 0, 0 })
  {
    ghosts->InsertNextValue(static_cast<unsigned char>(flag));
  }
  box->GetCellData()->AddArray(ghosts);
  auto sampler = makeSampler(box, 400);
  const std::vector<vtkIdType> counts = countsOf(runSampler(sampler), 6);
  CHECK(checks, counts[1] == 0 && counts[3] == 0 && counts[0] > 90 && counts[5] > 90);
  ghosts->FillValue(1);
  ghosts->Modified();
  box->Modified();
  ErrorTest test(checks, sampler);
  test.Expect("The input surface has only ghost cells: all 12 triangles", __LINE__);
}

// The outer surface of tetrahedra counts, and cells are theirs.
void checkVolume(Checks& checks)
{
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(makePoints({ 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1 })->GetPoints());
  const std::vector<vtkIdType> corners{ 0, 1, 2, 3, 1, 2, 3, 4 };
  grid->InsertNextCell(VTK_TETRA, 4, corners.data());
  grid->InsertNextCell(VTK_TETRA, 4, corners.data() + 4);
  grid->GetCellData()->AddArray(makeNumbers("Number", 2));
  auto sampler = makeSampler(grid, 1200);
  vtkPolyData* particles = runSampler(sampler);
  CHECK(checks, particles->GetNumberOfPoints() == 1200);
  bool isOuter = true;
  for (vtkIdType i = 0; i < particles->GetNumberOfPoints(); ++i)
  {
    double x[3];
    particles->GetPoint(i, x);
    const bool isFirst = particles->GetPointData()->GetArray("CellId")->GetTuple1(i) == 0.0;
    const double number = particles->GetPointData()->GetArray("Number")->GetTuple1(i);
    isOuter = isOuter && number == (isFirst ? 0.0 : 1.0);
    // The face between the two is where x + y + z = 1.
    isOuter =
      isOuter && (isFirst ? x[0] + x[1] + x[2] < 1.0 + 1e-12 : x[0] + x[1] + x[2] > 1.0 - 1e-12);
  }
  CHECK(checks, isOuter);
  // Three faces of half a square, and three of sides of length sqrt(2).
  const double second = 3.0 * std::sqrt(3.0) / 2.0;
  const double right = 1200.0 * second / (1.5 + second);
  checks.Near(
    static_cast<double>(countsOf(particles, 2)[1]), right, 0.03 * right, "count", __LINE__);
}

void checkErrors(Checks& checks)
{
  auto sampler = makeSampler(makeSphere(0, 0, 0, 1));
  ErrorTest test(checks, sampler);
  for (const int iterations : { -1, 1001 })
  {
    sampler->SetRelaxationIterations(iterations);
    test.Expect(
      "RelaxationIterations is " + std::to_string(iterations) + "; it must be from 0 to 1000",
      __LINE__);
  }
  sampler->SetRelaxationIterations(20);
  for (const int method : { -1, 2 })
  {
    sampler->SetMethod(method);
    test.Expect("Method is " + std::to_string(method) + "; it must be 0 (Relaxation)", __LINE__);
  }
  sampler->SetMethodToRelaxation();
  sampler->SetNumberOfParticles(std::numeric_limits<vtkIdType>::max());
  test.Expect("Not enough memory for", __LINE__);
  sampler->SetNumberOfParticles(10);
  sampler->SetInputData(makePolygons({ 0, 0, 0, 1, 1, 1, 2, 2, 2 }, { 3, 0, 1, 2 }));
  test.Expect("The input surface has no area", __LINE__);
  sampler->SetInputData(makePolygons({ 0, 0, 0, 1, 0, 0, 0.5, 1e-13, 0 }, { 3, 0, 1, 2 }));
  test.Expect(
    "The input surface has no area: each of its 1 triangles is lower than 1e-12", __LINE__);
  sampler->SetInputData(makePoints({ 0, 0, 0, 1, 1, 1 }));
  test.Expect(
    "The input surface has 2 points and no polygons; it must be a surface of polygons", __LINE__);
  auto box = makeBox(0, 1, 0, 1, 0, 1);
  box->GetCellData()->AddArray(makeArray("D", 6, [](vtkIdType i) { return i == 4 ? -1.0 : 1.0; }));
  sampler->SetInputData(box);
  sampler->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "D");
  test.Expect("The density array 'D' has 1 negative value, the first at index 4 (-1)", __LINE__);
  box->GetCellData()->AddArray(makeArray("D", 6, [](vtkIdType) { return 0.0; }));
  box->Modified();
  test.Expect("The density array 'D' has a total mass of zero", __LINE__);
}

void checkThreads(Checks& checks)
{
  auto sphere = makeSphere(0, 0, 0, 1);
  sphere->GetPointData()->AddArray(makeArray("Density", sphere->GetNumberOfPoints(), bumpy));
  auto sampler = makeSampler(sphere, 20000);
  sampler->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Density");
  const auto run = [&](int threading) {
    sampler->SetThreading(threading);
    sampler->Modified();
    return coordinates(runSampler(sampler));
  };
  CHECK(checks, expectSameBits(checks, run, __LINE__).size() == 20000 * 3);
}

void checkAborts(Checks& checks)
{
  auto sampler = makeSampler(makeSphere(0, 0, 0, 1, 300), 200000);
  const auto outdate = [&]() { sampler->Modified(); };
  for (const double from : { 0.001, 0.1, 0.3, 0.5, 0.7, 0.9, 0.97 })
  {
    checkAbort(checks, sampler, from, outdate, __LINE__);
  }
}

} // namespace

int TestSurfaceSamplerShapes(int, char*[])
{
  return runChecks({ checkShapes, checkHardShapes, checkFew, checkDensity, checkGhosts, checkVolume,
    checkErrors, checkThreads, checkAborts });
}
