// SPDX-License-Identifier: BSD-3-Clause
// Values that are written in place, through a pointer, with Modified() of the image only: every one
// of them counts at the next update, whatever its type and place in memory.
#include "TestData.h"

#include "vtkFloatArray.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkShortArray.h"
#include "vtkUnsignedCharArray.h"

namespace
{

double sumOf(vtkDataArray* array)
{
  double sum = 0.0;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    sum += array->GetComponent(i, 0);
  }
  return sum;
}

// Writes into some of the values, one after the other. The mass is their sum: cells are of size 1.
template <class ArrayT>
void checkWrites(Checks& checks, int nx, int ny, vtkIdType step)
{
  auto image = makeImage<ArrayT>(nx + 1, ny + 1, 1, true, bumpy);
  vtkDataArray* array = image->GetCellData()->GetScalars();
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  sampler->SetNumberOfParticles(1);
  sampler->Update();
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); i += step)
  {
    const double value = array->GetComponent(i, 0);
    array->SetComponent(i, 0, value + 1.0);
    image->Modified();
    sampler->Update();
    const double wanted = sumOf(array);
    std::ostringstream detail;
    detail << array->GetClassName() << " of " << nx << " x " << ny << ", value " << i;
    const double found = fieldValue(sampler->GetOutput(), "TotalMass");
    checks.That(std::abs(found - wanted) <= 1e-9 * wanted, "the new mass", __LINE__, detail.str());
  }
}

// Modified() without a new value.
void checkNothingNew(Checks& checks)
{
  auto image = makeImage(12, 9, 1, true, bumpy);
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  sampler->SetNumberOfParticles(1);
  sampler->Update();
  const vtkMTimeType built = sampler->GetTableBuildTime();
  image->Modified();
  sampler->Update();
  CHECK(checks, sampler->GetTableBuildTime() == built);
}

} // namespace

int TestDensityInPlace(int, char*[])
{
  Checks checks;
  // As many bytes as fill no whole words, too.
  checkWrites<vtkDoubleArray>(checks, 7, 5, 1);
  checkWrites<vtkFloatArray>(checks, 7, 5, 1);
  checkWrites<vtkShortArray>(checks, 5, 7, 1);
  checkWrites<vtkUnsignedCharArray>(checks, 7, 5, 1);
  checkWrites<vtkUnsignedCharArray>(checks, 3, 3, 1);
  // Values that are not in one piece.
  checkWrites<vtkSOADataArrayTemplate<double>>(checks, 7, 5, 5);
  // Of many ranges.
  checkWrites<vtkDoubleArray>(checks, 190, 170, 3989);
  checkWrites<vtkUnsignedCharArray>(checks, 700, 501, 60013);
  checkNothingNew(checks);
  return checks.Result();
}
