// SPDX-License-Identifier: BSD-3-Clause
// EqualizeAreas of the warp and the map: areas come closer to masses, at the corners of the
// density's cells and between them; when it has no effect; what is kept; how it runs.
#include "MapTest.h"
#include "PointSetTest.h"
#include "ProgressTest.h"
#include "ThreadsTest.h"
#include "WarpTest.h"

#include "vtkCallbackCommand.h"

#include <algorithm>
#include <cmath>

namespace
{

constexpr int nx = 60;
constexpr int ny = 44;

// On cells of uneven sides, in a plane that is turned.
vtkSmartPointer<vtkImageData> turnedDensity()
{
  auto image = makeImage(nx + 1, ny + 1, 1, true, smoothDensity(nx, ny));
  const double turned[9] = { 0, -1, 0, 1, 0, 0, 0, 0, 1 };
  image->SetDirectionMatrix(turned);
  image->SetSpacing(0.5, 1.5, 1.0);
  image->SetOrigin(3.0, -2.0, 7.0);
  return image;
}

// The mean of |area - mass| / mass over the cells of the image after the warp.
double areaError(vtkDensityEqualizingWarp* warp, vtkImageData* image)
{
  const Values masses = arrayValues(image->GetCellData()->GetArray("Density"));
  const Values x = warpCoordinates(warp);
  double total = 0.0;
  for (const double mass : masses)
  {
    total += mass;
  }
  double sum = 0.0;
  for (int j = 0; j < ny; ++j)
  {
    for (int i = 0; i < nx; ++i)
    {
      const double* a = x.data() + 3 * (j * (nx + 1) + i);
      const double* b = a + 3;
      const double* c = b + 3 * (nx + 1);
      const double* d = a + 3 * (nx + 1);
      const double area =
        0.5 * std::abs((c[0] - a[0]) * (d[1] - b[1]) - (c[1] - a[1]) * (d[0] - b[0]));
      const double share = masses[static_cast<std::size_t>(j * nx + i)] / total;
      sum += std::abs(area / (nx * ny * 0.75) - share) / share / (nx * ny);
    }
  }
  return sum;
}

Values cornersOf(vtkImageData* image)
{
  Values x(static_cast<std::size_t>(3 * image->GetNumberOfPoints()));
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    image->GetPoint(i, x.data() + 3 * i);
  }
  return x;
}

void checkWarp(Checks& checks)
{
  auto image = turnedDensity();
  vtkNew<vtkDensityEqualizingWarp> warp;
  Messages messages(warp);
  warp->SetInputData(makePoints(cornersOf(image)));
  warp->SetDensityData(image);
  warp->SetNumberOfSteps(16);
  const double before = areaError(warp, image);
  const Values unequal = displacements(warp);
  const vtkMTimeType built = warp->GetTableBuildTime();
  warp->EqualizeAreasOn();
  const double after = areaError(warp, image);
  CHECK(checks, before > 0.005 && after < 0.05 * before);
  CHECK(checks, warp->GetTableBuildTime() == built);
  const Values whole = displacements(warp);
  CHECK(checks, largestDifference(whole, unequal) < 1.0);
  warp->SetBlend(0.5);
  warpCoordinates(warp);
  Values half = whole;
  for (double& value : half)
  {
    value *= 0.5;
  }
  CHECK(checks, largestDifference(displacements(warp), half) < 1e-12);
  warp->SetBlend(0.0);
  CHECK(checks, largestDifference(warpCoordinates(warp), cornersOf(image)) == 0.0);
  warp->SetBlend(1.0);
  warp->EqualizeAreasOff();
  warpCoordinates(warp);
  CHECK(checks, displacements(warp) == unequal);
  CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());
}

constexpr int mapX = 40;
constexpr int mapY = 36;

// Away from the border the determinant is the density over its mean, but for the error of
// differences.
double determinantError(vtkTransportMap* map, vtkImageData* image, int depth)
{
  map->Update();
  const Values found = imageValues(map->GetOutput(), "JacobianDeterminant");
  const Values density = arrayValues(densityOf(image));
  double mean = 0.0;
  for (const double value : density)
  {
    mean += value / static_cast<double>(density.size());
  }
  const auto isInside = [](int i, int count) { return count == 1 || (i > 2 && i + 3 < count); };
  double sum = 0.0;
  double samples = 0.0;
  for (int i = 0; i < static_cast<int>(found.size()); ++i)
  {
    if (isInside(i % mapX, mapX) && isInside(i / mapX % mapY, mapY) &&
      isInside(i / mapX / mapY, depth))
    {
      const auto at = static_cast<std::size_t>(i);
      sum += std::abs(found[at] - density[at] / mean);
      ++samples;
    }
  }
  return sum / samples;
}

void checkMap(Checks& checks)
{
  for (const int depth : { 1, 18 })
  {
    auto image = makeImage(mapX, mapY, depth, false, smoothDensity(mapX, mapY, depth));
    vtkNew<vtkTransportMap> map;
    Messages messages(map);
    map->SetInputData(image);
    map->SetNumberOfSteps(6);
    map->Update();
    const Values forward = imageValues(map->GetOutput(), "Displacement");
    map->EqualizeAreasOn();
    map->Update();
    CHECK(checks, imageValues(map->GetOutput(), "Displacement") == forward);
    map->SetDirectionToDensityToUniform();
    const double after = determinantError(map, image, depth);
    map->EqualizeAreasOff();
    const double before = determinantError(map, image, depth);
    std::cout << "determinants are off by " << before << " and " << after << "\n";
    CHECK(checks, after < 0.6 * before);
    CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());
  }
}

// Along a line the map is exact, whatever the steps.
void checkLine(Checks& checks)
{
  auto image = makeImage(5, 1, 1, true, [](vtkIdType i) { return i == 1 ? 5.0 : 1.0; });
  vtkNew<vtkDensityEqualizingWarp> warp;
  warp->SetInputData(makePoints({ 1, 0, 0, 1.5, 0, 0, 2, 0, 0 }));
  warp->SetDensityData(image);
  warp->SetNumberOfSteps(200);
  warp->EqualizeAreasOn();
  const Values x = warpCoordinates(warp);
  CHECK(checks, std::abs(x[0] - 0.5) < 1e-6 && std::abs(x[6] - 3.0) < 1e-6);
  CHECK(checks, std::abs(x[3] - 1.75) < 0.02);
}

void checkTables(Checks& checks)
{
  vtkNew<vtkDensityEqualizingWarp> warp;
  ErrorTest ofWarp(checks, warp);
  auto image = turnedDensity();
  warp->SetInputData(makePoints(cornersOf(image)));
  warp->SetDensityData(image);
  warp->EqualizeAreasOn();
  warp->SetTablesToTiled();
  const char* text =
    "Tables is Tiled, which does not give equal areas (EqualizeAreas); Tables = Whole does, or "
    "Auto";
  ofWarp.Expect(text, __LINE__);
  warp->SetBlend(0.0); // no map
  ofWarp.ExpectNone(__LINE__);
  vtkNew<vtkTransportMap> map;
  ErrorTest ofMap(checks, map);
  map->SetInputData(image);
  map->SetTablesToTiled();
  map->EqualizeAreasOn();
  ofMap.ExpectNone(__LINE__); // UniformToDensity
  map->SetDirectionToDensityToUniform();
  ofMap.Expect(text, __LINE__);
  map->SetTablesToAuto();
  ofMap.ExpectNone(__LINE__);
}

// The corners of all cells are moved once for a density and the settings of the flow, whichever
// filter asks.
void checkKept(Checks& checks)
{
  auto image = makeImage(501, 401, 1, true, smoothDensity(500, 400));
  vtkNew<vtkDensityEqualizingWarp> warp;
  warp->SetThreadingToSerial();
  warp->SetInputData(makePoints({ 3, 4, 0 }));
  warp->SetDensityData(image);
  warp->EqualizeAreasOn();
  warp->Update();
  // The correction reports after each of its loops, of which there are hundreds.
  const auto reports = [](vtkAlgorithm* filter) {
    double count = 0.0;
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(&count);
    command->SetCallback(
      [](vtkObject*, unsigned long, void* data, void*) { ++*static_cast<double*>(data); });
    const unsigned long tag = filter->AddObserver(vtkCommand::ProgressEvent, command);
    filter->Update();
    filter->RemoveObserver(tag);
    return count;
  };
  warp->SetNumberOfSteps(33);
  const double made = reports(warp);
  CHECK(checks, made > 50.0);
  warp->SetInputData(makePoints({ 3, 4, 0, 10, 20, 0 }));
  CHECK(checks, reports(warp) < 0.3 * made);
  vtkNew<vtkTransportMap> map;
  map->SetThreadingToSerial();
  map->SetInputData(image);
  map->SetDirectionToDensityToUniform();
  map->SetSampleDimensions(2, 2, 1);
  map->SetNumberOfSteps(33);
  map->EqualizeAreasOn();
  CHECK(checks, reports(map) < 0.5 * made);
  // Options that are not used do not matter, nor do those of another filter; it is kept while
  // somebody wants it.
  warp->SetTolerance(0.5);
  warp->SetAreaTolerance(0.5);
  CHECK(checks, reports(warp) < 0.3 * made);
  map->SetNumberOfSteps(32);
  map->Update();
  warp->Modified();
  CHECK(checks, reports(warp) < 0.3 * made);
  map->Modified();
  CHECK(checks, reports(map) < 0.3 * made);
  map->EqualizeAreasOff();
  map->Update();
  map->EqualizeAreasOn();
  CHECK(checks, reports(map) > 0.5 * made);
}

// 1, and a square of `contrast` off the middle.
vtkSmartPointer<vtkImageData> squareOf(double contrast, double added)
{
  return makeImage(129, 129, 1, true, [=](vtkIdType i) {
    const double x = (static_cast<double>(i % 128) + 0.5) / 128 - 0.4;
    const double y = (static_cast<double>(i / 128) + 0.5) / 128 - 0.6;
    return added + (std::max(std::abs(x), std::abs(y)) < 0.15 ? contrast : 1.0);
  });
}

std::size_t countWarnings(const Messages& messages, const char* part)
{
  return static_cast<std::size_t>(std::count_if(messages.Warnings.begin(), messages.Warnings.end(),
    [part](const std::string& text) { return contains(text, part); }));
}

// How many passes were kept, a warning if none was, and that its advice helps.
void checkPasses(Checks& checks)
{
  vtkNew<vtkTransportMap> map;
  vtkNew<vtkDensityEqualizingWarp> warp;
  Messages ofMap(map);
  Messages ofWarp(warp);
  map->SetNumberOfSteps(1024);
  warp->SetNumberOfSteps(1024);
  warp->SetInputData(makePoints({ 30, 40, 0, 60, 70, 0 }));
  const auto run = [&](double contrast, double added) {
    auto image = squareOf(contrast, added);
    map->SetInputData(image);
    warp->SetDensityData(image);
    ofMap.Warnings.clear();
    ofWarp.Warnings.clear();
    map->Update();
    warp->Update();
  };
  const auto passesOf = [](vtkDataObject* output) { return fieldValue(output, "EqualAreaPasses"); };
  map->EqualizeAreasOn();
  run(1000.0, 0.0); // UniformToDensity, and the warp without
  CHECK(checks, std::isnan(passesOf(map->GetOutput())) && std::isnan(passesOf(warp->GetOutput())));
  map->SetDirectionToDensityToUniform();
  warp->EqualizeAreasOn();
  const char* text = "EqualizeAreas changed nothing: every pass made errors larger or folds more "
                     "numerous (less contrast helps, for example a part of the mean added with "
                     "Calculator)";
  run(1000.0, 0.0);
  CHECK(checks, passesOf(map->GetOutput()) == 0.0 && passesOf(warp->GetOutput()) == 0.0);
  CHECK(checks, countWarnings(ofMap, text) == 1 && countWarnings(ofWarp, text) == 1);
  run(1000.0, 10.0); // a ninth of the mean
  CHECK(checks, passesOf(map->GetOutput()) == 2.0 && passesOf(warp->GetOutput()) == 2.0);
  CHECK(checks, countWarnings(ofMap, "EqualizeAreas") == 0);
  CHECK(checks, countWarnings(ofWarp, "EqualizeAreas") == 0);
  CHECK(checks, ofMap.Errors.empty() && ofWarp.Errors.empty());
}

// Of the corrected map there is no estimate, and no warning: those of the flow alone are none.
void checkEstimate(Checks& checks)
{
  auto image =
    makeImage(65, 65, 1, true, [](vtkIdType i) { return i == 64 * 32 + 21 ? 1e4 : 1.0; });
  vtkNew<vtkTransportMap> map;
  Messages messages(map);
  map->SetInputData(image);
  map->SetDirectionToDensityToUniform();
  map->SetIntegratorToEuler();
  map->SetAreaTolerance(0.0125);
  map->Update();
  const char* text = "AreaTolerance 0.0125 is not reached: with 4096 steps";
  CHECK(checks, fieldValue(map->GetOutput(), "AreaErrorEstimate") > 0.0125);
  CHECK(checks, countWarnings(messages, text) == 1);
  CHECK(checks, countWarnings(messages, "e+0") == 0); // "8.1e+02 %"
  messages.Warnings.clear();
  map->EqualizeAreasOn();
  map->Update();
  CHECK(checks, fieldValue(map->GetOutput(), "EqualAreaPasses") > 0.0);
  CHECK(checks, fieldValue(map->GetOutput(), "StepsTaken") == 4096.0);
  CHECK(checks, !map->GetOutput()->GetFieldData()->HasArray("AreaErrorEstimate"));
  CHECK(checks, countWarnings(messages, "AreaTolerance") == 0);
}

void checkThreads(Checks& checks)
{
  for (const int depth : { 1, 11 })
  {
    auto image = makeImage(61, 57, depth, true, bumpy);
    const double bounds[6] = { -2, 62, 0, 56, 0, depth - 1.0 };
    vtkNew<vtkDensityEqualizingWarp> warp;
    warp->SetInputData(makePoints(randomCoordinates(bounds, 2000)));
    warp->SetDensityData(image);
    warp->EqualizeAreasOn();
    const auto run = [&](int threading) {
      warp->SetThreading(threading);
      forgetTables(warp, image);
      return warpCoordinates(warp);
    };
    expectSameBits(checks, run, __LINE__);
  }
}

void checkAbort(Checks& checks)
{
  auto image = makeImage(401, 401, 1, true, bumpy);
  vtkNew<vtkDensityEqualizingWarp> warp;
  Messages messages(warp);
  warp->SetInputData(makePoints({ 3, 4, 0 }));
  warp->SetDensityData(image);
  warp->EqualizeAreasOn();
  for (const double from : { 0.2, 0.8, 0.9 })
  {
    checkAbort(
      checks, warp, from, [&]() { warp->Modified(); }, __LINE__);
  }
  ProgressTest test(warp);
  warp->Modified();
  warp->Update();
  CHECK(checks, warp->GetOutput()->GetNumberOfPoints() == 1);
  test.ExpectRising(checks, 10, __LINE__);
  CHECK(checks, messages.Errors.empty());
}

} // namespace

int TestEqualAreas(int, char*[])
{
  return runChecks({ checkWarp, checkMap, checkLine, checkTables, checkKept, checkPasses,
    checkEstimate, checkThreads, checkAbort });
}
