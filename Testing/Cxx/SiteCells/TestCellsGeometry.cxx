// SPDX-License-Identifier: BSD-3-Clause
// Domains of vtkEqualMassCells: of one to three dimensions, turned, from the sites alone; and sites
// that are alone, double or outside.
#include "CellsTest.h"

#include "vtkMath.h"

namespace
{

// The labels of sites in a square do not depend on where the square lies and how it is turned.
void checkTurned(Checks& checks)
{
  const std::array<double, 6> unit = { 0.0, 1.0, 0.0, 0.75, 0.0, 0.0 };
  const std::vector<double> flat = randomCoordinates(unit.data(), 12);
  vtkNew<vtkEqualMassCells> cells;
  cells->SetResolution(40);
  cells->SetInputData(makePoints(flat));
  cells->SetDomainData(makeDomain(unit));
  const std::vector<vtkIdType> expected = runCells(cells);
  CHECK(checks, expected.size() == 40u * 30);

  // In the yz plane, the image's x and y along z and -y, three by three cells from index 5 on.
  auto turned = vtkSmartPointer<vtkImageData>::New();
  turned->SetExtent(5, 8, -2, 1, 7, 7);
  turned->SetSpacing(2.0 / 3.0, 0.5, 3.0);
  turned->SetOrigin(10.0, -4.0, 2.0);
  turned->SetDirectionMatrix(0, 0, 1, 0, -1, 0, 1, 0, 0);
  std::vector<double> moved;
  for (std::size_t i = 0; i < flat.size(); i += 3)
  {
    const double ijk[3] = { 5.0 + 3.0 * flat[i], -2.0 + 3.0 * flat[i + 1] / 0.75, 7.0 };
    double x[3];
    turned->TransformContinuousIndexToPhysicalPoint(ijk, x);
    moved.insert(moved.end(), x, x + 3);
  }
  cells->SetDomainData(turned);
  cells->SetInputData(makePoints(moved));
  Messages messages(cells);
  CHECK(checks, runCells(cells) == expected);
  CHECK(checks, messages.Warnings.empty());
  const double* given = turned->GetBounds();
  double expectedBounds[6];
  std::copy_n(given, 6, expectedBounds);
  const double* bounds = cells->GetLabels()->GetBounds();
  const double* drawn = cells->GetOutlines()->GetBounds();
  for (int i = 0; i < 6; ++i)
  {
    CHECK_NEAR(checks, bounds[i], expectedBounds[i], 1e-12);
    CHECK_NEAR(checks, drawn[i], expectedBounds[i], 1e-12);
  }
  CHECK_NEAR(checks, siteValue(cells, "CellMass", 0), 3.0 / 12.0, 1e-12);
  // The values and the resolution of a domain do not count, only its box.
  auto fine = makeImage(9, 7, 1, true, bumpy);
  fine->SetSpacing(0.125, 0.125, 1.0);
  cells->SetDomainData(fine);
  cells->SetInputData(makePoints(flat));
  CHECK(checks, runCells(cells) == expected);
  // That of values on points is half a spacing larger on each side.
  auto dual = makeImage(8, 6, 1, false, bumpy);
  dual->SetSpacing(0.125, 0.125, 1.0);
  dual->SetOrigin(0.0625, 0.0625, 0.0);
  cells->SetDomainData(dual);
  CHECK(checks, runCells(cells) == expected);
}

void checkVolume(Checks& checks, bool mirrored)
{
  const std::array<double, 6> box = { 0.0, 2.0, 0.0, 1.0, -1.0, 0.0 };
  vtkNew<vtkEqualMassCells> cells;
  cells->SetInputData(makeSites(box, 16));
  auto domain = makeDomain(box);
  if (mirrored)
  {
    domain->SetOrigin(2.0, 0.0, -1.0);
    domain->SetSpacing(-2.0, 1.0, 1.0);
  }
  cells->SetDomainData(domain);
  cells->SetResolution(24);
  const std::vector<vtkIdType> labels = runCells(cells);
  CHECK(checks, labels.size() == 24u * 12 * 12);
  for (const int count : countLabels(labels, 16))
  {
    CHECK(checks, count == 24 * 12 * 12 / 16);
  }
  // Each cell's faces look outwards and enclose its volume.
  vtkPolyData* outlines = cells->GetOutlines();
  CHECK(checks, outlines->GetNumberOfPolys() == outlines->GetNumberOfCells());
  std::vector<double> volumes(16);
  for (vtkIdType i = 0; i < outlines->GetNumberOfCells(); ++i)
  {
    vtkNew<vtkIdList> face;
    outlines->GetCellPoints(i, face);
    CHECK(checks, face->GetNumberOfIds() == 4);
    double x[4][3];
    for (vtkIdType k = 0; k < 4; ++k)
    {
      outlines->GetPoint(face->GetId(k), x[k]);
    }
    double a[3];
    double b[3];
    double normal[3];
    vtkMath::Subtract(x[1], x[0], a);
    vtkMath::Subtract(x[3], x[0], b);
    vtkMath::Cross(a, b, normal);
    const auto label =
      static_cast<std::size_t>(outlines->GetCellData()->GetScalars()->GetTuple1(i));
    volumes[label] += vtkMath::Dot(x[0], normal) / 3.0;
  }
  for (const double volume : volumes)
  {
    CHECK_NEAR(checks, volume, 2.0 / 16.0, 1e-12);
  }
  CHECK_NEAR(checks, siteValue(cells, "CellMass", 3), 2.0 / 16.0, 1e-12);
}

void checkLine(Checks& checks)
{
  vtkNew<vtkEqualMassCells> cells;
  cells->SetDomainData(makeDomain({ 0.0, 0.0, 0.0, 10.0, 0.0, 0.0 }));
  cells->SetInputData(makePoints({ 0, 9, 0, 0, 1, 0, 0, 4, 0, 0, 4.2, 0 }));
  cells->SetResolution(100);
  const std::vector<vtkIdType> labels = runCells(cells);
  CHECK(checks, labels.size() == 100);
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    const vtkIdType order[] = { 1, 2, 3, 0 };
    CHECK(checks, labels[i] == order[i / 25]);
  }
  CHECK(checks, cells->GetOutlines()->GetNumberOfVerts() == 8);
  CHECK_NEAR(checks, siteValue(cells, "CellCentroid", 1, 1), 1.25, 1e-12);
  CHECK_NEAR(checks, siteValue(cells, "CellMass", 1), 2.5, 1e-12);
}

// Costs of lengths whose squares pass the range of numbers.
void checkUnits(Checks& checks)
{
  vtkNew<vtkEqualMassCells> cells;
  cells->SetCostExponent(1.0);
  cells->SetResolution(100);
  for (const double unit : { 1.0, 1e-170, 1e200 })
  {
    cells->SetInputData(makePoints({ 0, 0, 0, 2.0 * unit, 0, 0, 3.0 * unit, 0, 0 }));
    Messages messages(cells);
    CHECK_NEAR(checks, countLabels(runCells(cells), 3)[1], 33.5, 0.5);
    CHECK(checks, messages.Errors.empty());
    vtkDataArray* cost = cells->GetLabels()->GetFieldData()->GetArray("TransportCost");
    CHECK_NEAR(checks, cost ? cost->GetComponent(0, 0) / unit : 0.0, 0.4477, 0.005);
  }
}

// Without a domain it is the bounds of the sites, a tenth longer.
void checkOwnBounds(Checks& checks)
{
  vtkNew<vtkEqualMassCells> cells;
  cells->SetInputData(makePoints({ 0, 0, 3, 10, 0, 3, 0, 20, 3, 10, 20, 3, 5, 1, 3 }));
  cells->SetResolution(44);
  const std::vector<vtkIdType> labels = runCells(cells);
  CHECK(checks, labels.size() == 44u * 22);
  const double* bounds = cells->GetLabels()->GetBounds();
  const double expected[] = { -0.5, 10.5, -1.0, 21.0, 3.0, 3.0 };
  for (int i = 0; i < 6; ++i)
  {
    CHECK_NEAR(checks, bounds[i], expected[i], 1e-12);
  }
  // A second update does nothing, although the extent was a guess before the first.
  const vtkMTimeType before = cells->GetLabels()->GetMTime();
  cells->Update();
  CHECK(checks, cells->GetLabels()->GetMTime() == before);
}

void checkOneSite(Checks& checks)
{
  vtkNew<vtkEqualMassCells> cells;
  Messages messages(cells);
  cells->SetDomainData(makeDomain({ 0.0, 2.0, 0.0, 1.0, 0.0, 0.0 }));
  cells->SetInputData(makePoints({ 0.5, 0.5, 0 }));
  cells->SetResolution(10);
  CHECK(checks, runCells(cells) == std::vector<vtkIdType>(50, 0));
  CHECK_NEAR(checks, siteValue(cells, "CellMass", 0), 2.0, 1e-12);
  CHECK_NEAR(checks, siteValue(cells, "CellCentroid", 0), 1.0, 1e-12);
  CHECK(checks, cells->GetOutlines()->GetNumberOfCells() == 30);
  CHECK(checks, messages.Errors.empty());
}

// A site for every pixel has that pixel; for one site more there is none.
void checkSiteForEachPixel(Checks& checks)
{
  vtkNew<vtkEqualMassCells> cells;
  Messages messages(cells);
  cells->SetDomainData(makeDomain({ 0.0, 4.0, 0.0, 3.0, 0.0, 0.0 }));
  cells->SetResolution(4);
  std::vector<double> x;
  std::vector<vtkIdType> expected;
  for (int i = 0; i < 12; ++i)
  {
    x.insert(x.end(), { 0.5 + i % 4, 0.5 + i / 4, 0.0 });
    expected.push_back(i);
  }
  cells->SetInputData(makePoints(x));
  CHECK(checks, runCells(cells) == expected);
  CHECK_NEAR(checks, siteValue(cells, "CellCost", 7), 0.0, 1e-15);
  CHECK_NEAR(checks, siteValue(cells, "CellMass", 7), 1.0, 1e-15);
  CHECK(checks, messages.Errors.empty());
  x.insert(x.end(), { 1.1, 1.1, 0.0 });
  cells->SetInputData(makePoints(x));
  cells->Update();
  CHECK(checks, messages.IsOneError("13 sites for 4 x 3 pixels"));
  CHECK(checks, cells->GetLabels()->GetNumberOfPoints() == 0);
}

// Sites in one pixel share the mass of one cell, to the last bit, and its pixels but for one.
void checkDoubleSites(Checks& checks)
{
  vtkNew<vtkEqualMassCells> cells;
  Messages messages(cells);
  cells->SetDomainData(makeDomain({ 0.0, 1.0, 0.0, 1.0, 0.0, 0.0 }));
  cells->SetInputData(
    makePoints({ 0.201, 0.3, 0, 0.7, 0.8, 0, 0.201, 0.3, 0, 0.202, 0.3, 0, 0.5, 0.1, 0 }));
  cells->SetResolution(33);
  const std::vector<int> counts = countLabels(runCells(cells), 5); // 217.8 each
  for (const int count : counts)
  {
    CHECK_NEAR(checks, count, 217.8, 1.0);
  }
  const double mass = siteValue(cells, "CellMass", 0);
  CHECK(checks, siteValue(cells, "CellMass", 2) == mass);
  CHECK(checks, siteValue(cells, "CellMass", 3) == mass);
  CHECK_NEAR(checks, 3.0 * mass * 1089, counts[0] + counts[2] + counts[3], 1e-9);
  // All at one point is a case of this.
  cells->SetInputData(makePoints({ 0.5, 0.5, 0, 0.5, 0.5, 0 }));
  CHECK_NEAR(checks, countLabels(runCells(cells), 2)[0], 544.5, 0.5);
  CHECK(checks, siteValue(cells, "CellMass", 1) == 0.5);
  CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());
}

// Sites outside count as the nearest points of the border, and are where they were.
void checkOutside(Checks& checks)
{
  const std::array<double, 6> unit = { 0.0, 1.0, 0.0, 1.0, 0.0, 0.0 };
  vtkNew<vtkEqualMassCells> cells;
  Messages messages(cells);
  cells->SetDomainData(makeDomain(unit));
  cells->SetResolution(32);
  cells->SetInputData(makePoints({ 0, 0.5, 0, 0.6, 1, 0, 0.7, 0.3, 0 }));
  const std::vector<vtkIdType> inside = runCells(cells);
  CHECK(checks, messages.Warnings.empty());
  cells->SetInputData(makePoints({ -3, 0.5, 0, 0.6, 1.5, 0, 0.7, 0.3, 2 }));
  CHECK(checks, runCells(cells) == inside);
  CHECK(checks, messages.Warnings.size() == 1);
  CHECK(checks, contains(messages.Warnings.front(), "3 of 3 sites are outside the domain"));
  CHECK(checks, cells->GetSites()->GetPoint(0)[0] == -3.0);
  CHECK(checks, siteValue(cells, "CellCost", 2) > 4.0 / 3.0); // two below the plane, a third
  // However far away they are, the middles of their cells are those of the pixels.
  std::vector<double> middles;
  for (vtkIdType site = 0; site < 3; ++site)
  {
    middles.push_back(siteValue(cells, "CellCentroid", site, 0));
    middles.push_back(siteValue(cells, "CellCentroid", site, 1));
    CHECK(checks, siteValue(cells, "CellCentroid", site, 2) == 0.0);
  }
  cells->SetInputData(makePoints({ -3e17, 0.5, 0, 0.6, 1e20, 0, 0.7, 0.3, 2e17 }));
  CHECK(checks, runCells(cells) == inside);
  for (vtkIdType site = 0; site < 3; ++site)
  {
    const double* middle = middles.data() + 2 * site;
    CHECK_NEAR(checks, siteValue(cells, "CellCentroid", site, 0), middle[0], 1e-14);
    CHECK_NEAR(checks, siteValue(cells, "CellCentroid", site, 1), middle[1], 1e-14);
    CHECK(checks, siteValue(cells, "CellCentroid", site, 2) == 0.0);
  }
}

} // namespace

int TestCellsGeometry(int, char*[])
{
  Checks checks;
  checkTurned(checks);
  checkVolume(checks, false);
  checkVolume(checks, true);
  checkLine(checks);
  checkUnits(checks);
  checkOwnBounds(checks);
  checkOneSite(checks);
  checkSiteForEachPixel(checks);
  checkDoubleSites(checks);
  checkOutside(checks);
  return checks.Result();
}
