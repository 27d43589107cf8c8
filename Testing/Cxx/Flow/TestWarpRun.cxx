// SPDX-License-Identifier: BSD-3-Clause
// How it runs: tables that are kept, the same bits on any number of threads, progress, an abort.
#include "PointSetTest.h"
#include "ProgressTest.h"
#include "ThreadsTest.h"
#include "WarpTest.h"

namespace
{

void checkCache(Checks& checks)
{
  vtkNew<vtkDensityEqualizingWarp> warp;
  checkTables(checks, warp.Get(),
    { { "Blend", [&]() { warp->SetBlend(0.5); } },
      { "NumberOfSteps", [&]() { warp->SetNumberOfSteps(9); } } },
    __LINE__);
}

void checkThreads(Checks& checks)
{
  for (const int depth : { 1, 11 })
  {
    auto image = makeImage(41, 37, depth, true, bumpy);
    const double bounds[6] = { -2, 42, 0, 36, 0, depth - 1.0 };
    vtkNew<vtkDensityEqualizingWarp> warp;
    Messages messages(warp);
    warp->SetInputData(makePoints(randomCoordinates(bounds, 20000)));
    warp->SetDensityData(image);
    const auto run = [&](int threading) {
      warp->SetThreading(threading);
      forgetTables(warp, image);
      const Values places = warpCoordinates(warp);
      return std::make_pair(places, displacements(warp));
    };
    const Values serial = expectSameBits(checks, run, __LINE__).first;
    // Half of the points go where they go among all.
    warp->SetInputData(makePoints(randomCoordinates(bounds, 10000)));
    CHECK(checks, warpCoordinates(warp) == Values(serial.begin(), serial.begin() + 30000));
  }
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
      checks, warp, from, [&]() { warp->Modified(); }, __LINE__);
  }
  ProgressTest test(warp);
  changeDensity(image);
  warp->SetInputData(makePoints(randomCoordinates(bounds, 100000)));
  warp->Update();
  CHECK(checks, warp->GetOutput()->GetNumberOfPoints() == 100000);
  test.ExpectRising(checks, 6, __LINE__);
  CHECK(checks, messages.Errors.empty());
}

void checkTypesAroundAnError(Checks& checks)
{
  vtkNew<vtkDensityEqualizingWarp> warp;
  warp->SetDensityData(makeImage(9, 7, 1, true, bumpy));
  checkTypesAroundAnError(
    checks, warp.Get(), [&]() { warp->SetBlend(2.0); }, [&]() { warp->SetBlend(1.0); }, __LINE__);
}

} // namespace

int TestWarpRun(int, char*[])
{
  return runChecks({ checkCache, checkThreads, checkAbort, checkTypesAroundAnError });
}
