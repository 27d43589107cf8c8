// SPDX-License-Identifier: BSD-3-Clause
// What the tests of vtkTransportMap share beside TestData.h.
#ifndef MapTest_h
#define MapTest_h

#include "TestData.h"
#include "vtkCell.h"
#include "vtkMatrix3x3.h"
#include "vtkTransportMap.h"

// Where the values of a map are.
inline Values samplePlaces(vtkImageData* map)
{
  const bool onPoints = map->GetPointData()->GetArray("Displacement") != nullptr;
  const vtkIdType count = onPoints ? map->GetNumberOfPoints() : map->GetNumberOfCells();
  Values places(static_cast<std::size_t>(3 * count));
  for (vtkIdType i = 0; i < count; ++i)
  {
    double* x = places.data() + 3 * i;
    if (onPoints)
    {
      map->GetPoint(i, x);
      continue;
    }
    // The mean of the corners: right for every direction matrix.
    vtkCell* cell = map->GetCell(i);
    const vtkIdType corners = cell->GetNumberOfPoints();
    x[0] = x[1] = x[2] = 0.0;
    for (vtkIdType k = 0; k < corners; ++k)
    {
      double p[3];
      map->GetPoint(cell->GetPointId(static_cast<int>(k)), p);
      for (int a = 0; a < 3; ++a)
      {
        x[a] += p[a] / static_cast<double>(corners);
      }
    }
  }
  return places;
}

// Smooth and positive, by cell or point of a grid with `nx` and `ny` values an axis.
inline std::function<double(vtkIdType)> smoothDensity(int nx, int ny, int nz = 1)
{
  return [=](vtkIdType i) {
    const double x = (static_cast<double>(i % nx) + 0.5) / nx;
    const double y = (static_cast<double>(i / nx % ny) + 0.5) / ny;
    const double z = (static_cast<double>(i / nx / ny) + 0.5) / nz;
    const double r = (x - 0.4) * (x - 0.4) + (y - 0.55) * (y - 0.55) + (z - 0.5) * (z - 0.5);
    return 0.4 + 2.0 * std::exp(-8.0 * r) + 0.1 * std::sin(5.0 * x + 3.0 * y);
  };
}

// The error of a run, and after one without, whether the map has all samples.
class MapErrorTest : public ErrorTest
{
public:
  MapErrorTest(Checks& checks, vtkTransportMap* map)
    : ErrorTest(checks, map)
    , Check(checks)
    , Map(map)
  {
  }

  void ExpectNone(std::size_t samples, int line)
  {
    this->ErrorTest::ExpectNone(line);
    this->Check.That(imageValues(this->Map->GetOutput(), "Divergence").size() == samples,
      "number of samples", line);
  }

private:
  Checks& Check;
  vtkTransportMap* Map;
};

#endif
