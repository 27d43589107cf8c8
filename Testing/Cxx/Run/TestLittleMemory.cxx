// SPDX-License-Identifier: BSD-3-Clause
// Filters whose output grows while it is made, with less and less memory: all of it or one error.
// What an optimal map takes is asked for before the work begins.
#include "../../MemoryLimit.h"
#include "BlendTest.h"
#include "CellsTest.h"
#include "MapRegions.h"
#include "ParameterizationTest.h"
#include "SolidTest.h"
#include "SurfaceSamplerTest.h"

#include "Bridge/Plan/DensityPlan.h"
#include "Core/Messages/Failure.h"

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

void checkSurfaceSampler(Checks& checks, int method)
{
  auto surface = makeHill(false);
  surface->GetCellData()->AddArray(makeNumbers("Number", surface->GetNumberOfCells()));
  surface->GetPointData()->AddArray(makeNumbers("Density", surface->GetNumberOfPoints()));
  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetMethod(method);
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

void checkOptimal(Checks& checks)
{
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(makeImage(40, 30, 1, true, bumpy));
  sampler->SetMethodToOptimal();
  sampler->SetNumberOfParticles(20000);
  checkSweep(checks, sampler, __LINE__);
  auto morph = makeMorph(makeDensity({ 24, 20, 1 }, true, bumpy),
    makeDensity({ 24, 20, 1 }, true, otherDensity(24, 20)));
  morph->SetMethodToOptimal();
  morph->SetParticlesPerCell(9);
  checkSweep(checks, morph, __LINE__);
  vtkNew<vtkTransportMap> map;
  map->SetInputData(makeDensity({ 48, 40, 1 }, true, bumpy));
  map->SetTargetData(makeDensity({ 48, 40, 1 }, true, otherDensity(48, 40)));
  map->SetSampleDimensions(300, 200, 1);
  map->SetNumberOfSteps(4);
  for (const int method : { 0, 1 })
  {
    map->SetMethod(method);
    checkSweep(checks, map, __LINE__);
  }
}

// There is memory neither for the map nor for the tables: the map is asked for first.
void checkMapBeforeTables(Checks& checks)
{
  const Counts cells{ 96, 96, 96 };
  auto density = makeDensity(cells, true, bumpy);
  auto other = makeDensity(cells, true, otherDensity(96, 96, 96));
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetNumberOfParticles(1000);
  vtkNew<vtkTransportMap> map;
  map->SetSampleDimensions(4, 4, 4);
  auto morph = makeMorph(density, other);
  morph->SetDimensions(8, 8, 8);
  auto barycenter = makeBarycenter({ density, other, density }, { 1.0, 1.0, 1.0 });
  barycenter->SetDimensions(8, 8, 8);
  const auto check = [&](vtkTransportAlgorithm* filter, const std::string& densities, int line) {
    filter->SetThreadingToSerial();
    filter->SetMethodToOptimal();
    ErrorTest test(checks, filter);
    const MemoryLimit limit(16 << 20);
    test.Expect({ "the optimal map " + densities, "Method RectifiedFlow needs none" }, line);
    filter->SetMethodToRectifiedFlow();
    filter->CertifyOn();
    test.Expect({ "the optimal map " + densities, "Certify Off needs none" }, line);
  };
  for (vtkTransportAlgorithm* filter :
    { static_cast<vtkTransportAlgorithm*>(sampler), static_cast<vtkTransportAlgorithm*>(map) })
  {
    filter->SetInputData(density);
    check(filter, "of a density of 96 x 96 x 96 cells", __LINE__);
    CHECK(checks, filter->GetTableBuildTime() == 0);
  }
  map->SetTargetData(other);
  check(map, "between densities of 96 x 96 x 96 and 96 x 96 x 96 cells", __LINE__);
  CHECK(checks, map->GetTableBuildTime() == 0);
  check(morph, "between densities of 96 x 96 x 96 and 96 x 96 x 96 cells", __LINE__);
  check(barycenter, "between densities of 8 x 8 x 8 and 96 x 96 x 96 cells", __LINE__);
}

#endif

// Particles that get exact counts are asked for with their map and without, if it is there.
void checkExactCounts(Checks& checks)
{
  using namespace RectifiedTransport;
  using namespace RectifiedTransport::Bridge;
  const GridSize<2> size{ 40, 30 };
  const Ranks& alone = SoloRanks::Get();
  const auto isRefused = [&](const auto& require) {
    try
    {
      require();
    }
    catch (const Failure&)
    {
      return true;
    }
    return false;
  };
  for (const bool isOptimal : { true, false })
  {
    for (const double particles : { 1e3, 1e15 })
    {
      OptimalNeeds needs{ {}, particles };
      needs.Setting.IsOptimal = isOptimal;
      const bool isWrong = isOptimal && particles > 1e14;
      const auto map = [&]() {
        requireMemory(memoryOfOptimalMap<2>("", size, size, needs, alone));
      };
      const auto counts = [&]() { needs.RequireForSamples<2>(size, alone); };
      CHECK(checks, isRefused(map) == isWrong);
      CHECK(checks, isRefused(counts) == isWrong);
    }
  }
}

} // namespace

int TestLittleMemory(int, char*[])
{
  Checks checks;
#ifdef HAS_MEMORY_LIMIT
  checkCells(checks);
  checkSolid(checks);
  checkParameterization(checks);
  checkSurfaceSampler(checks, vtkSurfaceSampler::RELAXATION);
  checkSurfaceSampler(checks, vtkSurfaceSampler::FLOW);
  checkCartogram(checks);
  checkOptimal(checks);
  checkMapBeforeTables(checks);
#endif
  checkExactCounts(checks);
  return checks.Result();
}
