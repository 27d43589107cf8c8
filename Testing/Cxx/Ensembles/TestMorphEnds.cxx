// SPDX-License-Identifier: BSD-3-Clause
// vtkTransportInterpolator at its ends, and vtkTransportBarycenter at a weight of 1: the density of
// the input as it was read, and no jump near them.
#include "BlendTest.h"

#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <functional>
#include <limits>

namespace
{

double relativeL1(const Values& a, const Values& b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    sum += std::abs(a[i] - b[i]);
  }
  return a.size() == b.size() && !a.empty() ? sum / sumOf(b) : HUGE_VAL;
}

// Thin bands, which no kernel resolves, beside a blob.
std::function<double(vtkIdType)> bands(int nx, int ny, double x, double y)
{
  return [=](vtkIdType i) {
    const auto column = static_cast<double>(i % nx);
    const auto row = static_cast<double>(i / nx % ny);
    const double far = (column - x) * (column - x) + (row - y) * (row - y);
    return (i % nx % 5 == 0 ? 1.0 : 0.0) + (far < 30.0 ? 2.0 : 0.0);
  };
}

Values valuesOf(vtkImageData* image)
{
  return imageValues(image, "Density");
}

// The output at both ends, to the bit.
void expectEnds(Checks& checks, vtkTransportInterpolator* morph, const Values& first,
  const Values& last, int line)
{
  for (const double t : { 0.0, 1.0 })
  {
    morph->SetParameter(t);
    const Values found = runDensity(morph);
    std::ostringstream detail;
    detail << "at " << t << ": " << relativeL1(found, t == 0.0 ? first : last);
    checks.That(found == (t == 0.0 ? first : last), "the input", line, detail.str());
    const double mass = massOf(morph->GetDensity());
    const double total = fieldValue(morph->GetDensity(), "TotalMass");
    checks.Near(total, mass, 1e-12 * mass, "mass", line);
  }
}

void checkBits(Checks& checks)
{
  for (const Counts& values :
    { Counts{ 24, 18, 1 }, Counts{ 12, 1, 15 }, Counts{ 9, 8, 7 }, Counts{ 1, 40, 1 } })
  {
    for (const bool cells : { true, false })
    {
      const int nx = std::max(values[0], values[1] > 1 ? values[0] : 2);
      auto source = makeDensity(values, cells, bands(nx, 9, 6.0, 4.0));
      auto target = makeDensity(values, !cells, otherDensity(values[0], values[1], values[2]));
      // Of points, whose dual cells are the cells of the other one.
      vtkImageData* points = cells ? target : source;
      points->SetOrigin(
        values[0] > 1 ? 0.5 : 0.0, values[1] > 1 ? 0.5 : 0.0, values[2] > 1 ? 0.5 : 0.0);
      auto morph = makeMorph(source, target);
      for (const int method : { 0, 1 })
      {
        morph->SetMethod(method);
        for (int kernel = 0; kernel < 4; ++kernel)
        {
          morph->SetKernel(kernel);
          expectEnds(checks, morph, valuesOf(source), valuesOf(target), __LINE__);
        }
      }
    }
  }
}

void checkMassModes(Checks& checks)
{
  auto source = makeDensity({ 14, 11, 1 }, true, bumpy);
  auto target = makeDensity({ 14, 11, 1 }, true, [](vtkIdType i) { return 3.0 + bumpy(i + 5); });
  const double first = massOf(source);
  const double last = massOf(target);
  auto morph = makeMorph(source, target);
  for (const auto& [mode, atFirst, atLast] :
    { std::tuple(vtkTransportBlend::MASS_LINEAR, first, last),
      std::tuple(vtkTransportBlend::MASS_GEOMETRIC, first, last),
      std::tuple(vtkTransportBlend::MASS_SOURCE, first, first),
      std::tuple(vtkTransportBlend::MASS_NORMALIZE, 1.0, 1.0) })
  {
    morph->SetMassMode(mode);
    for (const double t : { 0.0, 1.0 })
    {
      morph->SetParameter(t);
      Values expected = valuesOf(t == 0.0 ? source : target);
      const double factor = (t == 0.0 ? atFirst : atLast) / (t == 0.0 ? first : last);
      std::transform(expected.begin(), expected.end(), expected.begin(),
        [=](double value) { return factor * value; });
      const Values found = runDensity(morph);
      CHECK_NEAR(checks, largestDifference(found, expected), 0.0, 1e-14 * factor * 10.0);
      CHECK(checks, factor != 1.0 || found == expected);
    }
  }
  // Masses that no product or quotient of them holds.
  auto small = makeDensity({ 14, 11, 1 }, true, [](vtkIdType i) { return 1e-300 * bumpy(i); });
  auto large = makeDensity({ 14, 11, 1 }, true, [](vtkIdType i) { return 1e300 * bumpy(i); });
  auto extreme = makeMorph(small, large, 1.0);
  extreme->SetMassModeToSource();
  const Values found = runDensity(extreme);
  CHECK_NEAR(checks, relativeL1(found, valuesOf(small)), 0.0, 1e-12);
}

// A component, the inverse and clamped values of an array of bytes, holes in different ways.
void checkReading(Checks& checks)
{
  const auto image = [](int seed) {
    auto made = makeDensity({ 12, 10, 1 }, true, bumpy);
    vtkNew<vtkUnsignedCharArray> bytes;
    bytes->SetName("Density");
    bytes->SetNumberOfComponents(2);
    bytes->SetNumberOfTuples(120);
    for (vtkIdType i = 0; i < 120; ++i)
    {
      bytes->SetTypedComponent(i, 0, 7);
      bytes->SetTypedComponent(i, 1, static_cast<unsigned char>((37 * i + seed) % 250));
    }
    made->GetCellData()->SetScalars(bytes);
    vtkUnsignedCharArray* flags = made->AllocateCellGhostArray();
    flags->SetValue(17, vtkDataSetAttributes::HIDDENCELL);
    return made;
  };
  auto source = image(3);
  auto target = image(40);
  auto morph = makeMorph(source, target);
  morph->SetComponent(1);
  morph->SetInvertDensity(true);
  const auto read = [](vtkImageData* data) {
    vtkDataArray* bytes = data->GetCellData()->GetArray("Density");
    Values values;
    for (vtkIdType i = 0; i < 120; ++i)
    {
      values.push_back(i == 17 ? 0.0 : 255.0 - bytes->GetComponent(i, 1));
    }
    return values;
  };
  expectEnds(checks, morph, read(source), read(target), __LINE__);

  const double nan = std::numeric_limits<double>::quiet_NaN();
  auto holes = makeDensity({ 12, 10, 1 }, true, [=](vtkIdType i) {
    return i % 7 == 0 ? nan : i % 11 == 0 ? -5.0 : i % 13 == 0 ? 99.0 : 1.0;
  });
  auto gaps = makeMorph(holes, makeDensity({ 12, 10, 1 }, true, bumpy));
  gaps->SetNaNValuesToEmpty();
  gaps->SetNegativeValuesToClamp();
  gaps->SetValidRange(-10.0, 50.0);
  Values expected;
  for (int i = 0; i < 120; ++i)
  {
    expected.push_back(i % 7 == 0 || i % 11 == 0 || i % 13 == 0 ? 0.0 : 1.0);
  }
  CHECK(checks, (gaps->SetParameter(0.0), runDensity(gaps)) == expected);
}

// The mass of the cells [i, i + 1] of a row, spread evenly over each, in the cells from `low` on.
Values overlapsOf(const Values& row, double first, double side, double low, double step, int cells)
{
  Values means(static_cast<std::size_t>(cells), 0.0);
  for (std::size_t i = 0; i < row.size(); ++i)
  {
    const double from = first + side * static_cast<double>(i);
    for (int k = 0; k < cells; ++k)
    {
      const double left = std::max(from, low + step * k);
      const double right = std::min(from + side, low + step * (k + 1));
      means[static_cast<std::size_t>(k)] += std::max(0.0, right - left) / step * row[i];
    }
  }
  return means;
}

void checkOverlaps(Checks& checks)
{
  auto source = makeDensity({ 20, 1, 1 }, true, bumpy);
  auto target = makeDensity({ 9, 1, 1 }, true, [](vtkIdType i) { return 1.0 + bumpy(i); });
  target->SetSpacing(0.7, 1.0, 1.0);
  target->SetOrigin(17.3, 0.0, 0.0);
  const double length = 17.3 + 0.7 * 9;
  for (const int cells : { 0, 13, 100 })
  {
    auto morph = makeMorph(source, target);
    morph->SetDimensions(cells, 0, 0);
    const int count = cells > 0 ? cells : 20;
    const double step = length / count;
    morph->SetParameter(0.0);
    CHECK_NEAR(checks,
      largestDifference(
        runDensity(morph), overlapsOf(valuesOf(source), 0.0, 1.0, 0.0, step, count)),
      0.0, 1e-12);
    morph->SetParameter(1.0);
    CHECK_NEAR(checks,
      largestDifference(
        runDensity(morph), overlapsOf(valuesOf(target), 17.3, 0.7, 0.0, step, count)),
      0.0, 1e-12);
  }
  // In space every mass is there, whatever the places.
  auto volume = makeDensity({ 7, 8, 9 }, false, bumpy);
  auto away = makeDensity({ 5, 4, 11 }, true, bumpy);
  away->SetOrigin(3.21, -2.2, 1.7);
  away->SetSpacing(1.3, 0.4, 0.9);
  auto morph = makeMorph(volume, away);
  for (const double t : { 0.0, 1.0 })
  {
    morph->SetParameter(t);
    morph->Update();
    const double mass = massOf(t == 0.0 ? volume : away);
    CHECK_NEAR(checks, massOf(morph->GetDensity()), mass, 1e-12 * mass);
  }
}

// The difference goes to 0 with the parameter, and nothing is negative or lost on the way.
void checkContinuity(Checks& checks)
{
  for (const int method : { 0, 1 })
  {
    for (const bool cells : { true, false })
    {
      auto source = makeDensity({ 40, 30, 1 }, cells, bands(40, 30, 10.0, 9.0));
      auto target = makeDensity({ 40, 30, 1 }, cells, bands(40, 30, 13.0, 11.0));
      auto morph = makeMorph(source, target);
      morph->SetMethod(method);
      morph->SetKernelToTriangularShapedCloud();
      morph->SetParticlesPerCell(4);
      morph->SetMassModeToNormalize();
      for (const bool isFirst : { true, false })
      {
        Values end = valuesOf(isFirst ? source : target);
        const double mass = sumOf(end);
        std::transform(end.begin(), end.end(), end.begin(), [=](double v) { return v / mass; });
        double before = 0.0;
        for (const double off : { 0.0, 1e-9, 1e-4, 1e-3, 0.01, 0.03, 0.06, 0.0999 })
        {
          morph->SetParameter(isFirst ? off : 1.0 - off);
          const Values found = runDensity(morph);
          const double difference = relativeL1(found, end);
          std::ostringstream detail;
          detail << off << ": " << difference << " after " << before;
          checks.That(difference <= 20.0 * off + 1e-12, "near", __LINE__, detail.str());
          checks.That(difference >= 0.8 * before, "further", __LINE__, detail.str());
          CHECK(checks, *std::min_element(found.begin(), found.end()) >= 0.0);
          CHECK_NEAR(checks, sumOf(found), 1.0, 1e-12);
          before = difference;
        }
        // Nor is there a jump where the input no longer counts.
        const auto at = [&](double off) {
          morph->SetParameter(isFirst ? off : 1.0 - off);
          return runDensity(morph);
        };
        const Values inside = at(0.1 - 1e-7);
        CHECK_NEAR(checks, relativeL1(inside, at(0.1 + 1e-7)), 0.0, 1e-4);
      }
    }
  }
}

// What does not move stays as it was read, near an end.
void checkStanding(Checks& checks)
{
  auto image = makeDensity({ 30, 20, 1 }, true, bands(30, 20, 9.0, 9.0));
  auto morph = makeMorph(image, image, 0.01);
  const double particles = [&]() {
    auto half = makeMorph(image, image, 0.5);
    return relativeL1(runDensity(half), valuesOf(image));
  }();
  CHECK(checks, particles > 0.01);
  CHECK_NEAR(checks, relativeL1(runDensity(morph), valuesOf(image)), 0.1 * particles, 1e-9);
}

void checkWeights(Checks& checks)
{
  auto a = makeDensity({ 14, 11, 1 }, true, bands(14, 11, 3.0, 4.0));
  auto b = makeDensity({ 14, 11, 1 }, true, bumpy);
  auto c = makeDensity({ 14, 11, 1 }, true, smoothDensity(14, 11));
  for (const int method : { 0, 1 })
  {
    const auto run = [&](const Values& weights) {
      auto barycenter = makeBarycenter({ a, b, c }, weights);
      barycenter->SetMethod(method);
      return runDensity(barycenter);
    };
    CHECK(checks, run({ 1, 0, 0 }) == valuesOf(a));
    CHECK(checks, run({ 0, 7, 0 }) == valuesOf(b));
    CHECK(checks, run({ 0, 0, 0.3 }) == valuesOf(c));
    CHECK(checks, relativeL1(run({ 1e-5, 1, 1e-5 }), valuesOf(b)) < 1e-2);
  }
  CHECK(checks, runDensity(makeBarycenter({ a })) == valuesOf(a));
}

} // namespace

int TestMorphEnds(int, char*[])
{
  return runChecks({ checkBits, checkMassModes, checkReading, checkOverlaps, checkContinuity,
    checkStanding, checkWeights });
}
