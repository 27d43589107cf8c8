// SPDX-License-Identifier: BSD-3-Clause
// vtkEqualMassCells with Shape Power: polygons of equal area and least cost, what it needs, and how
// it runs.
#include "CellsTest.h"
#include "ProgressTest.h"
#include "ThreadsTest.h"

#include <limits>

namespace
{

constexpr std::array<double, 6> square = { 0.0, 1.0, 0.0, 1.0, 0.0, 0.0 };

vtkSmartPointer<vtkEqualMassCells> makeCells(vtkDataSet* sites, vtkImageData* domain)
{
  auto cells = vtkSmartPointer<vtkEqualMassCells>::New();
  cells->SetInputData(sites);
  cells->SetDomainData(domain);
  cells->SetResolution(60);
  cells->SetShapeToPower();
  return cells;
}

double costOf(vtkEqualMassCells* cells, int port)
{
  vtkDataArray* cost = cells->GetOutputDataObject(port)->GetFieldData()->GetArray("TransportCost");
  return cost && cost->GetNumberOfTuples() == 1 ? cost->GetComponent(0, 0) : std::nan("");
}

// The areas within the lines of each site, about axis z; and whether they are loops.
std::vector<double> areasOf(Checks& checks, vtkEqualMassCells* cells)
{
  vtkPolyData* outlines = cells->GetOutlines();
  const std::vector<vtkIdType> ids = labelsOf(outlines);
  CHECK(checks, outlines->GetNumberOfLines() == outlines->GetNumberOfCells());
  CHECK(checks, outlines->GetCellData()->GetScalars() != nullptr);
  CHECK(checks, outlines->GetPoints()->GetDataType() == VTK_DOUBLE);
  const auto count = static_cast<std::size_t>(cells->GetSites()->GetNumberOfPoints());
  std::vector<double> areas(count, 0.0);
  std::vector<vtkIdType> ends(static_cast<std::size_t>(outlines->GetNumberOfPoints()), 0);
  for (vtkIdType i = 0; i < outlines->GetNumberOfCells(); ++i)
  {
    vtkNew<vtkIdList> line;
    outlines->GetCellPoints(i, line);
    CHECK(checks, line->GetNumberOfIds() == 2);
    double a[3];
    double b[3];
    outlines->GetPoint(line->GetId(0), a);
    outlines->GetPoint(line->GetId(1), b);
    ++ends[static_cast<std::size_t>(line->GetId(0))];
    --ends[static_cast<std::size_t>(line->GetId(1))];
    areas.at(static_cast<std::size_t>(ids[static_cast<std::size_t>(i)])) +=
      0.5 * (a[0] * b[1] - a[1] * b[0]);
  }
  CHECK(checks, std::all_of(ends.begin(), ends.end(), [](vtkIdType end) { return end == 0; }));
  return areas;
}

void checkOutputs(Checks& checks)
{
  const std::array<double, 6> box = { 1.0, 4.0, -1.0, 1.0, 0.5, 0.5 };
  auto sites = makeSites(box, 80);
  auto cells = makeCells(sites, makeDomain(box));
  Messages messages(cells);
  const std::vector<vtkIdType> labels = runCells(cells);
  CHECK(checks, labels.size() == 60u * 40);
  const std::vector<double> areas = areasOf(checks, cells);
  const std::vector<double> polygons = areasOfPolygons(checks, cells);
  CHECK(checks, cells->GetPolygons()->GetNumberOfCells() == 80);
  double cost = 0.0;
  for (vtkIdType i = 0; i < 80; ++i)
  {
    CHECK_NEAR(
      checks, polygons[static_cast<std::size_t>(i)], areas[static_cast<std::size_t>(i)], 1e-15);
    const double mass = siteValue(cells, "CellMass", i);
    CHECK_NEAR(checks, mass, 6.0 / 80.0, 1e-6 * 6.0 / 80.0);
    CHECK_NEAR(checks, areas[static_cast<std::size_t>(i)], mass, 1e-11);
    CHECK_NEAR(checks, siteValue(cells, "CellCentroid", i, 2), 0.5, 0.0);
    cost += siteValue(cells, "CellCost", i);
  }
  CHECK_NEAR(checks, costOf(cells, 0), cost, 1e-13);
  CHECK_NEAR(checks, costOf(cells, 1), cost, 1e-13);
  // The labels' pixels have nearly those centroids, and the flow's cells cost more.
  for (const int count : countLabels(labels, 80))
  {
    CHECK_NEAR(checks, count, 30.0, 12.0);
  }
  cells->SetShapeToFlow();
  cells->Update();
  CHECK(checks, costOf(cells, 0) > 1.02 * cost);
  CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());
}

// Where and how the plane lies does not matter.
void checkTurned(Checks& checks)
{
  const std::vector<double> flat = randomCoordinates(square.data(), 30);
  auto plain = makeCells(makePoints(flat), makeDomain(square));
  const std::vector<vtkIdType> expected = runCells(plain);
  auto turned = vtkSmartPointer<vtkImageData>::New();
  turned->SetExtent(5, 8, -2, 1, 7, 7);
  turned->SetSpacing(2.0, 2.0, 3.0);
  turned->SetOrigin(10.0, -4.0, 2.0);
  turned->SetDirectionMatrix(0, 0, 1, 0, -1, 0, 1, 0, 0);
  std::vector<double> moved;
  for (std::size_t i = 0; i < flat.size(); i += 3)
  {
    const double ijk[3] = { 5.0 + 3.0 * flat[i], -2.0 + 3.0 * flat[i + 1], 7.0 };
    double x[3];
    turned->TransformContinuousIndexToPhysicalPoint(ijk, x);
    moved.insert(moved.end(), x, x + 3);
  }
  auto cells = makeCells(makePoints(moved), turned);
  CHECK(checks, runCells(cells) == expected);
  CHECK_NEAR(checks, costOf(cells, 0), 36.0 * costOf(plain, 0), 1e-8);
  const double* bounds = cells->GetOutlines()->GetBounds();
  double domain[6];
  turned->GetBounds(domain);
  for (int i = 0; i < 6; ++i)
  {
    CHECK_NEAR(checks, bounds[i], domain[i], 1e-12);
  }
}

void checkSpecialSites(Checks& checks)
{
  const auto expectShares = [&](vtkEqualMassCells* cells, vtkIdType count, int line) {
    cells->Update();
    const std::vector<double> areas = areasOf(checks, cells);
    for (vtkIdType i = 0; i < count; ++i)
    {
      const double share = 1.0 / static_cast<double>(count);
      checks.Near(areas[static_cast<std::size_t>(i)], share, 2e-6 * share, "area", line);
    }
  };
  auto one = makeCells(makePoints({ 0.2, 0.2, 0 }), makeDomain(square));
  expectShares(one, 1, __LINE__);
  CHECK(checks, one->GetOutlines()->GetNumberOfLines() == 4);
  CHECK_NEAR(checks, costOf(one, 0), 2.0 / 12.0 + 0.18, 1e-12);

  auto twice = makeCells(makePoints({ 0.5, 0.5, 0, 0.5, 0.5, 0 }), makeDomain(square));
  expectShares(twice, 2, __LINE__);
  CHECK_NEAR(checks, costOf(twice, 0), 2.0 / 12.0, 1e-9);

  auto many = makeCells(makeSites(square, 300), makeDomain(square));
  many->SetResolution(5); // fewer pixels than sites
  expectShares(many, 300, __LINE__);
  CHECK(checks, many->GetLabels()->GetNumberOfCells() == 25);

  auto outside =
    makeCells(makePoints({ -3, 0.5, 0, 0.6, 0.5, 2, 0.7, 0.3, 0 }), makeDomain(square));
  Messages messages(outside);
  expectShares(outside, 3, __LINE__);
  CHECK(checks, messages.Warnings.size() == 1);
  CHECK(checks,
    contains(messages.Warnings.front(),
      "2 of 3 sites are outside the domain; their "
      "cells are of least cost"));
  CHECK(checks, siteValue(outside, "CellCost", 1) > 4.0 / 3.0);
  CHECK(checks, outside->GetSites()->GetPoint(0)[0] == -3.0);

  // Its own bounds are the domain.
  auto own = makeCells(makeSites(square, 20), nullptr);
  own->Update();
  const double* bounds = own->GetLabels()->GetBounds();
  CHECK_NEAR(checks, siteValue(own, "CellMass", 3),
    (bounds[1] - bounds[0]) * (bounds[3] - bounds[2]) / 20.0, 1e-8);
}

void checkCache(Checks& checks)
{
  auto sites = makeSites(square, 9);
  auto cells = makeCells(sites, makeDomain(square));
  NewLabels newLabels(cells);
  const auto makes = [&newLabels]() { return newLabels(); };
  CHECK(checks, makes());
  expectAfterEach(checks, makes, false,
    { { "NumberOfSteps", [&]() { cells->SetNumberOfSteps(16); } },
      { "Integrator", [&]() { cells->SetIntegratorToRungeKutta4(); } },
      { "Threading", [&]() { cells->SetThreadingToSerial(); } } },
    __LINE__);
  const auto moveSite = [&]() {
    sites->GetPoints()->SetPoint(2, 0.5, 0.5, 0.0);
    sites->GetPoints()->Modified();
  };
  expectAfterEach(checks, makes, true,
    { { "Shape", [&]() { cells->SetShapeToFlow(); } },
      { "Shape again", [&]() { cells->SetShapeToPower(); } },
      { "Resolution", [&]() { cells->SetResolution(31); } }, { "a site", moveSite },
      { "other sites", [&]() { cells->SetInputData(makeSites(square, 9)); } } },
    __LINE__);
}

void checkRuns(Checks& checks)
{
  auto sites = makeSites(square, 400);
  const auto run = [&](int threading) {
    auto cells = makeCells(sites, makeDomain(square));
    cells->SetThreading(threading);
    const std::vector<vtkIdType> labels = runCells(cells);
    return std::make_pair(
      labels, arrayValues(cells->GetSites()->GetPointData()->GetArray("CellCost")));
  };
  const auto [labels, costs] = expectSameBits(checks, run, __LINE__);
  CHECK(checks, labels.size() == 3600 && costs.size() == 400);

  auto cells = makeCells(sites, makeDomain(square));
  cells->SetResolution(400);
  Messages messages(cells);
  for (const double from : { 0.001, 0.3, 0.91 })
  {
    checkAbort(
      checks, cells, from, [&]() { sites->GetPoints()->Modified(); }, __LINE__);
  }
  ProgressTest progress(cells);
  sites->GetPoints()->Modified();
  CHECK(checks, runCells(cells).size() == 400u * 400);
  progress.ExpectRising(checks, 6, __LINE__);
  CHECK(checks, messages.Errors.empty());
}

void checkErrors(Checks& checks)
{
  const auto fresh = [&]() { return makeCells(makeSites(square, 5), makeDomain(square)); };
  auto cells = fresh();
  CHECK(checks, cells->GetShapeAsString() == std::string("Power"));
  cells->SetNormExponent(4.0);
  ErrorTest(checks, cells)
    .Expect("NormExponent is 4; it must be 2, which Shape Power needs", __LINE__);
  cells = fresh();
  cells->SetCostExponent(1.0);
  ErrorTest(checks, cells)
    .Expect("CostExponent is 1; it must be 2, which Shape Power needs", __LINE__);
  cells = fresh();
  cells->SetShape(2);
  ErrorTest(checks, cells).Expect("Shape is 2; it must be 0 (Flow) or 1 (Power)", __LINE__);
  cells = fresh();
  cells->SetDomainData(makeDomain({ 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 }));
  ErrorTest(checks, cells)
    .Expect("Shape Power needs a domain of two dimensions; this one has 3", __LINE__);
  cells = fresh();
  cells->SetDomainData(makeDomain({ 0.0, 1.0, 0.0, 0.0, 0.0, 0.0 }));
  ErrorTest(checks, cells)
    .Expect("Shape Power needs a domain of two dimensions; this one has 1", __LINE__);
  cells = fresh();
  auto skew = makeDomain(square);
  skew->SetDirectionMatrix(1, 0.5, 0, 0, 1, 0, 0, 0, 1);
  cells->SetDomainData(skew);
  ErrorTest(checks, cells).Expect("axes of the domain are not at right angles", __LINE__);
  cells = fresh();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  cells->SetInputData(makePoints({ 0, 0, 0, nan, 1, 0, 1, 1, 0 }));
  ErrorTest(checks, cells).Expect({ "input point set", "1 point", "index 1" }, __LINE__);
  cells = fresh();
  cells->SetDomainData(makeDomain({ 0.0, 1e155, 0.0, 1e155, 0.0, 0.0 }));
  ErrorTest(checks, cells).Expect({ "area", "largest double" }, __LINE__);
}

} // namespace

int TestCellsPower(int, char*[])
{
  return runChecks(
    { checkOutputs, checkTurned, checkSpecialSites, checkCache, checkRuns, checkErrors });
}
