// SPDX-License-Identifier: BSD-3-Clause
// Colours with alpha, the last of two or four components, over white: that is 255 for bytes
// whatever their values are, and for every other type the largest value of the array.
#include "TestData.h"

#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedShortArray.h"

namespace
{

constexpr int luminance = -2;
constexpr int width = 19;
constexpr int height = 11;

using Points = std::vector<double>;

Points pointsOf(vtkImageData* image, bool invert)
{
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  sampler->SetNumberOfParticles(400);
  sampler->SetComponent(luminance);
  sampler->SetInvertDensity(invert);
  return sampleCoordinates(sampler);
}

// From 0 to 64, which is among the values: shares of it are exact.
double level(vtkIdType i)
{
  return static_cast<double>(i == 0 ? 64 : (i * 67 + i * i % 13) % 65);
}

double greyLevel(vtkIdType tuple, int components)
{
  const vtkIdType i = tuple * components;
  return components == 2 ? level(i)
                         : (2126 * level(i) + 7152 * level(i + 1) + 722 * level(i + 2)) / 10000;
}

// Values are levels times a unit; white is a number of levels.
template <class ArrayT>
void checkAlpha(Checks& checks, double unit, double white)
{
  for (const int components : { 2, 4 })
  {
    auto image = makeImage<ArrayT>(
      width, height, 1, false, [unit](vtkIdType i) { return unit * level(i); }, components);
    for (const bool invert : { false, true })
    {
      auto expected = makeImage(width, height, 1, false, [=](vtkIdType i) {
        const double opacity = level((i + 1) * components - 1) / white;
        const double ink = (white - greyLevel(i, components)) * opacity;
        return unit * (invert ? ink : white - ink);
      });
      std::ostringstream detail;
      detail << image->GetPointData()->GetScalars()->GetClassName() << ", " << components
             << " components, largest " << 64 * unit << (invert ? ", inverted" : "");
      const double off = largestDifference(pointsOf(image, invert), pointsOf(expected, false));
      checks.That(off <= 1e-7, "alpha over white", __LINE__, detail.str());
    }
  }
}

// All white and opaque but one pixel, in floating-point colours: rounding of the luminance must not
// give negative ink.
void checkWhitePaper(Checks& checks)
{
  for (const double white : { 0.3, 0.7, 0.81 }) // the last rounds up
  {
    vtkNew<vtkTransportSampler> sampler;
    Messages messages(sampler);
    sampler->SetInputData(makeImage(
      width, height, 1, false, [=](vtkIdType i) { return i < 3 ? 0.1 * white : white; }, 4));
    sampler->SetComponent(luminance);
    sampler->InvertDensityOn();
    sampler->SetNumberOfParticles(50);
    sampler->Update();
    CHECK(checks, messages.Errors.empty());
    CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == 50);
  }
}

// White is the largest value wherever it is in a large array, of the chosen component or of all.
template <class ArrayT>
void checkLargeArray(Checks& checks)
{
  constexpr int wide = 210;
  constexpr int high = 160;
  for (const vtkIdType place : { 5, 17000, wide * high - 1 })
  {
    const auto value = [=](vtkIdType i) {
      return i / 2 == place ? 50.0 - static_cast<double>(i % 2) : static_cast<double>(i % 30);
    };
    auto image = makeImage<ArrayT>(wide, high, 1, false, value, 2);
    vtkNew<vtkTransportSampler> sampler;
    sampler->SetInputData(image);
    sampler->SetNumberOfParticles(1);
    sampler->InvertDensityOn();
    for (const int component : { 0, 1 })
    {
      double mass = 0.0;
      for (vtkIdType i = 0; i < wide * high; ++i)
      {
        mass += 50.0 - component - value(2 * i + component);
      }
      sampler->SetComponent(component);
      sampler->Update();
      CHECK_NEAR(checks, fieldValue(sampler->GetOutput(), "TotalMass"), mass, 1e-9 * mass);
    }
  }
}

// Luminance is of as many components as colours have.
void checkColours(Checks& checks)
{
  for (int components = 1; components <= 6; ++components)
  {
    vtkNew<vtkTransportSampler> sampler;
    Messages messages(sampler);
    sampler->SetInputData(makeImage(width, height, 1, false, bumpy, components));
    sampler->SetComponent(luminance);
    sampler->SetNumberOfParticles(50);
    sampler->Update();
    const bool isColour = components <= 4;
    CHECK(checks, messages.Errors.size() == (isColour ? 0 : 1));
    CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == (isColour ? 50 : 0));
    if (!messages.Errors.empty())
    {
      const std::string last = std::to_string(components - 1);
      CHECK(checks,
        contains(
          messages.Errors[0], "must be -1 (Auto), -3 (magnitude) or an index from 0 to " + last));
    }
  }
}

} // namespace

int TestSamplerAlpha(int, char*[])
{
  Checks checks;
  checkAlpha<vtkFloatArray>(checks, 1.0 / 64.0, 64.0); // colours from 0 to 1
  checkAlpha<vtkDoubleArray>(checks, 1e-3, 64.0);
  checkAlpha<vtkUnsignedShortArray>(checks, 1000.0, 64.0);
  checkAlpha<vtkIntArray>(checks, 3.0, 64.0);
  checkAlpha<vtkSOADataArrayTemplate<float>>(checks, 0.25, 64.0);
  checkAlpha<vtkUnsignedCharArray>(checks, 1.0, 255.0);
  checkAlpha<vtkUnsignedCharArray>(checks, 3.0, 85.0);
  checkWhitePaper(checks);
  checkLargeArray<vtkFloatArray>(checks);
  checkLargeArray<vtkSOADataArrayTemplate<float>>(checks);
  checkColours(checks);
  return checks.Result();
}
