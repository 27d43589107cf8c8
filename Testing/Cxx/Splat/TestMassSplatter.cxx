// SPDX-License-Identifier: BSD-3-Clause
// Splat Mass: geometry and association of the output, masses, ghosts, empty inputs, errors.
#include "SplatTest.h"

#include "vtkIntArray.h"
#include "vtkIntegrateAttributes.h"
#include "vtkMatrix3x3.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <limits>

namespace
{

const double box[6] = { -1.0, 3.0, 10.0, 12.0, 5.0, 6.0 };

// Points that reach the bounds of the box.
std::vector<double> pointsOfBox()
{
  std::vector<double> x = randomCoordinates(box, 500);
  x.insert(x.end(), { box[0], box[2], box[4], box[1], box[3], box[5] });
  return x;
}

void checkBounds(Checks& checks)
{
  vtkNew<vtkMassSplatter> splatter;
  splatter->SetInputData(makePoints(pointsOfBox()));
  splatter->SetDimensions(8, 5, 4);
  splatter->Update();
  vtkImageData* output = splatter->GetOutput();
  checkExtent(checks, output, { 0, 7, 0, 4, 0, 3 }, __LINE__);
  CHECK_NEAR(checks, output->GetSpacing()[0], 0.5, 1e-15);
  CHECK_NEAR(checks, output->GetSpacing()[1], 0.4, 1e-15);
  CHECK_NEAR(checks, output->GetSpacing()[2], 0.25, 1e-15);
  CHECK_NEAR(checks, output->GetOrigin()[0], -0.75, 1e-14);
  CHECK_NEAR(checks, output->GetOrigin()[1], 10.2, 1e-14);
  CHECK_NEAR(checks, output->GetOrigin()[2], 5.125, 1e-14);
  CHECK(checks,
    output->GetPointData()->GetScalars() &&
      output->GetPointData()->GetScalars()->GetName() == std::string("Density"));
  CHECK(checks, output->GetCellData()->GetNumberOfArrays() == 0);
  CHECK_NEAR(checks, totalMass(splatter), 502.0, 1e-9);
  const std::vector<double> onPoints = splatValues(splatter);
  CHECK_NEAR(checks, sumOf(onPoints) * 0.05, 502.0, 1e-9);

  splatter->SetAssociationToCells();
  CHECK(checks, splatValues(splatter) == onPoints);
  output = splatter->GetOutput();
  checkExtent(checks, output, { 0, 8, 0, 5, 0, 4 }, __LINE__);
  CHECK_NEAR(checks, output->GetOrigin()[1], 10.0, 1e-14);
  CHECK(checks, output->GetCellData()->GetScalars() != nullptr);
  CHECK(checks, output->GetPointData()->GetNumberOfArrays() == 0);

  vtkNew<vtkIntegrateAttributes> integrate;
  integrate->SetInputConnection(splatter->GetOutputPort());
  integrate->Update();
  CHECK_NEAR(checks, integrate->GetOutput()->GetCellData()->GetArray("Density")->GetComponent(0, 0),
    502.0, 1e-9);

  splatter->DivideByVolumeOff();
  CHECK_NEAR(checks, sumOf(splatValues(splatter)), 502.0, 1e-9);
  CHECK_NEAR(checks, totalMass(splatter), 502.0, 1e-9);

  // One value along an axis: no axis for points, the same numbers.
  splatter->SetDimensions(8, 1, 4);
  const std::vector<double> flat = splatValues(splatter);
  splatter->SetAssociationToPoints();
  CHECK(checks, splatValues(splatter) == flat);
  checkExtent(checks, splatter->GetOutput(), { 0, 7, 0, 0, 0, 3 }, __LINE__);
  CHECK_NEAR(checks, splatter->GetOutput()->GetOrigin()[1], 11.0, 1e-14);
}

// The plane y = 2: the dimension there counts as 1.
void checkPlane(Checks& checks)
{
  std::vector<double> x = pointsOfBox();
  for (std::size_t i = 1; i < x.size(); i += 3)
  {
    x[i] = 2.0;
  }
  vtkNew<vtkMassSplatter> splatter;
  Messages messages(splatter);
  splatter->SetInputData(makePoints(x, true));
  splatter->SetDimensions(8, 77, 4);
  const std::vector<double> values = splatValues(splatter);
  checkExtent(checks, splatter->GetOutput(), { 0, 7, 0, 0, 0, 3 }, __LINE__);
  CHECK_NEAR(checks, splatter->GetOutput()->GetOrigin()[1], 2.0, 0.0);
  CHECK_NEAR(checks, sumOf(values) * 0.5 * 0.25, 502.0, 1e-9);
  CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());
}

void checkReference(Checks& checks)
{
  vtkNew<vtkImageData> reference;
  reference->SetExtent(3, 12, -2, 6, 5, 5);
  reference->SetOrigin(0.5, -1.0, 2.0);
  reference->SetSpacing(0.5, 0.25, 7.0);
  // The image's axes are y and minus x.
  const double turn[9] = { 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0 };
  reference->SetDirectionMatrix(turn);
  vtkNew<vtkMassSplatter> splatter;
  Messages messages(splatter);
  splatter->SetReferenceData(reference);
  splatter->SetKernelToNearestCell();
  for (const int association : { 0, 1 })
  {
    splatter->SetAssociation(association);
    // At a value of each association, index (7, 2).
    const double shift = association == vtkMassSplatter::CELLS ? 0.5 : 0.0;
    double point[3];
    const double index[3] = { 7.0 + shift, 2.0 + shift, 5.0 };
    reference->TransformContinuousIndexToPhysicalPoint(index, point);
    splatter->SetInputData(makePoints({ point[0], point[1], point[2] }));
    const std::vector<double> values = splatValues(splatter);
    vtkImageData* output = splatter->GetOutput();
    checkExtent(checks, output, { 3, 12, -2, 6, 5, 5 }, __LINE__);
    CHECK(checks, output->GetDirectionMatrix()->GetElement(0, 1) == -1.0);
    CHECK(checks, output->GetOrigin()[0] == 0.5 && output->GetSpacing()[1] == 0.25);
    const std::size_t row = association == vtkMassSplatter::CELLS ? 9 : 10;
    CHECK(checks, values.size() == row * (association == vtkMassSplatter::CELLS ? 8 : 9));
    CHECK_NEAR(checks, values[4 * row + 4], 8.0, 1e-12);
    CHECK_NEAR(checks, sumOf(values), 8.0, 1e-12);
  }
  CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());

  // Beyond the border, and off the plane.
  splatter->SetAssociationToCells();
  splatter->SetInputData(makePoints({ 0.5, 0.6, 37.0, 50.0, 0.6, 37.0, 0.5, 0.6, 37.1 }));
  splatter->Update();
  CHECK(checks, messages.Warnings.size() == 1 && contains(messages.Warnings[0], "2 of 3 points"));
  CHECK(checks,
    !messages.Warnings.empty() &&
      contains(messages.Warnings[0], "went to the nearest points of its border"));
  CHECK_NEAR(checks, totalMass(splatter), 3.0, 1e-12);
  splatter->SetBoundaryToDrop();
  splatter->Update();
  CHECK(checks, messages.Warnings.size() == 2 && contains(messages.Warnings[1], "left out"));
  CHECK_NEAR(checks, totalMass(splatter), 1.0, 1e-12);
}

// What Drop loses at the border is not in TotalMass.
void checkDrop(Checks& checks)
{
  vtkNew<vtkMassSplatter> splatter;
  splatter->SetInputData(makePoints({ 0.0, 0.0, 0.0, 4.0, 3.0, 0.0 }));
  splatter->SetDimensions(4, 3, 1);
  splatter->SetBoundaryToDrop();
  splatter->Update();
  CHECK_NEAR(checks, totalMass(splatter), 0.5, 1e-15);
  CHECK_NEAR(checks, sumOf(splatValues(splatter)), 0.5, 1e-15);
  splatter->SetBoundaryToRenormalize();
  splatter->Update();
  CHECK_NEAR(checks, totalMass(splatter), 2.0, 1e-15);
  CHECK_NEAR(checks, splatValues(splatter)[0], 1.0, 1e-15);
}

void checkMasses(Checks& checks)
{
  vtkSmartPointer<vtkPolyData> points =
    makePoints({ 0.5, 0.5, 0.0, 1.5, 0.5, 0.0, 2.5, 1.5, 0.0, 0.0, 0.0, 0.0, 3.0, 2.0, 0.0 });
  vtkNew<vtkIntArray> mass;
  mass->SetName("Weight");
  for (const int value : { 2, -3, 5, 0, 0 })
  {
    mass->InsertNextValue(value);
  }
  points->GetPointData()->AddArray(mass);
  vtkNew<vtkDoubleArray> note;
  note->SetName("Note");
  note->InsertNextValue(8.0);
  points->GetFieldData()->AddArray(note);
  vtkNew<vtkMassSplatter> splatter;
  splatter->SetInputData(points);
  splatter->SetDimensions(3, 2, 1);
  splatter->SetInputArrayToProcess(0, 0, 0, 0, "Weight");
  const std::vector<double> values = splatValues(splatter);
  const std::vector<double> expected{ 2.0, -3.0, 0.0, 0.0, 0.0, 5.0 };
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    CHECK_NEAR(checks, values.at(i), expected[i], 1e-14);
  }
  CHECK_NEAR(checks, totalMass(splatter), 4.0, 1e-14);
  CHECK(checks, splatter->GetOutput()->GetFieldData()->GetArray("Note") != nullptr);
  splatter->SetInputArrayToProcess(0, 0, 0, 0, "None");
  splatter->Update();
  CHECK_NEAR(checks, totalMass(splatter), 5.0, 1e-14);

  splatter->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  Messages messages(splatter);
  splatter->Update();
  CHECK(checks, messages.IsOneError("no active Scalars"));
  points->GetPointData()->SetActiveScalars("Weight");
  splatter->Update();
  CHECK_NEAR(checks, totalMass(splatter), 4.0, 1e-14);
  points->GetPointData()->SetActiveScalars(nullptr);
  splatter->SetInputArrayToProcess(0, 0, 0, 0, "None");

  // Duplicates and hidden points have no mass, whether there is an array or not.
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  for (const int flag : { 0, int{ vtkDataSetAttributes::DUPLICATEPOINT },
         int{ vtkDataSetAttributes::HIDDENPOINT }, 0, 0 })
  {
    ghosts->InsertNextValue(static_cast<unsigned char>(flag));
  }
  points->GetPointData()->AddArray(ghosts);
  splatter->Update();
  CHECK_NEAR(checks, totalMass(splatter), 3.0, 1e-14);
  splatter->SetInputArrayToProcess(0, 0, 0, 0, "Weight");
  splatter->Update();
  CHECK_NEAR(checks, totalMass(splatter), 2.0, 1e-14);
}

void checkEmpty(Checks& checks)
{
  vtkNew<vtkMassSplatter> splatter;
  Messages messages(splatter);
  splatter->SetInputData(makePoints(pointsOfBox()));
  splatter->Update();
  vtkNew<vtkPolyData> none;
  splatter->SetInputData(none);
  splatter->Update();
  CHECK(checks, splatter->GetOutput()->GetNumberOfPoints() == 0);
  vtkNew<vtkImageData> reference;
  reference->SetDimensions(4, 3, 2);
  splatter->SetReferenceData(reference);
  CHECK(checks, splatValues(splatter) == std::vector<double>(24, 0.0));
  CHECK(checks, totalMass(splatter) == 0.0);
  vtkNew<vtkImageData> empty;
  splatter->SetReferenceData(empty);
  splatter->Update();
  CHECK(checks, splatter->GetOutput()->GetNumberOfPoints() == 0);
  CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());
}

void checkErrors(Checks& checks)
{
  vtkNew<vtkMassSplatter> splatter;
  ErrorTest test(checks, splatter);
  vtkSmartPointer<vtkPolyData> points = makePoints(pointsOfBox());
  const auto expect = [&](std::initializer_list<std::string> parts, int line) {
    splatter->Modified();
    test.Expect(parts, line);
  };
  splatter->SetInputData(points);
  splatter->SetDimensions(4, 0, 4);
  expect({ "Dimensions is 4 0 4", "at least 1" }, __LINE__);
  splatter->SetDimensions(4, 4, 2000000000);
  expect({ "Dimensions is 4 4 2000000000", "at most 1073741824" }, __LINE__);
  splatter->SetDimensions(1 << 20, 1 << 20, 1 << 20);
  expect({ "Not enough memory", "Density" }, __LINE__);
  splatter->SetDimensions(1 << 21, 1 << 21, 1 << 22); // 2^64 values
  expect({ "Not enough memory", "2097152 x 2097152 x 4194304 values" }, __LINE__);
  splatter->SetDimensions(4, 4, 4);
  splatter->SetAssociation(2);
  expect({ "Association is 2", "0 (Points) or 1 (Cells)" }, __LINE__);
  splatter->SetAssociation(0);
  splatter->SetKernel(4);
  expect({ "Kernel is 4", "3 (Gaussian)" }, __LINE__);
  splatter->SetKernel(0);
  splatter->SetBoundary(-1);
  expect({ "Boundary is -1", "1 (Drop)" }, __LINE__);
  splatter->SetBoundary(0);
  splatter->SetThreading(9);
  expect({ "Threading is 9" }, __LINE__);
  splatter->SetThreading(0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double radius : { 0.0, -1.0, 10001.0, nan, std::numeric_limits<double>::infinity() })
  {
    splatter->SetRadius(radius);
    expect({ "Radius is ", "above 0 and at most 10000" }, __LINE__);
  }
  splatter->SetRadius(1.0);

  vtkNew<vtkDoubleArray> mass;
  mass->SetName("Mass");
  mass->SetNumberOfValues(points->GetNumberOfPoints());
  mass->FillValue(1.0);
  mass->SetValue(7, nan);
  mass->SetValue(9, HUGE_VAL);
  points->GetPointData()->AddArray(mass);
  vtkNew<vtkDoubleArray> vectors;
  vectors->SetName("Vectors");
  vectors->SetNumberOfComponents(3);
  vectors->SetNumberOfTuples(points->GetNumberOfPoints());
  points->GetPointData()->AddArray(vectors);
  vtkNew<vtkStringArray> names;
  names->SetName("Names");
  names->SetNumberOfValues(points->GetNumberOfPoints());
  points->GetPointData()->AddArray(names);
  splatter->SetInputArrayToProcess(0, 0, 0, 0, "Mass");
  expect({ "'Mass' has 2 values that are NaN or infinite", "index 7" }, __LINE__);
  mass->FillValue(1e307);
  expect({ "'Mass' sums to inf" }, __LINE__);
  vtkSmartPointer<vtkPolyData> heavy = makePoints({ 0.0, 0.0, 0.0, 1e-3, 1e-3, 1e-3 });
  vtkNew<vtkDoubleArray> pair; // which sums to 0
  pair->SetName("Mass");
  pair->InsertNextValue(1e303);
  pair->InsertNextValue(-1e303);
  heavy->GetPointData()->AddArray(pair);
  splatter->SetInputData(heavy);
  expect({ "masses of 2e+303", "past the largest double", "DivideByVolume off" }, __LINE__);
  splatter->SetInputData(points);
  splatter->SetInputArrayToProcess(0, 0, 0, 0, "Vectors");
  expect({ "'Vectors' has 3 components", "must have 1" }, __LINE__);
  splatter->SetInputArrayToProcess(0, 0, 0, 0, "Names");
  expect({ "'Names' is not numeric" }, __LINE__);
  splatter->SetInputArrayToProcess(0, 0, 0, 0, "Wrong");
  expect({ "no mass array 'Wrong'", "Mass, Vectors" }, __LINE__);
  splatter->SetInputArrayToProcess(0, 0, 0, 1, "Mass");
  expect({ "association of the mass array is 1", "0 (points)" }, __LINE__);
  splatter->SetInputArrayToProcess(0, 0, 0, 0, "");

  splatter->SetInputData(makePoints({ 0.0, 0.0, 0.0, nan, 0.0, 0.0 }));
  expect({ "input point set has 1 point", "index 1" }, __LINE__);
  splatter->SetInputData(makePoints({ 1.0, 2.0, 3.0, 1.0, 2.0, 3.0 }));
  expect({ "all at one place", "Reference" }, __LINE__);
  vtkNew<vtkImageData> reference;
  reference->SetDimensions(1, 1, 1);
  splatter->SetReferenceData(reference);
  expect({ "The Reference has one point", "at least one axis" }, __LINE__);
}

// A composite executive gives a filter whatever its blocks are.
void checkBlocks(Checks& checks)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 3, 1);
  blocks->SetBlock(0, image);
  blocks->SetBlock(1, makePoints(pointsOfBox()));
  vtkNew<vtkMassSplatter> splatter;
  Messages messages(splatter);
  splatter->SetInputDataObject(0, blocks);
  splatter->Update();
  CHECK(checks, !messages.Errors.empty() && contains(messages.Errors[0], "vtkImageData"));
}

} // namespace

int TestMassSplatter(int, char*[])
{
  return runChecks({ checkBounds, checkPlane, checkReference, checkDrop, checkMasses, checkEmpty,
    checkErrors, checkBlocks });
}
