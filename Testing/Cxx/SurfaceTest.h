// SPDX-License-Identifier: BSD-3-Clause
// What the tests of filters on surfaces that are disks share.
#ifndef SurfaceTest_h
#define SurfaceTest_h

#include "TestData.h"

#include "vtkCellArray.h"

#include <cmath>

// Polygons, each after its number of points.
inline vtkSmartPointer<vtkPolyData> makePolygons(
  const Values& points, const std::vector<vtkIdType>& polygons)
{
  auto data = makePoints(points);
  vtkNew<vtkCellArray> cells;
  for (std::size_t i = 0; i < polygons.size(); i += 1 + static_cast<std::size_t>(polygons[i]))
  {
    cells->InsertNextCell(polygons[i], polygons.data() + i + 1);
  }
  data->SetPolys(cells);
  return data;
}

// Squares, of one polygon or two triangles each; place(x, y) is where the corner of an index is,
// whose id is x + y (columns + 1).
template <class Place>
vtkSmartPointer<vtkPolyData> makeSheet(
  int columns, int rows, const Place& place, bool triangles = true)
{
  Values points;
  std::vector<vtkIdType> polygons;
  for (int y = 0; y <= rows; ++y)
  {
    for (int x = 0; x <= columns; ++x)
    {
      const std::array<double, 3> at = place(static_cast<double>(x), static_cast<double>(y));
      points.insert(points.end(), at.begin(), at.end());
      const vtkIdType i = x + y * (columns + 1);
      const vtkIdType above = i + columns + 1;
      if (x < columns && y < rows && triangles)
      {
        polygons.insert(polygons.end(), { 3, i, i + 1, above + 1, 3, i, above + 1, above });
      }
      else if (x < columns && y < rows)
      {
        polygons.insert(polygons.end(), { 4, i, i + 1, above + 1, above });
      }
    }
  }
  return makePolygons(points, polygons);
}

inline vtkSmartPointer<vtkPolyData> makeFlatSheet(int columns, int rows, bool triangles = true)
{
  return makeSheet(
    columns, rows,
    [](double x, double y) {
      return std::array<double, 3>{ x, y, 0.0 };
    },
    triangles);
}

// With hills.
inline vtkSmartPointer<vtkPolyData> makeHills(int columns, int rows)
{
  return makeSheet(columns, rows, [](double x, double y) {
    return std::array<double, 3>{ x, y, 1.5 * std::sin(0.4 * x) * std::cos(0.3 * y) };
  });
}

// A sphere, from the pole to a latitude: half of it for 0.5.
inline vtkSmartPointer<vtkPolyData> makeCap(int rings, double part)
{
  const double half = std::acos(-1.0); // of a turn
  const int around = 3 * rings;
  Values points{ 0, 0, 1 };
  std::vector<vtkIdType> polygons;
  for (int i = 1; i <= rings; ++i)
  {
    const double polar = part * half * i / rings;
    for (int j = 0; j < around; ++j)
    {
      const double angle = 2.0 * half * j / around;
      const double at[3] = { std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle),
        std::cos(polar) };
      points.insert(points.end(), at, at + 3);
      const vtkIdType here = 1 + (i - 1) * around + j;
      const vtkIdType next = 1 + (i - 1) * around + (j + 1) % around;
      if (i == 1)
      {
        polygons.insert(polygons.end(), { 3, 0, here, next });
      }
      else
      {
        const vtkIdType above = here - around;
        polygons.insert(polygons.end(), { 3, above, here, next, 3, above, next, next - around });
      }
    }
  }
  return makePolygons(points, polygons);
}

// The ids 0, 1, 2 ... of points or cells.
inline vtkSmartPointer<vtkDoubleArray> makeNumbers(const char* name, vtkIdType count)
{
  auto numbers = vtkSmartPointer<vtkDoubleArray>::New();
  numbers->SetName(name);
  for (vtkIdType i = 0; i < count; ++i)
  {
    numbers->InsertNextValue(static_cast<double>(i));
  }
  return numbers;
}

// A strip with eight teeth, of 24 triangles.
inline vtkSmartPointer<vtkPolyData> makeTeeth()
{
  constexpr int teeth = 8;
  Values points;
  std::vector<vtkIdType> polygons;
  for (int i = 0; i <= teeth; ++i)
  {
    const double x = i;
    points.insert(points.end(), { x, 0, 0, x, -1, 0, x + 0.5, 1, 0 });
    if (i < teeth)
    {
      const vtkIdType p = 3 * i;
      polygons.insert(
        polygons.end(), { 3, p, p + 3, p + 2, 3, p + 1, p + 4, p + 3, 3, p + 1, p + 3, p });
    }
  }
  points.resize(points.size() - 3);
  return makePolygons(points, polygons);
}

#endif
