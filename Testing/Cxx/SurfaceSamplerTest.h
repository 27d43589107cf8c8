// SPDX-License-Identifier: BSD-3-Clause
// What the tests of vtkSurfaceSampler share.
#ifndef SurfaceSamplerTest_h
#define SurfaceSamplerTest_h

#include "SurfaceTest.h"

#include "vtkMassProperties.h"
#include "vtkSurfaceSampler.h"
#include "vtkTriangleFilter.h"

#include <cmath>
#include <functional>

// A hill of a rectangle of 24 x 16.
inline vtkSmartPointer<vtkPolyData> makeHill(bool triangles = true, double scale = 1.0)
{
  return makeSheet(
    24, 16,
    [scale](double x, double y) {
      const double r = (x - 12.0) * (x - 12.0) + (y - 8.0) * (y - 8.0);
      return std::array<double, 3>{ scale * x, scale * y, scale * 6.0 * std::exp(-r / 20.0) };
    },
    triangles);
}

inline double areaOf(vtkPolyData* surface)
{
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(surface);
  vtkNew<vtkMassProperties> area;
  area->SetInputConnection(triangles->GetOutputPort());
  area->Update();
  return area->GetSurfaceArea();
}

// An array of a function of the index.
template <class ArrayT = vtkDoubleArray>
vtkSmartPointer<ArrayT> makeArray(
  const char* name, vtkIdType count, const std::function<double(vtkIdType)>& value)
{
  auto array = vtkSmartPointer<ArrayT>::New();
  array->SetName(name);
  array->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    array->SetComponent(i, 0, value(i));
  }
  return array;
}

inline vtkPolyData* runSampler(vtkSurfaceSampler* sampler)
{
  sampler->Update();
  return sampler->GetOutput();
}

#endif
