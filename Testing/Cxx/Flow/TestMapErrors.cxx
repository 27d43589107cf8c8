// SPDX-License-Identifier: BSD-3-Clause
// What is wrong is reported in one error; the output is then empty, and the next run may succeed.
#include "MapTest.h"

#include <limits>

namespace
{

void checkSampleDimensions(Checks& checks)
{
  vtkNew<vtkTransportMap> map;
  map->SetInputData(makeImage(6, 5, 1, true, bumpy));
  MapErrorTest test(checks, map);
  test.ExpectNone(20, __LINE__);
  map->SetSampleDimensions(4, -1, 0);
  test.Expect("SampleDimensions is 4 -1 0; it must be 0 (as many as the input) or greater along "
              "every axis",
    __LINE__);
  map->SetSampleDimensions(4, 4, 4);
  test.Expect("SampleDimensions is 4 4 4; it must be 0 or 1 along z, where the input has one point",
    __LINE__);
  map->SetSampleDimensions(std::numeric_limits<int>::max(), 1, 1);
  test.Expect(
    "SampleDimensions is 2147483647 1 1; it must be at most 1073741824 along every axis", __LINE__);
  map->SetSampleDimensions(1 << 30, 1 << 30, 1);
  test.Expect("Not enough memory for a map of 1073741824 x 1073741824 samples (see "
              "SampleDimensions): ",
    __LINE__);
  map->SetSampleDimensions(1, 3, 1);
  test.ExpectNone(3, __LINE__);
  map->SetInputData(makeImage(6, 1, 5, false, bumpy));
  test.Expect(
    "SampleDimensions is 1 3 1; it must be 0 or at least 2 along x: points have no axis where",
    __LINE__);
  map->SetSampleDimensions(3, 1, 2);
  test.ExpectNone(6, __LINE__);
}

void checkProperties(Checks& checks)
{
  vtkNew<vtkTransportMap> map;
  map->SetInputData(makeImage(6, 5, 1, true, bumpy));
  MapErrorTest test(checks, map);
  for (const int direction : { -1, 2 })
  {
    map->SetDirection(direction);
    test.Expect("Direction is " + std::to_string(direction) +
        "; it must be 0 (UniformToDensity) or 1 (DensityToUniform)",
      __LINE__);
  }
  map->SetDirection(1);
  expectFlowErrors(test, map.Get(), __LINE__);
  test.ExpectNone(20, __LINE__);
}

void checkInput(Checks& checks)
{
  vtkNew<vtkTransportMap> map;
  map->SetInputData(makeImage(6, 5, 1, true, bumpy));
  MapErrorTest test(checks, map);
  map->SetInputData(makeImage(6, 5, 1, true, [](vtkIdType i) { return i == 3 ? -1.0 : 1.0; }));
  test.Expect("'Density' has 1 negative value; NegativeValues = Clamp takes them as 0", __LINE__);
  map->SetInputData(makeImage(6, 5, 1, true, [](vtkIdType) { return 0.0; }));
  test.Expect("'Density' has a total mass of zero", __LINE__);
  map->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Missing");
  test.Expect("no density array 'Missing'", __LINE__);
  map->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Density");
  map->SetInputData(makeImage(1, 1, 1, true, bumpy));
  test.Expect("one point along every axis", __LINE__);
  map->SetInputData(makeImage(6, 5, 1, true, bumpy));
  test.ExpectNone(20, __LINE__);

  // Nothing upstream yet is no error, whatever is asked for.
  vtkNew<vtkImageData> empty;
  map->SetInputData(empty);
  test.ExpectNone(0, __LINE__);
  CHECK(checks, map->GetOutput()->GetNumberOfPoints() == 0);
  map->SetSampleDimensions(4, 5, 6);
  test.ExpectNone(0, __LINE__);
}

// One number of steps takes some samples to where nothing is.
void checkWarning(Checks& checks)
{
  vtkNew<vtkTransportMap> map;
  Messages messages(map);
  map->SetInputData(makeImage(
    40, 40, 1, false, [](vtkIdType i) { return i % 40 == 7 || i / 40 == 30 ? 1.0 : 0.0; }));
  map->SetIntegratorToEuler();
  map->SetNumberOfSteps(1);
  map->Update();
  CHECK(checks, messages.Errors.empty());
  CHECK(checks, messages.Warnings.size() == 2);
  CHECK(checks,
    !messages.Warnings.empty() &&
      contains(messages.Warnings[0], " of 1600 samples in empty cells moved to the nearest cell"));
  CHECK(checks,
    messages.Warnings.size() == 2 &&
      contains(messages.Warnings[1], " %) are folded: JacobianDeterminant is 0 or negative there"));
}

} // namespace

int TestMapErrors(int, char*[])
{
  return runChecks({ checkSampleDimensions, checkProperties, checkInput, checkWarning });
}
