// SPDX-License-Identifier: BSD-3-Clause
// What the tests of vtkDensityEqualizingWarp share.
#ifndef WarpTest_h
#define WarpTest_h

#include "SamplerTest.h"

#include "vtkDensityEqualizingWarp.h"

#include <algorithm>
#include <random>

inline vtkSmartPointer<vtkPolyData> makePoints(const std::vector<double>& x, bool single = false)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(single ? VTK_FLOAT : VTK_DOUBLE);
  for (std::size_t i = 0; i < x.size(); i += 3)
  {
    points->InsertNextPoint(x.data() + i);
  }
  data->SetPoints(points);
  return data;
}

// Coordinates at random in a box, three a point.
inline std::vector<double> randomCoordinates(const double bounds[6], int count)
{
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<double> x;
  for (int i = 0; i < 3 * count; ++i)
  {
    const double* range = bounds + 2 * (i % 3);
    x.push_back(range[0] + (range[1] - range[0]) * unit(random));
  }
  return x;
}

inline std::vector<double> warpCoordinates(vtkDensityEqualizingWarp* warp)
{
  warp->Update();
  vtkPointSet* output = warp->GetOutput();
  std::vector<double> all(static_cast<std::size_t>(3 * output->GetNumberOfPoints()));
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    output->GetPoint(i, all.data() + 3 * i);
  }
  return all;
}

// The values of the output's Displacement, three a point.
inline std::vector<double> displacements(vtkDensityEqualizingWarp* warp)
{
  vtkDataArray* array = warp->GetOutput()->GetPointData()->GetArray("Displacement");
  std::vector<double> all;
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    all.insert(all.end(), array->GetTuple3(i), array->GetTuple3(i) + 3);
  }
  return all;
}

#endif
