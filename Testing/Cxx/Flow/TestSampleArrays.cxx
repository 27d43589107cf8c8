// SPDX-License-Identifier: BSD-3-Clause
// SampleArrays of vtkTransportSampler: the image's values at the particles, against the image's own
// search for cells and a function that is linear in space.
#include "TestData.h"

#include "vtkIdTypeArray.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkTypeUInt64Array.h"
#include "vtkUnsignedCharArray.h"

namespace
{

constexpr vtkIdType count = 700;

double linear(const double* x)
{
  return 3.0 + 2.0 * x[0] - x[1] + 0.5 * x[2];
}

// Cell arrays of the numbers and of the names of the cells, and a point array of linear().
void addArrays(vtkImageData* image)
{
  vtkNew<vtkIdTypeArray> numbers;
  numbers->SetName("Number");
  vtkNew<vtkStringArray> names;
  names->SetName("Name");
  for (vtkIdType i = 0; i < image->GetNumberOfCells(); ++i)
  {
    numbers->InsertNextValue(i);
    names->InsertNextValue("cell " + std::to_string(i));
  }
  image->GetCellData()->AddArray(numbers);
  image->GetCellData()->AddArray(names);
  vtkNew<vtkDoubleArray> heights;
  heights->SetName("Height");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    heights->InsertNextValue(linear(image->GetPoint(i)));
  }
  image->GetPointData()->AddArray(heights);
}

vtkSmartPointer<vtkTransportSampler> makeSampler(vtkImageData* image)
{
  auto sampler = vtkSmartPointer<vtkTransportSampler>::New();
  sampler->SetInputData(image);
  sampler->SetNumberOfParticles(count);
  sampler->SetSeedPatternToRandom();
  return sampler;
}

// A particle's place between the image's points, where a domain of points is larger.
void clampToPoints(vtkImageData* image, double* x)
{
  double index[3];
  image->TransformPhysicalPointToContinuousIndex(x, index);
  const int* extent = image->GetExtent();
  for (int a = 0; a < 3; ++a)
  {
    index[a] = std::clamp(
      index[a], static_cast<double>(extent[2 * a]), static_cast<double>(extent[2 * a + 1]));
  }
  image->TransformContinuousIndexToPhysicalPoint(index, x);
}

void checkValues(Checks& checks, vtkImageData* image, int line)
{
  addArrays(image);
  auto sampler = makeSampler(image);
  sampler->Update();
  vtkPolyData* output = sampler->GetOutput();
  vtkDataArray* numbers = pointArray(output, "Number");
  vtkDataArray* heights = pointArray(output, "Height");
  auto* names = vtkStringArray::SafeDownCast(output->GetPointData()->GetAbstractArray("Name"));
  const bool hasAll = numbers && heights && names && pointArray(output, "Density");
  checks.That(hasAll, "arrays", line);
  if (!hasAll)
  {
    return;
  }
  vtkDataArray* scalars = output->GetPointData()->GetScalars();
  checks.That(scalars && scalars == pointArray(output, "Mass"), "active scalars", line);
  double largest = 0.0;
  bool isInCell = true;
  bool isNamed = true;
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    double x[3];
    output->GetPoint(i, x);
    clampToPoints(image, x);
    largest = std::max(largest, std::abs(heights->GetComponent(i, 0) - linear(x)));
    const auto cell = static_cast<vtkIdType>(numbers->GetComponent(i, 0));
    double bounds[6];
    image->GetCellBounds(cell, bounds);
    for (int a = 0; a < 3; ++a)
    {
      isInCell = isInCell && x[a] >= bounds[2 * a] - 1e-9 && x[a] <= bounds[2 * a + 1] + 1e-9;
    }
    isNamed = isNamed && names->GetValue(i) == "cell " + std::to_string(cell);
  }
  checks.That(largest < 1e-9, "points' values are linear", line, std::to_string(largest));
  checks.That(isInCell, "cells' values", line);
  checks.That(isNamed, "names", line);
}

void checkValues(Checks& checks)
{
  for (const bool cells : { true, false })
  {
    for (const std::array<int, 3>& values :
      { std::array<int, 3>{ 30, 1, 1 }, { 12, 1, 9 }, { 7, 9, 1 }, { 6, 5, 4 } })
    {
      auto image = makeImage(values[0], values[1], values[2], cells, bumpy);
      image->SetOrigin(3.0, -2.0, 7.0);
      image->SetSpacing(0.5, 2.0, -1.5);
      checkValues(checks, image, __LINE__);
    }
  }
}

// The numbers and colours of a photograph.
void checkColours(Checks& checks)
{
  auto image = makeImage(20, 15, 1, false, bumpy);
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetName("Colour");
  colours->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < 300; ++i)
  {
    colours->InsertNextTuple3(
      10.0 * static_cast<double>(i % 20), 10.0 * static_cast<double>(i / 20), 77.0);
  }
  image->GetPointData()->AddArray(colours);
  auto sampler = makeSampler(image);
  sampler->Update();
  vtkDataArray* found = pointArray(sampler->GetOutput(), "Colour");
  CHECK(checks, found && found->GetDataType() == VTK_UNSIGNED_CHAR);
  for (vtkIdType i = 0; found && i < count; ++i)
  {
    double x[3];
    sampler->GetOutput()->GetPoint(i, x);
    CHECK_NEAR(checks, found->GetComponent(i, 0), 10.0 * std::clamp(x[0], 0.0, 19.0), 0.5 + 1e-9);
    CHECK_NEAR(checks, found->GetComponent(i, 1), 10.0 * std::clamp(x[1], 0.0, 14.0), 0.5 + 1e-9);
    CHECK(checks, found->GetComponent(i, 2) == 77.0);
  }
}

// Names that are taken, ghosts, paths, and the property.
void checkLeftOut(Checks& checks)
{
  auto image = makeImage(9, 9, 1, true, bumpy);
  addArrays(image);
  for (const char* name : { "Mass", "SeedId", "Taken", "vtkGhostType" })
  {
    vtkNew<vtkUnsignedCharArray> array;
    array->SetName(name);
    array->SetNumberOfTuples(64);
    array->Fill(0);
    image->GetCellData()->AddArray(array);
  }
  auto seeds = makePoints({ 1, 1, 0, 2, 5, 0, 6, 3, 0 });
  vtkNew<vtkDoubleArray> taken;
  taken->SetName("Taken");
  taken->SetNumberOfTuples(3);
  taken->Fill(5.0);
  seeds->GetPointData()->AddArray(taken);
  auto sampler = makeSampler(image);
  sampler->SetSeedsData(seeds);
  sampler->Update();
  vtkPointData* data = sampler->GetOutput()->GetPointData();
  CHECK(checks, data->GetArray("Taken") == taken);
  CHECK(checks, vtkDoubleArray::SafeDownCast(data->GetArray("Mass")) != nullptr);
  CHECK(checks, vtkIdTypeArray::SafeDownCast(data->GetArray("SeedId")) != nullptr);
  CHECK(checks, !data->HasArray("vtkGhostType") && data->HasArray("Number"));
  sampler->OutputPathsOn();
  sampler->Update();
  CHECK(checks, !sampler->GetOutput()->GetPointData()->HasArray("Number"));
  CHECK(checks, !sampler->GetOutput()->GetCellData()->HasArray("Number"));
  sampler->OutputPathsOff();
  sampler->SampleArraysOff();
  sampler->Update();
  CHECK(checks, !sampler->GetOutput()->GetPointData()->HasArray("Number"));
  CHECK(checks, !sampler->GetOutput()->GetPointData()->HasArray("Density"));
}

// A value that is not finite stays with its cell and between its points.
void checkNotFinite(Checks& checks)
{
  auto image = makeImage(9, 9, 1, true, bumpy);
  vtkNew<vtkDoubleArray> values;
  values->SetName("Value");
  values->SetNumberOfTuples(81);
  values->Fill(1.0);
  values->SetValue(40, std::numeric_limits<double>::quiet_NaN()); // at (4, 4)
  image->GetPointData()->AddArray(values);
  auto sampler = makeSampler(image);
  sampler->SetSeedsData(makePoints({ 3, 4, 0, 4, 5, 0, 3.5, 4.5, 0, 8, 8, 0, 0, 0, 0, 4, 4, 0 }));
  sampler->SetFlowTime(0.0);
  sampler->Update();
  vtkDataArray* found = pointArray(sampler->GetOutput(), "Value");
  for (vtkIdType i = 0; i < 6; ++i)
  {
    CHECK(checks, std::isnan(found->GetComponent(i, 0)) == (i == 2 || i == 5));
  }
}

// The least and the largest values of a type stay what they are, but for the weights' rounding.
template <class Array>
void checkLimits(Checks& checks)
{
  using Value = typename Array::ValueType;
  for (const Value limit : { std::numeric_limits<Value>::min(), std::numeric_limits<Value>::max() })
  {
    auto image = makeImage(9, 9, 1, false, bumpy);
    vtkNew<Array> values;
    values->SetName("Value");
    values->SetNumberOfValues(81);
    for (vtkIdType i = 0; i < 81; ++i)
    {
      values->SetValue(i, limit);
    }
    image->GetPointData()->AddArray(values);
    auto sampler = makeSampler(image);
    sampler->Update();
    auto* found = Array::SafeDownCast(pointArray(sampler->GetOutput(), "Value"));
    for (vtkIdType i = 0; i < count; ++i)
    {
      const double size = std::abs(static_cast<double>(limit));
      CHECK_NEAR(
        checks, static_cast<double>(found->GetValue(i)), static_cast<double>(limit), 1e-15 * size);
    }
  }
}

void checkIntegers(Checks& checks)
{
  checkLimits<vtkTypeInt64Array>(checks);
  checkLimits<vtkTypeUInt64Array>(checks);
  checkLimits<vtkTypeInt32Array>(checks);
  checkLimits<vtkUnsignedCharArray>(checks);
}

void checkErrors(Checks& checks)
{
  auto image = makeImage(9, 9, 1, true, bumpy);
  vtkNew<vtkDoubleArray> shorter;
  shorter->SetName("Short");
  shorter->SetNumberOfTuples(80);
  shorter->Fill(1.0);
  image->GetPointData()->AddArray(shorter);
  auto sampler = makeSampler(image);
  ErrorTest test(checks, sampler);
  test.Expect("The point array 'Short' of the input image has 80 tuples; it must have one for each "
              "of the 81 points",
    __LINE__);
}

} // namespace

int TestSampleArrays(int, char*[])
{
  return runChecks(
    { checkValues, checkColours, checkLeftOut, checkNotFinite, checkIntegers, checkErrors });
}
