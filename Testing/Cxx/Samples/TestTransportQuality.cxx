// SPDX-License-Identifier: BSD-3-Clause
// The numbers of vtkTransportQuality, against what is known by hand.
#include "QualityTest.h"

#include "vtkStringArray.h"
#include "vtkStructuredGrid.h"
#include "vtkTransportSampler.h"

#include <array>
#include <limits>
#include <map>

namespace
{

double value(vtkTransportQuality* quality, const char* column)
{
  vtkTable* table = quality->GetOutput();
  return table->GetNumberOfRows() == 1 && table->GetColumnByName(column)
    ? table->GetValueByName(0, column).ToDouble()
    : std::nan("");
}

double measured(vtkTransportQuality* quality, const char* column)
{
  quality->Update();
  return value(quality, column);
}

void addArray(
  vtkPointSet* particles, const char* name, const std::vector<double>& values, int components = 1)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / components);
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  particles->GetPointData()->AddArray(array);
}

double ones(vtkIdType)
{
  return 1.0;
}

// Perfect lattices have a spacing of exactly 1, whatever the units and the rest of the scene.
void checkLattices(Checks& checks)
{
  vtkNew<vtkTransportQuality> quality;
  Messages messages(quality);
  const auto expect = [&](double smallest, double mean, double tolerance, int line) {
    quality->Update();
    checks.Near(value(quality, "SmallestSpacing"), smallest, tolerance, "smallest", line);
    checks.Near(value(quality, "MeanSpacing"), mean, tolerance, "mean", line);
  };
  std::vector<double> row;
  for (int i = 0; i < 20; ++i)
  {
    row.insert(row.end(), { 0.15 + 0.3 * i, 0.0, 0.0 });
  }
  auto line = makeImage(13, 1, 1, true, ones);
  line->SetSpacing(0.5, 1.0, 1.0);
  quality->SetInputData(makePoints(row));
  quality->SetDensityData(line);
  expect(1.0, 1.0, 1e-7, __LINE__);

  // 30 x 20 of distance 2, in a domain of other cells.
  const double high = std::sqrt(3.0);
  std::vector<double> hexagons;
  for (int j = 0; j < 20; ++j)
  {
    for (int i = 0; i < 30; ++i)
    {
      hexagons.insert(hexagons.end(), { 0.5 + 2.0 * i + j % 2, high * (j + 0.5), 0.0 });
    }
  }
  auto plane = makeImage(17, 9, 1, true, ones);
  plane->SetSpacing(60.0 / 16.0, 20.0 * high / 8.0, 1.0);
  quality->SetInputData(makePoints(hexagons));
  quality->SetDensityData(plane);
  expect(1.0, 1.0, 1e-7, __LINE__);
  // A square lattice of one point a cell: sqrt(sqrt(3) / 2).
  std::vector<double> squares;
  for (int i = 0; i < 100; ++i)
  {
    squares.insert(squares.end(), { 0.5 + i % 10, 0.5 + i / 10, 0.0 });
  }
  quality->SetInputData(makePoints(squares));
  quality->SetDensityData(makeImage(11, 11, 1, true, ones));
  expect(0.9306048591, 0.9306048591, 1e-7, __LINE__);

  std::vector<double> cubic;
  for (int k = 0; k < 6; ++k)
  {
    for (int j = 0; j < 6; ++j)
    {
      for (int i = 0; i < 6; ++i)
      {
        if ((i + j + k) % 2 == 0)
        {
          cubic.insert(cubic.end(), { 0.5 + i, 0.5 + j, 0.5 + k });
        }
      }
    }
  }
  quality->SetInputData(makePoints(cubic));
  quality->SetDensityData(makeImage(7, 7, 7, true, ones));
  expect(1.0, 1.0, 1e-7, __LINE__);
  // One out of place is seen in the smallest, and hardly in the mean.
  cubic[0] += 0.4;
  quality->SetInputData(makePoints(cubic));
  quality->Update();
  CHECK(checks, value(quality, "SmallestSpacing") < 0.95);
  CHECK(checks, value(quality, "MeanSpacing") > 0.95);
  CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());
}

// Half of the domain has four times the density: a lattice of half the distance is as good there.
void checkUnevenDensity(Checks& checks)
{
  auto image = makeImage(9, 5, 1, true, [](vtkIdType i) { return i % 8 < 4 ? 4.0 : 1.0; });
  std::vector<double> x;
  for (int i = 0; i < 8; ++i)
  {
    for (int j = 0; j < 8; ++j)
    {
      x.insert(x.end(), { 0.25 + 0.5 * i, 0.25 + 0.5 * j, 0.0 });
      if (i < 4 && j < 4)
      {
        x.insert(x.end(), { 4.5 + i, 0.5 + j, 0.0 });
      }
    }
  }
  vtkNew<vtkTransportQuality> quality;
  quality->SetInputData(makePoints(x));
  quality->SetDensityData(image);
  CHECK_NEAR(checks, measured(quality, "MeanSpacing"), 0.9306048591, 0.02);
  quality->SetBlockSize(1);
  CHECK_NEAR(checks, measured(quality, "DensityError"), 0.0, 1e-12);
}

void checkBlocks(Checks& checks)
{
  // Blocks of 2 x 2, 2 x 1, 1 x 2 and 1 x 1 cells.
  auto image = makeImage(4, 4, 1, true, [](vtkIdType i) { return 1.0 + static_cast<double>(i); });
  const double expected[4] = { 1 + 2 + 4 + 5, 3 + 6, 7 + 8, 9 };
  const double found[4] = { 2, 1, 1, 0 };
  const double measure[4] = { 4, 2, 2, 1 };
  double difference = 0.0;
  double norm = 0.0;
  for (int b = 0; b < 4; ++b)
  {
    const double m = expected[b] / 45.0;
    const double p = found[b] / 5.0; // one of five is outside
    difference += (p - m) * (p - m) / measure[b];
    norm += m * m / measure[b];
  }
  image->SetSpacing(0.5, 4.0, 1.0);
  image->SetOrigin(10.0, 0.0, 0.0);
  auto particles = makePoints({ 10.1, 0.1, 0, 10.9, 7.9, 0, 11.4, 3, 0, 10.2, 11, 0, 12.0, 3, 0 });
  vtkNew<vtkTransportQuality> quality;
  quality->SetInputData(particles);
  quality->SetDensityData(image);
  quality->SetBlockSize(2);
  CHECK_NEAR(checks, measured(quality, "DensityError"), std::sqrt(difference / norm), 1e-12);
  CHECK_NEAR(checks, value(quality, "LargestBlockError"), 1.0, 1e-12); // of the empty block
  CHECK(checks, value(quality, "Particles") == 5);
  CHECK(checks, value(quality, "Outside") == 1);
  CHECK_NEAR(checks, value(quality, "TotalMass"), 90.0, 1e-12);
  CHECK(checks, value(quality, "TransportCost") == 0.0);

  // Masses count as shares, whatever their unit; those of the blocks leave no error.
  auto matching = makePoints({ 10.1, 0.1, 0, 11.4, 3, 0, 10.2, 11, 0, 11.4, 9, 0, 12.0, 3, 0 });
  addArray(matching, "Mass", { 120, 90, 150, 90, 0 });
  quality->SetInputData(matching);
  CHECK_NEAR(checks, measured(quality, "DensityError"), 0.0, 1e-12);
  CHECK_NEAR(checks, value(quality, "LargestBlockError"), 0.0, 1e-12);
  addArray(matching, "Mass", { 60, 90, 150, 120, 30 });
  matching->Modified();
  CHECK_NEAR(checks, measured(quality, "LargestBlockError"), 0.5, 1e-12);
  addArray(particles, "Mass", { 70, 50, 90, 150, 0 });
  quality->SetInputData(particles);
  addArray(particles, "Displacement", { 1, 2, 2, 0, 0, 0, 0, 0, 0, 3, 0, 4, 7, 7, 7 }, 3);
  const double all = 70 + 50 + 90 + 150;
  CHECK_NEAR(checks, measured(quality, "TransportCost"), (70 * 9 + 150 * 25) / all, 1e-12);
}

// Of as many cells as hold 64 particles on average.
void checkUsualBlocks(Checks& checks)
{
  auto image = makeImage(60, 40, 1, true, bumpy);
  std::vector<double> x;
  for (int i = 0; i < 1600; ++i)
  {
    x.insert(x.end(), { std::fmod(7.3 * i, 60.0), std::fmod(3.1 * i, 40.0), 0.0 });
  }
  vtkNew<vtkTransportQuality> quality;
  quality->SetInputData(makePoints(x));
  quality->SetDensityData(image);
  const double usual = measured(quality, "DensityError");
  for (const int size : { 8, 9, 10, 11, 12 })
  {
    quality->SetBlockSize(size);
    CHECK(checks, (measured(quality, "DensityError") == usual) == (size == 10));
  }
}

// The DensityError to expect of particles at random, and of evenly spread ones.
struct ExpectedErrors
{
  double Chance;
  double Uniform;
};

// The variance of a share m of n independent particles is m (1 - m) / n.
ExpectedErrors expectedErrors(vtkImageData* image, int blockSize, int particles)
{
  std::map<std::array<int, 3>, std::pair<double, double>> blocks; // mass and cells
  double all = 0.0;
  int dimensions[3];
  image->GetDimensions(dimensions);
  for (vtkIdType i = 0; i < image->GetNumberOfCells(); ++i)
  {
    const int at = static_cast<int>(i);
    const int nx = std::max(1, dimensions[0] - 1);
    const int ny = std::max(1, dimensions[1] - 1);
    auto& [mass, cells] =
      blocks[{ at % nx / blockSize, at / nx % ny / blockSize, at / nx / ny / blockSize }];
    mass += image->GetCellData()->GetScalars()->GetTuple1(i);
    cells += 1.0;
    all += image->GetCellData()->GetScalars()->GetTuple1(i);
  }
  double variance = 0.0;
  double difference = 0.0;
  double norm = 0.0;
  for (const auto& [place, block] : blocks)
  {
    const double share = block.first / all;
    const double off = block.second / static_cast<double>(image->GetNumberOfCells()) - share;
    variance += share * (1.0 - share) / particles / block.second;
    difference += off * off / block.second;
    norm += share * share / block.second;
  }
  return { std::sqrt(variance / norm), std::sqrt(difference / norm) };
}

// What a sampler makes is good, and its own figures agree.
void checkSampler(Checks& checks, const std::array<int, 3>& points, double spacingOfChance)
{
  const double all = static_cast<double>(points[0]) * points[1] * points[2];
  auto image = makeImage(points[0], points[1], points[2], true, [=](vtkIdType i) {
    return i % 40 < 4 ? 0.0 : bumpy(i) * (1.0 + 9.0 * static_cast<double>(i) / all);
  });
  image->SetSpacing(0.4, 1.5, 0.9);
  constexpr int count = 3000;
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  sampler->SetNumberOfParticles(count);
  vtkNew<vtkTransportQuality> quality;
  quality->SetInputConnection(sampler->GetOutputPort());
  quality->SetDensityData(image);
  quality->SetBlockSize(4);
  quality->Update();
  vtkPolyData* particles = sampler->GetOutput();
  CHECK_NEAR(checks, value(quality, "TotalMass") / fieldValue(particles, "TotalMass"), 1.0, 1e-12);
  CHECK_NEAR(
    checks, value(quality, "TransportCost") / fieldValue(particles, "TransportCost"), 1.0, 1e-12);
  CHECK(checks, value(quality, "Particles") == count);
  CHECK(checks, value(quality, "InEmptyCells") == 0);
  CHECK(checks, value(quality, "Outside") == 0);
  // Blue noise is much better than chance, which gives what it must.
  const auto [chance, uniform] = expectedErrors(image, 4, count);
  const double error = value(quality, "DensityError");
  const double mean = value(quality, "MeanSpacing");
  const double smallest = value(quality, "SmallestSpacing");
  sampler->SetSeedPatternToRandom();
  // A draw varies by about one in the root of twice the blocks, 6 to 7 %; the mean of many does
  // not.
  constexpr int draws = 16;
  double meanOfDraws = 0.0;
  for (int draw = 0; draw < draws; ++draw)
  {
    sampler->SetRandomSeed(draw);
    quality->Update();
    meanOfDraws += value(quality, "DensityError") / chance / draws;
  }
  CHECK_NEAR(checks, meanOfDraws, 1.0, 0.05);
  CHECK_NEAR(checks, value(quality, "MeanSpacing"), spacingOfChance, 0.04);
  const double smallestByChance = value(quality, "SmallestSpacing");
  CHECK_NEAR(checks, smallestByChance, 0.0, 0.06);
  CHECK(checks, error < 0.6 * chance);
  CHECK(checks, mean > spacingOfChance + 0.15 && mean < 1.0);
  CHECK(checks, smallest < mean && (points[1] == 1 || smallest > 2.0 * smallestByChance));
  // The seeds do not follow the density, and as many are where there is no mass as that has cells.
  sampler->SetSeedPatternToBlueNoise();
  sampler->SetFlowTime(0.0);
  quality->Update();
  CHECK_NEAR(checks, value(quality, "DensityError") / uniform, 1.0, 0.1);
  CHECK_NEAR(checks, value(quality, "InEmptyCells") / count, 0.1, 0.01);
}

void checkSampler(Checks& checks)
{
  // Of points at random the nearest other one is 1 / 2 n away on a line of n a unit, 1 / 2 sqrt(n)
  // in a plane and 0.554 / n^(1/3) in a volume; the densest lattices have 1 / n, 1.0746 / sqrt(n)
  // and 1.1225 / n^(1/3).
  checkSampler(checks, { 401, 1, 1 }, 0.5);
  checkSampler(checks, { 61, 41, 1 }, 0.5 / 1.0746);
  checkSampler(checks, { 17, 17, 15 }, 0.554 / 1.1225);
}

void checkOutside(Checks& checks)
{
  auto image = makeImage(5, 4, 1, true, [](vtkIdType i) { return i == 5 ? 0.0 : 1.0; });
  vtkNew<vtkTransportQuality> quality;
  quality->SetDensityData(image);
  // In cell 5, on its border, beyond, above, and off by no more than single precision.
  quality->SetInputData(
    makePoints({ 1.5, 1.5, 0, 2, 1.5, 0, 4.1, 1, 0, 1, 1, 0.5, 4.000001, 0.5, -1e-7 }));
  quality->Update();
  CHECK(checks, value(quality, "Outside") == 2);
  CHECK(checks, value(quality, "InEmptyCells") == 1);
  // One alone has no neighbour.
  quality->SetInputData(makePoints({ 1.5, 1.5, 0 }));
  quality->Update();
  CHECK(checks, value(quality, "SmallestSpacing") == 0.0 && value(quality, "MeanSpacing") == 0.0);
}

void checkErrors(Checks& checks)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  vtkNew<vtkTransportQuality> quality;
  ErrorTest test(checks, quality);
  const auto points = []() { return makePoints({ 1, 1, 0, 2, 2, 0 }); };
  quality->SetInputData(points());
  quality->SetDensityData(makeImage(5, 4, 1, true, bumpy));
  for (const int size : { -1, -8 })
  {
    quality->SetBlockSize(size);
    test.Expect({ "BlockSize is " + std::to_string(size), "at least 1" }, __LINE__);
  }
  quality->SetBlockSize(2147483647);
  CHECK(checks, measured(quality, "DensityError") == 0.0); // one block
  quality->SetBlockSize(8);
  quality->SetThreading(4);
  test.Expect("Threading is 4; it must be 0 (Auto)", __LINE__);
  quality->SetThreadingToAuto();
  quality->SetTables(3);
  test.Expect({ "Tables is 3", "0 (Auto), 1 (Whole) or 2 (Tiled)" }, __LINE__);
  quality->SetTablesToTiled();
  quality->SetDensityData(makeImage(5, 1, 1, true, bumpy));
  test.Expect({ "Tables is Tiled", "two or three axes", "Tables = Whole" }, __LINE__);
  quality->SetTablesToAuto();
  quality->SetDensityData(makeImage(5, 4, 1, true, bumpy));
  const auto withArray = [&](const char* name, const std::vector<double>& values, int components) {
    auto set = points();
    addArray(set, name, values, components);
    quality->SetInputData(set);
  };
  withArray("Mass", { 1, nan }, 1);
  test.Expect({ "'Mass' of the particles has the value nan at index 1", "finite" }, __LINE__);
  withArray("Mass", { -2, 1 }, 1);
  test.Expect({ "'Mass' of the particles has the value -2 at index 0", "not negative" }, __LINE__);
  withArray("Mass", { 0, 0 }, 1);
  test.Expect({ "'Mass' of the particles sums to 0", "positive" }, __LINE__);
  withArray("Mass", { 1, 2, 3, 4 }, 2);
  test.Expect({ "'Mass' of the particles has 2 components", "have 1" }, __LINE__);
  withArray("Mass", { 1, 2, 3 }, 1);
  test.Expect({ "'Mass' of the particles has 3 tuples", "2 particles" }, __LINE__);
  withArray("Displacement", { 1, 2 }, 1);
  test.Expect({ "'Displacement' of the particles has 1 component;", "have 3" }, __LINE__);
  withArray("Displacement", { 1, 2, 3, 4, nan, 6 }, 3);
  test.Expect({ "'Displacement' of the particles has the value nan at index 1" }, __LINE__);
  auto words = points();
  vtkNew<vtkStringArray> text;
  text->SetName("Mass");
  text->SetNumberOfValues(2);
  words->GetPointData()->AddArray(text);
  quality->SetInputData(words);
  test.Expect({ "'Mass' of the particles is not numeric" }, __LINE__);
  quality->SetInputData(makePoints({ 3, 2, 0, 1, nan, 0 }));
  test.Expect({ "input point set has 1 point that is NaN", "first at index 1" }, __LINE__);
  quality->SetInputData(points());
  quality->SetDensityData(
    makeImage(5, 4, 1, true, [](vtkIdType i) { return 1.0 - static_cast<double>(i); }));
  test.Expect({ "'Density' has 10 negative values" }, __LINE__);
  quality->SetDensityData(makeImage(1, 1, 1, false, bumpy));
  test.Expect({ "one point along every axis" }, __LINE__);
  quality->SetInputArrayToProcess(0, 1, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Missing");
  quality->SetDensityData(makeImage(5, 4, 1, true, bumpy));
  test.Expect({ "no density array 'Missing'" }, __LINE__);

  // Nothing there is no error.
  quality->SetInputArrayToProcess(0, 1, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Density");
  vtkNew<vtkStructuredGrid> nothing;
  quality->SetInputData(nothing);
  test.ExpectNone(__LINE__);
  CHECK(checks, quality->GetOutput()->GetNumberOfRows() == 0);
  quality->SetInputData(points());
  vtkNew<vtkImageData> empty;
  quality->SetDensityData(empty);
  test.ExpectNone(__LINE__);
  CHECK(checks, quality->GetOutput()->GetNumberOfRows() == 0);
}

} // namespace

int TestTransportQuality(int, char*[])
{
  return runChecks({ checkLattices, checkUnevenDensity, checkBlocks, checkUsualBlocks, checkSampler,
    checkOutside, checkErrors });
}
