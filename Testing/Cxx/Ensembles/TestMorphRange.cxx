// SPDX-License-Identifier: BSD-3-Clause
// Arrays of vtkTransportInterpolator that are written anew in the same memory: their modification
// time and range change, and arrays that others hold keep their values.
#include "BlendTest.h"

#include "vtkInformation.h"
#include "vtkInformationStringKey.h"

namespace
{

struct Known
{
  vtkMTimeType Time = 0;
  std::array<double, 2> Range{};
};

// Checks the time and the ranges that an array reports against its values.
void checkRange(Checks& checks, vtkDataArray* array, Known& known, int line)
{
  Values values;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    values.push_back(array->GetComponent(i, 0));
  }
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  std::array<double, 2> range{};
  array->GetRange(range.data());
  std::array<double, 2> finite{};
  array->GetFiniteRange(finite.data());
  const std::array<double, 2> wanted{ *least, *most };
  const std::string name = array->GetName();
  checks.That(range == wanted && finite == wanted, "range", line, name);
  checks.That(range != known.Range, "other values", line, name);
  checks.That(array->GetMTime() > known.Time, "modified", line, name);
  known = { array->GetMTime(), range };
}

void checkRanges(Checks& checks)
{
  auto source = makeDensity({ 30, 20, 1 }, true, smoothDensity(30, 20));
  auto target = makeDensity({ 30, 20, 1 }, true, [](vtkIdType i) { return 5.0 * bumpy(i); });
  auto morph = makeMorph(source, target);
  Known density;
  Known mass;
  Known points;
  for (const double parameter : { 0.0, 0.3, 0.6, 1.0 })
  {
    morph->SetParameter(parameter);
    morph->Update();
    checkRange(checks, morph->GetDensity()->GetCellData()->GetArray("Density"), density, __LINE__);
    checkRange(checks, pointArray(morph->GetParticles(), "Mass"), mass, __LINE__);
    checkRange(checks, morph->GetParticles()->GetPoints()->GetData(), points, __LINE__);
    const Values places = particlePlaces(morph);
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (std::size_t i = 0; i < places.size(); i += 3)
    {
      low = std::min(low, places[i]);
      high = std::max(high, places[i]);
    }
    const double* bounds = morph->GetParticles()->GetBounds();
    CHECK(checks, bounds[0] == low && bounds[1] == high);
  }
}

void checkHeld(Checks& checks)
{
  auto morph = makeMorph(makeDensity({ 30, 20, 1 }, true, smoothDensity(30, 20)),
    makeDensity({ 30, 20, 1 }, true, bumpy), 0.0);
  morph->SetMassModeToLinear();
  morph->Update();
  const std::vector<vtkSmartPointer<vtkDataArray>> held{
    morph->GetDensity()->GetCellData()->GetArray("Density"),
    pointArray(morph->GetParticles(), "Mass"), morph->GetParticles()->GetPoints()->GetData()
  };
  std::vector<Values> before;
  for (vtkDataArray* array : held)
  {
    before.push_back(arrayValues(array));
  }
  morph->SetParameter(1.0);
  morph->Update();
  for (std::size_t i = 0; i < held.size(); ++i)
  {
    checks.That(arrayValues(held[i]) == before[i], "what is held stays", __LINE__,
      held[i]->GetName() ? held[i]->GetName() : "");
  }
  CHECK(checks, densityValues(morph) != before[0]);
}

// What somebody wrote on an array is not on the next one.
void checkMarked(Checks& checks)
{
  auto morph = makeMorph(makeDensity({ 30, 20, 1 }, true, smoothDensity(30, 20)),
    makeDensity({ 30, 20, 1 }, true, bumpy), 0.0);
  morph->Update();
  const auto arraysOf = [&]() {
    return std::array<vtkDataArray*, 2>{ morph->GetDensity()->GetCellData()->GetArray(0),
      pointArray(morph->GetParticles(), "Mass") };
  };
  for (vtkDataArray* array : arraysOf())
  {
    array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), "g");
    array->SetName("Mine");
  }
  morph->SetParameter(1.0);
  morph->Update();
  CHECK(checks, arraysOf()[0] && arraysOf()[0]->GetName() == std::string("Density"));
  CHECK(checks, arraysOf()[1] != nullptr);
  for (vtkDataArray* array : arraysOf())
  {
    CHECK(checks, array && !array->GetInformation()->Has(vtkDataArray::UNITS_LABEL()));
  }
}

} // namespace

int TestMorphRange(int, char*[])
{
  return runChecks({ checkRanges, checkHeld, checkMarked });
}
