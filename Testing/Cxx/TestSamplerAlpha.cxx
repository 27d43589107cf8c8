// SPDX-License-Identifier: BSD-3-Clause
// Alpha over white, the last of two or four components: white is 255 for bytes whatever their
// values are, and for every other type the largest value of the array.
#include "SamplerTest.h"

#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedShortArray.h"

namespace
{

constexpr int width = 19;
constexpr int height = 11;

using Points = std::vector<double>;

Points pointsOf(vtkImageData* image, bool invert)
{
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  sampler->SetNumberOfParticles(400);
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
  return checks.Result();
}
