// SPDX-License-Identifier: BSD-3-Clause
// What comes out: the type of the input, its cells, order and data; any geometry of the density;
// pieces and blocks; what is wrong, and what is empty.
#include "BlocksTest.h"
#include "PointSetTest.h"
#include "RelaxationTest.h"

#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"

#include <limits>

namespace
{

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

vtkSmartPointer<vtkImageData> flatDensity()
{
  return makeImage(9, 7, 1, true, bumpy); // [0,8] x [0,6], z = 0
}

void addData(vtkPointSet* set)
{
  vtkNew<vtkFloatArray> heat;
  heat->SetName("Heat");
  for (vtkIdType i = 0; i < set->GetNumberOfPoints(); ++i)
  {
    heat->InsertNextValue(static_cast<float>(0.5 * static_cast<double>(i)));
  }
  set->GetPointData()->SetScalars(heat);
  vtkNew<vtkIdTypeArray> label;
  label->SetName("Label");
  for (vtkIdType i = 0; i < set->GetNumberOfCells(); ++i)
  {
    label->InsertNextValue(7 * i);
  }
  set->GetCellData()->AddArray(label);
  set->GetFieldData()->AddArray(label);
  vtkNew<vtkIdTypeArray> old;
  old->SetName("Energy");
  old->InsertNextValue(-1);
  set->GetFieldData()->AddArray(old);
}

// The same cells of the same points, which are moved and double; the input is as it was.
void expectRelaxed(Checks& checks, vtkPointSet* set, int line)
{
  addData(set);
  const Values before = coordinates(set);
  for (int method = 0; method < 2; ++method)
  {
    auto relaxation = makeRelaxation(method, set, flatDensity());
    Messages messages(relaxation);
    const Values after = relaxedCoordinates(relaxation);
    vtkPointSet* output = relaxation->GetOutput();
    checks.That(output->GetDataObjectType() == set->GetDataObjectType(), "the type", line);
    checks.That(sameCells(output, set), "the same cells", line);
    checks.That(output->GetPoints()->GetDataType() == VTK_DOUBLE, "double points", line);
    checks.That(after.size() == before.size() && largestDifference(after, before) > 1e-3,
      "all points moved", line);
    checks.That(output->GetPointData()->GetScalars() == set->GetPointData()->GetScalars(),
      "point data", line);
    checks.That(output->GetCellData()->GetArray("Label") == set->GetCellData()->GetArray("Label"),
      "cell data", line);
    checks.That(output->GetFieldData()->GetArray("Label") != nullptr, "field data", line);
    expectEnergy(checks, relaxation, line);
    checks.That(energies(relaxation)[0] > energies(relaxation).back(), "a lower energy", line);
    checks.That(coordinates(set) == before && fieldValue(set, "Energy") == -1.0,
      "the input is as it was", line);
    checks.That(messages.Errors.empty() && messages.Warnings.empty(), "no message", line);
  }
}

void checkTypes(Checks& checks)
{
  vtkNew<vtkPoints> points; // single precision
  for (int i = 0; i < 24; ++i)
  {
    points->InsertNextPoint(1.5 + i % 4, 1.5 + 0.1 * (i / 12) + i / 4 % 3, 0.0);
  }
  checkPointSetTypes(
    points, [&](vtkPointSet* set, int line) { expectRelaxed(checks, set, line); }, __LINE__);
}

void checkBlocks(Checks& checks)
{
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(makePoints({ 5, 1, 0 })->GetPoints());
  auto blocks = makeBlocks({ makePoints({ 1, 2, 0, 3, 4, 0 }), grid });
  vtkNew<vtkTrivialProducer> source;
  source->SetOutput(blocks);
  auto relaxation = makeRelaxation(0, nullptr, flatDensity());
  Messages messages(relaxation);
  relaxation->SetInputConnection(source->GetOutputPort());
  relaxation->Update();
  CHECK(checks, outputBlock<vtkPolyData>(relaxation, 0) != nullptr);
  CHECK(checks, outputBlock<vtkUnstructuredGrid>(relaxation, 1) != nullptr);
  CHECK(checks, messages.Errors.empty());
  blocks->SetBlock(1, flatDensity());
  source->Modified();
  relaxation->Update();
  auto* moved = outputBlock<vtkPolyData>(relaxation, 0);
  CHECK(checks, moved && moved->GetNumberOfPoints() == 2);
  CHECK(checks, messages.IsOneError("a block of type vtkImageData; it must be a vtkPointSet"));
}

void checkPieces(Checks& checks)
{
  auto relaxation = makeRelaxation(0, makePoints({ 1, 2, 0, 3, 4, 0 }), flatDensity());
  expectOnePiece(checks, relaxation, __LINE__);
}

// The points of a density's cells, some in a row, on a grid of whole numbers about the origin.
Values someIndices(int nx, int ny, int nz)
{
  const double bounds[6] = { 0, nx - 1.0, 0, ny - 1.0, 0, nz - 1.0 };
  return randomCoordinates(bounds, 60);
}

// Where the density lies does not matter: neither its place nor its directions nor the unit, nor
// which coordinate plane it lies in.
void checkGeometry(Checks& checks, int nx, int ny, int nz, int method)
{
  auto image = makeImage(nx, ny, nz, true, bumpy);
  const Values x = someIndices(nx, ny, nz);
  const Values plain = relaxedCoordinates(makeRelaxation(method, makePoints(x), image));
  CHECK(checks, largestDifference(plain, x) > 0.01);

  auto placed = makeImage(nx, ny, nz, true, bumpy);
  const double turned[9] = { 0.6, 0, -0.8, 0, -1, 0, 0.8, 0, 0.6 };
  placed->SetExtent(3, 2 + nx, -2, ny - 3, 5, 4 + nz);
  placed->SetOrigin(11.0, -4.0, 6.0);
  placed->SetSpacing(0.3, 0.3, 0.3);
  placed->SetDirectionMatrix(turned);
  const auto place = [&](const Values& from) {
    Values to(from.size());
    for (std::size_t i = 0; i < from.size(); i += 3)
    {
      const double index[3] = { from[i] + 3, from[i + 1] - 2, from[i + 2] + 5 };
      placed->TransformContinuousIndexToPhysicalPoint(index, to.data() + i);
    }
    return to;
  };
  auto relaxation = makeRelaxation(method, makePoints(place(x)), placed);
  Messages messages(relaxation);
  CHECK_NEAR(checks, largestDifference(relaxedCoordinates(relaxation), place(plain)), 0.0, 1e-6);
  CHECK(checks, messages.Warnings.empty());
  expectEnergy(checks, relaxation, __LINE__);

  // Ways are physical: another spacing along one axis is another relaxation.
  auto narrow = makeImage(nx, ny, nz, true, bumpy);
  narrow->SetSpacing(nx > 1 ? 0.25 : 1.0, nx > 1 ? 1.0 : 0.25, 1.0);
  Values squeezed = x;
  for (std::size_t i = nx > 1 ? 0 : 1; i < x.size(); i += 3)
  {
    squeezed[i] *= 0.25;
  }
  relaxation = makeRelaxation(method, makePoints(squeezed), narrow);
  relaxation->Update();
  expectEnergy(checks, relaxation, __LINE__);
}

void checkGeometry(Checks& checks)
{
  for (int method = 0; method < 2; ++method)
  {
    checkGeometry(checks, 8, 6, 1, method);
    checkGeometry(checks, 8, 1, 6, method);
    checkGeometry(checks, 1, 8, 6, method);
  }
  checkGeometry(checks, 8, 6, 5, vtkBlueNoiseRelaxation::GAUSSIAN_BLUE_NOISE);
}

// The same values on cells, and on the points in their middles.
void checkCellsAndPoints(Checks& checks)
{
  const double bounds[6] = { 1.0, 5.5, 2.0, 16.0, 3.0, 9.25 };
  auto points = makePoints(randomCoordinates(bounds, 80));
  std::vector<Values> found;
  for (vtkImageData* image : makeCellsAndPoints())
  {
    found.push_back(relaxedCoordinates(makeRelaxation(0, points, image)));
  }
  CHECK_NEAR(checks, largestDifference(found[0], found[1]), 0.0, 1e-6);
}

// What is wrong with a density is found without its tables, too.
void checkDensityErrors(Checks& checks, int method)
{
  auto relaxation = makeRelaxation(method, makePoints({ 3, 2, 0, 1, 1, 0 }), flatDensity());
  ErrorTest test(checks, relaxation);
  const auto expect = [&](
                        vtkImageData* density, std::initializer_list<std::string> parts, int line) {
    relaxation->SetDensityData(density);
    test.Expect(parts, line);
    checks.That(relaxation->GetOutput()->IsA("vtkPolyData"), "the type of the input", line);
  };
  const auto image = [](const std::function<double(vtkIdType)>& value) {
    return makeImage(6, 5, 1, true, value);
  };
  expect(image([](vtkIdType i) { return i == 3 ? nan : 1.0; }),
    { "'Density' has 1 value that is NaN", "first at index 3" }, __LINE__);
  expect(image([](vtkIdType) { return 0.0; }), { "'Density' has a total mass of zero" }, __LINE__);
  auto negative = image([](vtkIdType) { return -1.0; });
  expect(negative, { "'Density' has 20 negative values", "Clamp" }, __LINE__);
  relaxation->SetNegativeValuesToClamp();
  expect(negative, { "'Density' has a total mass of zero" }, __LINE__);
  relaxation->SetNegativeValuesToError();
  relaxation->SetComponent(1);
  expect(flatDensity(), { "Component is 1" }, __LINE__);
  relaxation->SetComponent(-1);
  auto heavy = image([](vtkIdType) { return 1e300; });
  heavy->SetSpacing(1e5, 1e5, 1.0);
  expect(heavy, { "a total mass past the largest double" }, __LINE__);
  expect(makeImage(6, 1, 1, true, bumpy),
    { "The density has 1 dimension; Relax Blue Noise needs 2 or 3" }, __LINE__);
  expect(makeImage(1, 1, 1, false, bumpy), { "axis" }, __LINE__);
  relaxation->SetInputArrayToProcess(0, 1, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Missing");
  expect(flatDensity(), { "no density array 'Missing'", "Density (cell)" }, __LINE__);
  relaxation->SetInputArrayToProcess(0, 1, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Density");
  relaxation->SetDensityData(flatDensity());
  test.ExpectNone(__LINE__);

  // Ink, of which the largest value has to be known.
  relaxation->SetDensityData(makeImage(6, 5, 1, true, [](vtkIdType) { return 3.0; }));
  relaxation->InvertDensityOn();
  test.Expect("'Density' has a total mass of zero", __LINE__);
  relaxation->SetDensityData(flatDensity());
  test.ExpectNone(__LINE__);
}

void checkErrors(Checks& checks)
{
  for (int method = 0; method < 2; ++method)
  {
    checkDensityErrors(checks, method);
  }
  auto points = makePoints({ 3, 2, 0, 1, 1, 0 });
  addData(points);
  auto relaxation = makeRelaxation(0, points, flatDensity());
  ErrorTest test(checks, relaxation);
  relaxation->SetMethod(2);
  test.Expect("Method is 2; it must be 0 (GaussianBlueNoise) or 1 (OptimalTransport)", __LINE__);
  relaxation->SetMethodToGaussianBlueNoise();
  relaxation->SetMaximumIterations(-1);
  test.Expect("MaximumIterations is -1; it must be at least 0", __LINE__);
  relaxation->SetMaximumIterations(3);
  for (const double tolerance : { -1e-9, 1.0, 7.0, nan })
  {
    relaxation->SetTolerance(tolerance);
    test.Expect({ "Tolerance is ", "it must be at least 0 and less than 1" }, __LINE__);
  }
  relaxation->SetTolerance(0.0);
  relaxation->SetThreading(9);
  test.Expect("Threading is 9; it must be 0 (Auto)", __LINE__);
  relaxation->SetThreadingToAuto();
  relaxation->SetDensityData(makeImage(5, 4, 3, true, bumpy));
  test.ExpectNone(__LINE__);
  relaxation->SetMethodToOptimalTransport();
  test.Expect("The density has 3 dimensions; Method OptimalTransport needs 2 (use "
              "GaussianBlueNoise)",
    __LINE__);
  relaxation->SetDensityData(flatDensity());
  relaxation->SetInputData(makePoints({ 3, 2, 0, 1, nan, 0, 1, 1, 1, 0, 0, HUGE_VAL }));
  test.Expect(
    { "input point set has 2 points that are NaN or infinite", "first at index 1" }, __LINE__);
  relaxation->SetInputData(points);
  test.ExpectNone(__LINE__);
  CHECK(checks, relaxation->GetOutput()->GetNumberOfPoints() == 2);
}

// No points, or no density yet: an empty output of the right type.
void checkEmpty(Checks& checks)
{
  for (int method = 0; method < 2; ++method)
  {
    vtkNew<vtkUnstructuredGrid> nothing;
    auto relaxation = makeRelaxation(method, nothing, flatDensity());
    Messages messages(relaxation);
    relaxation->Update();
    CHECK(checks, relaxation->GetOutput()->IsA("vtkUnstructuredGrid"));
    CHECK(checks, relaxation->GetOutput()->GetNumberOfPoints() == 0);
    vtkNew<vtkImageData> empty;
    relaxation->SetInputData(makePoints({ 3, 2, 0 }));
    relaxation->SetDensityData(empty);
    relaxation->Update();
    CHECK(checks, relaxation->GetOutput()->IsA("vtkPolyData"));
    CHECK(checks, relaxation->GetOutput()->GetNumberOfPoints() == 0);
    CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());
  }
}

} // namespace

int TestBlueNoiseRelaxation(int, char*[])
{
  return runChecks({ checkTypes, checkBlocks, checkPieces, checkGeometry, checkCellsAndPoints,
    checkErrors, checkEmpty });
}
