// SPDX-License-Identifier: BSD-3-Clause
// A closed surface of any number of triangles.
#ifndef KnotInput_h
#define KnotInput_h

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <cmath>

namespace RectifiedTransport
{

// A knotted tube of 2 * around * across triangles.
inline void makeKnot(int around, int across, vtkPolyData* knot)
{
  const double turn = 2.0 * std::acos(-1.0);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> triangles;
  for (vtkIdType i = 0; i < around; ++i)
  {
    for (vtkIdType j = 0; j < across; ++j)
    {
      const double u = 2.0 * turn * static_cast<double>(i) / around;
      const double v = turn * static_cast<double>(j) / across;
      const double r = 3.0 + std::cos(1.5 * u) + 0.6 * std::cos(v);
      points->InsertNextPoint(
        r * std::cos(u), r * std::sin(u), std::sin(1.5 * u) + 0.6 * std::sin(v));
      const vtkIdType k = (i + 1) % around;
      const vtkIdType l = (j + 1) % across;
      const vtkIdType lower[3] = { i * across + j, k * across + j, k * across + l };
      const vtkIdType upper[3] = { i * across + j, k * across + l, i * across + l };
      triangles->InsertNextCell(3, lower);
      triangles->InsertNextCell(3, upper);
    }
  }
  knot->SetPoints(points);
  knot->SetPolys(triangles);
}

} // namespace RectifiedTransport

#endif
