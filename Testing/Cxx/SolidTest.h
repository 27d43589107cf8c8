// SPDX-License-Identifier: BSD-3-Clause
// What the tests of vtkSolidDensity share.
#ifndef SolidTest_h
#define SolidTest_h

#include "TestData.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCleanPolyData.h"
#include "vtkMassProperties.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkReverseSense.h"
#include "vtkSolidDensity.h"
#include "vtkSphereSource.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"
#include "vtkTriangleFilter.h"

#include <algorithm>
#include <cmath>

constexpr double pi = 3.14159265358979323846;

inline vtkSmartPointer<vtkPolyData> makeSphere(
  double x, double y, double z, double radius, int resolution = 40)
{
  vtkNew<vtkSphereSource> source;
  source->SetCenter(x, y, z);
  source->SetRadius(radius);
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  return source->GetOutput();
}

inline vtkSmartPointer<vtkPolyData> transformed(vtkPolyData* surface, vtkTransform* transform)
{
  vtkNew<vtkTransformPolyDataFilter> filter;
  filter->SetInputData(surface);
  filter->SetTransform(transform);
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->Update();
  return filter->GetOutput();
}

inline vtkSmartPointer<vtkPolyData> turned(vtkPolyData* surface)
{
  vtkNew<vtkReverseSense> filter;
  filter->SetInputData(surface);
  filter->Update();
  return filter->GetOutput();
}

inline vtkSmartPointer<vtkPolyData> together(vtkPolyData* a, vtkPolyData* b)
{
  vtkNew<vtkAppendPolyData> filter;
  filter->AddInputData(a);
  filter->AddInputData(b);
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->Update();
  return filter->GetOutput();
}

// A closed polyhedron with the faces' corners one after the other, each face after its size.
inline vtkSmartPointer<vtkPolyData> makePolyhedron(
  const std::vector<double>& points, const std::vector<vtkIdType>& faces)
{
  auto data = makePoints(points);
  vtkNew<vtkCellArray> polygons;
  for (std::size_t i = 0; i < faces.size(); i += 1 + static_cast<std::size_t>(faces[i]))
  {
    polygons->InsertNextCell(faces[i], faces.data() + i + 1);
  }
  data->SetPolys(polygons);
  return data;
}

// A box of six quads.
inline vtkSmartPointer<vtkPolyData> makeBox(
  double x0, double x1, double y0, double y1, double z0, double z1)
{
  return makePolyhedron({ x0, y0, z0, x1, y0, z0, x1, y1, z0, x0, y1, z0, x0, y0, z1, x1, y0, z1,
                          x1, y1, z1, x0, y1, z1 },
    { 4, 0, 3, 2, 1, 4, 4, 5, 6, 7, 4, 0, 1, 5, 4, 4, 1, 2, 6, 5, 4, 2, 3, 7, 6, 4, 3, 0, 4, 7 });
}

// Of all that vtkMassProperties takes for inside.
inline double volumeOf(vtkPolyData* surface)
{
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(surface);
  vtkNew<vtkMassProperties> mass;
  mass->SetInputConnection(triangles->GetOutputPort());
  mass->Update();
  return mass->GetVolume();
}

inline std::vector<double> densityOf(vtkSolidDensity* solid)
{
  vtkImageData* image = solid->GetOutput();
  return arrayValues(solid->GetAssociation() == vtkSolidDensity::POINTS
      ? image->GetPointData()->GetArray("Density")
      : image->GetCellData()->GetArray("Density"));
}

inline std::vector<double> runSolid(vtkSolidDensity* solid)
{
  solid->Update();
  return densityOf(solid);
}

// The sum of the output's density times the cells' volume.
inline double massOf(vtkSolidDensity* solid)
{
  const double* spacing = solid->GetOutput()->GetSpacing();
  return sumOf(densityOf(solid)) * spacing[0] * spacing[1] * spacing[2];
}

// How many values are not from 0 to 1, or above 0 in cells that touch the bounds nowhere. All are
// wrong if there are none.
inline std::size_t countLeaks(vtkSolidDensity* solid, const double bounds[6])
{
  vtkImageData* image = solid->GetOutput();
  const bool onPoints = solid->GetAssociation() == vtkSolidDensity::POINTS;
  const double h = image->GetSpacing()[0];
  const std::vector<double> values = densityOf(solid);
  std::size_t wrong = values.empty() ? 1 : 0;
  std::size_t cells[3];
  double low[3];
  for (int a = 0; a < 3; ++a)
  {
    cells[a] = static_cast<std::size_t>(image->GetDimensions()[a] - (onPoints ? 0 : 1));
    low[a] = image->GetOrigin()[a] - (onPoints ? 0.5 * h : 0.0);
  }
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const std::size_t at[3] = { i % cells[0], i / cells[0] % cells[1], i / cells[0] / cells[1] };
    bool outside = false;
    for (int a = 0; a < 3; ++a)
    {
      const double begin = low[a] + h * static_cast<double>(at[a]);
      const double tolerance = 1e-9 * h;
      outside =
        outside || begin > bounds[2 * a + 1] + tolerance || begin + h < bounds[2 * a] - tolerance;
    }
    const bool right = values[i] >= 0.0 && values[i] <= 1.0 && !(outside && values[i] != 0.0);
    wrong += right ? 0 : 1;
  }
  return wrong;
}

inline double massOf(vtkPolyData* surface, int resolution, int supersampling = 2)
{
  vtkNew<vtkSolidDensity> solid;
  solid->SetInputData(surface);
  solid->SetResolution(resolution);
  solid->SetSupersampling(supersampling);
  solid->Update();
  return massOf(solid);
}

// A sphere of quads alone, whose corners meet at the poles and whose edges meet along a seam.
inline vtkSmartPointer<vtkPolyData> makeQuadSphere(int rows, int columns)
{
  std::vector<double> points;
  std::vector<vtkIdType> faces;
  for (int row = 0; row <= rows; ++row)
  {
    const double radius = row % rows == 0 ? 0.0 : std::sin(pi * row / rows);
    for (int column = 0; column <= columns; ++column)
    {
      const double angle = 2.0 * pi * (column % columns) / columns;
      const double place[3] = { radius * std::cos(angle), radius * std::sin(angle),
        std::cos(pi * row / rows) };
      points.insert(points.end(), place, place + 3);
      if (row < rows && column < columns)
      {
        const vtkIdType corner = row * (columns + 1) + column;
        const vtkIdType below = corner + columns + 1;
        faces.insert(faces.end(), { 4, corner, corner + 1, below + 1, below });
      }
    }
  }
  return makePolyhedron(points, faces);
}

#endif
