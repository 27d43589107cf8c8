// SPDX-License-Identifier: BSD-3-Clause
// What vtkTransportDistance refuses is one error that names the input; the tables are then empty.
#include "DistanceTest.h"

#include <limits>

namespace
{

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void checkProperties(Checks& checks)
{
  auto distance = makeDistance(makeBells({ { 10, 20 }, { 14, 28 } }));
  ErrorTest test(checks, distance);
  test.ExpectNone(__LINE__);
  for (const int wrong : { -1, 2 })
  {
    const std::string is = " is " + std::to_string(wrong) + "; it must be 0 (";
    distance->SetMethod(wrong);
    test.Expect("Method" + is + "Linearized) or 1 (Certified)", __LINE__);
    distance->SetMethodToLinearized();
    distance->SetMassDifference(wrong);
    test.Expect("MassDifference" + is + "Normalize) or 1 (Error)", __LINE__);
    distance->SetMassDifferenceToNormalize();
  }
  for (const int wrong : { std::numeric_limits<int>::min(), 0, 101 })
  {
    distance->SetNumberOfCoordinates(wrong);
    test.Expect(
      "NumberOfCoordinates is " + std::to_string(wrong) + "; it must be from 1 to 100", __LINE__);
  }
  for (const int right : { 1, 100 })
  {
    distance->SetNumberOfCoordinates(right);
    test.ExpectNone(__LINE__);
  }
  distance->SetThreading(9);
  test.Expect("Threading is 9; it must be 0 (Auto)", __LINE__);
}

// The error comes from the setter, and changes nothing.
void checkNames(Checks& checks)
{
  vtkNew<vtkTransportDistance> distance;
  Messages messages(distance);
  distance->SetInputName(1, "wind");
  for (const int wrong : { -1, 1000000 })
  {
    messages.Clear();
    distance->SetInputName(wrong, "calm");
    CHECK(checks,
      messages.IsOneError("The number of a connection is " + std::to_string(wrong) +
        "; it must be from 0 to 999999"));
  }
  for (const int wrong : { -1, 1000001 })
  {
    messages.Clear();
    distance->SetNumberOfInputNames(wrong);
    CHECK(checks,
      messages.IsOneError("The number of input names is " + std::to_string(wrong) +
        "; it must be from 0 to 1000000"));
  }
  CHECK(checks, distance->GetNumberOfInputNames() == 2);
  CHECK(checks, distance->GetInputName(-1) == std::string());
  CHECK(checks, distance->GetInputName(1) == std::string("wind"));
}

void checkNumber(Checks& checks)
{
  auto distance = makeDistance({ makeBell(10, 20) });
  ErrorTest test(checks, distance);
  test.Expect("There is one density; distances need two or more (more inputs, or OverTime On for "
              "the time steps of one)",
    __LINE__);
  distance->AddInputDataObject(makeBell(14, 28));
  test.ExpectNone(__LINE__);
  // Nothing upstream yet is no error.
  distance->AddInputDataObject(vtkNew<vtkImageData>());
  test.ExpectNone(__LINE__);
  CHECK(checks, isEmpty(distance));
}

// The error names the second input, which `change` makes another one.
void expectRefused(Checks& checks, const std::function<void(vtkImageData*)>& change,
  const std::string& part, int line)
{
  for (const int method : distanceMethods)
  {
    auto distance = makeDistance(makeBells({ { 10, 20 }, { 14, 28 } }), method);
    change(vtkImageData::SafeDownCast(distance->GetInputDataObject(0, 1)));
    ErrorTest test(checks, distance);
    test.Expect({ "Input 2 of 2", part }, line);
    distance->RemoveAllInputs();
    connect(distance, makeBells({ { 10, 20 }, { 14, 28 } }));
    test.ExpectNone(line);
  }
}

void checkInputs(Checks& checks)
{
  const auto refused = [&](const std::function<void(vtkImageData*)>& change,
                         const std::string& part,
                         int line) { expectRefused(checks, change, part, line); };
  refused([](vtkImageData* image) { image->SetOrigin(0.25, 0.0, 0.0); },
    "reaches from 0.25 to 20.25 along x", __LINE__);
  refused(
    [](vtkImageData* image) {
      const double turned[9] = { 0, -1, 0, 1, 0, 0, 0, 0, 1 };
      image->SetDirectionMatrix(turned);
    },
    "different direction matrices", __LINE__);
  refused([](vtkImageData* image) { image->ShallowCopy(unitCells(4, 4, 4)); }, "axes", __LINE__);
  refused([](vtkImageData* image) { densityOf(image)->Fill(0.0); },
    "The density array 'Density' has a total mass of zero", __LINE__);
  refused([](vtkImageData* image) { densityOf(image)->SetComponent(3, 0, -1.0); },
    "1 negative value", __LINE__);
  refused([](vtkImageData* image) { densityOf(image)->SetComponent(3, 0, nan); },
    "1 value that is NaN or infinite", __LINE__);
}

// An input with half as many cells in the same box.
void checkResolutions(Checks& checks)
{
  auto coarse = makeImage(21, 21, 1, true, [](vtkIdType i) {
    return std::exp(
      -std::hypot(static_cast<double>(i % 20) - 10, static_cast<double>(i / 20) - 10));
  });
  coarse->SetSpacing(1.0, 4.0, 1.0);
  auto distance = makeDistance({ coarse, makeBell(26, 20) });
  ErrorTest test(checks, distance);
  test.ExpectNone(__LINE__);
  distance->SetMethodToCertified();
  test.Expect({ "Method Certified needs densities with the same number of cells along each axis",
                "Input 1 of 2 has 20 x 20", "Input 2 of 2 40 x 40", "Linearized takes both" },
    __LINE__);
}

void checkArrays(Checks& checks)
{
  auto distance = makeDistance(makeBells({ { 10, 20 }, { 14, 28 }, { 22, 14 } }));
  ErrorTest test(checks, distance);
  distance->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Density");
  test.ExpectNone(__LINE__);
  densityOf(distance->GetInputDataObject(0, 2))->SetName("Other");
  distance->Modified();
  test.Expect("Input 3 of 3: The input image has no density array 'Density'; it has no point "
              "arrays and Other (cell)",
    __LINE__);
  distance->SetInputName(2, "calm");
  test.Expect("Input 3 of 3 (calm): The input image has no density array", __LINE__);
}

// Inputs of which one has `factor` times the mass of the other.
vtkSmartPointer<vtkTransportDistance> makeUneven(double factor)
{
  return makeDistance({ makeBell(12, 20), makeBell(24, 20, factor) });
}

void checkMasses(Checks& checks)
{
  auto few = makeUneven(1.001);
  ErrorTest test(checks, few);
  test.ExpectNone(__LINE__);
  few->SetMassDifferenceToError();
  test.Expect({ "The masses of the densities differ: they are from ", " in Input 1 of 2 to ",
                " in Input 2 of 2; MassDifference Normalize divides each by its mass" },
    __LINE__);
  auto rounded = makeUneven(1.0 + 1e-9);
  rounded->SetMassDifferenceToError();
  ErrorTest(checks, rounded).ExpectNone(__LINE__);
}

// One warning, while the masses stay as they are.
void checkWarning(Checks& checks)
{
  auto little = makeUneven(1.005);
  Messages ofLittle(little);
  little->Update();
  CHECK(checks, ofLittle.Warnings.empty());
  auto much = makeUneven(4.0);
  Messages ofMuch(much);
  for (const int dimensions : { 1, 2, 3 })
  {
    much->SetNumberOfCoordinates(dimensions);
    much->Update();
  }
  CHECK(checks, ofMuch.Errors.empty() && ofMuch.Warnings.size() == 1);
  CHECK(checks, contains(ofMuch.Warnings[0], "in Input 2 of 2; each is divided by its mass"));
  connect(much, { makeBell(12, 20), makeBell(24, 20, 5.0) });
  much->Update();
  CHECK(checks, ofMuch.Warnings.size() == 2);
}

} // namespace

int TestDistanceErrors(int, char*[])
{
  return runChecks({ checkProperties, checkNames, checkNumber, checkInputs, checkResolutions,
    checkArrays, checkMasses, checkWarning });
}
