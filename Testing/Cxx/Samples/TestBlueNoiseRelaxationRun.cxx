// SPDX-License-Identifier: BSD-3-Clause
// How it runs: tables that are kept or not needed, the same bits on any number of threads,
// progress, an abort, memory that cannot be had.
#include "../../MemoryLimit.h"
#include "PointSetTest.h"
#include "ProgressTest.h"
#include "RelaxationTest.h"
#include "ThreadsTest.h"

namespace
{

void checkCache(Checks& checks)
{
  vtkNew<vtkBlueNoiseRelaxation> relaxation;
  relaxation->SetMaximumIterations(2);
  checkTables(checks, relaxation.Get(),
    { { "MaximumIterations", [&]() { relaxation->SetMaximumIterations(1); } },
      { "Tolerance", [&]() { relaxation->SetTolerance(0.5); } },
      { "Method", [&]() { relaxation->SetMethodToOptimalTransport(); } },
      { "the first Method", [&]() { relaxation->SetMethodToGaussianBlueNoise(); } } },
    __LINE__);

  // The other method needs none, and keeps none of a density that is gone.
  auto image = makeImage(9, 7, 1, true, bumpy);
  auto transport = makeRelaxation(1, makePoints({ 3, 2, 0, 5, 5, 0 }), image);
  CHECK(checks, !builds(transport) && transport->GetOutput()->GetNumberOfPoints() == 2);
  CHECK(checks, transport->GetTableBuildTime() == 0);
  transport->SetMethodToGaussianBlueNoise();
  CHECK(checks, builds(transport));
  transport->SetMethodToOptimalTransport();
  changeDensity(image);
  CHECK(checks, !builds(transport));
  transport->SetMethodToGaussianBlueNoise();
  CHECK(checks, builds(transport) && !builds(transport));
}

void checkThreads(Checks& checks, int depth, int method)
{
  auto image = makeImage(41, 37, depth, true, bumpy);
  const double bounds[6] = { -2, 42, 0, 36, 0, depth - 1.0 };
  const int count = method == vtkBlueNoiseRelaxation::OPTIMAL_TRANSPORT ? 400 : 1000;
  auto relaxation = makeRelaxation(method, makePoints(randomCoordinates(bounds, count)), image);
  relaxation->SetMaximumIterations(2);
  Messages messages(relaxation);
  const auto run = [&](int threading) {
    relaxation->SetThreading(threading);
    forgetTables(relaxation, image);
    const Values places = relaxedCoordinates(relaxation);
    return std::make_pair(places, energies(relaxation));
  };
  CHECK(checks, expectSameBits(checks, run, __LINE__).second.size() == 3);
  CHECK(checks, messages.Errors.empty());
}

void checkThreads(Checks& checks)
{
  checkThreads(checks, 1, vtkBlueNoiseRelaxation::GAUSSIAN_BLUE_NOISE);
  checkThreads(checks, 1, vtkBlueNoiseRelaxation::OPTIMAL_TRANSPORT);
  checkThreads(checks, 6, vtkBlueNoiseRelaxation::GAUSSIAN_BLUE_NOISE);
}

// From the first pass over the points to the last iteration.
void checkAbort(Checks& checks)
{
  auto image = makeImage(301, 301, 1, true, bumpy);
  const double bounds[6] = { 0, 300, 0, 300, 0, 0 };
  for (int method = 0; method < 2; ++method)
  {
    const int count = method == 0 ? 20000 : 4000;
    auto relaxation = makeRelaxation(method, makePoints(randomCoordinates(bounds, count)), image);
    relaxation->SetMaximumIterations(50);
    Messages messages(relaxation);
    for (const double from : { 0.0, 0.01, 0.1, 0.3 })
    {
      checkAbort(
        checks, relaxation, from, [&]() { relaxation->Modified(); }, __LINE__,
        from == 0.0 ? 0 : 15);
    }
    relaxation->SetInputData(makePoints(randomCoordinates(bounds, 2000)));
    relaxation->SetMaximumIterations(3);
    changeDensity(image);
    ProgressTest test(relaxation);
    relaxation->Update();
    CHECK(checks, relaxation->GetOutput()->GetNumberOfPoints() == 2000);
    test.ExpectRising(checks, 6, __LINE__);
    CHECK(checks, messages.Errors.empty());
  }
}

#ifdef HAS_MEMORY_LIMIT
void checkMemory(Checks& checks)
{
  const double bounds[6] = { 0, 8, 0, 6, 0, 0 };
  for (int method = 0; method < 2; ++method)
  {
    auto relaxation = makeRelaxation(
      method, makePoints(randomCoordinates(bounds, 200000)), makeImage(9, 7, 1, true, bumpy));
    relaxation->SetMaximumIterations(0);
    relaxation->SetThreadingToSerial(); // new threads need memory of their own
    ErrorTest test(checks, relaxation);
    {
      const MemoryLimit limit(64 << 20);
      test.Expect({ "Not enough memory for the relaxation of 200000 points in 48 cells of the "
                    "density: ",
                    " MB were asked for" },
        __LINE__);
    }
    relaxation->SetInputData(makePoints(randomCoordinates(bounds, 100)));
    test.ExpectNone(__LINE__);
  }
}
#else
void checkMemory(Checks&) {}
#endif

void checkTypesAroundAnError(Checks& checks)
{
  auto relaxation = makeRelaxation(0, nullptr, makeImage(9, 7, 1, true, bumpy));
  checkTypesAroundAnError(
    checks, relaxation.Get(), [&]() { relaxation->SetTolerance(2.0); },
    [&]() { relaxation->SetTolerance(0.0); }, __LINE__);
}

} // namespace

int TestBlueNoiseRelaxationRun(int, char*[])
{
  return runChecks({ checkCache, checkThreads, checkAbort, checkMemory, checkTypesAroundAnError });
}
