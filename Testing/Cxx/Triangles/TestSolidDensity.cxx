// SPDX-License-Identifier: BSD-3-Clause
// What vtkSolidDensity gives: the image around the surface, volumes against formulas and
// vtkMassProperties, and what counts as inside.
#include "SolidTest.h"

#include "vtkStripper.h"
#include "vtkXMLPolyDataReader.h"

#include <array>
#include <random>

namespace
{

// A box of 4 x 2 x 1 whose longest side has 8 of 10 cells: all faces are on borders of cells.
void checkGeometry(Checks& checks)
{
  vtkNew<vtkSolidDensity> solid;
  solid->SetInputData(makeBox(1, 5, -2, 0, 7, 8));
  solid->SetResolution(10);
  solid->SetPadding(0.125);
  solid->SetAssociationToCells();
  const std::vector<double> cells = runSolid(solid);
  vtkImageData* image = solid->GetOutput();
  const std::array<int, 3> wanted{ 11, 7, 5 };
  const std::array<double, 6> bounds{ 0.5, 5.5, -2.5, 0.5, 6.5, 8.5 };
  for (int a = 0; a < 3; ++a)
  {
    const std::size_t i = static_cast<std::size_t>(a);
    CHECK(checks, image->GetDimensions()[a] == wanted[i]);
    CHECK(checks, image->GetSpacing()[a] == 0.5);
    CHECK(checks, image->GetBounds()[2 * a] == bounds[2 * i]);
    CHECK(checks, image->GetBounds()[2 * a + 1] == bounds[2 * i + 1]);
  }
  CHECK(checks, image->GetCellData()->GetScalars() == image->GetCellData()->GetArray("Density"));
  CHECK(checks, vtkDoubleArray::SafeDownCast(image->GetCellData()->GetScalars()));
  for (vtkIdType i = 0; i < image->GetNumberOfCells(); ++i)
  {
    double x[6];
    image->GetCellBounds(i, x);
    const bool inside = x[0] >= 1 && x[1] <= 5 && x[2] >= -2 && x[3] <= 0 && x[4] >= 7 && x[5] <= 8;
    CHECK(checks, cells[static_cast<std::size_t>(i)] == (inside ? 1.0 : 0.0));
  }
  solid->SetAssociationToPoints();
  CHECK(checks, runSolid(solid) == cells);
  CHECK(checks, image->GetCellData()->GetNumberOfArrays() == 0);
  CHECK(checks, image->GetPointData()->GetScalars() == image->GetPointData()->GetArray("Density"));
  for (int a = 0; a < 3; ++a)
  {
    const std::size_t i = static_cast<std::size_t>(a);
    CHECK(checks, image->GetDimensions()[a] == wanted[i] - 1);
    CHECK(checks, image->GetSpacing()[a] == 0.5);
    CHECK(checks, image->GetOrigin()[a] == bounds[2 * i] + 0.25);
  }
}

// Sides that are no whole number of cells are covered, about the centre.
void checkBox(Checks& checks)
{
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> side(0.1, 3.0);
  for (int run = 0; run < 20; ++run)
  {
    const double x[3] = { side(random), side(random), side(random) };
    const double longest = std::max({ x[0], x[1], x[2] });
    vtkNew<vtkSolidDensity> solid;
    solid->SetInputData(makeBox(5, 5 + x[0], -9, -9 + x[1], 0, x[2]));
    solid->SetResolution(16 + run);
    solid->SetPadding(0.01 * run);
    solid->SetAssociationToCells();
    solid->Update();
    vtkImageData* image = solid->GetOutput();
    const double spacing = longest * (1.0 + 0.02 * run) / (16 + run);
    for (int a = 0; a < 3; ++a)
    {
      const double low = a == 0 ? 5 : a == 1 ? -9 : 0;
      CHECK_NEAR(checks, image->GetSpacing()[a], spacing, 1e-14);
      CHECK_NEAR(checks, image->GetCenter()[a], low + 0.5 * x[a], 1e-13);
      const double length = spacing * (image->GetDimensions()[a] - 1);
      const double wanted = x[a] + 0.02 * run * longest;
      CHECK(checks, length > wanted - 1e-9 && length < wanted + spacing);
    }
    CHECK(checks,
      std::max({ image->GetDimensions()[0], image->GetDimensions()[1],
        image->GetDimensions()[2] }) == 17 + run);
  }
}

void checkSpot(Checks& checks)
{
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(RECTIFIEDTRANSPORT_DATA "/spot.vtp");
  reader->Update();
  const double volume = volumeOf(reader->GetOutput());
  CHECK(checks, volume > 0.1);
  CHECK_NEAR(checks, massOf(reader->GetOutput(), 128) / volume, 1.0, 1e-5);
  CHECK_NEAR(checks, massOf(reader->GetOutput(), 8, 1) / volume, 1.0, 1e-5);
}

// Against the formula, for the surface that the sphere becomes as it is refined.
void checkSphere(Checks& checks)
{
  const double volume = 4.0 / 3.0 * pi * 27.0;
  CHECK_NEAR(checks, massOf(makeSphere(1, 2, 3, 3.0, 400), 128) / volume, 1.0, 5e-4);
  auto sphere = makeSphere(0.1, -0.2, 0.3, 0.5);
  const double truth = volumeOf(sphere);
  for (const int resolution : { 1, 8, 64, 128 })
  {
    for (const int supersampling : { 1, 2, 16 })
    {
      CHECK_NEAR(checks, massOf(sphere, resolution, supersampling) / truth, 1.0, 1e-12);
    }
  }
}

// The same solid moved, turned in space, mirrored and with its axes exchanged.
void checkTransforms(Checks& checks)
{
  auto tetrahedron = makePolyhedron({ 0.1, 0.2, 0.3, 2.1, 0.5, 0.1, 0.7, 1.9, 0.4, 0.6, 0.8, 2.3 },
    { 3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 2, 0, 3 });
  const double truth = volumeOf(tetrahedron);
  std::mt19937_64 random(9);
  std::normal_distribution<double> normal;
  for (int run = 0; run < 24; ++run)
  {
    vtkNew<vtkTransform> transform;
    transform->Translate(normal(random), 100.0 * normal(random), 0.0);
    if (run % 3 == 0)
    {
      transform->RotateWXYZ(360.0 * normal(random), normal(random), normal(random), normal(random));
    }
    else if (run % 3 == 1)
    {
      const double permutation[16] = { 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1 };
      transform->Concatenate(permutation);
    }
    transform->Scale(run % 2 ? 1.0 : -1.0, run % 4 < 2 ? 1.0 : -1.0, 1.0);
    auto moved = transformed(tetrahedron, transform);
    vtkNew<vtkSolidDensity> solid;
    solid->SetInputData(moved);
    solid->SetSupersampling(4);
    solid->SetAssociationToCells();
    solid->Update();
    CHECK_NEAR(checks, massOf(solid) / truth, 1.0, 1e-11);
    double bounds[6];
    moved->GetBounds(bounds);
    CHECK(checks, countLeaks(solid, bounds) == 0);
  }
}

void checkInside(Checks& checks)
{
  auto ball = makeSphere(0, 0, 0, 1.0, 60);
  auto core = makeSphere(0.1, 0, 0, 0.5, 50);
  const double shell = volumeOf(ball) - volumeOf(core);
  auto hollow = together(ball, turned(core));
  CHECK_NEAR(checks, massOf(hollow, 96) / shell, 1.0, 1e-11);
  CHECK_NEAR(checks, massOf(hollow, 96) / volumeOf(hollow), 1.0, 1e-11);
  CHECK_NEAR(checks, massOf(turned(hollow), 96) / shell, 1.0, 1e-11);
  CHECK_NEAR(checks, massOf(together(ball, core), 96) / volumeOf(ball), 1.0, 1e-11);
  // Beside each other, one of them inside out.
  auto far = makeSphere(9, 0, 0, 0.5, 50);
  CHECK_NEAR(
    checks, massOf(together(ball, turned(far)), 32) / (volumeOf(ball) + volumeOf(far)), 1.0, 1e-11);

  // Two balls of radius r, a distance d apart, share pi (4 r + d) (2 r - d)^2 / 12.
  auto other = makeSphere(0.8, 0, 0, 1.0, 60);
  const double lens = pi * 4.8 * 1.2 * 1.2 / 12.0;
  const double united = massOf(together(ball, other), 96);
  CHECK_NEAR(checks, united, 2.0 * 4.0 / 3.0 * pi - lens, 0.01 * united);
  CHECK_NEAR(checks, massOf(together(ball, turned(other)), 96), united - lens, 0.01 * united);
}

// Wherever polygons disagree, their component goes by most of its area; strips are cut.
void checkPolygons(Checks& checks)
{
  auto sphere = makeSphere(0, 0, 0, 1.0);
  vtkNew<vtkSolidDensity> solid;
  solid->SetInputData(sphere);
  solid->SetResolution(30);
  const std::vector<double> wanted = runSolid(solid);
  vtkNew<vtkStripper> stripper;
  stripper->SetInputData(sphere);
  stripper->Update();
  CHECK(checks, stripper->GetOutput()->GetNumberOfStrips() > 0);
  solid->SetInputData(stripper->GetOutput());
  CHECK(checks, largestDifference(runSolid(solid), wanted) < 1e-12);

  // Each triangle with points of its own, some turned, a vertex and a line far away.
  auto loose = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < sphere->GetNumberOfCells(); ++i)
  {
    sphere->GetCellPoints(i, ids);
    const bool turn = i % 5 == 0;
    vtkIdType corners[3];
    for (int j = 0; j < 3; ++j)
    {
      corners[j] = points->InsertNextPoint(sphere->GetPoint(ids->GetId(turn ? 2 - j : j)));
    }
    polygons->InsertNextCell(3, corners);
    corners[1] = corners[0]; // without area
    polygons->InsertNextCell(3, corners);
  }
  vtkNew<vtkCellArray> others;
  const vtkIdType line[2] = { points->InsertNextPoint(50, 0, 0),
    points->InsertNextPoint(0, 90, 0) };
  others->InsertNextCell(2, line);
  loose->SetPoints(points);
  loose->SetLines(others);
  loose->SetPolys(polygons);
  solid->SetInputData(loose);
  CHECK(checks, largestDifference(runSolid(solid), wanted) < 1e-12);

  // A prism over a concave polygon.
  auto prism = makePolyhedron({ 0, 0, 0, 3, 0, 0, 3, 3, 0, 1.5, 1, 0, 0, 3, 0, 0, 0, 2, 3, 0, 2, 3,
                                3, 2, 1.5, 1, 2, 0, 3, 2 },
    { 5, 4, 3, 2, 1, 0, 5, 5, 6, 7, 8, 9, 4, 0, 1, 6, 5, 4, 1, 2, 7, 6, 4, 2, 3, 8, 7, 4, 3, 4, 9,
      8, 4, 4, 0, 5, 9 });
  CHECK_NEAR(checks, massOf(prism, 96, 4), 2.0 * (9.0 - 3.0), 1e-11);
}

void checkCornersThatCoincide(Checks& checks)
{
  auto surface = makeQuadSphere(24, 36);
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputData(surface);
  clean->Update();
  const double volume = volumeOf(clean->GetOutput());
  CHECK_NEAR(checks, volume, 4.0 / 3.0 * pi, 0.1);
  CHECK_NEAR(checks, massOf(surface, 64), volume, 1e-11 * volume);
}

// Two triangles back to back: closed, with nothing inside.
void checkFlat(Checks& checks)
{
  vtkNew<vtkSolidDensity> solid;
  solid->SetInputData(makePolyhedron({ 0, 0, 0, 1, 0, 0, 0, 1, 0 }, { 3, 0, 1, 2, 3, 0, 2, 1 }));
  for (const double padding : { 0.0, 0.05 })
  {
    solid->SetPadding(padding);
    const std::vector<double> values = runSolid(solid);
    CHECK(checks, values.size() >= 64 * 64);
    CHECK(checks,
      std::count(values.begin(), values.end(), 0.0) == static_cast<std::ptrdiff_t>(values.size()));
  }
}

void checkSizes(Checks& checks)
{
  auto box = makeBox(0, 1, 0, 1, 0, 1);
  vtkNew<vtkSolidDensity> solid;
  solid->SetInputData(box);
  solid->SetResolution(1);
  solid->SetPadding(0.5);
  CHECK(checks, runSolid(solid) == std::vector<double>{ 0.125 });
  solid->SetPadding(0.0);
  CHECK(checks, runSolid(solid) == std::vector<double>{ 1.0 });
  // Of any size, far from the origin.
  auto tetrahedron = makePolyhedron(
    { 3, 0, 0, 5, 0, 0, 3, 2, 0, 3, 0, 2 }, { 3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 2, 0, 3 });
  const double truth = massOf(tetrahedron, 20);
  for (const double scale : { 1e-100, 1e-30, 1e30, 1e100 })
  {
    vtkNew<vtkTransform> transform;
    transform->Translate(-1e6 * scale, 0.0, 1e8 * scale);
    transform->Scale(scale, scale, scale);
    const double volume = massOf(transformed(tetrahedron, transform), 20);
    CHECK_NEAR(checks, volume / (scale * scale * scale) / truth, 1.0, 1e-6);
  }
}

} // namespace

int TestSolidDensity(int, char*[])
{
  return runChecks({ checkGeometry, checkBox, checkSphere, checkSpot, checkTransforms, checkInside,
    checkPolygons, checkCornersThatCoincide, checkFlat, checkSizes });
}
