// SPDX-License-Identifier: BSD-3-Clause
// What the tests of vtkMassSplatter share.
#ifndef SplatTest_h
#define SplatTest_h

#include "WarpTest.h"

#include "vtkMassSplatter.h"

#include <array>

inline void checkExtent(
  Checks& checks, vtkImageData* image, const std::array<int, 6>& expected, int line)
{
  std::array<int, 6> extent;
  image->GetExtent(extent.data());
  std::string text;
  for (const int end : extent)
  {
    text += std::to_string(end) + " ";
  }
  checks.That(extent == expected, "extent", line, text);
}

inline std::vector<double> splatValues(vtkMassSplatter* splatter)
{
  splatter->Update();
  vtkImageData* output = splatter->GetOutput();
  vtkDataArray* array = output->GetPointData()->GetArray("Density");
  array = array ? array : output->GetCellData()->GetArray("Density");
  std::vector<double> values;
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    values.push_back(array->GetTuple1(i));
  }
  return values;
}

inline double totalMass(vtkMassSplatter* splatter)
{
  vtkDataArray* array = splatter->GetOutput()->GetFieldData()->GetArray("TotalMass");
  return array ? array->GetTuple1(0) : std::nan("");
}

inline double sumOf(const std::vector<double>& values)
{
  double sum = 0.0;
  for (const double value : values)
  {
    sum += value;
  }
  return sum;
}

#endif
