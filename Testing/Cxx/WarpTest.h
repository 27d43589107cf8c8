// SPDX-License-Identifier: BSD-3-Clause
// What the tests of vtkDensityEqualizingWarp share.
#ifndef WarpTest_h
#define WarpTest_h

#include "TestData.h"

#include "vtkDensityEqualizingWarp.h"

#include <algorithm>
#include <random>

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
  return coordinates(warp->GetOutput());
}

// The values of the output's Displacement, three a point.
inline std::vector<double> displacements(vtkDensityEqualizingWarp* warp)
{
  return arrayValues(warp->GetOutput()->GetPointData()->GetArray("Displacement"));
}

// A filter of points in a density builds tables for another density, and neither for other points
// nor after the changes.
template <class Filter>
void checkTables(Checks& checks, Filter* filter, Changes changes, int line)
{
  auto image = makeImage(9, 7, 1, true, bumpy);
  auto points = makePoints({ 4, 2, 0, 1, 1, 1 });
  filter->SetDensityData(image);
  filter->SetInputData(makePoints({ 3, 2, 0 }));
  const auto build = [&]() { return builds(filter); };
  checks.That(build(), "the first run", line);
  expectAfterEach(checks, build, false,
    { { "other points", [&]() { filter->SetInputData(points); } },
      { "changed points", [&]() { points->Modified(); } } },
    line);
  expectAfterEach(checks, build, false, changes, line);
  expectAfterEach(checks, build, true,
    { { "InvertDensity", [&]() { filter->InvertDensityOn(); } },
      { "the image", [&]() { changeDensity(image); } } },
    line);
}

#endif
