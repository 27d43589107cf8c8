// SPDX-License-Identifier: BSD-3-Clause
// Filters whose output grows while it is made, with less and less memory: all of it or one error.
#include "../MemoryLimit.h"
#include "CellsTest.h"
#include "SolidTest.h"

#include <functional>

namespace
{

#ifdef HAS_MEMORY_LIMIT
void checkSweep(Checks& checks, vtkAlgorithm* algorithm, std::int64_t step,
  const std::function<bool()>& isWhole, const std::function<bool()>& isEmpty, int line)
{
  Messages messages(algorithm);
  int failed = 0;
  bool done = false;
  constexpr int most = 400;
  for (int i = 0; i < most && !done; ++i)
  {
    messages.Clear();
    algorithm->Modified();
    {
      const MemoryLimit limit(i * step);
      algorithm->Update();
    }
    done = messages.Errors.empty();
    failed += done ? 0 : 1;
    checks.That(messages.Errors.size() <= 1, "at most one error", line);
    checks.That(done || contains(messages.Errors[0], "memory"), "it is of memory", line);
    checks.That(done ? isWhole() : isEmpty(), "all or nothing", line, std::to_string(i));
  }
  checks.That(done && failed > 0, "both happen", line, std::to_string(failed));
}

void checkCells(Checks& checks)
{
  vtkNew<vtkEqualMassCells> cells;
  cells->SetThreadingToSerial(); // new threads need memory of their own
  cells->SetInputData(makeSites({ 0, 1, 0, 1, 0, 1 }, 2000));
  cells->SetResolution(48);
  cells->SetNumberOfSteps(4);
  cells->Update();
  const vtkIdType faces = cells->GetOutlines()->GetNumberOfPolys();
  CHECK(checks, faces > 100000);
  checkSweep(
    checks, cells, std::int64_t{ 1 } << 18,
    [&]() { return cells->GetOutlines()->GetNumberOfPolys() == faces; },
    [&]() {
      return cells->GetOutlines()->GetNumberOfPoints() == 0 &&
        cells->GetLabels()->GetNumberOfPoints() == 0 && cells->GetSites()->GetNumberOfPoints() == 0;
    },
    __LINE__);
}

void checkSolid(Checks& checks)
{
  vtkNew<vtkSolidDensity> solid;
  solid->SetThreadingToSerial();
  solid->SetInputData(makeQuadSphere(200, 200));
  solid->SetResolution(16);
  solid->Update();
  const vtkIdType points = solid->GetOutput()->GetNumberOfPoints();
  CHECK(checks, points > 0);
  checkSweep(
    checks, solid, std::int64_t{ 1 } << 18,
    [&]() { return solid->GetOutput()->GetNumberOfPoints() == points; },
    [&]() { return solid->GetOutput()->GetNumberOfPoints() == 0; }, __LINE__);
}
#endif

} // namespace

int TestLittleMemory(int, char*[])
{
  Checks checks;
#ifdef HAS_MEMORY_LIMIT
  checkCells(checks);
  checkSolid(checks);
#endif
  return checks.Result();
}
