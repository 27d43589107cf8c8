// SPDX-License-Identifier: BSD-3-Clause
// How vtkEqualMassCells runs: labels that are kept, the same bits on any number of threads, pieces,
// progress, an abort, and what it says of wrong input.
#include "CellsTest.h"
#include "ProgressTest.h"

#include "vtkInformation.h"
#include "vtkSMPTools.h"
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
  vtkSmartPointer<vtkDataArray> last;
  const auto expect = [&](bool made, const char* what, int line) {
    cells->Update();
    vtkDataArray* array = cells->GetLabels()->GetCellData()->GetArray("SiteId");
    checks.That((array != last) == made, what, line);
    last = array;
  };
  expect(true, "the first run", __LINE__);
  cells->SetCostExponent(4.0);
  expect(false, "another cost", __LINE__);
  cells->SetNormExponent(1.0);
  expect(false, "another norm", __LINE__);
  cells->SetThreadingToSerial();
  expect(false, "other threads", __LINE__);
  cells->SetNumberOfSteps(16);
  expect(true, "other steps", __LINE__);
  cells->SetIntegratorToRungeKutta4();
  expect(true, "another integrator", __LINE__);
  cells->SetResolution(31);
  expect(true, "another resolution", __LINE__);
  domain->SetOrigin(0.1, 0.0, 0.0);
  domain->Modified();
  expect(true, "another domain", __LINE__);
  sites->GetPoints()->SetPoint(2, 0.5, 0.5, 0.0);
  sites->GetPoints()->Modified();
  expect(true, "another site", __LINE__);
  cells->SetInputData(makeSites(square, 9));
  expect(true, "other sites", __LINE__);
}

void checkThreads(Checks& checks, double depth)
{
  const std::array<double, 6> box = { 0.0, 1.0, 0.0, 1.0, 0.0, depth };
  vtkNew<vtkEqualMassCells> cells;
  cells->SetInputData(makeSites(box, 40));
  cells->SetDomainData(makeDomain(box));
  cells->SetResolution(depth > 0.0 ? 24 : 100);
  cells->SetThreadingToSerial();
  const std::vector<vtkIdType> serial = runCells(cells);
  std::vector<double> costs;
  for (vtkIdType i = 0; i < 40; ++i)
  {
    costs.push_back(siteValue(cells, "CellCost", i));
  }
  for (const int threading : { 0, 1, 2 })
  {
    for (const int threads : { 1, 2, 3 })
    {
      vtkSMPTools::Initialize(threads);
      vtkNew<vtkEqualMassCells> other;
      other->SetInputData(cells->GetInputDataObject(0, 0));
      other->SetDomainData(cells->GetInputDataObject(1, 0));
      other->SetResolution(cells->GetResolution());
      other->SetThreading(threading);
      CHECK(checks, runCells(other) == serial);
      for (vtkIdType i = 0; i < 40; ++i)
      {
        CHECK(checks, siteValue(other, "CellCost", i) == costs[static_cast<std::size_t>(i)]);
      }
    }
  }
  vtkSMPTools::Initialize(0);
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
      checks, cells, from, [&]() { sites->GetPoints()->Modified(); },
      [&]() {
        return cells->GetLabels()->GetNumberOfPoints() == 0 &&
          cells->GetSites()->GetNumberOfPoints() == 0 &&
          cells->GetOutlines()->GetNumberOfPoints() == 0;
      },
      __LINE__);
  }
  ProgressTest progress(cells);
  sites->GetPoints()->Modified();
  CHECK(checks, runCells(cells).size() == 300u * 300);
  CHECK(checks, std::is_sorted(progress.Heard.begin(), progress.Heard.end()));
  CHECK(checks, progress.Heard.size() > 5 && progress.Heard.front() >= 0.0);
  CHECK_NEAR(checks, progress.Heard.back(), 1.0, 1e-12);
  CHECK(checks, messages.Errors.empty());
}

void expectError(
  Checks& checks, vtkEqualMassCells* cells, const std::vector<std::string>& parts, int line)
{
  Messages messages(cells);
  cells->Update();
  checks.That(messages.Errors.size() == 1, "one error", line);
  for (const std::string& part : parts)
  {
    checks.That(!messages.Errors.empty() && contains(messages.Errors.front(), part), part.c_str(),
      line, messages.Errors.empty() ? "no message" : messages.Errors.front());
  }
  checks.That(cells->GetLabels()->GetNumberOfPoints() == 0 &&
      (!cells->GetSites() || cells->GetSites()->GetNumberOfPoints() == 0) &&
      cells->GetOutlines()->GetNumberOfPoints() == 0,
    "empty outputs", line);
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
  cells->SetResolution(0);
  expectError(checks, cells, { "Resolution is 0; it must be from 1" }, __LINE__);
  cells->SetInputData(makePoints({})); // what is wrong is wrong without sites, too
  expectError(checks, cells, { "Resolution is 0; it must be from 1" }, __LINE__);
  cells = fresh();
  cells->SetResolution(2); // 2 x 2 pixels or fewer
  expectError(checks, cells, { "5 sites", "raise Resolution" }, __LINE__);
  cells = fresh();
  cells->SetNormExponent(0.5);
  expectError(checks, cells, { "NormExponent is 0.5; it must be at least 1" }, __LINE__);
  cells->SetNormExponent(nan);
  expectError(checks, cells, { "NormExponent is nan" }, __LINE__);
  cells = fresh();
  cells->SetCostExponent(0.0);
  expectError(checks, cells, { "CostExponent is 0; it must be a number above 0" }, __LINE__);
  cells = fresh();
  cells->SetInputData(makePoints({ 0, 0, 0, 1e3, 1e3, 0 }));
  cells->SetCostExponent(300.0);
  expectError(checks, cells, { "CostExponent 300", "largest double" }, __LINE__);
  cells = fresh();
  cells->SetDomainData(makeDomain({ 0.0, 1e155, 0.0, 1e155, 0.0, 0.0 }));
  cells->SetCostExponent(1.0);
  expectError(checks, cells, { "area", "largest double" }, __LINE__);
  cells = fresh();
  cells->SetNumberOfSteps(0);
  expectError(checks, cells, { "NumberOfSteps is 0" }, __LINE__);
  cells = fresh();
  cells->SetIntegrator(7);
  expectError(checks, cells, { "Integrator is 7" }, __LINE__);
  cells = fresh();
  cells->SetThreading(9);
  expectError(checks, cells, { "Threading is 9" }, __LINE__);
  cells = fresh();
  cells->SetInputData(makePoints({ 0, 0, 0, nan, 1, 0, 1, 1, 0 }));
  cells->SetDomainData(makeDomain(square));
  expectError(checks, cells, { "input point set", "1 point", "index 1" }, __LINE__);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  cells = fresh();
  cells->SetInputData(makePoints({ 0, 0, 0, 1, infinite, 0, 1, 1, 0 }));
  expectError(checks, cells, { "input point set", "1 point", "index 1" }, __LINE__);
  cells = fresh();
  cells->SetInputData(makePoints({ nan, nan, nan }));
  expectError(checks, cells, { "input point set", "1 point", "index 0" }, __LINE__);
  cells = fresh();
  cells->SetInputData(makePoints({ -1.5e308, 0, 0, 1.5e308, 1, 0, 1, 1, 0 }));
  expectError(checks, cells, { "spacing is (inf" }, __LINE__);
  cells = fresh();
  cells->SetInputData(makePoints({ 2, 2, 2, 2, 2, 2 }));
  expectError(checks, cells, { "all at one point", "Domain" }, __LINE__);
  cells = fresh();
  cells->SetDomainData(makeDomain({ 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 }));
  expectError(checks, cells, { "Domain has one point along every axis" }, __LINE__);
  cells = fresh();
  cells->SetDomainData(makeDomain({ 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 }));
  cells->SetResolution(100000);
  expectError(checks, cells, { "labels of 100000 x 100000 x 100000 pixels" }, __LINE__);
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
  Checks checks;
  checkCache(checks);
  checkThreads(checks, 0.0);
  checkThreads(checks, 1.0);
  checkPieces(checks);
  checkAborts(checks);
  checkErrors(checks);
  checkEmpty(checks);
  return checks.Result();
}
