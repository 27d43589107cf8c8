// SPDX-License-Identifier: BSD-3-Clause
// vtkTransportMap with a target in a pipeline: what it publishes and keeps, other data sets,
// several times of one source, threads, tables, progress and abort.
#include "InformationTest.h"
#include "MapTargetTest.h"
#include "ProgressTest.h"
#include "ThreadsTest.h"
#include "TimesTest.h"

#include "vtkImageDataToPointSet.h"
#include "vtkPolyData.h"

namespace
{

// What the arrays of the output hold together.
Values mapValues(vtkTransportMap* map)
{
  map->Update();
  Values all;
  for (const char* name : { "Displacement", "Divergence", "JacobianDeterminant", "CostDensity" })
  {
    const Values values = imageValues(map->GetOutput(), name);
    all.insert(all.end(), values.begin(), values.end());
  }
  return all;
}

vtkSmartPointer<vtkImageData> otherImage(int nx, int ny, int nz, bool cells)
{
  auto image = makeImage(nx, ny, nz, cells, [](vtkIdType i) { return bumpy(i + 11); });
  image->SetOrigin(1.0, 0.5, 0.0);
  return image;
}

void checkInformation(Checks& checks)
{
  const auto source = makeImage(9, 7, 1, true, bumpy);
  auto map = makeMapBetween(source, otherImage(12, 5, 1, false));
  checkInformation(checks, map, __LINE__);
  map->SetSampleDimensions(4, 0, 0);
  checkInformation(checks, map, __LINE__);
  // The samples on the target, and on its points.
  map->SetDirectionToDensityToUniform();
  checkInformation(checks, map, __LINE__);
  map->SetSampleDimensions(0, 0, 0);
  checkInformation(checks, map, __LINE__);
  CHECK(checks, map->GetOutput()->GetNumberOfPoints() == 60);
  CHECK(checks, map->GetOutput()->GetPointData()->GetArray("CostDensity") != nullptr);
  expectOnePiece(checks, map, __LINE__);
}

// A target leaves nothing behind.
void checkWithoutTarget(Checks& checks)
{
  const auto source = makeImage(19, 14, 1, true, bumpy);
  vtkNew<vtkTransportMap> alone;
  alone->SetInputData(source);
  auto map = makeMapBetween(source, otherImage(12, 5, 1, true));
  for (const int direction : { 0, 1 })
  {
    alone->SetDirection(direction);
    map->SetDirection(direction);
    map->SetTargetData(otherImage(12, 5, 1, true));
    CHECK(checks, mapValues(map) != mapValues(alone));
    map->SetTargetConnection(nullptr);
    CHECK(checks, mapValues(map) == mapValues(alone));
    CHECK(checks, map->GetOutput()->GetCellData()->GetArray("CostDensity") == nullptr);
    CHECK(checks, alone->GetOutput()->GetCellData()->GetNumberOfArrays() == 4);
  }
}

// Kept tables and maps give what new ones give, and change with either density.
void checkCache(Checks& checks)
{
  for (const int method : { 0, 1 })
  {
    const auto source = makeImage(19, 14, 1, true, bumpy);
    const auto target = otherImage(12, 5, 1, true);
    auto map = makeMapBetween(source, target);
    map->SetMethod(method);
    const Values first = mapValues(map);
    CHECK(checks, !builds(map));
    map->SetSampleDimensions(5, 5, 1);
    CHECK(checks, !builds(map));
    map->SetSampleDimensions(0, 0, 0);
    CHECK(checks, mapValues(map) == first);
    for (vtkImageData* changed : { source.Get(), target.Get() })
    {
      changeDensity(changed);
      const Values now = mapValues(map);
      CHECK(checks, now != first);
      auto anew = makeMapBetween(source, target);
      anew->SetMethod(method);
      CHECK(checks, mapValues(anew) == now);
    }
    auto anew = makeMapBetween(source, target);
    anew->SetMethod(method);
    for (vtkImageData* moved : { source.Get(), target.Get() })
    {
      moved->SetOrigin(4.0, 0.5, 0.0);
      auto other = makeMapBetween(source, target);
      other->SetMethod(method);
      CHECK(checks, mapValues(map) == mapValues(other));
    }
    map->SetOptimalityTolerance(0.2);
    anew->SetOptimalityTolerance(0.2);
    CHECK(checks, mapValues(map) == mapValues(anew));
  }
}

// Data that are no images, or are of another type than the input.
void checkOtherData(Checks& checks)
{
  const auto source = makeImage(9, 7, 1, true, bumpy);
  const auto target = otherImage(12, 5, 1, true);
  vtkNew<vtkImageDataToPointSet> grid;
  grid->SetInputData(target);
  auto ofImage = makeMapBetween(source, target);
  auto ofGrid = makeMapBetween(source, target);
  ofGrid->SetTargetConnection(grid->GetOutputPort());
  // The cells of one lattice are that image again.
  CHECK_NEAR(checks, largestDifference(mapValues(ofGrid), mapValues(ofImage)), 0.0, 1e-9);
  for (vtkTransportMap* map : { ofImage.Get(), ofGrid.Get() })
  {
    map->SetDirectionToDensityToUniform();
  }
  CHECK_NEAR(checks, largestDifference(mapValues(ofGrid), mapValues(ofImage)), 0.0, 1e-9);
  CHECK(checks, ofGrid->GetOutput()->GetNumberOfCells() == 44);
}

// Arrays by their names: each input has its own.
void checkArrays(Checks& checks)
{
  const auto source = makeImage(9, 7, 1, true, bumpy);
  const auto target = otherImage(9, 7, 1, true);
  const Values wanted = mapValues(makeMapBetween(source, target));
  vtkNew<vtkImageData> both;
  both->DeepCopy(source);
  vtkNew<vtkDoubleArray> other;
  other->DeepCopy(target->GetCellData()->GetScalars());
  other->SetName("Other");
  both->GetCellData()->AddArray(other);
  auto map = makeMapBetween(both, both);
  map->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Density");
  map->SetInputArrayToProcess(1, 1, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Other");
  vtkNew<vtkImageData> moved;
  moved->ShallowCopy(both);
  moved->SetOrigin(target->GetOrigin());
  map->SetTargetData(moved);
  CHECK(checks, mapValues(map) == wanted);
}

void checkThreads(Checks& checks)
{
  for (const int method : { 0, 1 })
  {
    for (const bool flat : { true, false })
    {
      const int layers = flat ? 1 : 9;
      auto map =
        makeMapBetween(makeImage(41, 30, layers, true, bumpy), otherImage(23, 31, layers, true));
      map->SetMethod(method);
      const auto run = [&](int threading) {
        map->SetThreading(threading);
        map->Modified();
        return mapValues(map);
      };
      CHECK(checks, !expectSameBits(checks, run, __LINE__).empty());
    }
  }
}

// Tiles are as exact as whole tables.
void checkTiles(Checks& checks)
{
  auto map = makeMapBetween(makeImage(61, 51, 1, true, smoothDensity(60, 50)),
    makeImage(41, 41, 1, true, smoothDensity(40, 40)));
  map->SetNumberOfSteps(64);
  map->SetTablesToWhole();
  map->Update();
  const Values whole = imageValues(map->GetOutput(), "Displacement");
  map->SetTablesToTiled();
  map->Update();
  CHECK_NEAR(
    checks, largestDifference(imageValues(map->GetOutput(), "Displacement"), whole), 0.0, 0.05);
  const double cost = fieldValue(map->GetOutput(), "TransportCost");
  CHECK_NEAR(checks, sumOf(imageValues(map->GetOutput(), "CostDensity")) / cost, 1.0, 1e-12);
}

void checkProgress(Checks& checks)
{
  for (const int method : { 0, 1 })
  {
    const auto source = makeImage(200, 150, 1, true, bumpy);
    auto map = makeMapBetween(source, otherImage(130, 170, 1, true));
    map->SetMethod(method);
    ProgressTest test(map);
    map->Update();
    test.ExpectRising(checks, 10, __LINE__);
    const auto outdate = [&]() { changeDensity(source); };
    for (const double from : { 0.0, 0.2, 0.5, 0.8, 0.95 })
    {
      checkAbort(checks, map, from, outdate, __LINE__);
    }
    map->Modified();
    map->Update();
    CHECK(checks, !imageValues(map->GetOutput(), "CostDensity").empty());
  }
}

} // namespace

int TestMapTargetRun(int, char*[])
{
  return runChecks({ checkInformation, checkWithoutTarget, checkCache, checkOtherData, checkArrays,
    checkThreads, checkTiles, checkProgress });
}
