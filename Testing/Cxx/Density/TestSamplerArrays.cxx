// SPDX-License-Identifier: BSD-3-Clause
// How arrays become densities: numeric types, memory layouts, components, colour, alpha, inversion.
#include "BlocksTest.h"
#include "TestData.h"

#include "vtkAppendFilter.h"
#include "vtkBitArray.h"
#include "vtkCharArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkLongArray.h"
#include "vtkLongLongArray.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkShortArray.h"
#include "vtkSignedCharArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedIntArray.h"
#include "vtkUnsignedLongArray.h"
#include "vtkUnsignedLongLongArray.h"
#include "vtkUnsignedShortArray.h"

#include <algorithm>
#include <cmath>

namespace
{

constexpr int width = 19;
constexpr int height = 11;

using Points = std::vector<double>;

Points pointsOf(vtkImageData* image, int component = -1, bool invert = false)
{
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  sampler->SetNumberOfParticles(400);
  sampler->SetComponent(component);
  sampler->SetInvertDensity(invert);
  return sampleCoordinates(sampler);
}

// The particles of the density that a function gives for each cell.
Points pointsOf(const std::function<double(vtkIdType)>& density)
{
  return pointsOf(makeImage(width, height, 1, false, density));
}

template <class... ArrayTs>
void checkAlike(Checks& checks)
{
  const Points expected = pointsOf(bumpy);
  for (const auto& image : { makeImage<ArrayTs>(width, height, 1, false, bumpy)... })
  {
    checks.That(pointsOf(image) == expected, "same particles", __LINE__,
      image->GetPointData()->GetScalars()->GetClassName());
  }
}

void checkTypes(Checks& checks)
{
  checkAlike<vtkCharArray, vtkSignedCharArray, vtkUnsignedCharArray, vtkShortArray,
    vtkUnsignedShortArray, vtkIntArray, vtkUnsignedIntArray, vtkLongArray, vtkUnsignedLongArray,
    vtkLongLongArray, vtkUnsignedLongLongArray, vtkIdTypeArray, vtkFloatArray,
    vtkSOADataArrayTemplate<float>, vtkSOADataArrayTemplate<int>>(checks);

  const auto bit = [](vtkIdType i) { return i % 3 == 0 ? 1.0 : 0.0; };
  CHECK(checks, pointsOf(makeImage<vtkBitArray>(width, height, 1, false, bit)) == pointsOf(bit));
}

constexpr int luminanceOf = -2;
constexpr int magnitudeOf = -3;

// Value i of an array of many components; the largest is 255.
double colour(vtkIdType i)
{
  return static_cast<double>(i == 0 ? 255 : (i * 67 + i * i % 13) % 256);
}

double luminance(vtkIdType tuple, int components)
{
  const vtkIdType i = tuple * components;
  return (2126 * colour(i) + 7152 * colour(i + 1) + 722 * colour(i + 2)) / 10000;
}

template <class ArrayT>
void checkColours(Checks& checks)
{
  const auto image = [](int components) {
    return makeImage<ArrayT>(width, height, 1, false, colour, components);
  };
  constexpr double rounding = 1e-7;
  // Index
  for (const int components : { 2, 3, 4, 7 })
  {
    const Points expected =
      pointsOf([components](vtkIdType i) { return colour(i * components + 1); });
    CHECK(checks, pointsOf(image(components), 1) == expected);
  }
  // Luminance
  const Points grey = pointsOf([](vtkIdType i) { return luminance(i, 3); });
  CHECK_NEAR(checks, largestDifference(pointsOf(image(3), luminanceOf), grey), 0.0, rounding);
  // Alpha over white, which is the largest value here and that of unsigned char.
  const Points greyAlpha = pointsOf([](vtkIdType i) {
    const double opacity = colour(2 * i + 1) / 255;
    return opacity * colour(2 * i) + (1 - opacity) * 255;
  });
  CHECK_NEAR(checks, largestDifference(pointsOf(image(2), luminanceOf), greyAlpha), 0.0, rounding);
  const Points colourAlpha = pointsOf([](vtkIdType i) {
    const double opacity = colour(4 * i + 3) / 255;
    return opacity * luminance(i, 4) + (1 - opacity) * 255;
  });
  CHECK_NEAR(
    checks, largestDifference(pointsOf(image(4), luminanceOf), colourAlpha), 0.0, rounding);
  // Inverted
  const Points inverted = pointsOf([](vtkIdType i) { return 255 - luminance(i, 3); });
  CHECK_NEAR(
    checks, largestDifference(pointsOf(image(3), luminanceOf, true), inverted), 0.0, rounding);
  const Points invertedAlpha =
    pointsOf([](vtkIdType i) { return colour(4 * i + 3) / 255 * (255 - luminance(i, 4)); });
  CHECK_NEAR(
    checks, largestDifference(pointsOf(image(4), luminanceOf, true), invertedAlpha), 0.0, rounding);
}

// What the output says was read of an array whose component 0, 1 ... of tuple i is value(i, 0) ...
struct Found
{
  double Component;
  double Mass;
};

template <class ArrayT, class Value>
Found readAs(int components, int component, const Value& value, bool invert = false)
{
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(makeImage<ArrayT>(
    width, height, 1, false,
    [&](vtkIdType i) { return value(i / components, static_cast<int>(i % components)); },
    components));
  sampler->SetNumberOfParticles(10);
  sampler->SetComponent(component);
  sampler->SetInvertDensity(invert);
  sampler->Update();
  vtkPolyData* output = sampler->GetOutput();
  return { fieldValue(output, "DensityComponent"), fieldValue(output, "TotalMass") };
}

double massOf(const std::function<double(vtkIdType)>& density)
{
  double mass = 0.0;
  for (vtkIdType i = 0; i < vtkIdType{ width } * height; ++i)
  {
    mass += density(i);
  }
  return mass;
}

// Auto takes the luminance of photographs and the magnitude of all else.
void checkAuto(Checks& checks)
{
  const auto value = [](vtkIdType i, int c) { return static_cast<double>((7 * i + 11 * c) % 23); };
  const auto is = [&](Found found, int component, const std::function<double(vtkIdType)>& density) {
    const double mass = massOf(density);
    CHECK(checks, found.Component == component);
    CHECK_NEAR(checks, found.Mass, mass, 1e-12 * mass);
  };
  for (const int n : { 2, 3, 4, 6, 9 })
  {
    const auto norm = [&](vtkIdType i) {
      double sum = 0.0;
      for (int c = 0; c < n; ++c)
      {
        sum += value(i, c) * value(i, c);
      }
      return std::sqrt(sum);
    };
    is(readAs<vtkDoubleArray>(n, -1, value), magnitudeOf, norm);
    is(readAs<vtkFloatArray>(n, -1, value), magnitudeOf, norm);
    is(readAs<vtkSOADataArrayTemplate<float>>(n, -1, value), magnitudeOf, norm);
    is(readAs<vtkIntArray>(n, -1, value), magnitudeOf, norm);
    is(readAs<vtkSignedCharArray>(n, -1, value), magnitudeOf, norm);
    is(readAs<vtkShortArray>(n, -1, value), magnitudeOf, norm);
    is(readAs<vtkUnsignedLongLongArray>(n, -1, value), magnitudeOf, norm);
    is(readAs<vtkUnsignedCharArray>(n, magnitudeOf, value), magnitudeOf, norm);
    is(readAs<vtkDoubleArray>(n, 1, value), 1, [&](vtkIdType i) { return value(i, 1); });
    double largest = 0.0;
    massOf([&](vtkIdType i) { return largest = std::max(largest, norm(i)); });
    is(readAs<vtkUnsignedCharArray>(n, magnitudeOf, value, true), magnitudeOf,
      [&](vtkIdType i) { return largest - norm(i); });
  }
  const auto grey = [&](vtkIdType i) {
    return (2126 * value(i, 0) + 7152 * value(i, 1) + 722 * value(i, 2)) / 10000;
  };
  is(readAs<vtkUnsignedCharArray>(3, -1, value), luminanceOf, grey);
  is(readAs<vtkUnsignedShortArray>(3, -1, value), luminanceOf, grey);
  is(readAs<vtkDoubleArray>(3, luminanceOf, value), luminanceOf, grey);
  const auto first = [&](vtkIdType i) { return value(i, 0); };
  for (const int component : { -1, luminanceOf, 0 })
  {
    is(readAs<vtkDoubleArray>(1, component, value), 0, first);
  }
  const auto negative = [](vtkIdType i, int) { return i % 2 == 0 ? 3.0 : -3.0; };
  is(readAs<vtkDoubleArray>(1, magnitudeOf, negative), magnitudeOf, [](vtkIdType) { return 3.0; });
}

// Squares past the largest double or below the least one do not harm.
void checkMagnitudes(Checks& checks)
{
  for (const double unit : { 1e-200, 1e-160, 1.0, 1e160, 1e200 })
  {
    const auto value = [unit](vtkIdType i, int c) {
      return i == 0 ? 0.0 : c == 0 ? 3 * unit : c == 1 ? -4 * unit : 0.0;
    };
    const double mass = (width * height - 1) * 5 * unit;
    CHECK_NEAR(checks, readAs<vtkDoubleArray>(3, -1, value).Mass, mass, 1e-12 * mass);
  }
}

// The white of unsigned char is 255 whatever the values are; of other types it is the largest one,
// of the component where that is chosen.
void checkWhite(Checks& checks)
{
  const auto small = [](vtkIdType i) { return 1.0 + static_cast<double>(i % 9); };
  CHECK(checks,
    pointsOf(makeImage<vtkUnsignedCharArray>(width, height, 1, false, small), -1, true) ==
      pointsOf([&](vtkIdType i) { return 255 - small(i); }));
  CHECK(checks,
    pointsOf(makeImage<vtkShortArray>(width, height, 1, false, small), -1, true) ==
      pointsOf([&](vtkIdType i) { return 9 - small(i); }));
  const auto two = [&](vtkIdType i) { return i % 2 == 0 ? 1000.0 : small(i / 2); };
  CHECK(checks,
    pointsOf(makeImage<vtkFloatArray>(width, height, 1, false, two, 2), 1, true) ==
      pointsOf([&](vtkIdType i) { return 9 - small(i); }));
}

// A grey in three channels is that grey, to the last bit, also inverted.
void checkGreys(Checks& checks)
{
  const auto grey = [](vtkIdType i) { return colour(i); };
  const auto three = [](vtkIdType i) { return colour(i / 3); };
  for (const bool invert : { false, true })
  {
    CHECK(checks,
      pointsOf(makeImage<vtkUnsignedCharArray>(width, height, 1, false, three, 3), -1, invert) ==
        pointsOf(makeImage<vtkUnsignedCharArray>(width, height, 1, false, grey), -1, invert));
  }
}

// All white but one pixel, in floating-point colours: rounding must not give negative ink.
void checkWhitePaper(Checks& checks)
{
  const auto paper = [](vtkIdType i) { return i < 3 ? 0.1 : 0.7; };
  vtkNew<vtkTransportSampler> sampler;
  Messages messages(sampler);
  sampler->SetInputData(makeImage<vtkFloatArray>(width, height, 1, false, paper, 3));
  sampler->SetComponent(luminanceOf);
  sampler->InvertDensityOn();
  sampler->Update();
  CHECK(checks, messages.Errors.empty());
  CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == 8192);
}

// A chosen array of the cells is taken although the points have scalars, and by default the points'
// scalars come first.
void checkChoice(Checks& checks)
{
  auto image = makeImage(width, height, 1, false, bumpy);
  const Points ofPoints = pointsOf(image);
  auto cells = makeImage(width, height, 1, true, colour);
  const Points ofCells = pointsOf(cells);
  cells->GetCellData()->GetScalars()->SetName("Other");
  image->GetCellData()->SetScalars(cells->GetCellData()->GetScalars());
  CHECK(checks, pointsOf(image) == ofPoints);
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  sampler->SetNumberOfParticles(400);
  sampler->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Other");
  CHECK(checks, sampleCoordinates(sampler) == ofCells);
  sampler->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, "Other");
  CHECK(checks, sampleCoordinates(sampler) == ofCells);
  sampler->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Density");
  CHECK(checks, sampleCoordinates(sampler) == ofPoints);
}

// Without active scalars, the only array is taken, beside which ghosts do not count.
void checkOnlyArray(Checks& checks)
{
  auto image = makeImage(width, height, 1, false, bumpy);
  const Points expected = pointsOf(image);
  vtkPointData* data = image->GetPointData();
  data->SetActiveScalars(nullptr);
  CHECK(checks, data->GetScalars() == nullptr);
  CHECK(checks, pointsOf(image) == expected);
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfTuples(image->GetNumberOfPoints());
  ghosts->Fill(0);
  data->AddArray(ghosts);
  CHECK(checks, pointsOf(image) == expected);

  auto other = makeImage(width, height, 1, true, bumpy);
  other->GetCellData()->GetScalars()->SetName("Other");
  image->GetCellData()->AddArray(other->GetCellData()->GetScalars());
  vtkNew<vtkTransportSampler> sampler;
  Messages messages(sampler);
  sampler->SetInputData(image);
  sampler->Update();
  CHECK(checks, messages.IsOneError("no active scalars"));
}

// Clamp takes negative values as 0.
void checkClamp(Checks& checks)
{
  const auto mixed = [](vtkIdType i) { return static_cast<double>(i % 7 - 2); };
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(makeImage(width, height, 1, false, mixed));
  sampler->SetNumberOfParticles(400);
  sampler->SetNegativeValuesToClamp();
  CHECK(checks,
    sampleCoordinates(sampler) == pointsOf([&](vtkIdType i) { return std::max(0.0, mixed(i)); }));
}

// Blocks whose densities are active scalars without a name.
void checkNamelessBlocks(Checks& checks)
{
  for (const bool cells : { true, false })
  {
    for (const bool areMeshes : { false, true })
    {
      const auto blocksOf = [&](const char* name) {
        auto blocks = makeTiles(makeImage(9, 7, 5, cells, bumpy), 3);
        for (unsigned int b = 0; b < 2; ++b)
        {
          if (areMeshes)
          {
            vtkNew<vtkAppendFilter> append;
            append->AddInputData(blocks->GetBlock(b));
            append->Update();
            blocks->SetBlock(b, append->GetOutput());
          }
          auto* set = vtkDataSet::SafeDownCast(blocks->GetBlock(b));
          set->GetAttributes(cells ? vtkDataObject::CELL : vtkDataObject::POINT)
            ->GetScalars()
            ->SetName(name);
        }
        return blocks;
      };
      std::vector<Values> found;
      for (const char* name : { "Density", static_cast<const char*>(nullptr) })
      {
        vtkNew<vtkTransportSampler> sampler;
        sampler->SetInputDataObject(blocksOf(name));
        sampler->SetNumberOfParticles(100);
        Messages messages(sampler);
        sampler->Update();
        CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());
        found.push_back(coordinates(sampler->GetOutput()));
      }
      CHECK(checks, found[0].size() == 300);
      CHECK_NEAR(checks, largestDifference(found[0], found[1]), 0.0, 0.0);
    }
  }
}

} // namespace

int TestSamplerArrays(int, char*[])
{
  return runChecks({ checkTypes, checkAuto, checkMagnitudes, checkColours<vtkUnsignedCharArray>,
    checkColours<vtkFloatArray>, checkColours<vtkSOADataArrayTemplate<short>>,
    checkColours<vtkIntArray>, checkWhite, checkGreys, checkWhitePaper, checkChoice, checkOnlyArray,
    checkClamp, checkNamelessBlocks });
}
