// SPDX-License-Identifier: BSD-3-Clause
// How vtkAreaPreservingParameterization runs: in a pipeline, the same bits on any number of
// threads, progress, an abort, and what it says of wrong input.
#include "BlocksTest.h"
#include "ParameterizationTest.h"
#include "ProgressTest.h"
#include "ThreadsTest.h"

#include "vtkPlaneSource.h"
#include "vtkSphereSource.h"

#include <limits>
#include <string>

namespace
{

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

void checkPipeline(Checks& checks)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(6, 5);
  vtkNew<Parameterization> filter;
  CHECK(checks, filter->GetResolution() == 512 && filter->GetPolish());
  CHECK(checks, filter->GetSeams() == Parameterization::SEAMS_AUTO);
  CHECK(checks, filter->GetNumberOfCorners() == 0);
  filter->SetInputConnection(plane->GetOutputPort());
  filter->SetResolution(32);
  Messages messages(filter);
  filter->Update();
  CHECK(checks, squareValues(filter).size() == 84);
  plane->SetResolution(3, 2);
  filter->Update();
  CHECK(checks, squareValues(filter).size() == 24);
  // Without an input there is nothing to do, and the arrays of the last run go.
  filter->SetInputData(vtkSmartPointer<vtkPolyData>::New());
  filter->Update();
  CHECK(checks, isEmpty(filter) && filter->GetOutput()->GetNumberOfPoints() == 0);
  CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());
  // The second of two pieces is empty.
  filter->SetInputData(makeHills(5, 5));
  expectOnePiece(checks, filter, __LINE__);
}

void checkBlocks(Checks& checks)
{
  vtkNew<Parameterization> filter;
  filter->SetResolution(32);
  filter->SetInputData(makeBlocks({ makeFlatSheet(4, 3), makeCap(5, 0.5) }));
  filter->Update();
  auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  CHECK(checks, output && output->GetNumberOfBlocks() == 2);
  const vtkIdType points[2] = { 20, 76 };
  for (const unsigned int block : { 0u, 1u })
  {
    auto* surface = outputBlock<vtkPolyData>(filter, block);
    CHECK(checks, surface && surface->GetNumberOfPoints() == points[block]);
    CHECK(checks, surface && surface->GetPointData()->GetTCoords());
    CHECK(checks, surface && surface->GetFieldData()->GetArray("FlippedCount"));
  }
}

void checkThreads(Checks& checks)
{
  for (const bool triangles : { true, false })
  {
    auto surface = makeSheet(
      50, 40,
      [](double x, double y) {
        return std::array<double, 3>{ x, y, 5.0 * std::sin(0.3 * x) * std::cos(0.2 * y) };
      },
      triangles);
    auto filter = makeParameterization(surface);
    const auto run = [&](int threading) {
      filter->SetThreading(threading);
      filter->Modified();
      Values all = runSquare(filter);
      for (const char* name : { "AreaDistortion", "AngleDistortion", "Flipped" })
      {
        const Values more = cellValues(filter, name);
        all.insert(all.end(), more.begin(), more.end());
      }
      for (const char* name : { "AreaDistortionRMS", "AngleDistortionMean", "FlippedCount" })
      {
        all.push_back(fieldValue(filter->GetOutput(), name));
      }
      return all;
    };
    CHECK(checks, expectSameBits(checks, run, __LINE__).size() == 2 * 51 * 41 + 3 * 4000 + 3);
  }
}

void checkAborts(Checks& checks)
{
  auto filter = makeParameterization(makeHills(150, 150));
  filter->SetResolution(512);
  Messages messages(filter);
  const auto outdate = [&]() { filter->Modified(); };
  for (const double from : { 0.001, 0.02, 0.05, 0.09, 0.12, 0.2, 0.35, 0.45, 0.6, 0.8, 0.96 })
  {
    checkAbort(checks, filter, from, outdate, __LINE__);
  }
  checkAbort(checks, filter, 0.15, outdate, __LINE__, 20);
  checkAbort(checks, filter, 0.5, outdate, __LINE__, 20);
  ProgressTest progress(filter);
  filter->Modified();
  CHECK(checks, !runSquare(filter).empty());
  progress.ExpectRising(checks, 20, __LINE__);
  CHECK(checks, messages.Errors.empty());
}

// Where polygons are cut, and cell data are copied.
void checkAbortAmongPolygons(Checks& checks)
{
  auto surface = makeFlatSheet(500, 500, false);
  surface->GetCellData()->AddArray(makeNumbers("Number", surface->GetNumberOfCells()));
  auto filter = makeParameterization(surface);
  Messages messages(filter);
  for (const double from : { 0.005, 0.02, 0.034, 0.04, 0.06 })
  {
    checkAbort(
      checks, filter, from, [&]() { filter->Modified(); }, __LINE__);
  }
  CHECK(checks, messages.Errors.empty());
}

vtkSmartPointer<vtkPolyData> makeClosed(int resolution)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(resolution);
  sphere->SetPhiResolution(resolution);
  sphere->Update();
  return sphere->GetOutput();
}

// A surface that is cut along seams.
void checkSeams(Checks& checks)
{
  auto filter = makeParameterization(makeClosed(40));
  Messages messages(filter);
  const auto run = [&](int threading) {
    filter->SetThreading(threading);
    filter->Modified();
    return runSquare(filter);
  };
  const std::size_t values = expectSameBits(checks, run, __LINE__).size();
  vtkPolyData* output = filter->GetOutput();
  CHECK(checks, values == 2 * static_cast<std::size_t>(output->GetNumberOfPoints()));
  CHECK(checks, output->GetPointData()->GetArray("PointIds"));
  CHECK(checks, output->GetCellData()->GetArray("Component"));
  CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());

  CHECK(checks, std::string(filter->GetSeamsAsString()) == "Auto");
  filter->SetSeamsToNone();
  CHECK(checks, std::string(filter->GetSeamsAsString()) == "None");
  ErrorTest(checks, filter).Expect("The input surface is closed", __LINE__);
  filter->SetSeams(2);
  ErrorTest(checks, filter).Expect("Seams is 2; it must be 0 (Auto) or 1 (None)", __LINE__);
  filter->SetSeamsToAuto();
  for (int i = 0; i < 4; ++i)
  {
    filter->SetCorner(i, i);
  }
  ErrorTest(checks, filter).Expect("give no Corners, which only a disk can have", __LINE__);
  filter->ClearCorners();
  ErrorTest(checks, filter).ExpectNone(__LINE__);
}

void checkAbortsOfSeams(Checks& checks)
{
  auto filter = makeParameterization(makeClosed(200));
  Messages messages(filter);
  for (const double from : { 0.02, 0.1, 0.15, 0.2, 0.3, 0.4, 0.49, 0.6, 0.96 })
  {
    checkAbort(
      checks, filter, from, [&]() { filter->Modified(); }, __LINE__);
  }
  ProgressTest progress(filter);
  filter->Modified();
  CHECK(checks, !runSquare(filter).empty());
  progress.ExpectRising(checks, 20, __LINE__);
  CHECK(checks, messages.Errors.empty());
}

void checkPropertyErrors(Checks& checks)
{
  auto filter = makeParameterization(makeFlatSheet(5, 4)); // 30 points
  ErrorTest test(checks, filter);
  const auto expectCorners = [&](
                               const std::vector<vtkIdType>& corners, const char* text, int line) {
    setCorners(filter, corners);
    test.Expect(text, line);
  };
  for (const int resolution : { 0, -7, 16385 })
  {
    filter->SetResolution(resolution);
    test.Expect(
      "Resolution is " + std::to_string(resolution) + "; it must be from 1 to 16384", __LINE__);
  }
  filter->SetResolution(16);
  filter->SetThreading(4);
  test.Expect("Threading is 4; it must be 0 (Auto)", __LINE__);
  filter->SetThreadingToAuto();
  expectCorners({ 0 }, "Corners are 1 points; they must be 4 of the boundary, or none", __LINE__);
  expectCorners({ 0, 5, 29 }, "Corners are 3 points; they must be 4", __LINE__);
  expectCorners({ 0, 5, 29, 24, 12 }, "Corners are 5 points; they must be 4", __LINE__);
  expectCorners({ 0, 5, 30, 24 }, "Corners have the point 30; there are points 0 to 29", __LINE__);
  expectCorners({ -1, 5, 29, 24 }, "Corners have the point -1; there are points 0 to 29", __LINE__);
  expectCorners({ 0, 5, 14, 24 },
    "Corners have the point 14, which is not on the boundary of the surface", __LINE__);
  expectCorners({ 0, 5, 29, 5 }, "Corners have the point 5 twice", __LINE__);
  filter->ClearCorners();
  test.ExpectNone(__LINE__);

  Messages messages(filter);
  filter->SetNumberOfCorners(-1);
  CHECK(checks, messages.IsOneError("The number of corners is -1; it must be from 0 to 1000000"));
  messages.Clear();
  filter->SetCorner(-1, 3);
  filter->SetCorner(1000000, 3);
  CHECK(checks, messages.Errors.size() == 2 && filter->GetNumberOfCorners() == 0);
  CHECK(
    checks, contains(messages.Errors[1], "The index of a corner is 1000000; it must be from 0"));
}

void checkSurfaceErrors(Checks& checks)
{
  vtkNew<Parameterization> filter;
  filter->SetResolution(8);
  filter->SetSeamsToNone();
  const auto expect = [&](vtkPolyData* surface, const std::string& text, int line) {
    filter->SetInputData(surface);
    ErrorTest(checks, filter).Expect(text, line);
  };
  expect(makePoints({ 0, 0, 0, 1, 0, 0 }),
    "The input surface has 2 points and no polygons; it must "
    "be a disk of polygons (lines and vertices do not count)",
    __LINE__);
  vtkNew<vtkSphereSource> sphere;
  sphere->Update();
  expect(
    sphere->GetOutput(), "The input surface is closed: it has no boundary; cut it open", __LINE__);

  auto sheet = makeFlatSheet(3, 3);
  sheet->GetPoints()->SetPoint(2, nan, 0, 0);
  sheet->GetPoints()->SetPoint(7, 0, infinity, 0);
  expect(sheet, "The input surface has 2 points that are NaN or infinite, the first at index 2",
    __LINE__);
  expect(makePolygons({ 0, 0, 0, 1, 0, 0, 2, 0, 0, 4, 0, 0 }, { 3, 0, 1, 2, 3, 1, 2, 3 }),
    "The input surface has 2 triangles without area, the first is triangle 0", __LINE__);
  const std::vector<double> corners{ 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.2, 0.3, 1 };
  expect(makePolygons(corners, { 3, 0, 1, 2, 3, 0, 2, 3, 3, 0, 2, 4 }),
    "The input surface has 1 non-manifold edge; every edge must be one of at most two", __LINE__);
  expect(makePolygons(
           { 0, 0, 0, 1, 0, 0, 1, 1, 0, 5, 0, 0, 6, 0, 0, 6, 1, 0 }, { 3, 0, 1, 2, 3, 3, 4, 5 }),
    "The input surface has 2 components that no edges join", __LINE__);
  expect(makePolygons(corners, { 3, 0, 1, 4, 3, 1, 2, 4, 3, 2, 0, 4 }),
    "The input surface has 3 points on its boundary", __LINE__);
  expect(makePolygons({ 0, 0, 0, 1, 0, 0, 1, 1, 0 }, { 3, 0, 1, 2 }),
    "The input surface has 3 points on its boundary; it must have at least 4", __LINE__);
  vtkNew<vtkSphereSource> tube; // without both poles
  tube->SetStartPhi(30);
  tube->SetEndPhi(150);
  tube->SetThetaResolution(8);
  tube->SetPhiResolution(5);
  tube->Update();
  expect(tube->GetOutput(), "The input surface has 2 boundary loops; it must have one", __LINE__);
  expect(makePolygons(corners, { 3, 0, 1, 2, 3, 0, 2, 17 }),
    "Cell 1 of the input surface has the point 17; there are points 0 to 4", __LINE__);
  expect(makePolygons(corners, { 4, 0, 1, 2, -3 }), "has the point -3", __LINE__);
  expect(makePolygons({ 0, 0, 0, 1, 1, 0, 1, 0, 0, 0, 1, 0 }, { 4, 0, 1, 2, 3 }),
    "The input surface has polygons that cannot be cut into triangles", __LINE__);
  filter->SetInputData(makeBlocks({ vtkSmartPointer<vtkImageData>::New() }));
  ErrorTest(checks, filter).Expect("The input has a block of type vtkImageData", __LINE__);
}

// Coordinates whose squares no double is.
void checkScales(Checks& checks)
{
  auto filter = makeParameterization(makeHills(5, 5));
  const Values wanted = runSquare(filter);
  for (const double scale : { 1e-200, 1e-30, 1e30, 1e200 })
  {
    Values points = coordinates(makeHills(5, 5));
    std::transform(
      points.begin(), points.end(), points.begin(), [scale](double x) { return scale * x; });
    auto scaled = makePoints(points);
    scaled->SetPolys(makeHills(5, 5)->GetPolys());
    filter->SetInputData(scaled);
    CHECK(checks, largestDifference(runSquare(filter), wanted) < 1e-6);
  }
}

} // namespace

int TestAreaPreservingRun(int, char*[])
{
  return runChecks({ checkPipeline, checkBlocks, checkThreads, checkAborts, checkAbortAmongPolygons,
    checkSeams, checkAbortsOfSeams, checkPropertyErrors, checkSurfaceErrors, checkScales });
}
