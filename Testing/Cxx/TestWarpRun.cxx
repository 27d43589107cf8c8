// SPDX-License-Identifier: BSD-3-Clause
// How it runs: tables that are kept, the same bits on any number of threads, progress, an abort.
#include "ProgressTest.h"
#include "WarpTest.h"

#include "vtkSMPTools.h"
#include "vtkStructuredGrid.h"
#include "vtkTrivialProducer.h"

namespace
{

void checkCache(Checks& checks)
{
  vtkNew<vtkDensityEqualizingWarp> warp;
  auto image = makeImage(9, 7, 1, true, bumpy);
  warp->SetDensityData(image);
  warp->SetInputData(makePoints({ 3, 2, 0 }));
  vtkMTimeType last = 0;
  const auto expect = [&](bool built, const char* what, int line) {
    warp->Update();
    checks.That((warp->GetTableBuildTime() > last) == built, what, line);
    last = warp->GetTableBuildTime();
  };
  expect(true, "the first run builds", __LINE__);
  warp->SetInputData(makePoints({ 4, 2, 0, 1, 1, 1 }));
  expect(false, "other points", __LINE__);
  warp->GetInputDataObject(0, 0)->Modified();
  expect(false, "changed points", __LINE__);
  warp->SetBlend(0.5);
  expect(false, "Blend", __LINE__);
  warp->SetNumberOfSteps(9);
  expect(false, "NumberOfSteps", __LINE__);
  warp->InvertDensityOn();
  expect(true, "InvertDensity", __LINE__);
  changeDensity(image);
  expect(true, "the image", __LINE__);
}

void checkThreads(Checks& checks, int depth)
{
  auto image = makeImage(41, 37, depth, true, bumpy);
  const double bounds[6] = { -2, 42, 0, 36, 0, depth - 1.0 };
  vtkNew<vtkDensityEqualizingWarp> warp;
  Messages quiet(warp);
  warp->SetInputData(makePoints(randomCoordinates(bounds, 20000)));
  warp->SetDensityData(image);
  warp->SetThreadingToSerial();
  const std::vector<double> serial = warpCoordinates(warp);
  const std::vector<double> moved = displacements(warp);
  for (const char* backend : { "Sequential", "STDThread", "TBB", "OpenMP" })
  {
    if (!vtkSMPTools::SetBackend(backend))
    {
      continue;
    }
    for (const int threading : { vtkTransportAlgorithm::THREADING_AUTO,
           vtkTransportAlgorithm::THREADING_VTK, vtkTransportAlgorithm::THREADING_OPENMP })
    {
      warp->SetThreading(threading);
      for (const int threads : { 1, 2, 3 })
      {
        vtkSMPTools::Initialize(threads);
        forgetTables(warp, image);
        checks.That(warpCoordinates(warp) == serial && displacements(warp) == moved, "same bits",
          __LINE__, std::string(backend) + ", " + std::to_string(threads) + " threads");
      }
    }
  }
  // Half of the points go where they go among all.
  warp->SetInputData(makePoints(randomCoordinates(bounds, 10000)));
  CHECK(
    checks, warpCoordinates(warp) == std::vector<double>(serial.begin(), serial.begin() + 30000));
}

void checkAbort(Checks& checks)
{
  auto image = makeImage(301, 301, 1, true, bumpy);
  const double bounds[6] = { 0, 300, 0, 300, 0, 0 };
  vtkNew<vtkDensityEqualizingWarp> warp;
  Messages messages(warp);
  warp->SetInputData(makePoints(randomCoordinates(bounds, 2000000)));
  warp->SetDensityData(image);
  for (const double from : { 0.01, 0.5, 0.99 })
  {
    checkAbort(
      checks, warp, from, [&]() { warp->Modified(); },
      [&]() {
        return warp->GetOutput()->GetNumberOfPoints() == 0 &&
          warp->GetOutput()->GetPointData()->GetNumberOfArrays() == 0;
      },
      __LINE__);
  }
  ProgressTest test(warp);
  changeDensity(image);
  warp->SetInputData(makePoints(randomCoordinates(bounds, 100000)));
  warp->Update();
  CHECK(checks, warp->GetOutput()->GetNumberOfPoints() == 100000);
  CHECK(checks, test.Heard.size() > 5);
  CHECK(checks, std::is_sorted(test.Heard.begin(), test.Heard.end()));
  CHECK(checks, test.Heard.front() >= 0.0 && test.Heard.back() == 1.0);
  CHECK(checks, messages.Errors.empty());
}

// After an error with points of another type a smaller grid is asked for no more than it has.
void checkTypesAroundAnError(Checks& checks)
{
  const auto makeGrid = [](int count) {
    auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
    vtkNew<vtkPoints> points;
    for (int i = 0; i < count; ++i)
    {
      points->InsertNextPoint(1.0 + 6.0 * i / count, 2.0, 0.0);
    }
    grid->SetDimensions(count, 1, 1);
    grid->SetPoints(points);
    return grid;
  };
  const auto trivial = vtkSmartPointer<vtkTrivialProducer>::New(); // says what is asked in vain
  vtkNew<vtkDensityEqualizingWarp> warp;
  Messages messages(warp);
  Messages ofProducer(trivial);
  warp->SetInputConnection(0, trivial->GetOutputPort());
  auto image = makeImage(9, 7, 1, true, bumpy);
  warp->SetDensityData(image);
  const auto run = [&](vtkDataObject* points) {
    trivial->SetOutput(points);
    warp->Update();
    return warp->GetOutput() ? warp->GetOutput()->GetNumberOfPoints() : 0;
  };
  CHECK(checks, run(makeGrid(241)) == 241);
  warp->SetBlend(2.0);
  CHECK(checks, run(makePoints({ 1, 1, 0, 3, 2, 0 })) == 0 && messages.Errors.size() == 1);
  warp->SetBlend(1.0);
  CHECK(checks, run(makeGrid(17)) == 17);
  CHECK(checks, messages.Errors.size() == 1 && ofProducer.Errors.empty());
}

} // namespace

int TestWarpRun(int, char*[])
{
  Checks checks;
  checkCache(checks);
  checkThreads(checks, 1);
  checkThreads(checks, 11);
  checkAbort(checks);
  checkTypesAroundAnError(checks);
  return checks.Result();
}
