// SPDX-License-Identifier: BSD-3-Clause
// How vtkTransportDistance runs: the same bits on any number of threads, progress, an abort,
// pieces.
#include "DistanceTest.h"
#include "ProgressTest.h"
#include "ThreadsTest.h"

namespace
{

// Densities that need a while; `number` makes others.
Images makeUnevenImages(int number)
{
  Images images;
  for (int k = 0; k < 10; ++k)
  {
    images.push_back(makeImage(97, 97, 1, true,
      [=](vtkIdType i) { return std::pow(bumpy(i * (k + 3) + 7 * k + number), 2); }));
  }
  return images;
}

// All numbers of the tables.
Values tablesOf(vtkTransportDistance* distance)
{
  distance->Update();
  Values all;
  for (int port = 0; port < 3; ++port)
  {
    auto* table = vtkTable::SafeDownCast(distance->GetOutputDataObject(port));
    for (const std::string& name : columnNames(table))
    {
      const Values column = columnValues(table, name);
      all.insert(all.end(), column.begin(), column.end());
    }
  }
  all.push_back(fieldValue(distance->GetCoordinates(), "Stress"));
  return all;
}

void checkThreads(Checks& checks)
{
  const Images images = makeBells({ { 10, 20 }, { 14, 28 }, { 22, 14 }, { 25, 25 } });
  for (const int method : distanceMethods)
  {
    const auto run = [&](int threading) {
      auto distance = makeDistance(images, method);
      distance->SetThreading(threading);
      return tablesOf(distance);
    };
    const Values serial = expectSameBits(checks, run, __LINE__);
    // A matrix of 16, 6 rows of bounds, 4 points with 2 coordinates and their mass, the stress.
    CHECK(checks, serial.size() == 16 + 24 + 12 + 1);
  }
}

// While densities are read, while maps or pairs are solved, and near the end.
void checkAbort(Checks& checks)
{
  for (const int method : distanceMethods)
  {
    int number = 0;
    auto distance = makeDistance(makeUnevenImages(number), method);
    Messages messages(distance);
    for (const double from : { 0.05, 0.55, 0.7 })
    {
      ::checkAbort(
        checks, distance, from, [&]() { connect(distance, makeUnevenImages(++number)); }, __LINE__);
    }
    CHECK(checks, messages.Errors.empty());
    ProgressTest progress(distance);
    connect(distance, makeUnevenImages(number));
    const Matrix found = distancesOf(distance);
    progress.ExpectRising(checks, 10, __LINE__);
    CHECK(checks, found == distancesOf(makeDistance(makeUnevenImages(number), method)));
  }
}

// Tables are in the first piece alone.
void checkPieces(Checks& checks)
{
  auto distance = makeDistance(makeBells({ { 10, 20 }, { 14, 28 } }));
  distance->UpdatePiece(0, 2, 0);
  CHECK(checks, distance->GetDistances()->GetNumberOfRows() == 2);
  // For another piece of a table VTK 9.3 and later do not run a filter again by themselves.
  distance->Modified();
  distance->UpdatePiece(1, 2, 0);
  CHECK(checks, isEmpty(distance));
}

} // namespace

int TestDistanceRun(int, char*[])
{
  return runChecks({ checkThreads, checkAbort, checkPieces });
}
