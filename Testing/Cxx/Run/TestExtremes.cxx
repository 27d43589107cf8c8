// SPDX-License-Identifier: BSD-3-Clause
// Input of finite numbers gives output of finite numbers, or one error: images, points and surfaces
// from the smallest spacings to the largest.
#include "BlendTest.h"
#include "CellsTest.h"
#include "KindTest.h"
#include "MapRegions.h"
#include "ParameterizationTest.h"
#include "SolidTest.h"
#include "SurfaceSamplerTest.h"

#include "vtkBlueNoiseRelaxation.h"
#include "vtkInformation.h"
#include "vtkMassSplatter.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"
#include "vtkTransportMap.h"
#include "vtkTransportQuality.h"
#include "vtkUniformSeedSource.h"

#include <limits>

namespace
{

// The name of a numeric array with a value that is none.
std::string notFinite(vtkFieldData* data)
{
  for (int i = 0; data && i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i);
    const std::string name = array && array->GetName() ? array->GetName() : "";
    if (name == "AreaErrorEstimate" || name == "LargestBlockError")
    {
      continue; // NaN says that there is nothing to measure
    }
    for (vtkIdType v = 0; array && v < array->GetNumberOfValues(); ++v)
    {
      const int components = array->GetNumberOfComponents();
      if (!std::isfinite(array->GetComponent(v / components, static_cast<int>(v % components))))
      {
        return array->GetName() ? array->GetName() : "(no name)";
      }
    }
  }
  return "";
}

std::string notFinite(vtkDataObject* output)
{
  std::string names;
  for (const int owner : { vtkDataObject::POINT, vtkDataObject::CELL, vtkDataObject::ROW })
  {
    names += notFinite(output->GetAttributes(owner));
  }
  names += notFinite(output->GetFieldData());
  auto* set = vtkDataSet::SafeDownCast(output);
  for (vtkIdType i = 0; set && i < set->GetNumberOfPoints(); ++i)
  {
    const double* x = set->GetPoint(i);
    if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
    {
      return names + "points";
    }
  }
  return names;
}

// Runs a filter. Returns whether it ended without an error.
bool expectFinite(Checks& checks, vtkAlgorithm* filter, double scale, int line)
{
  Messages messages(filter);
  filter->Update();
  std::ostringstream what;
  what << filter->GetClassName() << " at " << scale << ": ";
  checks.That(messages.Errors.size() <= 1, "at most one error", line, what.str());
  for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
  {
    vtkDataObject* output = filter->GetOutputDataObject(port);
    const std::string names = notFinite(output);
    checks.That(names.empty(), "finite", line, what.str() + names);
    auto* set = vtkDataSet::SafeDownCast(output);
    checks.That(
      messages.Errors.empty() || !set || set->GetNumberOfPoints() == 0, "empty", line, what.str());
  }
  return messages.Errors.empty();
}

vtkSmartPointer<vtkImageData> makeScaled(const Counts& size, bool cells, double scale)
{
  auto image = makeDensity(size, cells, bumpy);
  image->SetSpacing(scale, 1.5 * scale, 0.75 * scale);
  image->SetOrigin(-2.0 * scale, scale, 0.0);
  return image;
}

// Returns how many filters ended without an error.
int runAll(Checks& checks, const Counts& size, bool cells, double scale)
{
  auto image = makeScaled(size, cells, scale);
  int good = 0;
  const auto run = [&](vtkAlgorithm* filter, int line) {
    good += expectFinite(checks, filter, scale, line) ? 1 : 0;
  };
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  sampler->SetNumberOfParticles(60);
  run(sampler, __LINE__);
  vtkNew<vtkPolyData> particles;
  particles->ShallowCopy(sampler->GetOutput());
  sampler->OutputPathsOn();
  run(sampler, __LINE__);
  vtkNew<vtkTransportMap> map;
  map->SetInputData(image);
  run(map, __LINE__);
  map->SetDirectionToDensityToUniform();
  run(map, __LINE__);
  run(makeMorph(image, makeScaled({ 3, size[1] > 1 ? 4 : 1, size[2] }, cells, scale)), __LINE__);
  auto normalized = makeMorph(image, image);
  normalized->SetMassMode(vtkTransportBlend::MASS_NORMALIZE);
  run(normalized, __LINE__);
  run(makeBarycenter({ image, image }, { 1, 2 }), __LINE__);
  if (particles->GetNumberOfPoints() > 0)
  {
    vtkNew<vtkTransportQuality> quality;
    quality->SetInputData(particles);
    quality->SetDensityData(image);
    run(quality, __LINE__);
    vtkNew<vtkDensityEqualizingWarp> warp;
    warp->SetInputData(particles);
    warp->SetDensityData(image);
    run(warp, __LINE__);
    vtkNew<vtkBlueNoiseRelaxation> relaxation;
    relaxation->SetInputData(particles);
    relaxation->SetDensityData(image);
    relaxation->SetMaximumIterations(2);
    if (size[1] > 1)
    {
      run(relaxation, __LINE__);
      relaxation->SetMethodToOptimalTransport();
    }
    if (size[1] > 1 && size[2] == 1)
    {
      run(relaxation, __LINE__);
    }
    vtkNew<vtkMassSplatter> splatter;
    splatter->SetInputData(particles);
    splatter->SetDimensions(6, 6, 6);
    run(splatter, __LINE__);
    splatter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Mass");
    splatter->SetBoundaryToDrop();
    run(splatter, __LINE__);
    vtkNew<vtkEqualMassCells> labels;
    labels->SetInputData(particles);
    labels->SetResolution(size[1] == 1 ? 64 : 12); // a pixel for each
    run(labels, __LINE__);
    labels->SetDomainData(image);
    run(labels, __LINE__);
  }
  return good;
}

void checkScales(Checks& checks)
{
  int best = 0;
  int filters = 0;
  for (const Counts& size : { Counts{ 9, 1, 1 }, Counts{ 4, 3, 3 }, Counts{ 6, 5, 1 } })
  {
    // Blue noise is relaxed in a plane, by one of the methods also in space.
    filters = size[1] == 1 ? 13 : size[2] == 1 ? 15 : 14;
    for (int exponent = -320; exponent <= 308; exponent += 27)
    {
      best = std::max(best, runAll(checks, size, exponent % 2 == 0, std::pow(10.0, exponent)));
    }
    CHECK(checks, runAll(checks, size, true, 1e-90) == filters);
    CHECK(checks, runAll(checks, size, true, 1e90) == filters);
  }
  for (const double scale : { 1e-103, 1e-102, 1e-108, 1e102, 1e103, 1e153, 1e154, 1e160, 1e308 })
  {
    runAll(checks, { 9, 1, 1 }, true, scale);
    runAll(checks, { 4, 3, 3 }, true, scale);
  }
  CHECK(checks, best == filters);
}

// Every filter of the register, with sheets, maps and plane images, and with closed surfaces and
// images in space.
void checkKinds(Checks& checks)
{
  std::vector<double> scales{ 1.0 };
  for (int exponent = -320; exponent <= 308; exponent += 27)
  {
    scales.push_back(std::pow(10.0, exponent));
  }
  for (const Campaign::FilterKind& kind : Campaign::filterKinds())
  {
    bool isGood = false; // at scale 1
    for (const double scale : scales)
    {
      auto points = makePoints({ -scale, 2.5 * scale, 0, scale, 3 * scale, 0, 0, 4 * scale, 0 });
      auto sheet = makeSheet(5, 4, [scale](double x, double y) {
        return std::array<double, 3>{ 0.2 * scale * x, 0.2 * scale * y, 0.01 * scale * x * y };
      });
      auto box = makeBox(-scale, scale, 0, scale, 0, 0.5 * scale);
      for (const vtkSmartPointer<vtkPolyData>& surface : { sheet, box, makeMap(3, scale) })
      {
        const auto filter = kind.New();
        connectNeeded(
          filter, makeScaled({ 6, 5, surface == box ? 3 : 1 }, true, scale), points, surface);
        Campaign::RandomSource random(7);
        kind.MakeQuick(random, filter);
        const bool ends = expectFinite(checks, filter, scale, __LINE__);
        isGood = isGood || (ends && scale == 1.0);
      }
    }
    checks.That(isGood, "a result at scale 1", __LINE__, kind.Name);
  }
}

// Where the figures are no numbers, and where only what is on the way to them is none.
void checkFigures(Checks& checks)
{
  auto image = makeScaled({ 9, 1, 1 }, true, 1e160);
  vtkNew<vtkTransportSampler> sampler;
  vtkNew<vtkTransportMap> map;
  for (vtkAlgorithm* filter :
    { static_cast<vtkAlgorithm*>(sampler), static_cast<vtkAlgorithm*>(map) })
  {
    Messages messages(filter);
    filter->SetInputDataObject(image);
    filter->Update();
    CHECK(checks, messages.IsOneError("TransportCost, the mean of the squared"));
  }
  // The sum over the particles passes the largest double, the mean does not.
  auto large = makeScaled({ 9, 1, 1 }, true, 1.0);
  sampler->SetInputData(large);
  sampler->Update();
  const double cost = fieldValue(sampler->GetOutput(), "TransportCost");
  const double scale = 1e154 / std::sqrt(cost);
  sampler->SetInputData(makeScaled({ 9, 1, 1 }, true, scale));
  CHECK(checks, expectFinite(checks, sampler, scale, __LINE__));
  CHECK_NEAR(checks, fieldValue(sampler->GetOutput(), "TransportCost") / 1e308, 1.0, 1e-6);

  auto small = makeScaled({ 4, 3, 3 }, true, 1e-103);
  const vtkSmartPointer<vtkAlgorithm> blends[] = { makeMorph(small, small),
    makeBarycenter({ small, small }) };
  for (vtkAlgorithm* filter : blends)
  {
    Messages messages(filter);
    filter->Update();
    CHECK(checks, messages.IsOneError("make densities past the largest double"));
  }

  // Spacings of particles do not depend on the units.
  std::vector<double> spacings;
  for (const double unit : { 1.0, 1e-160, 1e160, 1e300 })
  {
    auto line = makeScaled({ 9, 1, 1 }, true, unit);
    std::vector<double> x;
    for (int i = 0; i < 30; ++i)
    {
      x.insert(x.end(), { unit * (-1.9 + 0.27 * i + 0.01 * (i % 3)), unit, 0.0 });
    }
    vtkNew<vtkTransportQuality> quality;
    quality->SetInputData(makePoints(x));
    quality->SetDensityData(line);
    quality->Update();
    spacings.push_back(quality->GetOutput()->GetNumberOfRows() == 1
        ? quality->GetOutput()->GetValueByName(0, "MeanSpacing").ToDouble()
        : std::nan(""));
  }
  for (const double spacing : spacings)
  {
    CHECK_NEAR(checks, spacing, spacings[0], 1e-9);
  }
  CHECK(checks, spacings[0] > 0.1);

  // Needles: the distance of two particles is a number of times what a cube has room for, or past
  // the largest double.
  for (const double length : { 1e200, 1e300 })
  {
    auto needles = makeDensity({ 4, 3, 3 }, true, bumpy);
    const double thickness = length == 1e200 ? 1e-100 : 1e-200;
    needles->SetSpacing(length, thickness, thickness);
    vtkNew<vtkTransportQuality> quality;
    quality->SetInputData(makePoints({ 0, 0, 0, 2 * length, 0, 0 }));
    quality->SetDensityData(needles);
    CHECK(checks, expectFinite(checks, quality, length, __LINE__) == (length == 1e200));
  }

  // Masses that are numbers, also their sum, but not what comes into one cell on the way.
  auto heavy = makePoints({ 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 0 });
  vtkNew<vtkDoubleArray> masses;
  masses->SetName("Mass");
  for (const double mass : { 1.5e308, 1.5e308, -1.5e308, 1.0 })
  {
    masses->InsertNextValue(mass);
  }
  heavy->GetPointData()->AddArray(masses);
  vtkNew<vtkMassSplatter> splatter;
  splatter->SetInputData(heavy);
  splatter->SetDimensions(4, 4, 4);
  splatter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Mass");
  for (const bool divides : { false, true })
  {
    splatter->SetDivideByVolume(divides);
    CHECK(checks, !expectFinite(checks, splatter, 1.0, __LINE__));
  }
}

void checkSources(Checks& checks)
{
  for (int exponent = -320; exponent <= 308; exponent += 4)
  {
    const double scale = std::pow(10.0, exponent);
    vtkNew<vtkSolidDensity> solid;
    solid->SetResolution(6);
    solid->SetInputData(makeBox(-scale, scale, 0, scale, 0, 0.5 * scale));
    // VTK cuts polygons into triangles where squares of their areas are numbers.
    const bool isGood = expectFinite(checks, solid, scale, __LINE__);
    checks.That(isGood || std::abs(exponent) > 76, "good", __LINE__, std::to_string(exponent));
    auto surface = makeSheet(5, 4, [scale](double x, double y) {
      return std::array<double, 3>{ 0.2 * scale * x, 0.2 * scale * y, 0.01 * scale * x * y };
    });
    checks.That(expectFinite(checks, makeParameterization(surface), scale, __LINE__), "a disk",
      __LINE__, std::to_string(exponent));
    vtkNew<vtkSurfaceSampler> sampler;
    sampler->SetInputData(surface);
    sampler->SetNumberOfParticles(20);
    sampler->SetResolution(20);
    for (const int method : { vtkSurfaceSampler::RELAXATION, vtkSurfaceSampler::FLOW })
    {
      sampler->SetMethod(method);
      // Areas are numbers, and not zero, between these.
      const bool isSampled = expectFinite(checks, sampler, scale, __LINE__);
      checks.That(isSampled == (exponent >= -160 && exponent <= 154), "sampled", __LINE__,
        std::to_string(exponent));
    }
    vtkNew<vtkUniformSeedSource> seeds;
    seeds->SetBounds(-scale, scale, 0, scale, 0, scale);
    seeds->SetNumberOfPoints(20);
    expectFinite(checks, seeds, scale, __LINE__);
    seeds->SetDimension(3);
    expectFinite(checks, seeds, scale, __LINE__);
  }
}

// A pipeline may ask for any time.
void checkTimes(Checks& checks)
{
  auto image = makeDensity({ 8, 6, 1 }, true, bumpy);
  auto morph = makeMorph(image, makeDensity({ 8, 6, 1 }, true, otherDensity(8, 6)));
  morph->PublishTimeOn();
  Messages messages(morph);
  morph->UpdateTimeStep(std::numeric_limits<double>::quiet_NaN());
  CHECK(checks, messages.IsOneError("time is nan; it must be a number"));
  CHECK(checks, isEmpty(morph));
  messages.Clear();
  for (const double time : { -HUGE_VAL, HUGE_VAL, 0.5 })
  {
    morph->UpdateTimeStep(time);
    CHECK(checks, messages.Errors.empty() && morph->GetParticles()->GetNumberOfPoints() == 48);
    CHECK(checks, notFinite(morph->GetParticles()).empty());
    CHECK(checks, notFinite(morph->GetDensity()).empty());
  }
}

} // namespace

int TestExtremes(int, char*[])
{
  return runChecks({ checkScales, checkKinds, checkFigures, checkSources, checkTimes });
}
