// SPDX-License-Identifier: BSD-3-Clause
// How vtkTransportQuality runs: tables that are kept, the same bits on any number of threads and in
// any place among others, progress, an abort.
#include "ProgressTest.h"
#include "WarpTest.h"

#include "vtkSMPTools.h"
#include "vtkTable.h"
#include "vtkTransportQuality.h"
#include "vtkVariant.h"

namespace
{

std::vector<double> row(vtkTransportQuality* quality)
{
  quality->Update();
  std::vector<double> values;
  vtkTable* table = quality->GetOutput();
  for (vtkIdType i = 0; i < table->GetNumberOfColumns() && table->GetNumberOfRows() == 1; ++i)
  {
    values.push_back(table->GetValue(0, i).ToDouble());
  }
  return values;
}

void checkCache(Checks& checks)
{
  vtkNew<vtkTransportQuality> quality;
  auto image = makeImage(9, 7, 1, true, bumpy);
  quality->SetDensityData(image);
  quality->SetInputData(makePoints({ 3, 2, 0 }));
  vtkMTimeType last = 0;
  const auto expect = [&](bool built, const char* what, int line) {
    quality->Update();
    checks.That((quality->GetTableBuildTime() > last) == built, what, line);
    last = quality->GetTableBuildTime();
  };
  expect(true, "the first run builds", __LINE__);
  quality->SetInputData(makePoints({ 4, 2, 0, 1, 1, 1 }));
  expect(false, "other particles", __LINE__);
  quality->SetBlockSize(3);
  expect(false, "BlockSize", __LINE__);
  quality->InvertDensityOn();
  expect(true, "InvertDensity", __LINE__);
  changeDensity(image);
  expect(true, "the image", __LINE__);
}

// The row is in the first piece alone, and has the field data of the particles.
void checkPieces(Checks& checks)
{
  vtkNew<vtkTransportQuality> quality;
  auto particles = makePoints({ 3, 2, 0, 1, 1, 0 });
  vtkNew<vtkDoubleArray> own;
  own->SetName("Own");
  own->InsertNextValue(5.0);
  particles->GetFieldData()->AddArray(own);
  quality->SetInputData(particles);
  quality->SetDensityData(makeImage(9, 7, 1, true, bumpy));
  quality->UpdatePiece(0, 2, 0);
  CHECK(checks, quality->GetOutput()->GetNumberOfRows() == 1);
  CHECK(checks, quality->GetOutput()->GetFieldData()->GetArray("Own") == own);
  // For another piece of a table VTK 9.3 and later do not run a filter again by themselves.
  quality->Modified();
  quality->UpdatePiece(1, 2, 0);
  CHECK(checks, quality->GetOutput()->GetNumberOfRows() == 0);
}

void checkThreads(Checks& checks, int depth)
{
  auto image = makeImage(41, 37, depth, true, [](vtkIdType i) { return bumpy(i) - 1.0; });
  const double bounds[6] = { -2, 42, 0, 36, 0, depth - 1.0 };
  auto particles = makePoints(randomCoordinates(bounds, 30000));
  vtkNew<vtkDoubleArray> masses;
  masses->SetName("Mass");
  for (vtkIdType i = 0; i < 30000; ++i)
  {
    masses->InsertNextValue(0.1 * bumpy(i));
  }
  particles->GetPointData()->AddArray(masses);
  vtkNew<vtkTransportQuality> quality;
  quality->SetInputData(particles);
  quality->SetDensityData(image);
  vtkSMPTools::SetBackend("STDThread");
  vtkSMPTools::Initialize(1);
  const std::vector<double> one = row(quality);
  CHECK(checks, one.size() == 8 && one[2] > 0 && one[3] > 0);
  for (const char* backend : { "Sequential", "STDThread" })
  {
    vtkSMPTools::SetBackend(backend);
    for (const int threads : { 1, 2, 3 })
    {
      vtkSMPTools::Initialize(threads);
      forgetTables(quality, image);
      checks.That(row(quality) == one, "same bits", __LINE__,
        std::string(backend) + ", " + std::to_string(threads) + " threads");
    }
  }
}

// In the middle of the spacings, which take a volume long; their first slice, too.
void checkLateAbort(Checks& checks)
{
  vtkNew<vtkTransportQuality> quality;
  const double bounds[6] = { 0, 60, 0, 60, 0, 60 };
  quality->SetInputData(makePoints(randomCoordinates(bounds, 300000)));
  quality->SetDensityData(makeImage(61, 61, 61, true, bumpy));
  checkAbort(
    checks, quality, 0.6999, [&]() { quality->Modified(); },
    [&]() { return quality->GetOutput()->GetNumberOfColumns() == 0; }, __LINE__, 20);
}

void checkAbort(Checks& checks)
{
  auto image = makeImage(301, 301, 1, true, bumpy);
  const double bounds[6] = { 0, 300, 0, 300, 0, 0 };
  vtkNew<vtkTransportQuality> quality;
  Messages messages(quality);
  quality->SetInputData(makePoints(randomCoordinates(bounds, 600000)));
  quality->SetDensityData(image);
  // In the points, before and in the tree, among the neighbours, in the spacings.
  for (const double from : { 0.01, 0.43, 0.5, 0.62, 0.8 })
  {
    checkAbort(
      checks, quality, from, [&]() { quality->Modified(); },
      [&]() { return quality->GetOutput()->GetNumberOfColumns() == 0; }, __LINE__);
  }
  checkLateAbort(checks);
  ProgressTest test(quality);
  changeDensity(image);
  quality->SetInputData(makePoints(randomCoordinates(bounds, 50000)));
  CHECK(checks, row(quality).size() == 8);
  CHECK(checks, test.Heard.size() > 5);
  CHECK(checks, std::is_sorted(test.Heard.begin(), test.Heard.end()));
  CHECK(checks, test.Heard.front() >= 0.0 && test.Heard.back() == 1.0);
  CHECK(checks, messages.Errors.empty());
}

} // namespace

int TestTransportQualityRun(int, char*[])
{
  Checks checks;
  checkCache(checks);
  checkPieces(checks);
  checkThreads(checks, 1);
  checkThreads(checks, 9);
  checkAbort(checks);
  return checks.Result();
}
