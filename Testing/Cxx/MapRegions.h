// SPDX-License-Identifier: BSD-3-Clause
// Small maps for tests of vtkCartogram.
#ifndef MapRegions_h
#define MapRegions_h

#include "TestData.h"

#include "vtkCartogram.h"
#include "vtkCellArray.h"

// side x side squares with points of their own and a cell array "Mass".
inline vtkSmartPointer<vtkPolyData> makeMap(int side, double size = 1.0, double from = 0.0,
  const std::function<double(vtkIdType)>& mass = bumpy)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkDoubleArray> masses;
  masses->SetName("Mass");
  for (int i = 0; i < side * side; ++i)
  {
    polygons->InsertNextCell(4);
    for (const auto& [x, y] : { std::pair(0, 0), { 1, 0 }, { 1, 1 }, { 0, 1 } })
    {
      polygons->InsertCellPoint(
        points->InsertNextPoint(from + size * (i % side + x), from + size * (i / side + y), 0.0));
    }
    masses->InsertNextValue(mass(i));
  }
  data->SetPoints(points);
  data->SetPolys(polygons);
  data->GetCellData()->AddArray(masses);
  return data;
}

// Of polygons in the plane of x and y, in their order.
inline Values polygonAreas(vtkPolyData* data)
{
  Values areas;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < data->GetNumberOfPolys(); ++cell)
  {
    data->GetPolys()->GetCellAtId(cell, ids);
    double origin[3];
    data->GetPoint(ids->GetId(0), origin);
    double sum = 0.0;
    for (vtkIdType i = 1; i + 1 < ids->GetNumberOfIds(); ++i)
    {
      double a[3];
      double b[3];
      data->GetPoint(ids->GetId(i), a);
      data->GetPoint(ids->GetId(i + 1), b);
      sum += (a[0] - origin[0]) * (b[1] - origin[1]) - (a[1] - origin[1]) * (b[0] - origin[0]);
    }
    areas.push_back(0.5 * sum);
  }
  return areas;
}

#endif
