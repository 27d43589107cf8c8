// SPDX-License-Identifier: BSD-3-Clause
// Pairs of densities between which there is no map: one error, which says what is wrong with which
// input.
#include "MapTargetTest.h"

#include <limits>

namespace
{

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void checkGrids(Checks& checks)
{
  auto map = makeMapBetween(makeImage(6, 5, 1, true, bumpy), makeImage(7, 9, 1, true, bumpy));
  MapErrorTest test(checks, map);
  test.ExpectNone(20, __LINE__);
  map->SetTargetData(makeImage(6, 5, 4, true, bumpy));
  test.Expect("Source has the axes x and y, Target has the axes x and y and z; all must have the "
              "same number of dimensions, along the same axes",
    __LINE__);
  map->SetTargetData(makeImage(6, 1, 5, true, bumpy));
  test.Expect("Source has the axes x and y, Target has the axes x and z", __LINE__);
  auto turned = makeImage(6, 5, 1, true, bumpy);
  turned->SetDirectionMatrix(0, -1, 0, 1, 0, 0, 0, 0, 1);
  map->SetTargetData(turned);
  test.Expect("Source and Target have different direction matrices", __LINE__);
  auto above = makeImage(6, 5, 1, true, bumpy);
  above->SetOrigin(0.0, 0.0, 2.0);
  map->SetTargetData(above);
  test.Expect("Source lies at z = 0, Target at z = 2", __LINE__);
  map->SetDirectionToDensityToUniform();
  test.Expect("Target lies at z = 2, Source at z = 0", __LINE__);
  // However far apart and however fine.
  auto far = makeImage(6, 5, 1, true, bumpy);
  far->SetOrigin(1e12, 0.0, 0.0);
  far->SetSpacing(1e-3, 1e-3, 1.0);
  map->SetTargetData(far);
  test.ExpectNone(20, __LINE__);
}

void checkDensities(Checks& checks)
{
  const auto source = makeImage(6, 5, 1, true, bumpy);
  auto map = makeMapBetween(source, source);
  MapErrorTest test(checks, map);
  map->SetTargetData(makeImage(6, 5, 1, true, [](vtkIdType i) { return i == 3 ? nan : 1.0; }));
  test.Expect("Target: The density array 'Density' has 1 value that is NaN", __LINE__);
  map->SetTargetData(makeImage(6, 5, 1, true, [](vtkIdType) { return 0.0; }));
  test.Expect("'Density' has a total mass of zero", __LINE__);
  map->SetTargetData(makeImage(6, 5, 1, true, [](vtkIdType i) { return i == 2 ? -1.0 : 1.0; }));
  test.Expect("'Density' has 1 negative value", __LINE__);
  map->SetTargetData(makeImage(1, 1, 1, true, bumpy));
  test.Expect({ "Target: ", "one point along every axis" }, __LINE__);
  map->SetTargetData(source);
  map->SetInputArrayToProcess(1, 1, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Missing");
  test.Expect({ "Target: ", "no density array 'Missing'" }, __LINE__);
  map->SetInputArrayToProcess(1, 1, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Density");
  test.ExpectNone(20, __LINE__);
  map->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Missing");
  test.Expect({ "Source: ", "no density array 'Missing'" }, __LINE__);
  // Without a target there is one density, which needs no name.
  map->SetTargetConnection(nullptr);
  test.Expect("): The input image has no density array 'Missing'", __LINE__);
}

// Nothing upstream yet, of one input or the other, is no error.
void checkEmpty(Checks& checks)
{
  const auto source = makeImage(6, 5, 1, true, bumpy);
  vtkNew<vtkImageData> empty;
  for (const int direction : { 0, 1 })
  {
    auto map = makeMapBetween(source, empty);
    map->SetDirection(direction);
    MapErrorTest test(checks, map);
    test.ExpectNone(0, __LINE__);
    map->SetInputData(empty);
    map->SetTargetData(source);
    test.ExpectNone(0, __LINE__);
    map->SetInputData(source);
    test.ExpectNone(20, __LINE__);
  }
}

void checkProperties(Checks& checks)
{
  auto map = makeMapBetween(makeImage(6, 5, 1, true, bumpy), makeImage(8, 4, 1, true, bumpy));
  MapErrorTest test(checks, map);
  expectFlowErrors(test, map.Get(), __LINE__);
  map->SetTablesToTiled();
  map->SetMethodToOptimal();
  test.Expect("Tables is Tiled, which does not give the optimal map (Method Optimal)", __LINE__);
  map->SetTablesToAuto();
  map->SetSampleDimensions(1 << 30, 1 << 30, 1);
  test.Expect("Not enough memory for a map of 1073741824 x 1073741824 samples (see "
              "SampleDimensions): ",
    __LINE__);
  map->SetSampleDimensions(3, 0, 0);
  test.ExpectNone(12, __LINE__);
}

// A few cells with nearly all mass do not serve the optimal map: the flow then takes its place.
void checkThinTarget(Checks& checks)
{
  const auto source = makeImage(65, 65, 1, true, [](vtkIdType) { return 1.0; });
  const auto spikes =
    makeImage(65, 65, 1, true, [](vtkIdType i) { return i % 997 == 5 ? 1e6 : 1.0; });
  auto map = makeMapBetween(source, spikes);
  map->SetNumberOfSteps(64);
  map->Update();
  const Values flow = imageValues(map->GetOutput(), "Displacement");
  Messages messages(map);
  map->SetMethodToOptimal();
  map->Update();
  CHECK(checks, messages.Errors.empty() && !messages.Warnings.empty());
  CHECK(checks, contains(messages.Warnings.front(), "Method Optimal did not reach the density"));
  CHECK(checks, imageValues(map->GetOutput(), "Displacement") == flow);
  CHECK(checks, fieldValue(map->GetOutput(), "TransportCostLowerBound") > 0.0);
}

} // namespace

int TestMapTargetErrors(int, char*[])
{
  return runChecks({ checkGrids, checkDensities, checkEmpty, checkProperties, checkThinTarget });
}
