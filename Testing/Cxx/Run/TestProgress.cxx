// SPDX-License-Identifier: BSD-3-Clause
// The progress of every filter begins at 0, never goes back and ends at 1: in the first run, in one
// that finds all made, and where only a part is new.
#include "../../SeedPatterns.h"
#include "BlendTest.h"
#include "CellsTest.h"
#include "KindTest.h"
#include "MapRegions.h"
#include "ParameterizationTest.h"
#include "ProgressTest.h"
#include "SolidTest.h"
#include "SurfaceSamplerTest.h"

#include "vtkBlueNoiseRelaxation.h"
#include "vtkMassSplatter.h"
#include "vtkTransportMap.h"
#include "vtkTransportQuality.h"
#include "vtkUniformSeedSource.h"

namespace
{

void expectRising(Checks& checks, vtkAlgorithm* filter, const char* what, int line)
{
  ProgressTest test(filter);
  filter->Modified();
  filter->Update();
  test.ExpectRising(checks, 2, line, what);
}

void expectRising(Checks& checks, vtkAlgorithm* filter, vtkImageData* density, int line)
{
  expectRising(checks, filter, "first", line);
  expectRising(checks, filter, "again", line);
  density->Modified();
  expectRising(checks, filter, "another image", line);
  changeDensity(density);
  expectRising(checks, filter, "another density", line);
}

void checkFlows(Checks& checks, int depth)
{
  auto image = makeImage(41, 30, depth, true, bumpy);
  const double bounds[6] = { 0.0, 40.0, 0.0, 29.0, 0.0, depth - 1.0 };
  auto points = makePoints(randomCoordinates(bounds, 3000));
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  for (const int integrator : { 0, 1, 2, 3 })
  {
    sampler->SetIntegrator(integrator);
    expectRising(checks, sampler, image, __LINE__);
  }
  sampler->InvertDensityOn();
  sampler->OutputPathsOn();
  expectRising(checks, sampler, image, __LINE__);
  sampler->SetSeedsData(points);
  sampler->OutputPathsOff();
  expectRising(checks, sampler, image, __LINE__);

  vtkNew<vtkTransportMap> map;
  map->SetInputData(image);
  expectRising(checks, map, image, __LINE__);
  map->SetDirectionToDensityToUniform();
  expectRising(checks, map, image, __LINE__);

  vtkNew<vtkDensityEqualizingWarp> warp;
  warp->SetInputData(points);
  warp->SetDensityData(image);
  expectRising(checks, warp, image, __LINE__);

  vtkNew<vtkTransportQuality> quality;
  quality->SetInputData(points);
  quality->SetDensityData(image);
  expectRising(checks, quality, image, __LINE__);

  vtkNew<vtkBlueNoiseRelaxation> relaxation;
  relaxation->SetInputData(makePoints(randomCoordinates(bounds, 300)));
  relaxation->SetDensityData(image);
  relaxation->SetMaximumIterations(3);
  expectRising(checks, relaxation, image, __LINE__);
  if (depth == 1)
  {
    relaxation->SetMethodToOptimalTransport();
    expectRising(checks, relaxation, image, __LINE__);
  }

  vtkNew<vtkMassSplatter> splatter;
  splatter->SetInputData(points);
  for (int kernel = 0; kernel < 4; ++kernel)
  {
    splatter->SetKernel(kernel);
    splatter->SetBoundary(kernel % 2);
    expectRising(checks, splatter, "splat", __LINE__);
  }
  splatter->SetReferenceData(image);
  expectRising(checks, splatter, "splat on a reference", __LINE__);

  vtkNew<vtkEqualMassCells> cells;
  cells->SetInputData(points);
  cells->SetResolution(depth == 1 ? 200 : 40);
  expectRising(checks, cells, "cells", __LINE__);
  expectRising(checks, cells, "cells again", __LINE__);
  cells->SetDomainData(image);
  points->Modified();
  expectRising(checks, cells, "cells of a domain", __LINE__);
}

void checkBlends(Checks& checks, int depth)
{
  auto source = makeDensity({ 40, 30, depth }, true, bumpy);
  auto target = makeDensity({ 40, 30, depth }, true, otherDensity(40, 30, depth));
  auto third = makeDensity({ 24, 36, depth }, false, otherDensity(24, 36, depth));
  for (const int perCell : { 1, 3 })
  {
    auto morph = makeMorph(source, target);
    morph->SetParticlesPerCell(perCell);
    expectRising(checks, morph, target, __LINE__);
    morph->SetParameter(0.25);
    expectRising(checks, morph, "another parameter", __LINE__);
    morph->SetDimensions(20, 20, depth);
    expectRising(checks, morph, "another grid", __LINE__);
  }
  auto barycenter = makeBarycenter({ source, target, third, source }, { 1, 2, 3, 4 });
  expectRising(checks, barycenter, third, __LINE__);
}

void checkSources(Checks& checks)
{
  vtkNew<vtkUniformSeedSource> seeds;
  for (const int dimension : { 2, 3 })
  {
    seeds->SetDimension(dimension);
    for (int pattern = 0; pattern < RectifiedTransport::numberOfSeedPatterns; ++pattern)
    {
      seeds->SetPattern(pattern);
      expectRising(checks, seeds, "seeds", __LINE__);
    }
  }
  vtkNew<vtkSolidDensity> solid;
  solid->SetInputData(makeSphere(0, 0, 0, 1));
  expectRising(checks, solid, "sphere", __LINE__);
  solid->SetInputData(makeBox(0, 1, 0, 2, 0, 3)); // of polygons that are cut into triangles
  expectRising(checks, solid, "box", __LINE__);
  solid->SetInputData(together(makeBox(0, 1, 0, 2, 0, 3), turned(makeSphere(5, 0, 0, 1))));
  expectRising(checks, solid, "two", __LINE__);
  expectRising(checks, makeParameterization(makeHills(9, 9)), "triangles", __LINE__);
  expectRising(checks, makeParameterization(makeFlatSheet(9, 9, false)), "quads", __LINE__);
  vtkNew<vtkSurfaceSampler> surface;
  surface->SetNumberOfParticles(100);
  surface->SetResolution(50);
  for (const int method : { vtkSurfaceSampler::RELAXATION, vtkSurfaceSampler::FLOW })
  {
    surface->SetMethod(method);
    for (const bool triangles : { false, true })
    {
      surface->SetInputData(makeHill(triangles));
      expectRising(checks, surface, "particles on a surface", __LINE__);
    }
  }
}

// Every filter of the register, as it is by default.
void checkKinds(Checks& checks)
{
  auto image = makeImage(9, 7, 1, true, bumpy);
  auto points = makePoints({ 3, 2, 0, 4, 5, 0, 6, 1, 0 });
  for (const Campaign::FilterKind& kind : Campaign::filterKinds())
  {
    int runs = 0;
    // Some take closed surfaces, others disks or maps.
    for (const vtkSmartPointer<vtkPolyData>& surface :
      { makeSphere(0, 0, 0, 1), makeHill(true), makeMap(3) })
    {
      const auto filter = kind.New();
      connectNeeded(filter, image, points, surface);
      Messages messages(filter);
      filter->Update();
      if (messages.Errors.empty())
      {
        expectRising(checks, filter, kind.Name, __LINE__);
        ++runs;
      }
    }
    checks.That(runs > 0, "a run without an error", __LINE__, kind.Name);
  }
}

// Loops of several slices.
void checkLarge(Checks& checks)
{
  auto image = makeImage(801, 751, 1, true, bumpy);
  const auto inFewSteps = [](vtkTransportAlgorithm* filter) {
    filter->SetIntegratorToEuler();
    filter->SetNumberOfSteps(1);
  };
  vtkNew<vtkTransportSampler> sampler;
  inFewSteps(sampler);
  sampler->SetInputData(image);
  sampler->SetSeedPatternToRandom();
  sampler->SetNumberOfParticles(600000);
  Messages messages(sampler);
  expectRising(checks, sampler, "many particles", __LINE__);
  vtkNew<vtkPolyData> points;
  points->ShallowCopy(sampler->GetOutput());

  vtkNew<vtkTransportMap> map;
  inFewSteps(map);
  map->SetInputData(image);
  expectRising(checks, map, "large map", __LINE__);
  vtkNew<vtkDensityEqualizingWarp> warp;
  inFewSteps(warp);
  warp->SetInputData(points);
  warp->SetDensityData(image);
  expectRising(checks, warp, "many points", __LINE__);
  vtkNew<vtkMassSplatter> splatter;
  splatter->SetInputData(points);
  splatter->SetDimensions(700, 800, 1);
  expectRising(checks, splatter, "large splat", __LINE__);
  auto morph = makeMorph(image, makeImage(801, 751, 1, true, otherDensity(800, 750)));
  inFewSteps(morph);
  Messages morphMessages(morph);
  expectRising(checks, morph, "many particles", __LINE__);
  morph->SetParameter(0.25);
  expectRising(checks, morph, "another parameter", __LINE__);
}

} // namespace

int TestProgress(int, char*[])
{
  Checks checks;
  checkFlows(checks, 1);
  checkFlows(checks, 6);
  checkBlends(checks, 1);
  checkBlends(checks, 6);
  checkSources(checks);
  checkKinds(checks);
  checkLarge(checks);
  return checks.Result();
}
