// SPDX-License-Identifier: BSD-3-Clause
// The masses of Splat Mass: with points and masses of every type, and wrong ones wherever they are
// in a long array.
#include "SplatTest.h"

#include "vtkBitArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkUnsignedCharArray.h"

#include <limits>

namespace
{

// Whole and half numbers, which every real type holds.
std::vector<double> halves(int count)
{
  std::vector<double> x;
  for (int i = 0; i < count; ++i)
  {
    x.insert(x.end(), { 0.5 * (i * 7 % 17), 0.5 * (i * 5 % 13), 0.5 * (i * 3 % 11) });
  }
  return x;
}

void addMasses(vtkPolyData* points, vtkDataArray* masses)
{
  masses->SetName("Weight");
  points->GetPointData()->AddArray(masses);
}

vtkSmartPointer<vtkImageData> makeReference()
{
  auto reference = makeImage(9, 7, 6, false, bumpy); // one value at each whole number
  reference->GetPointData()->Initialize();
  return reference;
}

// Each point's own mass goes to where it is, whatever the type of the points.
void checkPoints(Checks& checks)
{
  const std::vector<double> x = halves(200);
  vtkNew<vtkDoubleArray> masses;
  for (int i = 0; i < 200; ++i)
  {
    masses->InsertNextValue(0.25 + i);
  }
  vtkNew<vtkMassSplatter> splatter;
  splatter->SetReferenceData(makeReference());
  splatter->SetInputArrayToProcess(0, 0, 0, 0, "Weight");
  const auto valuesOf = [&](vtkPolyData* points) {
    addMasses(points, masses);
    splatter->SetInputData(points);
    return splatValues(splatter);
  };
  for (int kernel = 0; kernel < 4; ++kernel)
  {
    splatter->SetKernel(kernel);
    const std::vector<double> expected = valuesOf(makePoints(x));
    CHECK_NEAR(checks, sumOf(expected), 200 * (0.25 + 99.5), 1e-9);
    const std::vector<double> single = valuesOf(makePoints(x, true));
    CHECK_NEAR(checks, largestDifference(single, expected), 0.0, 1e-12);
    CHECK_NEAR(checks, totalMass(splatter), 200 * (0.25 + 99.5), 1e-9);

    vtkNew<vtkSOADataArrayTemplate<float>> apart;
    apart->SetNumberOfComponents(3);
    apart->SetNumberOfTuples(200);
    for (vtkIdType i = 0; i < 600; ++i)
    {
      apart->SetComponent(i / 3, static_cast<int>(i % 3), x[static_cast<std::size_t>(i)]);
    }
    auto points = makePoints(x);
    points->GetPoints()->SetData(apart);
    CHECK_NEAR(checks, largestDifference(valuesOf(points), expected), 0.0, 1e-12);
  }

  // By hand: two points with masses of their own, in single precision.
  vtkNew<vtkFloatArray> two;
  two->InsertNextValue(3.0f);
  two->InsertNextValue(-0.5f);
  auto pair = makePoints({ 2, 3, 1, 5.5, 4, 0 }, true);
  addMasses(pair, two);
  splatter->SetInputData(pair);
  splatter->SetKernelToCloudInCell();
  const std::vector<double> values = splatValues(splatter);
  CHECK(checks, values.size() == 9 * 7 * 6);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const bool first = i == 2 + 9 * (3 + 7 * 1);
    const bool second = i == 5 + 9 * 4 || i == 6 + 9 * 4;
    CHECK_NEAR(checks, values[i], first ? 3.0 : second ? -0.25 : 0.0, 1e-14);
  }
}

template <class ArrayT>
void checkType(Checks& checks, const std::function<double(int)>& mass)
{
  constexpr int count = 20000; // several ranges
  auto points = makePoints(halves(count), true);
  vtkNew<ArrayT> masses;
  masses->SetNumberOfComponents(1); // of which one that keeps them apart has none by itself
  masses->SetNumberOfValues(count);
  double sum = 0.0;
  for (int i = 0; i < count; ++i)
  {
    masses->SetComponent(i, 0, mass(i));
    sum += mass(i);
  }
  addMasses(points, masses);
  vtkNew<vtkMassSplatter> splatter;
  splatter->SetReferenceData(makeReference());
  splatter->SetInputData(points);
  splatter->SetInputArrayToProcess(0, 0, 0, 0, "Weight");
  const double found = sumOf(splatValues(splatter));
  const std::string name = masses->GetClassName();
  checks.That(std::abs(found - sum) <= 1e-9 * sum, "sum of values", __LINE__, name);
  checks.That(std::abs(totalMass(splatter) - sum) <= 1e-12 * sum, "TotalMass", __LINE__, name);
}

void checkTypes(Checks& checks)
{
  const auto small = [](int i) { return static_cast<double>(1 + i % 7); };
  checkType<vtkDoubleArray>(checks, [](int i) { return 0.1 * (i % 11); });
  checkType<vtkFloatArray>(checks, small);
  checkType<vtkIdTypeArray>(checks, small);
  checkType<vtkUnsignedCharArray>(checks, small);
  checkType<vtkSOADataArrayTemplate<double>>(checks, small);
  checkType<vtkBitArray>(checks, [](int i) { return i % 3 == 0 ? 1.0 : 0.0; });
}

// In cells whose measure has no inverse not even a mass of zero has a density.
void checkTinyCells(Checks& checks)
{
  auto points = makePoints({ 0, 0, 0, 1e-160, 1e-160, 0 });
  vtkNew<vtkDoubleArray> masses;
  masses->SetNumberOfValues(2);
  masses->FillValue(0.0);
  addMasses(points, masses);
  vtkNew<vtkMassSplatter> splatter;
  splatter->SetInputData(points);
  splatter->SetDimensions(1, 1, 1);
  splatter->SetInputArrayToProcess(0, 0, 0, 0, "Weight");
  ErrorTest(checks, splatter).Expect("past the largest double", __LINE__);
  splatter->DivideByVolumeOff();
  CHECK(checks, splatValues(splatter) == std::vector<double>{ 0.0 });
}

// An array that is called None is one; without it that name stands for 1 each.
void checkNone(Checks& checks)
{
  auto points = makePoints(halves(20));
  vtkNew<vtkMassSplatter> splatter;
  splatter->SetInputData(points);
  splatter->SetDimensions(3, 3, 3);
  splatter->SetInputArrayToProcess(0, 0, 0, 0, "None");
  splatter->Update();
  CHECK_NEAR(checks, totalMass(splatter), 20.0, 1e-12);
  vtkNew<vtkDoubleArray> masses;
  masses->SetNumberOfValues(20);
  masses->FillValue(0.5);
  addMasses(points, masses);
  masses->SetName("None");
  points->Modified();
  splatter->Update();
  CHECK_NEAR(checks, totalMass(splatter), 10.0, 1e-12);
}

// All of them are counted, and the first is named, on any number of threads.
void checkWrongMasses(Checks& checks)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr int count = 50000;
  auto points = makePoints(halves(count));
  const auto expect = [&](const std::vector<vtkIdType>& wrong, int line) {
    vtkNew<vtkDoubleArray> masses;
    masses->SetNumberOfValues(count);
    masses->FillValue(1.0);
    for (const vtkIdType i : wrong)
    {
      masses->SetValue(i, i % 2 == 0 ? nan : -HUGE_VAL);
    }
    addMasses(points, masses);
    const std::string number = std::to_string(wrong.size());
    const std::string words = "'Weight' has " + number +
      (wrong.size() == 1 ? " value that is" : " values that are") +
      " NaN or infinite, the first at index " + std::to_string(wrong.front()) + ";";
    for (int threading = 0; threading < 4; ++threading)
    {
      vtkNew<vtkMassSplatter> splatter;
      splatter->SetInputData(points);
      splatter->SetThreading(threading);
      splatter->SetInputArrayToProcess(0, 0, 0, 0, "Weight");
      ErrorTest(checks, splatter).Expect(words, line);
    }
  };
  expect({ 0 }, __LINE__);
  expect({ 8191, 8192 }, __LINE__);
  expect({ 20000 }, __LINE__);
  expect({ 20001, 20002, 35000, count - 1 }, __LINE__);
  expect({ count - 1 }, __LINE__);
}

} // namespace

int TestSplatMasses(int, char*[])
{
  return runChecks({ checkPoints, checkTypes, checkNone, checkTinyCells, checkWrongMasses });
}
