// SPDX-License-Identifier: BSD-3-Clause
// Equal Mass Cells, Splat Mass, Solid Density and Uniform Seeds.
#include "DrawnInputs.h"
#include "Kinds.h"
#include "OutputChecks.h"

#include "vtkCellData.h"
#include "vtkEqualMassCells.h"
#include "vtkMassSplatter.h"
#include "vtkPointData.h"
#include "vtkSolidDensity.h"
#include "vtkUniformSeedSource.h"

#include <algorithm>
#include <cmath>

namespace Campaign
{

namespace
{

// At times the second of two inputs: an image that only lends its geometry.
vtkImageData* drawGeometry(RandomSource& random, Settings& settings, Inputs& inputs)
{
  inputs.resize(2);
  if (!random.Chance(0.4))
  {
    return nullptr;
  }
  inputs[1] = { drawImage(random, rulesOf(settings)) };
  Input& image = inputs[1][0];
  image.Values = nullptr;
  image.Condition = State::Open;
  return vtkImageData::SafeDownCast(image.Data);
}

//------------------------------------------------------------------------------
using Cells = vtkEqualMassCells;

void drawCells(Settings& settings)
{
  settings.Draw<Cells, int>(
    "Resolution", &Cells::SetResolution, { 2, 5, 9, 14, 18, 18 }, { 0, -3 }, 1.0);
  settings.Draw<Cells, double>("NormExponent", &Cells::SetNormExponent,
    { 1.0, 2.0, 3.5, 1e300, Infinity }, { 0.5, -1.0, NaN }, 0.4);
  settings.Draw<Cells, double>("CostExponent", &Cells::SetCostExponent, { 5e-324, 0.5, 1.0, 3.0 },
    { 0.0, -1.0, NaN, Infinity }, 0.4);
  drawFlowSettings<Cells>(settings);
  settings.Draw<Cells, int>("Shape", &Cells::SetShape, { 0, 1 }, { -1, 2 }, 0.4);
  settings.Draw<Cells, int>("Measure", &Cells::SetMeasure, { 0, 1 }, { -1, 2 }, 0.3);
  // These count where the density does: out of range they are no errors elsewhere.
  settings.Draw<Cells, int>("Component", &Cells::SetComponent, { -1, 0 }, {}, 0.2);
  settings.Draw<Cells, vtkTypeBool>("InvertDensity", &Cells::SetInvertDensity, { 0, 1 }, {}, 0.2);
  settings.Draw<Cells, int>("NegativeValues", &Cells::SetNegativeValues, { 0, 1 }, {}, 0.2);
  settings.Draw<Cells, int>("NaNValues", &Cells::SetNaNValues, { 0, 1 }, {}, 0.2);
  drawValidRange(settings, false);
  settings.Draw<Cells, int>(
    "DensityResolution", &Cells::SetDensityResolution, { 1, 9, 16, 40 }, {}, 0.2);
}

Inputs drawCellsInputs(RandomSource& random, Settings& settings)
{
  Inputs inputs;
  vtkImageData* domain = drawGeometry(random, settings, inputs);
  inputs[0] = { drawPoints(random, domain, random.Of({ 5, 12, 30 })) };
  inputs[0][0].Values = nullptr;
  return inputs;
}

State expectCells(vtkAlgorithm* filter, const Inputs& inputs)
{
  auto* set = vtkPointSet::SafeDownCast(inputs[0][0].Data);
  auto* cells = Cells::SafeDownCast(filter);
  State state = inputs[0][0].Condition;
  if (set->GetNumberOfPoints() > cells->GetResolution() || cells->GetShape() == Cells::SHAPE_POWER)
  {
    // There may be less than a pixel for each site; a domain or cost that has no power cells.
    state = worse(state, State::Odd);
  }
  if (cells->GetMeasure() == Cells::DENSITY)
  {
    state = worse(state, State::Odd); // a domain without a density
  }
  return inputs[1].empty() ? state : worse(state, inputs[1][0].Condition);
}

void checkCells(vtkAlgorithm* filter, const Inputs& inputs, Findings& findings)
{
  auto* cells = Cells::SafeDownCast(filter);
  vtkImageData* labels = cells->GetLabels();
  vtkPointSet* sites = cells->GetSites();
  auto* input = vtkPointSet::SafeDownCast(inputs[0][0].Data);
  const vtkIdType count = input->GetNumberOfPoints();
  const vtkIdType pixels = labels->GetNumberOfCells();
  findings.That(sites->GetNumberOfPoints() == count, "all sites are there");
  requirePassed(input->GetPointData(), sites->GetPointData(),
    { "CellMass", "CellCentroid", "CellCost" }, findings);
  vtkDataArray* ids = requireArray(labels->GetCellData(), "SiteId", 1, pixels, findings);
  std::vector<double> found(static_cast<std::size_t>(count));
  for (vtkIdType i = 0; ids && i < pixels; ++i)
  {
    const double id = ids->GetComponent(i, 0);
    if (id == -1.0 && cells->GetMeasure() == Cells::DENSITY)
    {
      continue; // a pixel without mass
    }
    if (!(id >= 0.0 && id < static_cast<double>(count)))
    {
      findings.That(false, "SiteId " + textOf(id));
      return;
    }
    found[static_cast<std::size_t>(id)] += 1.0;
  }
  const double pixel = cellMeasure(labels);
  vtkDataArray* mass = requireArray(sites->GetPointData(), "CellMass", 1, count, findings);
  vtkDataArray* cost = requireArray(sites->GetPointData(), "CellCost", 1, count, findings);
  vtkDataArray* centroids = requireArray(sites->GetPointData(), "CellCentroid", 3, count, findings);
  const double share = static_cast<double>(pixels) / static_cast<double>(count);
  if (expectCells(filter, inputs) == State::Sound)
  {
    findings.Near(sumOf(mass), static_cast<double>(pixels) * pixel, 1e-9, "sum of CellMass");
    findings.Near(sumOf(cost), requireField(sites, "TransportCost", findings), 1e-9, "CellCost");
    for (const double number : found)
    {
      findings.That(std::abs(number - share) <= 1.0, "a cell of " + textOf(number) + " pixels");
    }
  }
  double bounds[6];
  labels->GetBounds(bounds);
  for (vtkIdType i = 0; centroids && inputs[1].empty() && i < count; ++i)
  {
    for (int a = 0; a < 3; ++a)
    {
      const double x = centroids->GetComponent(i, a);
      const double slack = 1e-9 * (std::abs(x) + bounds[2 * a + 1] - bounds[2 * a]);
      findings.That(
        x >= bounds[2 * a] - slack && x <= bounds[2 * a + 1] + slack, "CellCentroid " + textOf(x));
    }
  }
  vtkPolyData* outlines = cells->GetOutlines();
  requireArray(outlines->GetCellData(), "SiteId", 1, outlines->GetNumberOfCells(), findings);
}

//------------------------------------------------------------------------------
using Splatter = vtkMassSplatter;

void drawSplatter(Settings& settings)
{
  RandomSource& random = settings.GetRandom();
  const int x = random.Of({ 1, 2, 8, 20, 30 });
  const int y = random.Of({ 1, 2, 8, 20, 30 });
  const int z = random.Of({ 1, 1, 2, 8, 12 });
  settings.Add("Dimensions", std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z),
    [=](vtkAlgorithm* filter) { static_cast<Splatter*>(filter)->SetDimensions(x, y, z); });
  if (random.Chance(0.03))
  {
    const int wrong = random.Of({ 0, -7, std::numeric_limits<int>::min() });
    settings.Add(
      "Dimensions", std::to_string(wrong),
      [=](vtkAlgorithm* filter) { static_cast<Splatter*>(filter)->SetDimensions(wrong, 4, 4); },
      false);
  }
  settings.Draw<Splatter, int>("Association", &Splatter::SetAssociation, { 0, 1 }, { -1, 2 });
  settings.Draw<Splatter, int>("Kernel", &Splatter::SetKernel, { 0, 1, 2, 3, 3 }, { -1, 4 });
  settings.Draw<Splatter, double>("Radius", &Splatter::SetRadius,
    { 1e-300, 0.2, 1.0, 2.5, 10000.0 }, { 0.0, -1.0, 10001.0, NaN, Infinity }, 0.3);
  settings.Draw<Splatter, int>("Boundary", &Splatter::SetBoundary, { 0, 1 }, { -1, 2 });
  settings.Draw<Splatter, vtkTypeBool>(
    "DivideByVolume", &Splatter::SetDivideByVolume, { 0, 1 }, {});
  drawThreading<Splatter>(settings);
}

Inputs drawSplatterInputs(RandomSource& random, Settings& settings)
{
  Inputs inputs;
  vtkImageData* reference = drawGeometry(random, settings, inputs);
  inputs[0] = { drawPoints(random, reference, settings.IsLarge() ? 20000 : 1500) };
  const char* const usual = inputs[0][0].Values ? "Mass" : "";
  const std::string name = random.Chance(0.9) ? random.Of({ "", usual, usual, "None" })
                                              : random.Of({ "Mass", "Displacement", "Nothing" });
  settings.Add("Array", name, [name](vtkAlgorithm* filter) {
    filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name.c_str());
  });
  if (!name.empty() && name != "None")
  {
    inputs[0][0].Worsen(State::Odd);
  }
  return inputs;
}

State expectSplatter(vtkAlgorithm*, const Inputs& inputs)
{
  return inputs[1].empty() ? inputs[0][0].Condition
                           : worse(inputs[0][0].Condition, inputs[1][0].Condition);
}

void checkSplatter(vtkAlgorithm* filter, const Inputs& inputs, Findings& findings)
{
  auto* splatter = Splatter::SafeDownCast(filter);
  vtkImageData* output = splatter->GetOutput();
  vtkDataArray* density =
    requireDensity(output, splatter->GetAssociation() == Splatter::POINTS, findings);
  const double total = requireField(output, "TotalMass", findings);
  if (splatter->GetDivideByVolume() == 0 && splatter->GetBoundary() == Splatter::RENORMALIZE &&
    expectSplatter(filter, inputs) == State::Sound)
  {
    findings.Near(sumOf(density), total, 1e-11, "sum of the masses");
    auto* set = vtkPointSet::SafeDownCast(inputs[0][0].Data);
    findings.Near(total, static_cast<double>(set->GetNumberOfPoints()), 1e-12, "TotalMass");
  }
}

//------------------------------------------------------------------------------
using Solid = vtkSolidDensity;

void drawSolid(Settings& settings)
{
  settings.Draw<Solid, int>(
    "Resolution", &Solid::SetResolution, { 1, 2, 3, 8, 16, 20 }, { 0, -1 }, 1.0);
  settings.Draw<Solid, int>(
    "Supersampling", &Solid::SetSupersampling, { 1, 2, 3, 5, 16 }, { 0, 17, -4 }, 0.4);
  settings.Draw<Solid, double>(
    "Padding", &Solid::SetPadding, { 0.0, 0.01, 1.0, 100.0 }, { -0.1, NaN, Infinity }, 0.4);
  settings.Draw<Solid, int>("Association", &Solid::SetAssociation, { 0, 1 }, { -1, 2 });
  settings.Draw<Solid, int>("OpenSurfaces", &Solid::SetOpenSurfaces, { 0, 1 }, { -1, 2 });
  drawThreading<Solid>(settings);
}

Inputs drawSolidInputs(RandomSource& random, Settings&)
{
  Inputs inputs(1);
  inputs[0] = { drawSurface(random) };
  return inputs;
}

State expectSolid(vtkAlgorithm* filter, const Inputs& inputs)
{
  const State surface = inputs[0][0].Condition;
  const bool mayBeOpen = Solid::SafeDownCast(filter)->GetOpenSurfaces() == 1;
  return surface == State::Faulty && mayBeOpen ? State::Odd : surface;
}

void checkSolid(vtkAlgorithm* filter, const Inputs& inputs, Findings& findings)
{
  auto* solid = Solid::SafeDownCast(filter);
  vtkDataArray* density =
    requireDensity(solid->GetOutput(), solid->GetAssociation() == Solid::POINTS, findings);
  for (vtkIdType i = 0; density && i < density->GetNumberOfTuples(); ++i)
  {
    const double value = density->GetComponent(i, 0);
    if (!(value >= 0.0 && value <= 1.0))
    {
      findings.That(false, "Density " + textOf(value));
      break;
    }
  }
  findings.That(
    expectSolid(filter, inputs) != State::Sound || sumOf(density) > 0.0, "a solid has a volume");
}

//------------------------------------------------------------------------------
using Source = vtkUniformSeedSource;

void drawSource(Settings& settings)
{
  RandomSource& random = settings.GetRandom();
  if (random.Chance(0.6))
  {
    double bounds[6];
    bool inRange = true;
    for (int a = 0; a < 3; ++a)
    {
      bounds[2 * a] = random.Real(-10.0, 10.0);
      bounds[2 * a + 1] = bounds[2 * a] + random.Of({ 1.0, 1e-3, 1e6, random.Unit() + 0.1 });
    }
    if (random.Chance(0.1))
    {
      const auto end = static_cast<std::size_t>(random.Whole(0, 3));
      bounds[end] = random.Of({ NaN, Infinity, -Infinity });
      inRange = false;
    }
    std::string text;
    for (const double end : bounds)
    {
      text += textOf(end) + " ";
    }
    settings.Add(
      "Bounds", text,
      [=](vtkAlgorithm* filter) {
        static_cast<Source*>(filter)->SetBounds(
          bounds[0], bounds[1], bounds[2], bounds[3], bounds[4], bounds[5]);
      },
      inRange);
  }
  settings.Draw<Source, int>("Dimension", &Source::SetDimension, { 2, 3 }, { 1, 4, -1 });
  settings.Draw<Source, vtkIdType>("NumberOfPoints", &Source::SetNumberOfPoints,
    { 1, 2, 10, 777, 2000 }, { 0, -1, 1000000000000, std::numeric_limits<vtkIdType>::max() }, 0.9);
  settings.Draw<Source, int>("Pattern", &Source::SetPattern, { 0, 1, 2, 3, 4 }, { -1, 5 });
  settings.Draw<Source, int>("RandomSeed", &Source::SetRandomSeed,
    { 0, -1, 5, std::numeric_limits<int>::max(), std::numeric_limits<int>::min() }, {}, 0.3);
  drawThreading<Source>(settings);
}

void checkSource(vtkAlgorithm* filter, const Inputs&, Findings& findings)
{
  auto* source = Source::SafeDownCast(filter);
  vtkPolyData* output = source->GetOutput();
  requireFinitePoints(output, findings);
  requireVertices(output, findings);
  findings.That(source->GetPattern() == Source::LATTICE ||
      output->GetNumberOfPoints() == source->GetNumberOfPoints(),
    "NumberOfPoints");
  double bounds[6];
  output->GetPoints()->GetBounds(bounds);
  for (int a = 0; a < 2 * source->GetDimension(); a += 2)
  {
    findings.That(
      bounds[a] >= source->GetBounds()[a] && bounds[a + 1] <= source->GetBounds()[a + 1],
      "points are in the Bounds");
  }
}

//------------------------------------------------------------------------------
void quickCells(RandomSource& random, vtkAlgorithm* filter)
{
  auto* cells = Cells::SafeDownCast(filter);
  cells->SetResolution(8);
  cells->SetNumberOfSteps(8);
  cells->SetShape(random.Chance(0.1) ? 1 : 0); // power cells of one far site take seconds
  if (filter->GetNumberOfInputConnections(1) > 0)
  {
    cells->SetMeasure(static_cast<int>(random.Whole(0, 1)));
  }
}

void quickSplatter(RandomSource& random, vtkAlgorithm* filter)
{
  auto* splatter = Splatter::SafeDownCast(filter);
  splatter->SetDimensions(5, 6, 4);
  splatter->SetKernel(static_cast<int>(random.Whole(0, 3)));
}

void quickSolid(RandomSource&, vtkAlgorithm* filter)
{
  Solid::SafeDownCast(filter)->SetResolution(8);
}

void quickSource(RandomSource&, vtkAlgorithm* filter)
{
  Source::SafeDownCast(filter)->SetNumberOfPoints(30);
}

} // namespace

void addOtherKinds(std::vector<FilterKind>& kinds)
{
  kinds.push_back(
    { "Cells", make<Cells>, drawCells, drawCellsInputs, expectCells, checkCells, quickCells });
  kinds.push_back({ "Splatter", make<Splatter>, drawSplatter, drawSplatterInputs, expectSplatter,
    checkSplatter, quickSplatter });
  kinds.push_back(
    { "Solid", make<Solid>, drawSolid, drawSolidInputs, expectSolid, checkSolid, quickSolid });
  kinds.push_back(
    { "Source", make<Source>, drawSource, [](RandomSource&, Settings&) { return Inputs(); },
      [](vtkAlgorithm*, const Inputs&) { return State::Sound; }, checkSource, quickSource });
}

} // namespace Campaign
