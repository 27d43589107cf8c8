// SPDX-License-Identifier: BSD-3-Clause
// How vtkTransportQuality runs: tables that are kept, the same bits on any number of threads and in
// any place among others, progress, an abort.
#include "ProgressTest.h"
#include "QualityTest.h"
#include "ThreadsTest.h"

namespace
{

void checkCache(Checks& checks)
{
  vtkNew<vtkTransportQuality> quality;
  checkTables(
    checks, quality.Get(), { { "BlockSize", [&]() { quality->SetBlockSize(3); } } }, __LINE__);
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

void checkThreads(Checks& checks, int depth, int tables)
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
  quality->SetTables(tables);
  const auto run = [&](int threading) {
    quality->SetThreading(threading);
    forgetTables(quality, image);
    return runQuality(quality);
  };
  const std::vector<double> one = expectSameBits(checks, run, __LINE__);
  CHECK(checks, one.size() == 9 && one[2] > 0 && one[3] > 0);
}

// In the middle of the spacings, which take a volume long; their first slice, too.
void checkLateAbort(Checks& checks)
{
  vtkNew<vtkTransportQuality> quality;
  const double bounds[6] = { 0, 60, 0, 60, 0, 60 };
  quality->SetInputData(makePoints(randomCoordinates(bounds, 300000)));
  quality->SetDensityData(makeImage(61, 61, 61, true, bumpy));
  for (const int tables : { vtkTransportQuality::TABLES_WHOLE, vtkTransportQuality::TABLES_TILED })
  {
    quality->SetTables(tables);
    checkAbort(
      checks, quality, 0.7299, [&]() { quality->Modified(); }, __LINE__, 20);
  }
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
      checks, quality, from, [&]() { quality->Modified(); }, __LINE__);
  }
  checkLateAbort(checks);
  ProgressTest test(quality);
  changeDensity(image);
  quality->SetInputData(makePoints(randomCoordinates(bounds, 50000)));
  CHECK(checks, runQuality(quality).size() == 9);
  test.ExpectRising(checks, 6, __LINE__);
  CHECK(checks, messages.Errors.empty());
}

} // namespace

int TestTransportQualityRun(int, char*[])
{
  Checks checks;
  checkCache(checks);
  checkPieces(checks);
  for (const int tables : { vtkTransportQuality::TABLES_WHOLE, vtkTransportQuality::TABLES_TILED })
  {
    checkThreads(checks, 1, tables);
    checkThreads(checks, 9, tables);
  }
  checkAbort(checks);
  return checks.Result();
}
