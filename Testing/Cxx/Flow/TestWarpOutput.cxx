// SPDX-License-Identifier: BSD-3-Clause
// What comes out: the type of the input, its cells, order and data; any geometry of the density;
// pieces and blocks; what is wrong, and what is empty.
#include "BlocksTest.h"
#include "PointSetTest.h"
#include "WarpTest.h"

#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkTable.h"

#include <algorithm>
#include <functional>
#include <limits>

namespace
{

vtkSmartPointer<vtkImageData> flatDensity()
{
  return makeImage(9, 7, 1, true, bumpy); // [0,8] x [0,6], z = 0
}

void addData(vtkPointSet* set)
{
  vtkNew<vtkFloatArray> heat;
  heat->SetName("Heat");
  vtkNew<vtkIdTypeArray> old;
  old->SetName("Displacement");
  for (vtkIdType i = 0; i < set->GetNumberOfPoints(); ++i)
  {
    heat->InsertNextValue(static_cast<float>(0.5 * static_cast<double>(i)));
    old->InsertNextValue(i);
  }
  set->GetPointData()->SetScalars(heat);
  set->GetPointData()->AddArray(old);
  vtkNew<vtkIdTypeArray> label;
  label->SetName("Label");
  for (vtkIdType i = 0; i < set->GetNumberOfCells(); ++i)
  {
    label->InsertNextValue(7 * i);
  }
  set->GetCellData()->AddArray(label);
  set->GetFieldData()->AddArray(label);
}

// The same cells of the same points, which are moved and double; the input is as it was.
void expectMoved(Checks& checks, vtkPointSet* set, int line)
{
  addData(set);
  vtkNew<vtkDensityEqualizingWarp> warp;
  Messages messages(warp);
  warp->SetInputData(set);
  warp->SetDensityData(flatDensity());
  const std::string before = set->GetClassName();
  double corner[3];
  set->GetPoint(0, corner);
  warp->Update();
  vtkPointSet* output = warp->GetOutput();
  checks.That(output->GetClassName() == before, "the type of the input", line);
  checks.That(output->GetNumberOfPoints() == set->GetNumberOfPoints(), "all points", line);
  checks.That(sameCells(output, set), "the same cells", line);
  checks.That(output->GetPoints()->GetDataType() == VTK_DOUBLE, "double points", line);
  vtkPointData* data = output->GetPointData();
  checks.That(data->GetScalars() == set->GetPointData()->GetScalars(), "passed data", line);
  vtkDataArray* moved = data->GetVectors();
  checks.That(moved && moved == data->GetArray("Displacement") &&
      moved->GetNumberOfComponents() == 3 && moved->GetDataType() == VTK_DOUBLE,
    "Displacement", line);
  checks.That(output->GetCellData()->GetArray("Label") != nullptr, "cell data", line);
  checks.That(output->GetFieldData()->GetArray("Label") != nullptr, "field data", line);
  Values way = coordinates(output);
  const Values from = coordinates(set);
  std::transform(way.begin(), way.end(), from.begin(), way.begin(), std::minus<>());
  checks.Near(largestDifference(way, arrayValues(moved)), 0.0, 1e-12, "the way", line);
  checks.That(largestDifference(way, Values(way.size(), 0.0)) > 0.1, "moved", line);
  double after[3];
  set->GetPoint(0, after);
  checks.That(std::equal(corner, corner + 3, after) &&
      set->GetPointData()->GetArray("Displacement")->GetNumberOfComponents() == 1,
    "the input is as it was", line);
  checks.That(messages.Errors.empty() && messages.Warnings.empty(), "no message", line);
}

void checkTypes(Checks& checks)
{
  vtkNew<vtkPoints> points; // single precision
  for (int i = 0; i < 24; ++i)
  {
    points->InsertNextPoint(1.5 + i % 4, 1.5 + i / 4 % 3, i / 12);
  }
  checkPointSetTypes(
    points, [&](vtkPointSet* set, int line) { expectMoved(checks, set, line); }, __LINE__);
}

// Blocks one by one, with one build of the tables.
void checkBlocks(Checks& checks)
{
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(makePoints({ 5, 1, 0 })->GetPoints());
  auto blocks = makeBlocks({ makePoints({ 1, 2, 0, 3, 4, 0 }), grid });
  vtkNew<vtkTrivialProducer> source;
  source->SetOutput(blocks);
  vtkNew<vtkDensityEqualizingWarp> warp;
  Messages messages(warp);
  warp->SetInputConnection(source->GetOutputPort());
  warp->SetDensityData(flatDensity());
  warp->Update();
  auto* output = vtkMultiBlockDataSet::SafeDownCast(warp->GetOutputDataObject(0));
  CHECK(checks, output != nullptr && output->GetNumberOfBlocks() == 2);
  CHECK(checks, outputBlock<vtkPolyData>(warp, 0) != nullptr);
  CHECK(checks, outputBlock<vtkUnstructuredGrid>(warp, 1) != nullptr);
  CHECK(checks, messages.Errors.empty());

  // A block without points of its own is an error, and the others are moved.
  blocks->SetBlock(1, flatDensity());
  source->Modified();
  warp->Update();
  auto* moved = outputBlock<vtkPolyData>(warp, 0);
  CHECK(checks, moved && moved->GetNumberOfPoints() == 2);
  CHECK(checks, messages.IsOneError("a block of type vtkImageData; it must be a vtkPointSet"));
}

// A piece of the points goes where the whole takes it.
void checkPieces(Checks& checks)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(0, 0, 0);
  plane->SetPoint1(8, 0, 0);
  plane->SetPoint2(0, 6, 0);
  plane->SetResolution(8, 6);
  vtkNew<vtkDensityEqualizingWarp> warp;
  warp->SetInputConnection(plane->GetOutputPort());
  warp->SetDensityData(flatDensity());
  warp->UpdatePiece(0, 2, 0);
  plane->UpdatePiece(0, 2, 0);
  CHECK(checks, warp->GetOutput()->GetNumberOfPoints() == plane->GetOutput()->GetNumberOfPoints());
}

// Where the density lies does not matter: an affine map of both moves the points with it.
void checkGeometry(Checks& checks, const double direction[9])
{
  for (const int depth : { 1, 6 })
  {
    auto image = makeImage(8, 6, depth, true, bumpy);
    const double bounds[6] = { 0, 7, 0, 5, 0, depth - 1.0 };
    const std::vector<double> x = randomCoordinates(bounds, 200);
    vtkNew<vtkDensityEqualizingWarp> warp;
    warp->SetInputData(makePoints(x));
    warp->SetDensityData(image);
    const std::vector<double> plain = warpCoordinates(warp);

    auto placed = makeImage(8, 6, depth, true, bumpy);
    placed->SetExtent(3, 10, -2, 3, 5, 4 + depth);
    placed->SetOrigin(11.0, -4.0, 6.0);
    placed->SetSpacing(0.3, 2.5, 1.7);
    placed->SetDirectionMatrix(direction);
    const auto place = [&](const std::vector<double>& from) {
      std::vector<double> to(from.size());
      for (std::size_t i = 0; i < from.size(); i += 3)
      {
        const double index[3] = { from[i] + 3, from[i + 1] - 2, from[i + 2] + 5 };
        placed->TransformContinuousIndexToPhysicalPoint(index, to.data() + i);
      }
      return to;
    };
    warp->SetInputData(makePoints(place(x)));
    warp->SetDensityData(placed);
    CHECK_NEAR(checks, largestDifference(warpCoordinates(warp), place(plain)), 0.0, 1e-8);
  }
}

void checkGeometry(Checks& checks)
{
  const double turned[9] = { 0.6, 0, -0.8, 0, -1, 0, 0.8, 0, 0.6 };
  checkGeometry(checks, turned);
  const double sheared[9] = { 1, 0.7, 0.2, 0, 1, -0.4, 0.3, 0, 1 };
  checkGeometry(checks, sheared);
}

// The array is chosen on port 1.
void checkArray(Checks& checks)
{
  auto image = flatDensity();
  vtkNew<vtkDoubleArray> flat;
  flat->SetName("Flat");
  flat->SetNumberOfTuples(image->GetNumberOfCells());
  flat->Fill(2.0);
  image->GetCellData()->AddArray(flat);
  vtkNew<vtkDensityEqualizingWarp> warp;
  Messages messages(warp);
  warp->SetInputData(makePoints({ 3, 2, 0 }));
  warp->SetDensityData(image);
  warp->SetNumberOfSteps(200);
  CHECK(checks, std::abs(warpCoordinates(warp)[0] - 3.0) > 0.1);
  warp->SetInputArrayToProcess(0, 1, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Flat");
  CHECK_NEAR(checks, warpCoordinates(warp)[0], 3.0, 0.01);
  vtkInformation* choice = warp->GetInputArrayInformation(0);
  CHECK(checks, choice->Get(vtkAlgorithm::INPUT_PORT()) == 1);
  vtkNew<vtkDensityEqualizingWarp> fresh;
  choice = fresh->GetInputArrayInformation(0);
  CHECK(checks, choice->Get(vtkAlgorithm::INPUT_PORT()) == 1);
}

void checkErrors(Checks& checks)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  vtkNew<vtkDensityEqualizingWarp> warp;
  ErrorTest test(checks, warp);
  auto points = makePoints({ 3, 2, 0, 1, 1, 0 });
  addData(points);
  warp->SetInputData(points);
  warp->SetDensityData(flatDensity());
  const auto expect = [&](std::initializer_list<std::string> parts, int line) {
    test.Expect(parts, line);
    checks.That(warp->GetOutput()->IsA("vtkPolyData"), "the type of the input", line);
  };
  for (const double blend : { -0.5, 1.5, nan })
  {
    warp->SetBlend(blend);
    expect({ "Blend is ", "from 0 to 1" }, __LINE__);
  }
  warp->SetBlend(1.0);
  expectFlowErrors(test, warp.Get(), __LINE__);
  CHECK(checks, warp->GetOutput()->IsA("vtkPolyData"));
  warp->SetDensityData(makeImage(6, 5, 1, true, [&](vtkIdType i) { return i == 3 ? nan : 1.0; }));
  expect({ "'Density' has 1 value that is NaN", "first at index 3" }, __LINE__);
  warp->SetDensityData(makeImage(6, 5, 1, true, [](vtkIdType) { return 0.0; }));
  expect({ "'Density' has a total mass of zero" }, __LINE__);
  warp->SetDensityData(makeImage(6, 5, 1, true, [](vtkIdType) { return -1.0; }));
  expect({ "'Density' has 20 negative values", "Clamp" }, __LINE__);
  warp->SetDensityData(flatDensity());
  warp->SetInputArrayToProcess(0, 1, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Missing");
  expect({ "no density array 'Missing'", "Density (cell)" }, __LINE__);
  warp->SetInputArrayToProcess(0, 1, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Density");
  warp->SetInputData(makePoints({ 3, 2, 0, 1, nan, 0, 1, 1, 1, 0, 0, HUGE_VAL }));
  expect({ "input point set has 2 points that are NaN or infinite", "first at index 1" }, __LINE__);
  warp->SetInputData(points);
  test.ExpectNone(__LINE__);
  CHECK(checks, warp->GetOutput()->GetNumberOfPoints() == 2);
}

// An input of another type: the executive's error names the right one.
void checkTypesOfInputs(Checks& checks)
{
  for (const int port : { 0, 1 })
  {
    vtkNew<vtkDensityEqualizingWarp> warp;
    std::string errors;
    vtkNew<vtkCallbackCommand> observer;
    observer->SetClientData(&errors);
    observer->SetCallback([](vtkObject*, unsigned long, void* all, void* text) {
      *static_cast<std::string*>(all) += static_cast<const char*>(text);
    });
    warp->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, observer);
    const vtkSmartPointer<vtkDataObject> points = makePoints({ 3, 2, 0 });
    const vtkSmartPointer<vtkDataObject> image = flatDensity();
    warp->SetInputData(port == 0 ? image : points);
    const vtkSmartPointer<vtkDataObject> table = vtkSmartPointer<vtkTable>::New();
    warp->SetDensityData(port == 0 ? image : table);
    warp->Update();
    CHECK(checks, contains(errors, "input port index " + std::to_string(port)));
    CHECK(checks, contains(errors, port == 0 ? "vtkPointSet is required" : "vtkDataSet"));
    warp->SetInputData(points);
    warp->SetDensityData(image);
    warp->Update();
    CHECK(checks, warp->GetOutput() && warp->GetOutput()->GetNumberOfPoints() == 1);
  }
}

// No points, or no density yet: an empty output of the right type.
void checkEmpty(Checks& checks)
{
  vtkNew<vtkDensityEqualizingWarp> warp;
  Messages messages(warp);
  vtkNew<vtkUnstructuredGrid> nothing;
  warp->SetInputData(nothing);
  warp->SetDensityData(flatDensity());
  warp->Update();
  CHECK(checks, warp->GetOutput()->IsA("vtkUnstructuredGrid"));
  CHECK(checks, warp->GetOutput()->GetNumberOfPoints() == 0);
  vtkNew<vtkImageData> empty;
  warp->SetInputData(makePoints({ 3, 2, 0 }));
  warp->SetDensityData(empty);
  warp->Update();
  CHECK(checks, warp->GetOutput()->IsA("vtkPolyData"));
  CHECK(checks, warp->GetOutput()->GetNumberOfPoints() == 0);
  CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());
}

} // namespace

int TestWarpOutput(int, char*[])
{
  return runChecks({ checkTypes, checkBlocks, checkPieces, checkGeometry, checkArray, checkErrors,
    checkTypesOfInputs, checkEmpty });
}
