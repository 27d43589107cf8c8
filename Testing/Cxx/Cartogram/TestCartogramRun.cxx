// SPDX-License-Identifier: BSD-3-Clause
// How vtkCartogram runs: the same bits on any number of threads, progress, an abort, pieces, and
// coordinates and masses near the ends of what doubles hold.
#include "MapRegions.h"
#include "ProgressTest.h"
#include "ThreadsTest.h"
#include "WarpTest.h"

#include <algorithm>

namespace
{

vtkSmartPointer<vtkCartogram> makeCartogram(vtkPolyData* map, int resolution = 128)
{
  auto cartogram = vtkSmartPointer<vtkCartogram>::New();
  cartogram->SetInputData(map);
  cartogram->SetResolution(resolution);
  return cartogram;
}

void checkThreads(Checks& checks)
{
  auto map = makeMap(8);
  const double bounds[6] = { -1, 9, -1, 9, 0, 0 };
  auto overlay = makePoints(randomCoordinates(bounds, 3000));
  const auto run = [&](int threading) {
    auto cartogram = makeCartogram(map);
    cartogram->SetOverlayData(overlay);
    cartogram->SetThreading(threading);
    cartogram->Update();
    return std::make_tuple(coordinates(cartogram->GetRegions()),
      coordinates(cartogram->GetGraticule()), coordinates(cartogram->GetOverlay()),
      arrayValues(cartogram->GetRegions()->GetCellData()->GetArray("AreaError")));
  };
  const auto serial = expectSameBits(checks, run, __LINE__);
  CHECK(checks, std::get<0>(serial).size() > 3 * 1000 && std::get<2>(serial).size() == 9000);
}

void checkAborts(Checks& checks)
{
  auto map = makeMap(40);
  auto cartogram = makeCartogram(map, 512);
  Messages messages(cartogram);
  cartogram->Update(); // so that something is kept
  for (const double from : { 0.0, 0.01, 0.05, 0.98, 0.6, 0.08, 0.3, 0.15 })
  {
    for (const int delay : { 0, 7 })
    {
      if (delay > 0 && from > 0.5)
      {
        continue; // all may be done by then
      }
      checkAbort(
        checks, cartogram, from,
        [&]() {
          map->GetPoints()->SetPoint(0, 0.0, 0.5 * from + 0.01 * delay, 0.0);
          map->GetPoints()->Modified();
        },
        __LINE__, delay);
    }
  }
  // The last abort came before its map's raster was kept: that of another map is not taken.
  ProgressTest test(cartogram);
  cartogram->Modified();
  cartogram->Update();
  test.ExpectRising(checks, 20, __LINE__);
  CHECK(checks, messages.Errors.empty());
  CHECK(
    checks, coordinates(cartogram->GetRegions()) == [&]() {
      auto fresh = makeCartogram(map, 512);
      fresh->Update();
      return coordinates(fresh->GetRegions());
    }());
}

// Each pass takes at least half of its part of what is left: of a half, a third ...
void checkPasses(Checks& checks)
{
  auto cartogram = makeCartogram(makeMap(6));
  cartogram->SetTolerance(1e-9);
  double before = 0.0;
  for (const int passes : { 1, 2 })
  {
    cartogram->SetMaximumIterations(passes);
    ProgressTest test(cartogram);
    cartogram->Update();
    vtkDataArray* errors = cartogram->GetRegions()->GetFieldData()->GetArray("AreaErrors");
    CHECK(checks, errors && errors->GetNumberOfTuples() == passes);
    test.ExpectRising(checks, static_cast<std::size_t>(8 * passes), __LINE__);
    // The last value before the outputs are written.
    const auto written = std::find_if(
      test.Recorded.begin(), test.Recorded.end(), [](double progress) { return progress > 0.981; });
    CHECK(checks, written != test.Recorded.begin());
    const double reached = *(written - 1);
    CHECK(checks, reached > before + 0.5 / (passes + 1.0) * (0.98 - before) && reached < 0.98);
    before = reached;
  }
}

void checkPieces(Checks& checks)
{
  expectOnePiece(checks, makeCartogram(makeMap(3)), __LINE__);
}

// Areas of squares of unit size.
Values areasAt(double size, double from, double mass)
{
  auto cartogram =
    makeCartogram(makeMap(4, size, from, [mass](vtkIdType i) { return mass * bumpy(i); }));
  Messages messages(cartogram);
  cartogram->Update();
  Values areas = polygonAreas(cartogram->GetRegions());
  std::for_each(areas.begin(), areas.end(), [&](double& area) { area /= size * size; });
  return messages.Errors.empty() && messages.Warnings.empty() ? areas : Values();
}

void checkExtremes(Checks& checks)
{
  const Values usual = areasAt(1.0, 100.0, 1.0);
  const double total = sumOf(usual);
  CHECK_NEAR(checks, total, 16.0, 0.1);
  struct Case
  {
    double Size;
    double From;
    double Mass;
    double Tolerance;
  };
  for (const Case& each :
    { Case{ 1e-12, 0.0, 1.0, 1e-6 }, { 1e12, 0.0, 1.0, 1e-6 }, { 1.0, 1e12, 1.0, 1e-2 },
      { 1.0, -1e12, 1.0, 1e-2 }, { 1e6, 1e12, 1.0, 1e-6 }, { 1.0, 100.0, 1e-300, 1e-6 },
      { 1.0, 100.0, 1e300, 1e-6 }, { 1e-12, 0.0, 1e300, 1e-6 }, { 1e12, 0.0, 1e-300, 1e-6 } })
  {
    const Values areas = areasAt(each.Size, each.From, each.Mass);
    std::ostringstream what;
    what << each.Size << " from " << each.From << " of " << each.Mass << ": "
         << largestDifference(areas, usual);
    checks.That(
      largestDifference(areas, usual) <= each.Tolerance, "the same", __LINE__, what.str());
  }
  // Masses from one end to the other: those that are nothing beside others are none.
  auto cartogram = makeCartogram(makeMap(4, 1.0, 0.0, [](vtkIdType i) {
    return i == 5 ? 1e300 : i == 6 ? 1e-300 : 1.0;
  }));
  Messages messages(cartogram);
  cartogram->Update();
  CHECK(checks, messages.Errors.empty());
  CHECK(checks,
    std::any_of(messages.Warnings.begin(), messages.Warnings.end(), [](const std::string& warning) {
      return contains(warning, "15 of 16 regions (93.8 %) have no mass");
    }));
  const Values areas = polygonAreas(cartogram->GetRegions());
  CHECK(checks, areas.size() == 16 && areas[5] > 15.0);
}

} // namespace

int TestCartogramRun(int, char*[])
{
  return runChecks({ checkThreads, checkAborts, checkPasses, checkPieces, checkExtremes });
}
