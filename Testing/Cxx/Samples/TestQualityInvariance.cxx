// SPDX-License-Identifier: BSD-3-Clause
// What vtkTransportQuality measures is of particles and of a density in space: it does not depend
// on the cells that hold the density, nor on units, place and order.
#include "BlendTest.h"
#include "WarpTest.h"

#include "vtkTable.h"
#include "vtkTransportQuality.h"
#include "vtkVariant.h"

#include <map>

namespace
{

using Row = std::map<std::string, double>;

Row rowOf(vtkPolyData* particles, vtkImageData* density, int blockSize = 4)
{
  vtkNew<vtkTransportQuality> quality;
  quality->SetInputData(particles);
  quality->SetDensityData(density);
  quality->SetBlockSize(blockSize);
  quality->Update();
  vtkTable* table = quality->GetOutput();
  Row row;
  for (vtkIdType i = 0; i < table->GetNumberOfColumns(); ++i)
  {
    row[table->GetColumnName(i)] = table->GetValue(0, i).ToDouble();
  }
  return row;
}

void checkSame(
  Checks& checks, Row found, Row expected, const std::vector<std::string>& columns, int line)
{
  checks.That(expected.size() == 9, "nine columns", line);
  for (const std::string& name : columns)
  {
    checks.Near(
      found[name], expected[name], 1e-9 * (1.0 + std::abs(expected[name])), name.c_str(), line);
  }
}

const std::vector<std::string> ofSpace{ "Particles", "TotalMass", "InEmptyCells", "Outside",
  "TransportCost", "SmallestSpacing", "MeanSpacing" };

// Cells of a density that are no cubes, some of them empty.
double uneven(vtkIdType i)
{
  return i % 6 == 5 ? 0.0 : bumpy(i) * bumpy(i);
}

// The same density on a grid with more cells along some axes.
vtkSmartPointer<vtkImageData> refine(vtkImageData* coarse, const Counts& cells, const Counts& by)
{
  const auto fineCells = [&](std::size_t a) { return cells[a] * by[a]; };
  auto fine = makeDensity({ fineCells(0), fineCells(1), fineCells(2) }, true, [&](vtkIdType i) {
    const int at = static_cast<int>(i);
    const int x = at % fineCells(0) / by[0];
    const int y = at / fineCells(0) % fineCells(1) / by[1];
    const int z = at / fineCells(0) / fineCells(1) / by[2];
    return coarse->GetCellData()->GetScalars()->GetTuple1(x + cells[0] * (y + cells[1] * z));
  });
  const double* spacing = coarse->GetSpacing();
  fine->SetSpacing(spacing[0] / by[0], spacing[1] / by[1], spacing[2] / by[2]);
  fine->SetOrigin(coarse->GetOrigin());
  return fine;
}

void checkRefined(Checks& checks, const Counts& cells)
{
  auto density = makeDensity(cells, true, uneven);
  density->SetSpacing(0.5, 1.25, 0.8);
  density->SetOrigin(-1.0, 2.0, 3.0);
  double bounds[6];
  density->GetBounds(bounds);
  auto particles = makePoints(randomCoordinates(bounds, 700));
  const Row expected = rowOf(particles, density);
  CHECK(checks, expected.at("InEmptyCells") > 0 && expected.at("MeanSpacing") > 0.1);
  const int last = cells[2] > 1 ? 3 : 1;
  for (const Counts& by : { Counts{ 4, 1, 1 }, Counts{ 1, 5, 1 }, Counts{ 2, 3, last } })
  {
    checkSame(checks, rowOf(particles, refine(density, cells, by)), expected, ofSpace, __LINE__);
  }
  // Blocks of the same place and size are compared, too.
  std::vector<std::string> all = ofSpace;
  all.insert(all.end(), { "DensityError", "LargestBlockError" });
  const Row fine = rowOf(particles, refine(density, cells, { 2, 2, cells[2] > 1 ? 2 : 1 }), 8);
  checkSame(checks, fine, expected, all, __LINE__);
}

// Other units and another place; particles in another order, with their masses.
void checkUnits(Checks& checks)
{
  const Counts cells{ 12, 10, 1 };
  auto density = makeDensity(cells, true, uneven);
  const double bounds[6] = { -1, 12, 0, 10, 0, 0 };
  const std::vector<double> x = randomCoordinates(bounds, 300);
  const auto particlesOf = [&](double unit, bool backwards) {
    std::vector<double> places(x.size());
    vtkNew<vtkDoubleArray> masses;
    masses->SetName("Mass");
    vtkNew<vtkDoubleArray> ways;
    ways->SetName("Displacement");
    ways->SetNumberOfComponents(3);
    for (std::size_t i = 0; i < 300; ++i)
    {
      const std::size_t from = backwards ? 299 - i : i;
      for (std::size_t a = 0; a < 3; ++a)
      {
        places[3 * i + a] = unit * (x[3 * from + a] + 7.0);
      }
      masses->InsertNextValue(bumpy(static_cast<vtkIdType>(from)));
      ways->InsertNextTuple3(unit * bumpy(static_cast<vtkIdType>(from)), 0.0, unit);
    }
    auto particles = makePoints(places);
    particles->GetPointData()->AddArray(masses);
    particles->GetPointData()->AddArray(ways);
    return particles;
  };
  const auto place = [&](double unit) {
    density->SetSpacing(unit, unit, unit);
    density->SetOrigin(7.0 * unit, 7.0 * unit, 7.0 * unit);
  };
  place(1.0);
  Row expected = rowOf(particlesOf(1.0, false), density);
  CHECK(checks, expected["Outside"] > 5 && expected["TransportCost"] > 1.0);
  std::vector<std::string> all = ofSpace;
  all.insert(all.end(), { "DensityError", "LargestBlockError" });
  checkSame(checks, rowOf(particlesOf(1.0, true), density), expected, all, __LINE__);
  for (const double unit : { 0.0009765625, 1024.0 })
  {
    place(unit);
    Row wanted = expected;
    wanted["TotalMass"] *= unit * unit;
    wanted["TransportCost"] *= unit * unit;
    checkSame(checks, rowOf(particlesOf(unit, false), density), wanted, all, __LINE__);
  }
}

// A particle on the upper border is in the last block, as one just before it.
void checkBorder(Checks& checks)
{
  auto density = makeDensity({ 8, 12, 1 }, true, bumpy);
  const Row before =
    rowOf(makePoints({ 7.99, 1, 0, 3, 11.99, 0, 7.99, 11.99, 0, 2, 5, 0 }), density);
  const Row on = rowOf(makePoints({ 8, 1, 0, 3, 12, 0, 8, 12, 0, 2, 5, 0 }), density);
  checkSame(checks, on, before, { "DensityError", "LargestBlockError", "Outside", "InEmptyCells" },
    __LINE__);
  CHECK(checks, on.at("Outside") == 0.0);
}

// Spacings are those of particles in the domain that have a mass, from any other particle.
void checkSpacing(Checks& checks)
{
  auto density = makeDensity({ 10, 10, 1 }, true, [](vtkIdType) { return 3.0; });
  // Two with a quarter of the mass each, one without, and half of it outside.
  auto particles = makePoints({ 4, 5, 0, 6, 5, 0, 4, 6, 0, 13, 5, 0 });
  vtkNew<vtkDoubleArray> masses;
  masses->SetName("Mass");
  for (const double mass : { 1.0, 1.0, 0.0, 2.0 })
  {
    masses->InsertNextValue(mass);
  }
  particles->GetPointData()->AddArray(masses);
  const Row row = rowOf(particles, density);
  const double room = std::sqrt(2.0 / std::sqrt(3.0) * 25.0);
  CHECK(checks, row.at("Outside") == 1.0);
  CHECK_NEAR(checks, row.at("SmallestSpacing"), 1.0 / room, 1e-9);
  CHECK_NEAR(checks, row.at("MeanSpacing"), 1.5 / room, 1e-9);
}

} // namespace

int TestQualityInvariance(int, char*[])
{
  Checks checks;
  checkRefined(checks, { 12, 10, 1 });
  checkRefined(checks, { 8, 6, 5 });
  checkUnits(checks);
  checkBorder(checks);
  checkSpacing(checks);
  return checks.Result();
}
