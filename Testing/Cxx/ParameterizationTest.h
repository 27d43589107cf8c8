// SPDX-License-Identifier: BSD-3-Clause
// What the tests of vtkAreaPreservingParameterization share.
#ifndef ParameterizationTest_h
#define ParameterizationTest_h

#include "SurfaceTest.h"

#include "vtkAreaPreservingParameterization.h"

using Parameterization = vtkAreaPreservingParameterization;

inline vtkSmartPointer<Parameterization> makeParameterization(vtkPolyData* surface)
{
  auto filter = vtkSmartPointer<Parameterization>::New();
  filter->SetInputData(surface);
  filter->SetResolution(64);
  return filter;
}

inline void setCorners(Parameterization* filter, const std::vector<vtkIdType>& corners)
{
  filter->ClearCorners();
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    filter->SetCorner(static_cast<int>(i), corners[i]);
  }
}

// Two numbers a point; none where there is no such array.
inline Values squareValues(Parameterization* filter, const char* name = "AreaPreserving")
{
  return arrayValues(filter->GetOutput()->GetPointData()->GetArray(name));
}

inline Values cellValues(Parameterization* filter, const char* name)
{
  return arrayValues(filter->GetOutput()->GetCellData()->GetArray(name));
}

inline Values runSquare(Parameterization* filter)
{
  filter->Update();
  return squareValues(filter);
}

#endif
