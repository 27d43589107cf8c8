// SPDX-License-Identifier: BSD-3-Clause
// How vtkEqualMassCells runs: labels that are kept, the same bits on any number of threads, pieces,
// progress, an abort, and what it says of wrong input.
#include "CellsTest.h"
#include "ProgressTest.h"
#include "ThreadsTest.h"

#include "vtkInformation.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <limits>

namespace
{

constexpr std::array<double, 6> square = { 0.0, 1.0, 0.0, 1.0, 0.0, 0.0 };

// New costs come from the same labels; anything that may change the labels makes new ones.
void checkCache(Checks& checks)
{
  vtkNew<vtkEqualMassCells> cells;
  auto sites = makeSites(square, 9);
  auto domain = makeDomain(square);
  cells->SetInputData(sites);
  cells->SetDomainData(domain);
  cells->SetResolution(30);
  NewLabels newLabels(cells);
  const auto makes = [&newLabels]() { return newLabels(); };
  CHECK(checks, makes());
  expectAfterEach(checks, makes, false,
    { { "CostExponent", [&]() { cells->SetCostExponent(4.0); } },
      { "NormExponent", [&]() { cells->SetNormExponent(1.0); } },
      { "Threading", [&]() { cells->SetThreadingToSerial(); } } },
    __LINE__);
  const auto moveDomain = [&]() {
    domain->SetOrigin(0.1, 0.0, 0.0);
    domain->Modified();
  };
  const auto moveSite = [&]() {
    sites->GetPoints()->SetPoint(2, 0.5, 0.5, 0.0);
    sites->GetPoints()->Modified();
  };
  expectAfterEach(checks, makes, true,
    { { "NumberOfSteps", [&]() { cells->SetNumberOfSteps(16); } },
      { "Integrator", [&]() { cells->SetIntegratorToRungeKutta4(); } },
      { "Resolution", [&]() { cells->SetResolution(31); } }, { "the domain", moveDomain },
      { "a site", moveSite },
      { "other sites", [&]() { cells->SetInputData(makeSites(square, 9)); } } },
    __LINE__);
}

// A site that moves without a word of its points is noticed however they lie in memory.
void checkQuietMoves(Checks& checks)
{
  vtkNew<vtkSOADataArrayTemplate<double>> apart;
  for (const bool areApart : { false, true })
  {
    vtkNew<vtkEqualMassCells> cells;
    auto sites = makeSites(square, 9);
    apart->DeepCopy(sites->GetPoints()->GetData());
    if (areApart)
    {
      sites->GetPoints()->SetData(apart);
    }
    cells->SetInputData(sites);
    cells->SetResolution(30);
    NewLabels newLabels(cells);
    CHECK(checks, newLabels());
    sites->Modified();
    CHECK(checks, newLabels() == areApart); // no fingerprint: they may be others
    sites->GetPoints()->GetData()->SetComponent(2, 0, 0.5);
    sites->Modified();
    CHECK(checks, newLabels());
  }
}

void checkThreads(Checks& checks)
{
  for (const double depth : { 0.0, 1.0 })
  {
    const std::array<double, 6> box = { 0.0, 1.0, 0.0, 1.0, 0.0, depth };
    auto sites = makeSites(box, 40);
    auto domain = makeDomain(box);
    const auto run = [&](int threading) {
      vtkNew<vtkEqualMassCells> cells;
      cells->SetInputData(sites);
      cells->SetDomainData(domain);
      cells->SetResolution(depth > 0.0 ? 24 : 100);
      cells->SetThreading(threading);
      const std::vector<vtkIdType> labels = runCells(cells);
      return std::make_pair(
        labels, arrayValues(cells->GetSites()->GetPointData()->GetArray("CellCost")));
    };
    const auto [labels, costs] = expectSameBits(checks, run, __LINE__);
    CHECK(checks, labels.size() > 9000 && costs.size() == 40);
  }
}

void checkPieces(Checks& checks)
{
  vtkNew<vtkEqualMassCells> cells;
  cells->SetInputData(makeSites(square, 5));
  cells->SetDomainData(makeDomain(square));
  cells->SetResolution(20);
  cells->UpdatePiece(1, 2, 0);
  CHECK(checks, cells->GetLabels()->GetNumberOfPoints() == 0);
  CHECK(checks, cells->GetOutlines()->GetNumberOfPoints() == 0);
  // What is published before the data is what the data have.
  cells->UpdateInformation();
  int extent[6];
  cells->GetOutputInformation(0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent);
  CHECK(checks, extent[1] == 20 && extent[3] == 20 && extent[5] == 0);
}

void checkAborts(Checks& checks)
{
  vtkNew<vtkEqualMassCells> cells;
  Messages messages(cells);
  auto sites = makeSites(square, 200);
  cells->SetInputData(sites);
  cells->SetDomainData(makeDomain(square));
  cells->SetResolution(300);
  for (const double from : { 0.001, 0.3, 0.9, 0.95, 0.99 })
  {
    checkAbort(
      checks, cells, from, [&]() { sites->GetPoints()->Modified(); }, __LINE__);
  }
  ProgressTest progress(cells);
  sites->GetPoints()->Modified();
  CHECK(checks, runCells(cells).size() == 300u * 300);
  progress.ExpectRising(checks, 6, __LINE__);
  CHECK(checks, messages.Errors.empty());
}

void checkErrors(Checks& checks)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto fresh = [&]() {
    auto cells = vtkSmartPointer<vtkEqualMassCells>::New();
    cells->SetInputData(makeSites(square, 5));
    cells->SetResolution(20);
    return cells;
  };
  auto cells = fresh();
  cells->SetResolution(-1);
  ErrorTest(checks, cells).Expect("Resolution is -1; it must be from 1", __LINE__);
  cells->SetInputData(makePoints({})); // what is wrong is wrong without sites, too
  ErrorTest(checks, cells).Expect("Resolution is -1; it must be from 1", __LINE__);
  cells = fresh();
  cells->SetResolution(2); // 2 x 2 pixels or fewer
  ErrorTest(checks, cells).Expect({ "5 sites", "raise Resolution" }, __LINE__);
  cells = fresh();
  cells->SetNormExponent(0.5);
  ErrorTest(checks, cells).Expect("NormExponent is 0.5; it must be at least 1", __LINE__);
  cells->SetNormExponent(nan);
  ErrorTest(checks, cells).Expect("NormExponent is nan", __LINE__);
  cells = fresh();
  cells->SetCostExponent(0.0);
  ErrorTest(checks, cells).Expect("CostExponent is 0; it must be a number above 0", __LINE__);
  cells = fresh();
  cells->SetInputData(makePoints({ 0, 0, 0, 1e3, 1e3, 0 }));
  cells->SetCostExponent(300.0);
  ErrorTest(checks, cells).Expect({ "CostExponent 300", "largest double" }, __LINE__);
  cells = fresh();
  cells->SetDomainData(makeDomain({ 0.0, 1e155, 0.0, 1e155, 0.0, 0.0 }));
  cells->SetCostExponent(1.0);
  ErrorTest(checks, cells).Expect({ "area", "largest double" }, __LINE__);
  cells = fresh();
  ErrorTest test(checks, cells);
  expectFlowErrors(test, cells.Get(), __LINE__);
  cells->SetIntegrator(7);
  test.Expect("Integrator is 7", __LINE__);
  cells = fresh();
  cells->SetInputData(makePoints({ 0, 0, 0, nan, 1, 0, 1, 1, 0 }));
  cells->SetDomainData(makeDomain(square));
  ErrorTest(checks, cells).Expect({ "input point set", "1 point", "index 1" }, __LINE__);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  cells = fresh();
  cells->SetInputData(makePoints({ 0, 0, 0, 1, infinite, 0, 1, 1, 0 }));
  ErrorTest(checks, cells).Expect({ "input point set", "1 point", "index 1" }, __LINE__);
  cells = fresh();
  cells->SetInputData(makePoints({ nan, nan, nan }));
  ErrorTest(checks, cells).Expect({ "input point set", "1 point", "index 0" }, __LINE__);
  cells = fresh();
  cells->SetInputData(makePoints({ -1.5e308, 0, 0, 1.5e308, 1, 0, 1, 1, 0 }));
  ErrorTest(checks, cells).Expect("spacing is (inf", __LINE__);
  cells = fresh();
  cells->SetInputData(makePoints({ 2, 2, 2, 2, 2, 2 }));
  ErrorTest(checks, cells).Expect({ "all at one point", "Domain" }, __LINE__);
  cells = fresh();
  cells->SetDomainData(makeDomain({ 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 }));
  ErrorTest(checks, cells).Expect("Domain has one point along every axis", __LINE__);
  cells = fresh();
  cells->SetDomainData(makeDomain({ 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 }));
  cells->SetResolution(100000);
  ErrorTest(checks, cells).Expect("labels of 100000 x 100000 x 100000 pixels", __LINE__);
}

void checkEmpty(Checks& checks)
{
  vtkNew<vtkEqualMassCells> cells;
  Messages messages(cells);
  cells->SetInputData(makePoints({}));
  cells->Update();
  CHECK(checks, cells->GetLabels()->GetNumberOfPoints() == 0);
  CHECK(checks, cells->GetSites() && cells->GetSites()->GetNumberOfPoints() == 0);
  cells->SetInputData(makeSites(square, 5));
  cells->SetDomainData(vtkSmartPointer<vtkImageData>::New());
  cells->Update();
  CHECK(checks, cells->GetLabels()->GetNumberOfPoints() == 0);
  CHECK(checks, messages.Errors.empty());
}

} // namespace

int TestCellsRun(int, char*[])
{
  return runChecks({ checkCache, checkQuietMoves, checkThreads, checkPieces, checkAborts,
    checkErrors, checkEmpty });
}
