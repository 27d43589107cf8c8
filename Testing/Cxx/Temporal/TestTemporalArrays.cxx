// SPDX-License-Identifier: BSD-3-Clause
// The other arrays of the steps move along in vtkTransportTemporalInterpolator: floating-point
// values are means by mass, integers and texts are those of one of the steps.
#include "TemporalTest.h"

#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkStringArray.h"

namespace
{

// Adds an array of the cells, whose values come from a function of the cell's number.
template <class ArrayT, class Value>
void addCells(vtkImageData* image, const char* name, const Value& value)
{
  vtkNew<ArrayT> array;
  array->SetName(name);
  for (vtkIdType i = 0; i < image->GetNumberOfCells(); ++i)
  {
    array->InsertNextValue(value(i));
  }
  image->GetCellData()->AddArray(array);
}

// A blob with arrays: where a cell is in it along x, a constant that the step has, a label, a text.
vtkSmartPointer<vtkImageData> makeLabelled(double x, double y, float constant, int label)
{
  auto image = makeBlob(x, y);
  addCells<vtkDoubleArray>(
    image, "Offset", [=](vtkIdType i) { return static_cast<double>(i % blobSide) + 0.5 - x; });
  addCells<vtkFloatArray>(image, "Constant", [=](vtkIdType) { return constant; });
  addCells<vtkIntArray>(image, "Label", [=](vtkIdType) { return label; });
  addCells<vtkStringArray>(image, "Text", [=](vtkIdType) { return std::to_string(label); });
  return image;
}

Images labelledSteps()
{
  return { makeLabelled(12, 14, 1.0F, 3), makeLabelled(28, 22, 2.0F, 7) };
}

// What is at a place of the blob is there on the way, too: far from there in both steps.
void checkMoving(Checks& checks)
{
  ImageSeries series(labelledSteps(), { 0.0, 1.0 });
  auto filter = makeInterpolator(series);
  const Values density = densityAt(filter, 0.5);
  vtkImageData* image = filter->GetDensity();
  const Values offsets = imageValues(image, "Offset");
  const Values constants = imageValues(image, "Constant");
  CHECK(checks, offsets.size() == density.size() && constants.size() == density.size());
  for (std::size_t i = 0; i < offsets.size(); ++i)
  {
    const double truth = static_cast<double>(i % blobSide) + 0.5 - 20.0;
    CHECK(checks, density[i] < 0.1 || std::abs(offsets[i] - truth) < 0.6);
    CHECK_NEAR(checks, constants[i], 1.5, 1e-6);
  }
  CHECK(checks, image->GetCellData()->GetArray("Constant")->GetDataType() == VTK_FLOAT);
}

// There is nothing between two labels.
void checkLabels(Checks& checks)
{
  ImageSeries series(labelledSteps(), { 0.0, 1.0 });
  auto filter = makeInterpolator(series);
  for (const double time : { 0.25, 0.75 })
  {
    const Values density = densityAt(filter, time);
    vtkCellData* cells = filter->GetDensity()->GetCellData();
    auto* labels = vtkIntArray::SafeDownCast(cells->GetArray("Label"));
    auto* texts = vtkStringArray::SafeDownCast(cells->GetAbstractArray("Text"));
    CHECK(checks, labels != nullptr && texts != nullptr);
    const int wanted = time < 0.5 ? 3 : 7; // has three quarters of the mass everywhere
    for (vtkIdType i = 0; labels && texts && i < labels->GetNumberOfValues(); ++i)
    {
      const int label = labels->GetValue(i);
      CHECK(checks, density[static_cast<std::size_t>(i)] < 0.05 || label == wanted);
      CHECK(checks, label == 3 || label == 7);
      CHECK(checks, texts->GetValue(i) == std::to_string(label));
    }
  }
}

// At a step all arrays are those of the input.
void checkSteps(Checks& checks)
{
  const Images steps = labelledSteps();
  ImageSeries series(steps, { 0.0, 1.0 });
  auto filter = makeInterpolator(series);
  for (const std::size_t step : { 1, 0 })
  {
    filter->UpdateTimeStep(static_cast<double>(step));
    for (const char* name : { "Offset", "Constant", "Label" })
    {
      CHECK(checks, imageValues(filter->GetDensity(), name) == imageValues(steps[step], name));
    }
  }
}

// Without AdvectArrays there is the density alone; that needs no new map.
void checkOff(Checks& checks)
{
  ImageSeries series(labelledSteps(), { 0.0, 1.0 });
  auto filter = makeInterpolator(series);
  filter->AdvectArraysOff();
  for (const double time : { 0.0, 0.5 })
  {
    filter->UpdateTimeStep(time);
    CHECK(checks, filter->GetDensity()->GetCellData()->GetNumberOfArrays() == 1);
  }
  filter->AdvectArraysOn();
  filter->Update();
  CHECK(checks, filter->GetDensity()->GetCellData()->GetNumberOfArrays() == 5);
  CHECK(checks, filter->GetNumberOfMaps() == 1);
}

// An array that one of both steps lacks, or has with another type.
void checkMissing(Checks& checks)
{
  const Images steps = labelledSteps();
  steps[1]->GetCellData()->RemoveArray("Offset");
  steps[1]->GetCellData()->RemoveArray("Label");
  addCells<vtkDoubleArray>(steps[1], "Label", [](vtkIdType) { return 7.0; });
  ImageSeries series(steps, { 0.0, 1.0 });
  auto filter = makeInterpolator(series);
  Messages messages(filter);
  filter->UpdateTimeStep(0.5);
  vtkCellData* cells = filter->GetDensity()->GetCellData();
  CHECK(checks, !cells->GetAbstractArray("Offset") && !cells->GetAbstractArray("Label"));
  CHECK(checks, cells->GetAbstractArray("Constant") && cells->GetAbstractArray("Text"));
  CHECK(checks, messages.Errors.empty() && messages.Warnings.size() == 1);
  CHECK(checks,
    contains(messages.Warnings[0], "Time step 1 of 2 (t = 0) and the next one do not both have") &&
      contains(messages.Warnings[0], "'Offset'") && contains(messages.Warnings[0], "'Label'"));
}

} // namespace

int TestTemporalArrays(int, char*[])
{
  return runChecks({ checkMoving, checkLabels, checkSteps, checkOff, checkMissing });
}
