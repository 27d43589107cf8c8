// SPDX-License-Identifier: BSD-3-Clause
// Numbers of cells where sides are no whole multiples of each other: pixels as near to cubes as
// whole numbers allow (Equal Mass Cells), as many cubes as cover a solid (Solid Density).
#include "CellsTest.h"
#include "SolidTest.h"

namespace
{

// The pixels along the axes of a domain of these lengths, 0 where there is no axis.
std::array<int, 3> pixelsOf(const std::array<double, 3>& lengths, int resolution)
{
  const std::array<double, 6> box{ -2.0, lengths[0] - 2.0, 5.0, lengths[1] + 5.0, 0.0, lengths[2] };
  vtkNew<vtkEqualMassCells> cells;
  cells->SetDomainData(makeDomain(box));
  cells->SetInputData(makeSites(box, 1));
  cells->SetResolution(resolution);
  cells->Update();
  int dimensions[3];
  cells->GetLabels()->GetDimensions(dimensions);
  return { dimensions[0] - 1, dimensions[1] - 1, dimensions[2] - 1 };
}

// At least one pixel across a narrow domain, however many cells that has there.
void checkNarrow(Checks& checks)
{
  auto domain = makeImage(51, 8, 1, true, bumpy);
  domain->SetSpacing(1.0, 1e-3, 1.0);
  vtkNew<vtkEqualMassCells> cells;
  cells->SetDomainData(domain);
  cells->SetInputData(makePoints({ 1, 0, 0, 40, 0.003, 0 }));
  cells->SetResolution(20);
  cells->Update();
  const int* dimensions = cells->GetLabels()->GetDimensions();
  CHECK(checks, dimensions[0] == 21 && dimensions[1] == 2 && dimensions[2] == 1);
  CHECK_NEAR(checks, cells->GetLabels()->GetBounds()[3], 7e-3, 1e-12);
}

void checkPixels(Checks& checks)
{
  using Pixels = std::array<int, 3>;
  CHECK(checks, (pixelsOf({ 1.0, 0.26, 0.0 }, 10) == Pixels{ 10, 3, 0 }));
  CHECK(checks, (pixelsOf({ 1.0, 0.24, 0.0 }, 10) == Pixels{ 10, 2, 0 }));
  CHECK(checks, (pixelsOf({ 0.349, 1.0, 0.0 }, 10) == Pixels{ 3, 10, 0 }));
  CHECK(checks, (pixelsOf({ 0.351, 1.0, 0.96 }, 10) == Pixels{ 4, 10, 10 }));
  // At least one.
  CHECK(checks, (pixelsOf({ 1.0, 0.001, 0.0 }, 10) == Pixels{ 10, 1, 0 }));
  CHECK(checks, (pixelsOf({ 1.0, 0.001, 0.5 }, 1) == Pixels{ 1, 1, 1 }));
  const std::array<double, 6> range{ 0.03, 3.0, 0.03, 3.0, 0.03, 3.0 };
  const std::vector<double> lengths = randomCoordinates(range.data(), 40);
  for (std::size_t i = 0; i < lengths.size(); i += 3)
  {
    const std::array<double, 3> sides{ lengths[i], lengths[i + 1], lengths[i + 2] };
    const double longest = std::max({ sides[0], sides[1], sides[2] });
    const Pixels pixels = pixelsOf(sides, 23);
    for (std::size_t a = 0; a < 3; ++a)
    {
      const double wanted = std::max(1.0, 23.0 * sides[a] / longest);
      CHECK_NEAR(checks, pixels[a], wanted, 0.5);
    }
  }
}

// The cubes around a box of tenths, of which rounding makes a little more or less.
void checkCubes(Checks& checks)
{
  vtkNew<vtkSolidDensity> solid;
  solid->SetAssociationToCells();
  solid->SetPadding(0.0);
  const auto cubesOf = [&](double low, double y, double z) {
    solid->SetInputData(makeBox(low, low + 1.0, low, low + y, -low, z - low));
    solid->SetResolution(10);
    solid->Update();
    const int* dimensions = solid->GetOutput()->GetDimensions();
    return std::array<int, 3>{ dimensions[0] - 1, dimensions[1] - 1, dimensions[2] - 1 };
  };
  for (const double low : { 0.0, 0.1, 0.7, -3.3 })
  {
    for (int tenths = 1; tenths <= 10; ++tenths)
    {
      const double y = 0.1 * tenths;
      const double z = 1.1 - 0.1 * tenths;
      CHECK(checks, (cubesOf(low, y, z) == std::array<int, 3>{ 10, tenths, 11 - tenths }));
      // More by a thousandth of a cell than rounding explains, and less.
      const int more = std::min(tenths + 1, 10);
      const double off = tenths < 10 ? 1e-4 : 0.0;
      CHECK(checks, cubesOf(low, y + off, 1.0)[1] == more);
      CHECK(checks, cubesOf(low, y + 1e-3 * off, 1.0)[1] == more);
      CHECK(checks, cubesOf(low, y - 1e-4, 1.0)[1] == tenths);
    }
  }
}

// A margin that makes whole cells of the sides, too.
void checkPadding(Checks& checks)
{
  vtkNew<vtkSolidDensity> solid;
  solid->SetAssociationToCells();
  for (const double unit : { 1.0, 0.1, 1.0 / 3.0, 1e-7 })
  {
    // 4 x 2 x 1 units with half a unit on each side, in cells of half a unit.
    solid->SetInputData(makeBox(unit, 5 * unit, 0, 2 * unit, -unit, 0));
    solid->SetPadding(0.125);
    solid->SetResolution(10);
    solid->Update();
    const int* dimensions = solid->GetOutput()->GetDimensions();
    CHECK(checks, dimensions[0] == 11 && dimensions[1] == 7 && dimensions[2] == 5);
    CHECK_NEAR(checks, massOf(solid) / (8.0 * unit * unit * unit), 1.0, 1e-9);
  }
}

} // namespace

int TestGridRounding(int, char*[])
{
  return runChecks({ checkPixels, checkNarrow, checkCubes, checkPadding });
}
