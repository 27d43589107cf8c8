// SPDX-License-Identifier: BSD-3-Clause
// Whole updates of filters, and their inputs.
#ifndef RectifiedTransport_FilterRuns_h
#define RectifiedTransport_FilterRuns_h

#include "../Core/TestDensities.h"

#include <benchmark/benchmark.h>

#include <vtkCellData.h>
#include <vtkCollectiveAlgorithm.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <algorithm>

namespace RectifiedTransport
{

// Values in the cells of an image with unit spacing.
template <int Dimension>
vtkSmartPointer<vtkImageData> newImage(
  const GridSize<Dimension>& size, const std::vector<double>& values)
{
  int dimensions[3] = { 1, 1, 1 };
  for (int axis = 0; axis < Dimension; ++axis)
  {
    dimensions[axis] = static_cast<int>(size[axis]) + 1;
  }
  vtkNew<vtkDoubleArray> array;
  array->SetName("Density");
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(dimensions);
  image->GetCellData()->SetScalars(array);
  return image;
}

// Makes a density new to a filter. One value, the largest of the first component, changes: filters
// keep their tables while the content is the same, whatever Modified() says.
class ChangingDensity
{
public:
  explicit ChangingDensity(vtkDataArray* array)
    : Array(array)
  {
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    {
      if (array->GetComponent(i, 0) > this->Value)
      {
        this->Value = array->GetComponent(i, 0);
        this->Place = i;
      }
    }
  }

  void operator()()
  {
    this->IsLower = !this->IsLower;
    this->Array->SetComponent(this->Place, 0, this->IsLower ? 0.5 * this->Value : this->Value);
    this->Array->Modified();
  }

private:
  vtkSmartPointer<vtkDataArray> Array;
  vtkIdType Place = 0;
  double Value = 0.0;
  bool IsLower = false;
};

// On one thread, each after change().
template <class Change>
void timeUpdates(benchmark::State& state, vtkCollectiveAlgorithm* filter, Change change)
{
  filter->SetThreadingToSerial();
  for (auto _ : state)
  {
    change();
    filter->Update();
  }
}

} // namespace RectifiedTransport

#endif
