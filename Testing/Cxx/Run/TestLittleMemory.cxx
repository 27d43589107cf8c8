// SPDX-License-Identifier: BSD-3-Clause
// Filters whose output grows while it is made, with less and less memory: all of it or one error.
#include "../../MemoryLimit.h"
#include "CellsTest.h"
#include "MapRegions.h"
#include "ParameterizationTest.h"
#include "SolidTest.h"
#include "SurfaceSamplerTest.h"

#include <vector>

namespace
{

#ifdef HAS_MEMORY_LIMIT
// The numbers of points and cells of all outputs.
std::vector<vtkIdType> sizesOf(vtkAlgorithm* algorithm)
{
  std::vector<vtkIdType> sizes;
  for (int port = 0; port < algorithm->GetNumberOfOutputPorts(); ++port)
  {
    vtkDataObject* output = algorithm->GetOutputDataObject(port);
    sizes.push_back(output->GetNumberOfElements(vtkDataObject::POINT));
    sizes.push_back(output->GetNumberOfElements(vtkDataObject::CELL));
  }
  return sizes;
}

void checkSweep(Checks& checks, vtkCollectiveAlgorithm* algorithm, int line)
{
  algorithm->SetThreadingToSerial(); // new threads need memory of their own
  algorithm->Update();
  const std::vector<vtkIdType> whole = sizesOf(algorithm);
  checks.That(!isEmpty(algorithm), "an output", line);
  Messages messages(algorithm);
  int failed = 0;
  bool done = false;
  constexpr int most = 400;
  constexpr std::int64_t step = std::int64_t{ 1 } << 18;
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
    checks.That(done || messages.IsOneError("memory"), "one error of memory", line);
    checks.That(done ? sizesOf(algorithm) == whole : isEmpty(algorithm), "all or nothing", line,
      std::to_string(i));
  }
  checks.That(done && failed > 0, "both happen", line, std::to_string(failed));
}

void checkCells(Checks& checks)
{
  vtkNew<vtkEqualMassCells> cells;
  cells->SetInputData(makeSites({ 0, 1, 0, 1, 0, 1 }, 2000));
  cells->SetResolution(48);
  cells->SetNumberOfSteps(4);
  checkSweep(checks, cells, __LINE__);
  CHECK(checks, cells->GetOutlines()->GetNumberOfPolys() > 100000);
}

void checkSolid(Checks& checks)
{
  vtkNew<vtkSolidDensity> solid;
  solid->SetInputData(makeQuadSphere(200, 200));
  solid->SetResolution(16);
  checkSweep(checks, solid, __LINE__);
}

void checkParameterization(Checks& checks)
{
  auto surface = makeFlatSheet(70, 70, false);
  surface->GetCellData()->AddArray(makeNumbers("Number", surface->GetNumberOfCells()));
  auto filter = makeParameterization(surface);
  checkSweep(checks, filter, __LINE__);
}

void checkSurfaceSampler(Checks& checks)
{
  auto surface = makeHill(false);
  surface->GetCellData()->AddArray(makeNumbers("Number", surface->GetNumberOfCells()));
  surface->GetPointData()->AddArray(makeNumbers("Density", surface->GetNumberOfPoints()));
  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetInputData(surface);
  sampler->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Density");
  sampler->SetNumberOfParticles(50000);
  sampler->SetResolution(200);
  sampler->SetNumberOfSteps(4);
  checkSweep(checks, sampler, __LINE__);
}

void checkCartogram(Checks& checks)
{
  auto map = makeMap(60);
  map->GetPointData()->AddArray(makeNumbers("Number", map->GetNumberOfPoints()));
  vtkNew<vtkCartogram> cartogram;
  cartogram->SetInputData(map);
  cartogram->SetOverlayData(makeMap(50));
  cartogram->SetResolution(256);
  cartogram->SetMaximumIterations(1);
  cartogram->SetTolerance(1.0);
  checkSweep(checks, cartogram, __LINE__);
}
#endif

} // namespace

int TestLittleMemory(int, char*[])
{
  Checks checks;
#ifdef HAS_MEMORY_LIMIT
  checkCells(checks);
  checkSolid(checks);
  checkParameterization(checks);
  checkSurfaceSampler(checks);
  checkCartogram(checks);
#endif
  return checks.Result();
}
