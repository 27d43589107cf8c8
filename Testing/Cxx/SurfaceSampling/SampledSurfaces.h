// SPDX-License-Identifier: BSD-3-Clause
// The surfaces that the tests of vtkSurfaceSampler sample.
#ifndef SampledSurfaces_h
#define SampledSurfaces_h

#include "TestData.h"

#include "vtkCellArray.h"
#include "vtkMassProperties.h"
#include "vtkSurfaceSampler.h"
#include "vtkTriangleFilter.h"

#include <cmath>
#include <functional>

using Place = std::function<void(double x, double y, double* point)>;

// nx x ny quads, or twice as many triangles, whose corners `place` puts somewhere.
inline vtkSmartPointer<vtkPolyData> makeSheet(
  vtkIdType nx, vtkIdType ny, bool triangles, const Place& place)
{
  Values points;
  vtkNew<vtkCellArray> polygons;
  for (vtkIdType j = 0; j <= ny; ++j)
  {
    for (vtkIdType i = 0; i <= nx; ++i)
    {
      double point[3];
      place(static_cast<double>(i), static_cast<double>(j), point);
      points.insert(points.end(), point, point + 3);
      if (i == nx || j == ny)
      {
        continue;
      }
      const vtkIdType p = j * (nx + 1) + i;
      const vtkIdType ids[5] = { p, p + 1, p + nx + 2, p + nx + 1, p };
      if (triangles)
      {
        polygons->InsertNextCell(3, ids);
        polygons->InsertNextCell(3, ids + 2);
      }
      else
      {
        polygons->InsertNextCell(4, ids);
      }
    }
  }
  auto sheet = makePoints(points);
  sheet->SetPolys(polygons);
  return sheet;
}

// A hill of a rectangle of 24 x 16.
inline vtkSmartPointer<vtkPolyData> makeHill(bool triangles = true, double scale = 1.0)
{
  return makeSheet(24, 16, triangles, [=](double x, double y, double* point) {
    const double r = (x - 12.0) * (x - 12.0) + (y - 8.0) * (y - 8.0);
    point[0] = scale * x;
    point[1] = scale * y;
    point[2] = scale * 6.0 * std::exp(-r / 20.0);
  });
}

// A flat rectangle, cells of unit sides.
inline vtkSmartPointer<vtkPolyData> makeFlat(vtkIdType nx, vtkIdType ny, bool triangles = false)
{
  return makeSheet(nx, ny, triangles, [](double x, double y, double* point) {
    point[0] = x;
    point[1] = y;
    point[2] = 0.0;
  });
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
