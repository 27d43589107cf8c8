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
  return imageValues(splatter->GetOutput(), "Density");
}

inline double totalMass(vtkMassSplatter* splatter)
{
  return fieldValue(splatter->GetOutput(), "TotalMass");
}

#endif
