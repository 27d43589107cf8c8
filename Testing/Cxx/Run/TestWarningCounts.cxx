// SPDX-License-Identifier: BSD-3-Clause
// Warnings that count: none, one and several; what counts as outside; which particles of all had to
// be put into cells with mass; and from which part of all on there is a warning.
#include "BlendTest.h"
#include "CellsTest.h"

#include "vtkBlueNoiseRelaxation.h"
#include "vtkMassSplatter.h"

#include <set>

namespace
{

// Updates: the warnings that were given, but those of folds, which TestMapFolds and TestWarpFolds
// check.
std::vector<std::string> warningsOf(vtkAlgorithm* algorithm)
{
  Messages messages(algorithm);
  algorithm->Modified();
  algorithm->Update();
  std::vector<std::string> warnings = messages.Errors.empty() ? messages.Warnings : messages.Errors;
  warnings.erase(
    std::remove_if(warnings.begin(), warnings.end(),
      [](const std::string& text) { return text.find(" folded: ") != std::string::npos; }),
    warnings.end());
  return warnings;
}

// The number that stands before a text in the only warning; 0 if there is no warning.
int countOf(vtkAlgorithm* algorithm, const std::string& text)
{
  const std::vector<std::string> warnings = warningsOf(algorithm);
  if (warnings.empty())
  {
    return 0;
  }
  const std::size_t end = warnings[0].find(text);
  if (warnings.size() > 1 || end == std::string::npos)
  {
    return -1;
  }
  const std::size_t begin = warnings[0].find_last_not_of("0123456789", end - 1) + 1;
  return begin < end ? std::stoi(warnings[0].substr(begin, end - begin)) : -1;
}

using SetPoints = std::function<void(vtkPolyData*)>;

// A density on [0,4] x [0,3] units, z = 0, whose diagonal is 5 units.
vtkSmartPointer<vtkImageData> makeSmall(double unit)
{
  auto image = makeImage(5, 4, 1, true, bumpy);
  image->SetSpacing(unit, unit, unit);
  return image;
}

void checkOutside(Checks& checks, vtkAlgorithm* algorithm, const SetPoints& give, const char* what,
  double unit = 1.0)
{
  const std::vector<double> inside{ 1, 1, 0, 3, 2, 0, 0, 3, 0, 4, 0.5, 0 };
  const auto count = [&](const std::vector<double>& others) {
    std::vector<double> all = inside;
    all.insert(all.begin() + 3, others.begin(), others.end());
    std::for_each(all.begin(), all.end(), [=](double& x) { x *= unit; });
    give(makePoints(all));
    return countOf(algorithm, " of " + std::to_string(all.size() / 3) + " " + what);
  };
  const auto expect = [&](const std::vector<double>& others, int wanted, int line) {
    const int found = count(others);
    checks.That(found == wanted, what, line, std::to_string(found));
  };
  expect({}, 0, __LINE__);
  expect({ -1, 1, 0 }, 1, __LINE__);
  expect({ 1, 3.5, 0 }, 1, __LINE__);
  expect({ 2, 2, -0.5 }, 1, __LINE__); // below the plane
  expect({ -1, 1, 0, 2, 2, 0, 9, 9, 9 }, 2, __LINE__);
  expect({ -1, 1, 0, 2, 2, 7, 9, 9, 9 }, 3, __LINE__);
  // By no more than single precision misses a border, and by more.
  expect({ 4.000001, 1, 0, 2, -1e-6, 0 }, 0, __LINE__);
  expect({ 4.0001, 1, 0 }, 1, __LINE__);
  expect({ -1e-4, 1, 0 }, 1, __LINE__);
  expect({ 1, -1e-4, 0 }, 1, __LINE__);
}

void checkSeeds(Checks& checks, double unit)
{
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(makeSmall(unit));
  checkOutside(
    checks, sampler, [&](vtkPolyData* seeds) { sampler->SetSeedsData(seeds); }, "seeds outside",
    unit);
}

void checkRelaxation(Checks& checks, double unit)
{
  vtkNew<vtkBlueNoiseRelaxation> relaxation;
  relaxation->SetDensityData(makeSmall(unit));
  relaxation->SetMaximumIterations(1);
  for (int method = 0; method < 2; ++method)
  {
    relaxation->SetMethod(method);
    checkOutside(
      checks, relaxation, [&](vtkPolyData* points) { relaxation->SetInputData(points); },
      "points outside", unit);
  }
}

void checkSites(Checks& checks, double unit)
{
  vtkNew<vtkEqualMassCells> cells;
  cells->SetDomainData(makeDomain({ 0.0, 4.0 * unit, 0.0, 3.0 * unit, 0.0, 0.0 }));
  cells->SetResolution(16);
  checkOutside(
    checks, cells, [&](vtkPolyData* sites) { cells->SetInputData(sites); }, "sites ", unit);
}

void checkWarp(Checks& checks)
{
  vtkNew<vtkDensityEqualizingWarp> warp;
  warp->SetDensityData(makeSmall(1.0));
  const auto give = [&](vtkPolyData* points) { warp->SetInputData(points); };
  // What lies across the plane of a flat density is kept, and is not outside.
  const auto count = [&](const std::vector<double>& x) {
    give(makePoints(x));
    return countOf(warp, " of " + std::to_string(x.size() / 3) + " points outside");
  };
  CHECK(checks, count({ 1, 1, 0, 2, 2, 5 }) == 0);
  CHECK(checks, count({ 1, 1, 0, -2, 2, 5 }) == 1);
  CHECK(checks, count({ 1, 1, 0, 4.000001, 2, 5 }) == 0);
  CHECK(checks, count({ 1, 1, 0, 4.0001, 2, 5 }) == 1);
  CHECK(checks, count({ 1, 4, 0, -2, 2, 5, 1, 1, 0 }) == 2);
  warp->SetBlend(0.0); // and is counted where nothing moves
  CHECK(checks, count({ 1, 4, 0, -2, 2, 5, 1, 1, 0 }) == 2);
}

void checkSplat(Checks& checks, double unit)
{
  vtkNew<vtkMassSplatter> splatter;
  splatter->SetAssociationToCells();
  splatter->SetReferenceData(makeSmall(unit));
  for (int boundary = 0; boundary < 2; ++boundary)
  {
    splatter->SetBoundary(boundary);
    checkOutside(
      checks, splatter, [&](vtkPolyData* points) { splatter->SetInputData(points); }, "points ",
      unit);
    const auto count = [&](const std::vector<double>& x, const char* text) {
      splatter->SetInputData(makePoints(x));
      return countOf(splatter, text);
    };
    const double in = unit;
    CHECK(checks,
      count({ in, in, 0, -in, in, 0 }, " of 2 points is outside the domain; its mass") == 1);
    CHECK(checks,
      count({ -in, in, 0, -in, in, 0 }, " of 2 points are outside the domain; their mass") == 2);
  }
}

// Beside a line, to any side.
void checkLine(Checks& checks)
{
  const double oblique[9] = { 0.6, 0, -0.8, 0, 1, 0, 0.8, 0, 0.6 };
  for (const bool isOblique : { false, true })
  {
    auto line = makeImage(5, 1, 1, true, bumpy);
    if (isOblique)
    {
      line->SetDirectionMatrix(oblique);
    }
    vtkNew<vtkMassSplatter> splatter;
    splatter->SetAssociationToCells();
    splatter->SetReferenceData(line);
    const double across[][2] = { { 0, 0 }, { 0.5, 0 }, { -0.5, 0 }, { 0, 0.1 }, { 0, -0.1 },
      { 0.3, -0.3 } };
    for (const auto& [y, z] : across)
    {
      const double index[3] = { 1.0, y, z };
      double x[3];
      line->TransformContinuousIndexToPhysicalPoint(index, x);
      splatter->SetInputData(makePoints({ x[0], x[1], x[2] }));
      CHECK_NEAR(checks, countOf(splatter, " of 1 points"), y == 0.0 && z == 0.0 ? 0 : 1, 0.0);
    }
  }
}

// Mass in single cells, which one step misses.
vtkSmartPointer<vtkImageData> makeDots(int rows)
{
  return makeDensity(
    { 40, 40, 1 }, true, [=](vtkIdType i) { return i % 7 == 3 && i / 40 % rows == 2 ? 1.0 : 0.0; });
}

vtkSmartPointer<vtkTransportSampler> makeOneStep(vtkImageData* image, vtkPolyData* seeds = nullptr)
{
  auto sampler = vtkSmartPointer<vtkTransportSampler>::New();
  sampler->SetInputData(image);
  sampler->SetSeedsData(seeds);
  sampler->SetIntegratorToRungeKutta4();
  sampler->SetNumberOfSteps(1);
  return sampler;
}

// Of all seeds as many as of each by itself.
void checkParticles(Checks& checks)
{
  const double box[6] = { 0, 40, 0, 40, 0, 0 };
  const std::vector<double> x = randomCoordinates(box, 200);
  const int all =
    countOf(makeOneStep(makeDots(5), makePoints(x)), " of 200 particles in empty cells");
  int sum = 0;
  auto alone = makeOneStep(makeDots(5));
  for (std::size_t i = 0; i < x.size(); i += 3)
  {
    alone->SetSeedsData(makePoints({ x[i], x[i + 1], x[i + 2] }));
    const int count = countOf(alone, " of 1 particles in empty cells");
    CHECK(checks, count == 0 || count == 1);
    sum += count;
  }
  CHECK_NEAR(checks, all, sum, 0.0);
  CHECK(checks, sum > 5 && sum < 100);
  // Paths count every particle once.
  auto paths = makeOneStep(makeDots(5), makePoints(x));
  paths->OutputPathsOn();
  CHECK(checks, countOf(paths, " of 200 particles in empty cells") == all);
  CHECK(checks, countOf(makeOneStep(makeImage(9, 9, 1, true, bumpy)), " particles") == 0);
}

int latticeCount(vtkImageData* image)
{
  auto sampler = makeOneStep(image);
  sampler->SetSeedPatternToLattice();
  sampler->SetSamplesPerCell(1);
  return countOf(sampler, " of 1600 particles in empty cells");
}

// A map and both ends of a morph put as many particles into cells with mass as a sampler does that
// starts where they start.
void checkMaps(Checks& checks)
{
  auto dots = makeDots(5);
  auto other = makeDots(9);
  const int ofDots = latticeCount(dots);
  const int ofOther = latticeCount(other);
  CHECK(checks, ofDots > 0 && ofOther > 0 && ofDots != ofOther);

  vtkNew<vtkTransportMap> map;
  map->SetInputData(dots);
  map->SetIntegratorToRungeKutta4();
  map->SetNumberOfSteps(1);
  CHECK(checks, countOf(map, " of 1600 samples in empty cells") == ofDots);
  map->SetInputData(makeImage(9, 9, 1, true, bumpy));
  CHECK(checks, countOf(map, " samples") == 0);

  const std::string text = " particles in empty cells";
  const auto morphCount = [&](vtkImageData* source, vtkImageData* target, int perCell) {
    auto morph = makeMorph(source, target);
    morph->SetIntegratorToRungeKutta4();
    morph->SetNumberOfSteps(1);
    morph->SetParticlesPerCell(perCell);
    return countOf(morph, text);
  };
  auto uniform = makeDensity({ 40, 40, 1 }, true, [](vtkIdType) { return 1.0; });
  CHECK(checks, morphCount(uniform, uniform, 1) == 0);
  CHECK(checks, morphCount(dots, uniform, 1) == ofDots);
  CHECK(checks, morphCount(uniform, other, 1) == ofOther);
  CHECK(checks, morphCount(dots, other, 1) == ofDots + ofOther);

  // Several particles a cell: the flow to the uniform density leaves them where they start.
  for (const int perCell : { 2, 3, 5 })
  {
    auto still = makeMorph(uniform, uniform, 0.0);
    still->SetParticlesPerCell(perCell);
    still->Update();
    const Values starts = particleValues(still, "SourcePosition");
    CHECK(checks, starts.size() == 3u * 1600 * static_cast<std::size_t>(perCell));
    const int wanted = countOf(
      makeOneStep(dots, makePoints(starts)), " of " + std::to_string(starts.size() / 3) + text);
    CHECK(checks, wanted > 0);
    // Up to rounding of the starts, which decides at the edges of cells.
    CHECK_NEAR(checks, morphCount(dots, uniform, perCell), wanted, 0.02 * wanted);
  }
}

// A point inside as often as it takes, and one outside.
vtkSmartPointer<vtkPolyData> makeOneOutside(int count)
{
  std::vector<double> x;
  for (int i = 1; i < count; ++i)
  {
    x.insert(x.end(), { 0.5 + i % 7 * 0.5, 0.5 + i % 5 * 0.5, 0.0 });
  }
  x.insert(x.end(), { -1.0, 1.0, 0.0 });
  return makePoints(x);
}

// One of a thousand is worth a warning, one of a few more is in the field data alone.
void checkLimit(Checks& checks, vtkAlgorithm* algorithm, const SetPoints& give, int port,
  const char* field, bool warnsAlways = false)
{
  const auto expect = [&](vtkPolyData* points, double count, std::size_t warnings, int line) {
    give(points);
    const std::size_t found = warningsOf(algorithm).size();
    checks.That(found == warnings, field, line, std::to_string(found));
    const double given = fieldValue(algorithm->GetOutputDataObject(port), field);
    checks.That(given == count, field, line, std::to_string(given));
  };
  expect(makePoints({ 1, 1, 0, 3, 2, 0, 2, 1, 0 }), 0, 0, __LINE__);
  expect(makeOneOutside(1000), 1, 1, __LINE__);
  expect(makeOneOutside(1001), 1, warnsAlways ? 1 : 0, __LINE__);
}

void checkLimits(Checks& checks)
{
  auto image = makeSmall(1.0);
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  checkLimit(
    checks, sampler, [&](vtkPolyData* seeds) { sampler->SetSeedsData(seeds); }, 0, "OutsideSeeds",
    true);
  vtkNew<vtkBlueNoiseRelaxation> relaxation;
  relaxation->SetDensityData(image);
  relaxation->SetMaximumIterations(0);
  checkLimit(
    checks, relaxation, [&](vtkPolyData* points) { relaxation->SetInputData(points); }, 0,
    "OutsidePoints");
  vtkNew<vtkDensityEqualizingWarp> warp;
  warp->SetDensityData(image);
  checkLimit(
    checks, warp, [&](vtkPolyData* points) { warp->SetInputData(points); }, 0, "OutsidePoints");
  vtkNew<vtkMassSplatter> splatter;
  splatter->SetReferenceData(image);
  checkLimit(
    checks, splatter, [&](vtkPolyData* points) { splatter->SetInputData(points); }, 0,
    "OutsidePoints");
  vtkNew<vtkEqualMassCells> cells;
  cells->SetDomainData(image);
  cells->SetResolution(64);
  for (const int port : { 0, 1 })
  {
    checkLimit(
      checks, cells, [&](vtkPolyData* sites) { cells->SetInputData(sites); }, port, "OutsideSites");
    CHECK(checks, fieldValue(cells->GetOutputDataObject(port), "SitesWithoutMass") == 0.0);
  }
}

// A seed that one step leaves in an empty cell, among others that it does not.
void checkLimitOfParticles(Checks& checks)
{
  auto dots = makeDots(5);
  const double box[6] = { 0, 40, 0, 40, 0, 0 };
  const std::vector<double> x = randomCoordinates(box, 200);
  auto sampler = makeOneStep(dots);
  std::vector<double> ends[2]; // of a seed that ends in a cell with mass, and in an empty one
  for (std::size_t i = 0; i < x.size() && (ends[0].empty() || ends[1].empty()); i += 3)
  {
    const std::vector<double> seed{ x[i], x[i + 1], x[i + 2] };
    sampler->SetSeedsData(makePoints(seed));
    const std::size_t warnings = warningsOf(sampler).size();
    CHECK_NEAR(checks, fieldValue(sampler->GetOutput(), "MovedParticles"),
      static_cast<double>(warnings), 0.0);
    ends[warnings] = seed;
  }
  for (const int count : { 1000, 1001 })
  {
    std::vector<double> all = ends[1];
    for (int i = 1; i < count; ++i)
    {
      all.insert(all.end(), ends[0].begin(), ends[0].end());
    }
    sampler->SetSeedsData(makePoints(all));
    CHECK(checks, warningsOf(sampler).size() == (count == 1000 ? 1u : 0u));
    CHECK(checks, fieldValue(sampler->GetOutput(), "MovedParticles") == 1.0);
    CHECK(checks, fieldValue(sampler->GetOutput(), "OutsideSeeds") == 0.0);
  }
}

// Mass everywhere but in a few cells of a row: the longer the row, the more samples and particles
// end in it.
void checkLimitOfMaps(Checks& checks)
{
  auto uniform = makeDensity({ 40, 40, 1 }, true, [](vtkIdType) { return 1.0; });
  std::set<bool> given[2];
  for (const int empty : { 0, 1, 2, 3, 5, 8, 16, 30 })
  {
    auto row = makeDensity({ 40, 40, 1 }, true,
      [=](vtkIdType i) { return i >= 18 * 40 + 5 && i < 18 * 40 + 5 + empty ? 0.0 : 1.0; });
    vtkNew<vtkTransportMap> map;
    map->SetInputData(row);
    auto morph = makeMorph(uniform, row);
    morph->SetParticlesPerCell(1);
    morph->SetIntegratorToRungeKutta4();
    map->SetIntegratorToRungeKutta4();
    morph->SetNumberOfSteps(1);
    map->SetNumberOfSteps(1);
    const bool warns[] = { warningsOf(map).size() == 1, warningsOf(morph).size() == 1 };
    const double moved[] = { fieldValue(map->GetOutput(), "MovedSamples"),
      fieldValue(morph->GetDensity(), "MovedParticles") };
    for (int i = 0; i < 2; ++i)
    {
      CHECK(checks, warns[i] == (moved[i] >= 1.6));
      if (moved[i] > 0.0)
      {
        given[i].insert(warns[i]);
      }
    }
    CHECK(checks, moved[0] == moved[1] && (empty > 0 || moved[0] == 0.0));
    CHECK(checks, fieldValue(morph->GetParticles(), "MovedParticles") == moved[1]);
    // The maps stay, and so does their count.
    morph->SetParameter(0.25);
    CHECK(checks, warningsOf(morph).empty());
    CHECK(checks, fieldValue(morph->GetDensity(), "MovedParticles") == moved[1]);
  }
  CHECK(checks, given[0].size() == 2 && given[1].size() == 2);
}

} // namespace

int TestWarningCounts(int, char*[])
{
  Checks checks;
  for (const double unit : { 1.0, 1e-3, 500.0 })
  {
    checkSeeds(checks, unit);
    checkRelaxation(checks, unit);
    checkSites(checks, unit);
    checkSplat(checks, unit);
  }
  checkWarp(checks);
  checkLine(checks);
  checkParticles(checks);
  checkMaps(checks);
  checkLimits(checks);
  checkLimitOfParticles(checks);
  checkLimitOfMaps(checks);
  return checks.Result();
}
