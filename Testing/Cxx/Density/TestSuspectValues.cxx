// SPDX-License-Identifier: BSD-3-Clause
// One value that carries most of the mass is one warning that names it, its index and its share; in
// every filter that reads a density, once for each density. Values that are meant are none.
#include "BlendTest.h"
#include "BlocksTest.h"
#include "WarpTest.h"

#include "vtkBlueNoiseRelaxation.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkEqualMassCells.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageDataToPointSet.h"
#include "vtkShortArray.h"
#include "vtkThreshold.h"
#include "vtkTransportMap.h"
#include "vtkTransportQuality.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <sstream>

namespace
{

using Value = std::function<double(vtkIdType)>;

// 24 x 18 cells, or points; values of a few units but for some.
Value withFill(double fill, vtkIdType first, vtkIdType count)
{
  return [=](vtkIdType i) { return i >= first && i < first + count ? fill : bumpy(i); };
}

std::vector<std::string> warningsOf(
  vtkDataObject* data, const std::function<void(vtkTransportSampler*)>& set = {})
{
  vtkNew<vtkTransportSampler> sampler;
  Messages messages(sampler);
  sampler->SetInputDataObject(data);
  sampler->SetNumberOfParticles(50);
  if (set)
  {
    set(sampler);
  }
  sampler->Update();
  return messages.Errors.empty() ? messages.Warnings : std::vector<std::string>{ "an error" };
}

// One warning that has the parts.
void expect(Checks& checks, const std::vector<std::string>& found,
  std::initializer_list<std::string> parts, int line)
{
  const std::string text = found.empty() ? "no warning" : found[0];
  checks.That(found.size() == 1, "one warning", line, text);
  for (const std::string& part : parts)
  {
    checks.That(contains(text, part), part.c_str(), line, text);
  }
}

vtkSmartPointer<vtkImageData> floats(const Value& value, bool cells = true)
{
  return makeImage<vtkFloatArray>(cells ? 25 : 24, cells ? 19 : 18, 1, cells, value);
}

vtkSmartPointer<vtkDataObject> meshOf(const Value& value, bool cells)
{
  vtkNew<vtkImageDataToPointSet> grid;
  grid->SetInputData(floats(value, cells));
  grid->Update();
  return grid->GetOutput();
}

void clamp(vtkTransportSampler* sampler)
{
  sampler->SetNegativeValuesToClamp();
}

void invert(vtkTransportSampler* sampler)
{
  sampler->SetInvertDensity(true);
}

void checkLargest(Checks& checks)
{
  for (const bool cells : { true, false })
  {
    const std::string of = cells ? "cells" : "points";
    expect(checks, warningsOf(floats(withFill(1e20, 42, 1), cells)),
      { "The value 1e+20 of the density array 'Density', in 1 of 432 " + of + " (index 42)",
        "carries 100 % of the mass; if it marks missing data, ValidRange = -1e+299 " },
      __LINE__);
    expect(checks, warningsOf(floats(withFill(9.96921e36, 42, 130), cells)),
      { "The value 9.96921e+36", "in 130 of 432 " + of + " (the first at index 42)",
        "carries 100 % of the mass" },
      __LINE__);
  }
  // 12 is the mean of the others.
  expect(checks, warningsOf(floats(withFill(9999.0, 200, 30))),
    { "The value 9999 ", "in 30 of 432 cells (the first at index 200)", "carries 98" }, __LINE__);
  expect(checks,
    warningsOf(makeImage(25, 19, 1, true, [](vtkIdType i) { return i == 7 ? 2160.0 : 5.0; })),
    { "The value 2160 ", "in 1 of 432 cells (index 7)", "carries 50.1 % of the mass",
      "the next largest is 5 as a density; if it marks missing data, ValidRange = -1e+299 5 leaves "
      "it out" },
    __LINE__);
  // What is largest in the first slices is not so in all.
  expect(checks,
    warningsOf(makeImage(9, 9, 9, true,
      [](vtkIdType i) {
        return i == 3 ? 4e15 : i > 400 && i % 3 == 0 ? 1e30 : 2.0 + static_cast<double>(i % 7);
      })),
    { "The value 1e+30 ", "in 37 of 512 cells (the first at index 402)" }, __LINE__);
  // Of one axis.
  expect(checks, warningsOf(makeImage(40, 1, 1, false, withFill(1e30, 11, 2))),
    { "The value 1e+30 ", "in 2 of 40 points (the first at index 11)" }, __LINE__);
}

void checkOthers(Checks& checks)
{
  const auto none = [&](const std::vector<std::string>& found, int line) {
    checks.That(found.empty(), "no warning", line, found.empty() ? "" : found[0]);
  };
  none(warningsOf(floats(bumpy)), __LINE__);
  none(warningsOf(floats([](vtkIdType) { return 9999.0; })), __LINE__);
  // Masks, with and without a ground; one cell with all mass; several values that are large.
  none(warningsOf(floats([](vtkIdType i) { return i < 100 ? 1.0 : 0.0; })), __LINE__);
  none(warningsOf(floats([](vtkIdType i) { return i < 100 ? 1.0 : 1e-9; })), __LINE__);
  none(warningsOf(floats([](vtkIdType i) { return i == 100 ? 1.0 : 0.0; })), __LINE__);
  none(warningsOf(
         floats([](vtkIdType i) { return i < 5 ? 1e20 + 1e18 * static_cast<double>(i) : 1.0; })),
    __LINE__);
  none(
    warningsOf(makeImage(3, 2, 1, true, [](vtkIdType i) { return i == 0 ? 9.0 : 1.0; })), __LINE__);
  none(warningsOf(makeImage<vtkUnsignedCharArray>(25, 19, 1, true,
         [](vtkIdType i) { return i % 3 ? 255.0 : static_cast<double>(i % 250); })),
    __LINE__);
  none(warningsOf(floats([](vtkIdType i) { return i % 5 ? bumpy(i) : -1.0; }), clamp), __LINE__);
  none(warningsOf(floats([](vtkIdType i) { return i % 5 ? bumpy(i) : -bumpy(i + 3); }), clamp),
    __LINE__);
  none(warningsOf(floats(bumpy), invert), __LINE__);
  none(warningsOf(floats([](vtkIdType i) { return i < 100 ? 1.0 : 0.0; }), invert), __LINE__);
  // Half of the mass, and a little less: 431 cells of 5.
  none(warningsOf(makeImage(25, 19, 1, true, [](vtkIdType i) { return i == 7 ? 2150.0 : 5.0; })),
    __LINE__);
  // Blanked values are none.
  auto image = floats(withFill(1e20, 42, 30));
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  for (vtkIdType i = 0; i < image->GetNumberOfCells(); ++i)
  {
    ghosts->InsertNextValue(i >= 42 && i < 72 ? vtkDataSetAttributes::HIDDENCELL : 0);
  }
  image->GetCellData()->AddArray(ghosts);
  none(warningsOf(image), __LINE__);
  none(warningsOf(image, invert), __LINE__);
  ghosts->FillValue(0);
  ghosts->Modified();
  CHECK(checks, warningsOf(image).size() == 1);
}

void checkClamped(Checks& checks)
{
  expect(checks, warningsOf(floats(withFill(-9999.0, 42, 130)), clamp),
    { "The value -9999 of the density array 'Density', in 130 of 432 cells (the first at index 42)",
      "is 100 % of what NegativeValues = Clamp takes as 0" },
    __LINE__);
  expect(checks,
    warningsOf(makeImage<vtkShortArray>(25, 19, 1, true, withFill(-32768.0, 42, 1)), clamp),
    { "The value -32768 ", "in 1 of 432 cells (index 42)" }, __LINE__);
  expect(checks,
    warningsOf(
      floats([](vtkIdType i) { return i % 9 == 2 ? -1e20
                                 : i % 9 == 5    ? -2.0
                                                 : bumpy(i); }), clamp),
    { "The value -1e+20 ", "in 48 of 432 cells (the first at index 2)" }, __LINE__);
}

void checkInverted(Checks& checks)
{
  expect(checks, warningsOf(floats(withFill(-9999.0, 42, 130)), invert),
    { "The value -9999 of", "in 130 of 432 cells (the first at index 42)", "carries 99" },
    __LINE__);
  expect(checks, warningsOf(floats(withFill(1e20, 42, 130)), invert),
    { "InvertDensity takes the value 1e+20 of the density array 'Density', in 130 of 432 cells "
      "(the "
      "first at index 42), for white, and the next largest is 23" },
    __LINE__);
}

// The same in tiles, and in meshes by the block's own numbers.
void checkBlocks(Checks& checks)
{
  const auto image = floats(withFill(1e20, 42, 30));
  expect(checks, warningsOf(makeTiles(image, 11)),
    { "The value 1e+20 of the density array 'Density', in 30 of 432 cells (the first at index "
      "42)" },
    __LINE__);
  for (const bool cells : { true, false })
  {
    const std::string of = cells ? "cells" : "points";
    expect(checks, warningsOf(meshOf(withFill(1e20, 42, 30), cells)),
      { "The value 1e+20 of the density array 'Density' of the input, in 30 of 432 " + of +
          " (the first at index 42)",
        "carries 100 % of the mass" },
      __LINE__);
    expect(checks, warningsOf(meshOf(withFill(-9999.0, 42, 30), cells), clamp),
      { "The value -9999 of", "in 30 of 432 " + of }, __LINE__);
    expect(checks, warningsOf(meshOf(withFill(1e20, 42, 30), cells), invert),
      { "InvertDensity takes the value 1e+20", "in 30 of 432 " + of }, __LINE__);
    CHECK(checks, warningsOf(meshOf(bumpy, cells)).empty());
  }
  const auto blocks = makeBlocks({ meshOf(bumpy, true), meshOf(withFill(1e20, 42, 3), true),
    meshOf(withFill(1e20, 3, 1), true) });
  expect(checks, warningsOf(blocks),
    { "of the density array 'Density' of the block 2",
      "in 4 of 1296 cells (the first at index 42)" },
    __LINE__);
}

// What the warning says helps: the two numbers after "ValidRange = ".
void checkAdvice(Checks& checks)
{
  const auto follow = [&](vtkDataObject* data, const std::string& name,
                        const std::function<void(vtkTransportSampler*)>& set, int line) {
    const std::vector<std::string> before = warningsOf(data, set);
    const std::string text = before.empty() ? "no warning" : before[0];
    const std::string advice = (name.empty() ? "; if it marks missing data, "
                                             : "; it is the " + name + " of the field data: ") +
      std::string("ValidRange = ");
    const auto at = text.find(advice);
    checks.That(at != std::string::npos, "advice", line, text);
    double range[2] = { 0.0, 0.0 };
    if (at != std::string::npos)
    {
      std::istringstream(text.substr(at + advice.size())) >> range[0] >> range[1];
    }
    const auto found = warningsOf(data, [&](vtkTransportSampler* sampler) {
      if (set)
      {
        set(sampler);
      }
      sampler->SetValidRange(range);
    });
    checks.That(found.empty(), "no warning", line, found.empty() ? "" : found[0]);
  };
  for (const bool cells : { true, false })
  {
    follow(floats(withFill(1e20, 42, 30), cells), "", {}, __LINE__);
    follow(floats(withFill(9999.0, 42, 30), cells), "", {}, __LINE__);
    follow(floats(withFill(-9999.0, 42, 130), cells), "", clamp, __LINE__);
    follow(floats(withFill(-9999.0, 42, 130), cells), "", invert, __LINE__);
    follow(floats(withFill(1e20, 42, 130), cells), "", invert, __LINE__);
    follow(meshOf(withFill(1e20, 42, 30), cells), "", {}, __LINE__);
  }
  // One that is no usual number, and needs all of its digits.
  const auto single = [](vtkIdType i) { return i == 7 ? 2300.0 : 5.123456789012345; };
  follow(makeImage(25, 19, 1, true, single), "", {}, __LINE__);
  for (const char* name : { "_FillValue", "missing_value", "NO_DATA_VALUE" })
  {
    const auto image = floats(withFill(1e20, 42, 30));
    vtkNew<vtkDoubleArray> fill;
    fill->SetName(name);
    fill->InsertNextValue(1e20);
    image->GetFieldData()->AddArray(fill);
    follow(image, name, {}, __LINE__);
    follow(image, name, invert, __LINE__);
    fill->SetValue(0, 1.0); // of another array
    follow(image, "", {}, __LINE__);
  }
  // Threshold leaves them out, too.
  vtkNew<vtkThreshold> threshold;
  threshold->SetInputData(floats(withFill(1e20, 42, 30)));
  threshold->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Density");
  threshold->SetThresholdFunction(vtkThreshold::THRESHOLD_LOWER);
  threshold->SetLowerThreshold(1e10);
  threshold->Update();
  CHECK(checks, threshold->GetOutput()->GetNumberOfCells() == 402);
  CHECK(checks, warningsOf(threshold->GetOutput()).empty());
}

// Once for each change of the density; nothing else that runs a filter warns again.
void checkOnce(Checks& checks)
{
  auto image = floats(withFill(1e20, 42, 30));
  vtkNew<vtkTransportSampler> sampler;
  Messages messages(sampler);
  sampler->SetInputData(image);
  const auto warns = [&]() {
    messages.Clear();
    sampler->Update();
    return messages.Warnings.size();
  };
  CHECK(checks, warns() == 1);
  for (const double time : { 0.25, 0.5, 1.0 })
  {
    sampler->SetFlowTime(time);
    CHECK(checks, warns() == 0);
  }
  image->Modified(); // as at every run in ParaView
  CHECK(checks, warns() == 0);
  sampler->SetTables(1 - sampler->GetTables());
  CHECK(checks, warns() == 0);
  densityOf(image)->SetComponent(0, 0, 5.0);
  densityOf(image)->Modified();
  CHECK(checks, warns() == 1);
  // Another filter, which takes the tables of this one.
  vtkNew<vtkTransportMap> map;
  Messages ofMap(map);
  map->SetInputData(image);
  map->Update();
  const auto isOfValues = [](const std::string& text) {
    return text.find("of the density array") != std::string::npos;
  };
  CHECK(checks, std::count_if(ofMap.Warnings.begin(), ofMap.Warnings.end(), isOfValues) == 1);

  auto morph = makeMorph(floats(bumpy), image);
  Messages ofMorph(morph);
  for (int i = 0; i < 4; ++i)
  {
    morph->SetParameter(0.2 * i);
    morph->SetParticlesPerCell(1 + i / 2); // makes the maps again
    morph->Update();
  }
  expect(checks, ofMorph.Warnings, { "Target: The value 1e+20 of" }, __LINE__);
}

void checkFilters(Checks& checks)
{
  const auto image = floats(withFill(1e20, 42, 30));
  const double box[6] = { 1.0, 23.0, 1.0, 17.0, 0.0, 0.0 };
  const auto points = makePoints(randomCoordinates(box, 30));
  const auto expectOf = [&](vtkAlgorithm* filter, int line) {
    Messages messages(filter);
    filter->Update();
    std::vector<std::string> values;
    for (const std::string& warning : messages.Warnings)
    {
      if (contains(warning, "carries"))
      {
        values.push_back(warning);
      }
    }
    expect(checks, values, { "The value 1e+20 of the density array 'Density', in 30 of 432 cells" },
      line);
  };
  vtkNew<vtkTransportMap> map;
  map->SetInputData(image);
  expectOf(map, __LINE__);
  vtkNew<vtkDensityEqualizingWarp> warp;
  warp->SetInputData(points);
  warp->SetDensityData(image);
  expectOf(warp, __LINE__);
  vtkNew<vtkTransportQuality> quality;
  quality->SetInputData(points);
  quality->SetDensityData(image);
  expectOf(quality, __LINE__);
  for (const int method : { 0, 1 })
  {
    vtkNew<vtkBlueNoiseRelaxation> relaxation;
    relaxation->SetInputData(points);
    relaxation->SetDensityData(image);
    relaxation->SetMethod(method);
    relaxation->SetMaximumIterations(1);
    expectOf(relaxation, __LINE__);
    vtkNew<vtkEqualMassCells> cells;
    cells->SetInputData(points);
    cells->SetDomainData(image);
    cells->SetMeasureToDensity();
    cells->SetShape(method);
    cells->SetResolution(96);
    expectOf(cells, __LINE__);
  }
  auto barycenter = makeBarycenter({ image, image });
  Messages messages(barycenter);
  barycenter->Update();
  expect(checks, messages.Warnings, { "Input 1 of 2: The value 1e+20" }, __LINE__);
}

} // namespace

int TestSuspectValues(int, char*[])
{
  return runChecks({ checkLargest, checkOthers, checkClamped, checkInverted, checkBlocks,
    checkAdvice, checkOnce, checkFilters });
}
