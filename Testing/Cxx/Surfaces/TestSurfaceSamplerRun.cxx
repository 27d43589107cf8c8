// SPDX-License-Identifier: BSD-3-Clause
// How vtkSurfaceSampler runs: the same bits on any number of threads, progress, an abort, pieces
// and blocks, and what it says of wrong input.
#include "../../SeedPatterns.h"
#include "BlocksTest.h"
#include "ProgressTest.h"
#include "SurfaceSamplerTest.h"
#include "ThreadsTest.h"

#include "vtkSphereSource.h"
#include "vtkStringArray.h"

#include <limits>

namespace
{

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

void checkThreads(Checks& checks)
{
  auto hill = makeHill();
  hill->GetPointData()->AddArray(makeArray("Density", hill->GetNumberOfPoints(), bumpy));
  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetMethodToFlow();
  sampler->SetInputData(hill);
  sampler->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Density");
  sampler->SetNumberOfParticles(30000);
  sampler->SetResolution(200);
  const auto run = [&](int threading) {
    sampler->SetThreading(threading);
    sampler->Modified();
    Values all = coordinates(runSampler(sampler));
    for (const char* name : { "Mass", "CellId", "Normal", "Density" })
    {
      const Values values = arrayValues(pointArray(sampler->GetOutput(), name));
      all.insert(all.end(), values.begin(), values.end());
    }
    return all;
  };
  CHECK(checks, expectSameBits(checks, run, __LINE__).size() == 30000 * 9);
}

void checkAborts(Checks& checks)
{
  auto sheet = makeSheet(
    200, 150,
    [](double x, double y) {
      return std::array<double, 3>{ x, y, 1e-2 * x * y };
    },
    false);
  sheet->GetPointData()->AddArray(makeArray("Density", sheet->GetNumberOfPoints(), bumpy));
  sheet->GetCellData()->AddArray(makeArray("Number", sheet->GetNumberOfCells(), bumpy));
  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetMethodToFlow();
  Messages messages(sampler);
  sampler->SetInputData(sheet);
  sampler->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Density");
  sampler->SetNumberOfParticles(300000);
  const auto outdate = [&]() { sampler->Modified(); };
  for (const double from : { 0.001, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95 })
  {
    checkAbort(checks, sampler, from, outdate, __LINE__);
  }
  checkAbort(checks, sampler, 0.51, outdate, __LINE__, 20);
  ProgressTest progress(sampler);
  sampler->Modified();
  CHECK(checks, runSampler(sampler)->GetNumberOfPoints() == 300000);
  progress.ExpectRising(checks, 15, __LINE__);
  CHECK(checks, messages.Errors.empty());
}

void checkPipeline(Checks& checks)
{
  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetMethodToFlow();
  Messages messages(sampler);
  sampler->SetNumberOfParticles(50);
  sampler->SetInputData(vtkSmartPointer<vtkPolyData>::New());
  sampler->Update();
  CHECK(checks, isEmpty(sampler));
  sampler->SetInputData(makeHill());
  expectOnePiece(checks, sampler, __LINE__);
  sampler->SetInputData(makeBlocks({ makeHill(), nullptr, makeFlatSheet(3, 4, false) }));
  sampler->Update();
  for (const unsigned int block : { 0u, 2u })
  {
    auto* particles = outputBlock<vtkPolyData>(sampler, block);
    CHECK(checks, particles && particles->GetNumberOfPoints() == 50);
  }
  CHECK(checks, messages.Errors.empty());
  sampler->SetInputData(makeBlocks({ unitCells(2, 2, 1) }));
  sampler->Update();
  CHECK(checks, messages.IsOneError("The input has a block of type vtkImageData; it must be"));
}

void checkPropertyErrors(Checks& checks)
{
  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetMethodToFlow();
  sampler->SetInputData(makeHill());
  ErrorTest test(checks, sampler);
  sampler->SetNumberOfParticles(0);
  test.Expect("NumberOfParticles is 0; it must be at least 1", __LINE__);
  sampler->SetNumberOfParticles(1000000000000);
  test.Expect({ "Not enough memory for 1000000000000 particles (see NumberOfParticles)",
                "TB were asked for" },
    __LINE__);
  for (int pattern = 0; pattern < RectifiedTransport::numberOfSeedPatterns; ++pattern)
  {
    sampler->SetSeedPattern(pattern);
    sampler->SetNumberOfParticles(std::numeric_limits<vtkIdType>::max());
    test.Expect("Not enough memory for", __LINE__);
  }
  sampler->SetNumberOfParticles(10);
  sampler->SetSeedPattern(RectifiedTransport::numberOfSeedPatterns);
  test.Expect({ "SeedPattern is", "; it must be 0 (BlueNoise)" }, __LINE__);
  sampler->SetSeedPattern(0);
  for (const int resolution : { -3, 0, 16385 })
  {
    sampler->SetResolution(resolution);
    test.Expect(
      "Resolution is " + std::to_string(resolution) + "; it must be from 1 to 16384", __LINE__);
  }
  sampler->SetResolution(64);
  sampler->SetIntegrator(7);
  test.Expect("Integrator is 7; it must be", __LINE__);
  sampler->SetIntegrator(0);
  sampler->SetThreading(4);
  test.Expect("Threading is 4; it must be", __LINE__);
  sampler->SetThreading(0);
  sampler->SetNumberOfCorners(3);
  test.Expect("Corners are 3 points; they must be 4", __LINE__);
  sampler->SetCorner(3, 100);
  test.Expect("Corners ", __LINE__);
  sampler->ClearCorners();
  test.ExpectNone(__LINE__);
  CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == 10);
}

void checkDensityErrors(Checks& checks)
{
  auto hill = makeHill();
  vtkPointData* points = hill->GetPointData();
  const vtkIdType count = hill->GetNumberOfPoints();
  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetMethodToFlow();
  sampler->SetInputData(hill);
  sampler->SetNumberOfParticles(10);
  sampler->SetResolution(64);
  ErrorTest test(checks, sampler);
  sampler->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "D");
  test.Expect(
    "The input surface has no density array 'D'; it has no point arrays and no cell arrays",
    __LINE__);
  const auto expect = [&](const Values& some, const std::string& text, int line) {
    auto array = makeArray("D", count, [&](vtkIdType i) {
      return i >= 20 && i < 20 + static_cast<vtkIdType>(some.size())
        ? some[static_cast<std::size_t>(i - 20)]
        : 1.0;
    });
    points->AddArray(array);
    test.Expect("The density array 'D' has " + text, line);
  };
  expect({ -1.5, 2.0, -2.0 },
    "2 negative values, the first at index 20 (-1.5); a density must not be negative", __LINE__);
  expect({ 0.0, -2.0 }, "1 negative value, the first at index 21 (-2);", __LINE__);
  expect({ -3.0, nan, infinity, 0.0, nan },
    "3 values that are NaN or infinite, the first at index 21 (nan); every value must be finite",
    __LINE__);
  expect(
    { 0.0, -infinity }, "1 value that is NaN or infinite, the first at index 21 (-inf)", __LINE__);
  points->AddArray(makeArray("D", count, [](vtkIdType) { return 0.0; }));
  test.Expect("The density array 'D' has a total mass of zero; at least one value must be positive",
    __LINE__);
  points->AddArray(makeArray("D", count, [](vtkIdType) { return 1e308; }));
  test.Expect("The density array 'D' has a total mass past the largest double", __LINE__);
  points->AddArray(makeArray("D", count + 1, bumpy));
  test.Expect("The density array 'D' has " + std::to_string(count + 1) + " values, but there are " +
      std::to_string(count) + " points; there must be one for each",
    __LINE__);
  auto pairs = makeArray("D", 2 * count, bumpy);
  pairs->SetNumberOfComponents(2);
  points->AddArray(pairs);
  test.Expect("The density array 'D' has 2 components; it must have 1", __LINE__);
  vtkNew<vtkStringArray> text;
  text->SetName("D");
  text->SetNumberOfValues(count);
  points->AddArray(text);
  test.Expect("The density array 'D' is not numeric", __LINE__);
  sampler->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_NONE, "D");
  test.Expect("The field association of the density array is 2; it must be 0 (points)", __LINE__);
  // Values of lines do not count, those of polygons do.
  vtkNew<vtkCellArray> lines;
  const vtkIdType ends[2] = { 0, 1 };
  lines->InsertNextCell(2, ends);
  hill->SetLines(lines);
  hill->GetCellData()->AddArray(
    makeArray("C", hill->GetNumberOfCells(), [](vtkIdType i) { return i == 0 ? nan : 1.0; }));
  sampler->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "C");
  test.ExpectNone(__LINE__);
  hill->GetCellData()->AddArray(
    makeArray("C", hill->GetNumberOfCells(), [](vtkIdType i) { return i == 5 ? -1.0 : 1.0; }));
  test.Expect("The density array 'C' has 1 negative value, the first at index 5 (-1)", __LINE__);
}

void checkSurfaceErrors(Checks& checks)
{
  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetMethodToFlow();
  sampler->SetNumberOfParticles(10);
  ErrorTest test(checks, sampler);
  vtkNew<vtkSphereSource> sphere;
  sampler->SetInputConnection(sphere->GetOutputPort());
  test.Expect({ "The input surface is closed", "with Clip" }, __LINE__);
  auto points = makeFlatSheet(2, 2, false);
  points->SetPolys(vtkSmartPointer<vtkCellArray>::New());
  sampler->SetInputData(points);
  test.Expect("The input surface has 9 points and no polygons", __LINE__);
  auto wrong = makeFlatSheet(3, 3, false);
  wrong->GetPoints()->SetPoint(5, 0.0, nan, 0.0);
  sampler->SetInputData(wrong);
  test.Expect("The input surface has 1 point that is NaN or infinite", __LINE__);
  sampler->SetInputData(makeHill(true, 0x1p+600));
  test.Expect("The input surface has an area past the largest double", __LINE__);
}

} // namespace

int TestSurfaceSamplerRun(int, char*[])
{
  return runChecks({ checkThreads, checkAborts, checkPipeline, checkPropertyErrors,
    checkDensityErrors, checkSurfaceErrors });
}
