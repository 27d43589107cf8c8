// SPDX-License-Identifier: BSD-3-Clause
// The box that vtkEqualMassCells takes of a Domain is that of a density: with values on points half
// a spacing more on each side, and known before the data.
#include "CellsTest.h"
#include "InformationTest.h"

#include "vtkPointDataToCellData.h"
#include "vtkTrivialProducer.h"
#include "vtkUnsignedCharArray.h"

namespace
{

void addArray(vtkImageData* image, int owner, const char* name, bool active)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(image->GetNumberOfElements(owner));
  array->Fill(1.0);
  vtkDataSetAttributes* data = image->GetAttributes(owner);
  data->AddArray(array);
  if (active)
  {
    data->SetActiveScalars(name);
  }
}

void expectBox(Checks& checks, vtkImageData* domain, bool isDual, int line)
{
  vtkNew<vtkEqualMassCells> cells;
  const std::array<double, 6> box = { 1.1, 1.9, 1.1, 1.4, 0.0, 0.0 };
  cells->SetInputData(makeSites(box, 5));
  cells->SetDomainData(domain);
  cells->SetResolution(32);
  checkInformation(checks, cells, line);
  double expected[6];
  domain->GetBounds(expected);
  for (int i = 0; i < 4; ++i)
  {
    expected[i] += isDual ? (i % 2 == 0 ? -0.5 : 0.5) * domain->GetSpacing()[i / 2] : 0.0;
  }
  for (int i = 0; i < 6; ++i)
  {
    checks.Near(cells->GetLabels()->GetBounds()[i], expected[i], 1e-12, "bounds", line);
  }
}

vtkSmartPointer<vtkImageData> makeBare()
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(3, 9, -2, 1, 4, 4);
  image->SetSpacing(0.25, 0.5, 1.0);
  image->SetOrigin(0.1, 1.0, -4.0);
  return image;
}

// Whose values count where there are several, as for a density.
void checkAssociation(Checks& checks)
{
  constexpr int points = vtkDataObject::POINT;
  constexpr int cells = vtkDataObject::CELL;
  auto image = makeBare();
  expectBox(checks, image, false, __LINE__);
  addArray(image, points, vtkDataSetAttributes::GhostArrayName(), false);
  expectBox(checks, image, false, __LINE__);
  addArray(image, points, "A", false);
  expectBox(checks, image, true, __LINE__); // the only one
  addArray(image, points, "B", false);
  expectBox(checks, image, true, __LINE__);
  addArray(image, cells, "C", false);
  expectBox(checks, image, true, __LINE__);
  addArray(image, cells, "D", true);
  expectBox(checks, image, false, __LINE__); // the only scalars
  addArray(image, points, "E", true);
  expectBox(checks, image, true, __LINE__); // those of points come first

  auto onCells = makeBare();
  addArray(onCells, cells, "A", false);
  expectBox(checks, onCells, false, __LINE__);
}

// What is announced before the data may be of the filter's input.
void checkPipeline(Checks& checks)
{
  auto image = makeBare();
  addArray(image, vtkDataObject::POINT, "Density", true);
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(image);
  vtkNew<vtkPointDataToCellData> convert;
  convert->SetInputConnection(producer->GetOutputPort());
  const std::array<double, 6> box = { 1.1, 1.9, 1.1, 1.4, 0.0, 0.0 };
  vtkNew<vtkEqualMassCells> cells;
  cells->SetInputData(makeSites(box, 5));
  cells->SetDomainConnection(convert->GetOutputPort());
  cells->SetResolution(31);
  checkInformation(checks, cells, __LINE__);
  CHECK_NEAR(checks, cells->GetLabels()->GetBounds()[1] - image->GetBounds()[1], 0.0, 1e-12);
  cells->SetDomainConnection(producer->GetOutputPort());
  checkInformation(checks, cells, __LINE__);
  CHECK_NEAR(checks, cells->GetLabels()->GetBounds()[1] - image->GetBounds()[1], 0.125, 1e-12);
}

// Particles that were sampled from an image are inside of it.
void checkSampled(Checks& checks, bool onCells)
{
  auto image = makeImage(24, 17, 1, onCells, bumpy);
  image->SetDirectionMatrix(0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1);
  image->SetExtent(-4, 19, 2, 18, 3, 3);
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  vtkNew<vtkEqualMassCells> cells;
  cells->SetInputConnection(sampler->GetOutputPort());
  cells->SetDomainData(image);
  cells->SetResolution(160);
  Messages messages(cells);
  cells->Update();
  CHECK(checks, messages.Warnings.empty() && messages.Errors.empty());
  vtkImageData* labels = cells->GetLabels();
  const double cell = labels->GetSpacing()[0] * labels->GetSpacing()[1];
  CHECK_NEAR(checks, static_cast<double>(labels->GetNumberOfCells()) * cell,
    onCells ? 23 * 16 : 24 * 17, 1e-9);
}

} // namespace

int TestCellsDomain(int, char*[])
{
  Checks checks;
  checkAssociation(checks);
  checkPipeline(checks);
  checkSampled(checks, false);
  checkSampled(checks, true);
  return checks.Result();
}
