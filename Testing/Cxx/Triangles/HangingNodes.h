// SPDX-License-Identifier: BSD-3-Clause
// Surfaces of quads with T-junctions, for the tests of filters.
#ifndef FilterHangingNodes_h
#define FilterHangingNodes_h

#include "SurfaceTest.h"

#include "vtkAppendPolyData.h"
#include "vtkNew.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"

#include <cmath>
#include <functional>

using PlaceOnSheet = std::function<std::array<double, 3>(double, double)>;

// Of u and v from 0 to 1.
inline vtkSmartPointer<vtkPolyData> makeUnitSheet(
  int quads, bool triangles, const PlaceOnSheet& place)
{
  return makeSheet(
    quads, quads, [&](double x, double y) { return place(x / quads, y / quads); }, triangles);
}

// The sheets as one surface, with their numbers on cells.
inline vtkSmartPointer<vtkPolyData> numbered(vtkAppendPolyData* sheets)
{
  sheets->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  sheets->Update();
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->DeepCopy(sheets->GetOutput());
  surface->GetCellData()->AddArray(makeNumbers("Cell", surface->GetNumberOfCells()));
  return surface;
}

// A unit cube of `quads` by `quads` quads a side; the top has `ratio` times as many along each
// edge.
inline vtkSmartPointer<vtkPolyData> makeRefinedCube(int quads, int ratio, bool triangles)
{
  vtkNew<vtkAppendPolyData> sheets;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (const double level : { 0.0, 1.0 })
    {
      const bool isTop = axis == 2 && level == 1.0;
      sheets->AddInputData(
        makeUnitSheet(isTop ? quads * ratio : quads, triangles, [=](double u, double v) {
          std::array<double, 3> x;
          x[axis] = level;
          x[(axis + 1) % 3] = level == 1.0 ? u : v; // outwards
          x[(axis + 2) % 3] = level == 1.0 ? v : u;
          return x;
        }));
    }
  }
  return numbered(sheets);
}

// The unit square, `ratio` times as fine above y = 1/2.
inline vtkSmartPointer<vtkPolyData> makeRefinedSquare(int quads, int ratio, bool triangles)
{
  vtkNew<vtkAppendPolyData> sheets;
  for (const bool isUpper : { false, true })
  {
    sheets->AddInputData(
      makeUnitSheet(isUpper ? quads * ratio : quads, triangles, [=](double u, double v) {
        return std::array<double, 3>{ u, 0.5 * v + (isUpper ? 0.5 : 0.0), 0.0 };
      }));
  }
  return numbered(sheets);
}

// A kilometre in size, turned, 500 km away, in float.
inline vtkSmartPointer<vtkPolyData> farAway(vtkPolyData* surface)
{
  vtkNew<vtkTransform> transform;
  transform->Translate(500000.0, -500000.0, 100.0);
  transform->RotateWXYZ(40.0, 0.3, 0.5, 0.8);
  transform->Scale(1000.0, 1000.0, 1000.0);
  vtkNew<vtkTransformPolyDataFilter> filter;
  filter->SetInputData(surface);
  filter->SetTransform(transform);
  filter->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
  filter->Update();
  return filter->GetOutput();
}

#endif
