// SPDX-License-Identifier: BSD-3-Clause
// vtkTransportMap in a pipeline: what it publishes and keeps, pieces, progress, abort,
// threads.
#include "BlocksTest.h"
#include "InformationTest.h"
#include "MapTest.h"
#include "ProgressTest.h"
#include "ThreadsTest.h"

#include "vtkImageShiftScale.h"
#include "vtkImageShrink3D.h"
#include "vtkInformation.h"
#include "vtkPointDataToCellData.h"
#include "vtkRTAnalyticSource.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <algorithm>

namespace
{

void checkInformation(Checks& checks)
{
  const double turned[9] = { 0, -1, 0, 1, 0, 0, 0, 0, 1 };
  for (const bool cells : { false, true })
  {
    auto image = makeImage(9, 7, 5, cells, bumpy);
    image->SetExtent(2, 10, -3, 3, 0, 4);
    image->SetSpacing(0.5, 1.5, 2.0);
    image->SetOrigin(1.0, 2.0, 3.0);
    image->SetDirectionMatrix(turned);
    vtkNew<vtkTransportMap> map;
    map->SetInputData(image);
    checkInformation(checks, map, __LINE__);
    map->SetSampleDimensions(4, 0, 30);
    checkInformation(checks, map, __LINE__);
    map->SetInputArrayToProcess(0, 0, 0,
      cells ? vtkDataObject::FIELD_ASSOCIATION_CELLS : vtkDataObject::FIELD_ASSOCIATION_POINTS,
      "Density");
    map->SetSampleDimensions(2, 3, 4);
    checkInformation(checks, map, __LINE__);
    CHECK(checks,
      vtkDataObject::GetActiveFieldInformation(map->GetOutputInformation(0),
        vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS) == nullptr);
  }

  // Upstream has not run when information is asked for.
  vtkNew<vtkRTAnalyticSource> source;
  source->SetWholeExtent(-9, 12, -3, 4, 5, 11);
  vtkNew<vtkTransportMap> map;
  map->SetInputConnection(source->GetOutputPort());
  map->SetNegativeValuesToClamp();
  // On the input's own grid its scalars go on, as an image filter that follows has to know.
  vtkNew<vtkImageShiftScale> twice;
  twice->SetInputConnection(map->GetOutputPort());
  twice->SetScale(2.0);
  twice->Update();
  vtkDataArray* passed = map->GetOutput()->GetPointData()->GetScalars();
  vtkDataArray* doubled = twice->GetOutput()->GetPointData()->GetScalars();
  CHECK(checks, passed && doubled && passed->GetDataType() == VTK_FLOAT);
  CHECK(checks, doubled && doubled->GetDataType() == VTK_FLOAT);
  CHECK(checks, passed && doubled && doubled->GetTuple1(20) == 2.0 * passed->GetTuple1(20));
  map->SetSampleDimensions(10, 20, 5);
  checkInformation(checks, map, __LINE__);
  vtkNew<vtkPointDataToCellData> toCells;
  toCells->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkTransportMap> ofCells;
  ofCells->SetInputConnection(toCells->GetOutputPort());
  ofCells->SetNegativeValuesToClamp();
  ofCells->SetSampleDimensions(10, 20, 5);
  ofCells->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "RTData");
  checkInformation(checks, ofCells, __LINE__);

  // Where nothing tells points from cells before the data, the data decides, and once is enough.
  toCells->PassPointDataOff();
  vtkNew<vtkTransportMap> unknown;
  unknown->SetInputConnection(toCells->GetOutputPort());
  unknown->SetNegativeValuesToClamp();
  unknown->SetSampleDimensions(10, 20, 5);
  for (int run = 0; run < 2; ++run)
  {
    unknown->Update();
    CHECK(checks, unknown->GetOutput()->GetNumberOfCells() == 1000);
    CHECK(checks, imageValues(unknown->GetOutput(), "Divergence").size() == 1000);
  }
  const vtkMTimeType made = unknown->GetOutput()->GetMTime();
  unknown->Update();
  CHECK(checks, unknown->GetOutput()->GetMTime() == made);
  checkInformation(checks, unknown, __LINE__);

  // An image filter downstream relies on what is published.
  vtkNew<vtkImageShrink3D> shrink;
  shrink->SetInputConnection(map->GetOutputPort());
  shrink->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "JacobianDeterminant");
  shrink->SetShrinkFactors(2, 2, 1);
  shrink->Update();
  int dimensions[3];
  shrink->GetOutput()->GetDimensions(dimensions);
  CHECK(checks, dimensions[0] == 5 && dimensions[1] == 10 && dimensions[2] == 5);
}

// A whole image is asked for; the map is in the first piece.
void checkPieces(Checks& checks)
{
  vtkNew<vtkRTAnalyticSource> source;
  source->SetWholeExtent(-9, 12, -3, 4, 5, 11);
  vtkNew<vtkTransportMap> map;
  map->SetInputConnection(source->GetOutputPort());
  map->SetNegativeValuesToClamp();
  map->Update();
  const Values whole = imageValues(map->GetOutput(), "Displacement");
  map->UpdatePiece(0, 2, 1);
  CHECK(checks, whole.size() == 3u * 22 * 8 * 7);
  CHECK(checks, imageValues(map->GetOutput(), "Displacement") == whole);
  map->UpdatePiece(1, 2, 0);
  CHECK(checks, map->GetOutput()->GetNumberOfPoints() == 0);
}

void checkComposite(Checks& checks)
{
  auto image = makeImage(9, 9, 1, true, bumpy);
  vtkNew<vtkTransportMap> map;
  map->SetInputData(image);
  map->Update();
  const Values expected = imageValues(map->GetOutput(), "Divergence");
  auto blocks = makeTiles(image, 2);
  map->SetInputDataObject(blocks);
  map->Update();
  CHECK(checks, expected.size() == 64);
  CHECK(checks, imageValues(map->GetOutput(), "Divergence") == expected);
  // What is passed on is that of all of them.
  CHECK(checks, imageValues(map->GetOutput(), "Density") == imageValues(image, "Density"));

  // A block that is no data set is passed over; it is an error if all are such.
  Messages messages(map);
  vtkNew<vtkTable> table;
  blocks->SetBlock(2, table);
  map->Modified();
  map->Update();
  CHECK(checks, imageValues(map->GetOutput(), "Divergence") == expected);
  CHECK(checks, messages.Errors.empty() && messages.Warnings.size() == 1);
  CHECK(checks, contains(messages.Warnings.front(), "the first a vtkTable, block 3 of the input"));
  map->SetInputDataObject(makeBlocks({ table, table }));
  map->Update();
  CHECK(checks, messages.IsOneError("no image, mesh or grid, but 2 blocks of another type"));
}

// One table serves both directions and all samples.
void checkCache(Checks& checks)
{
  auto image = makeImage(30, 20, 1, true, bumpy);
  vtkNew<vtkTransportMap> map;
  CHECK(checks, map->GetTableBuildTime() == 0);
  map->SetInputData(image);
  map->Update();
  const vtkMTimeType built = map->GetTableBuildTime();
  CHECK(checks, built > 0);
  const Values forth = imageValues(map->GetOutput(), "Displacement");
  const vtkMTimeType made = map->GetOutput()->GetMTime();
  map->Update();
  CHECK(checks, map->GetOutput()->GetMTime() == made);
  map->SetDirectionToDensityToUniform();
  map->Update();
  CHECK(checks, map->GetTableBuildTime() == built);
  const Values back = imageValues(map->GetOutput(), "Displacement");
  CHECK(checks, back != forth);
  map->SetSampleDimensions(10, 50, 1);
  map->Update();
  CHECK(checks, map->GetTableBuildTime() == built);
  CHECK(checks, imageValues(map->GetOutput(), "Divergence").size() == 500);
  map->SetNumberOfSteps(16);
  map->Update();
  CHECK(checks, map->GetTableBuildTime() == built);

  // Kept tables give what new ones give.
  map->SetSampleDimensions(0, 0, 0);
  map->SetNumberOfSteps(32);
  map->SetDirectionToUniformToDensity();
  map->Update();
  CHECK(checks, map->GetTableBuildTime() == built);
  CHECK(checks, imageValues(map->GetOutput(), "Displacement") == forth);
  forgetTables(map, image);
  map->Update();
  CHECK(checks, map->GetTableBuildTime() > built);
  CHECK(checks, imageValues(map->GetOutput(), "Displacement") == forth);
}

void checkThreads(Checks& checks)
{
  for (const auto& image :
    { makeImage(211, 173, 1, false, bumpy), makeImage(30, 31, 29, true, bumpy) })
  {
    for (const int direction : { 0, 1 })
    {
      vtkNew<vtkTransportMap> map;
      map->SetInputData(image);
      map->SetDirection(direction);
      const auto run = [&](int threading) {
        map->SetThreading(threading);
        forgetTables(map, image);
        map->Update();
        Values all = imageValues(map->GetOutput(), "Displacement");
        for (const char* name : { "Divergence", "JacobianDeterminant" })
        {
          const Values values = imageValues(map->GetOutput(), name);
          all.insert(all.end(), values.begin(), values.end());
        }
        all.push_back(fieldValue(map->GetOutput(), "TransportCost"));
        all.push_back(fieldValue(map->GetOutput(), "TotalMass"));
        return all;
      };
      expectSameBits(checks, run, __LINE__);
    }
  }
}

void checkAbort(Checks& checks)
{
  auto image =
    makeImage(120, 110, 100, true, [](vtkIdType i) { return static_cast<double>(1 + i % 100); });
  vtkNew<vtkTransportMap> map;
  Messages messages(map);
  map->SetInputData(image);
  map->SetDirectionToDensityToUniform();
  map->SetNumberOfSteps(8);
  for (const double from : { 0.001, 0.5, 0.97 })
  {
    checkAbort(
      checks, map, from, [&]() { changeDensity(image); }, __LINE__);
  }
  ProgressTest progress(map);
  changeDensity(image);
  map->Update();
  CHECK(checks, imageValues(map->GetOutput(), "Divergence").size() == 119u * 109 * 99);
  progress.ExpectRising(checks, 11, __LINE__);
  CHECK(checks, messages.Errors.empty());
}

} // namespace

int TestMapPipeline(int, char*[])
{
  return runChecks(
    { checkInformation, checkPieces, checkComposite, checkCache, checkThreads, checkAbort });
}
