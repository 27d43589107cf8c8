// SPDX-License-Identifier: BSD-3-Clause
// What the tests of vtkTransportMap with a target share beside MapTest.h.
#ifndef MapTargetTest_h
#define MapTargetTest_h

#include "MapTest.h"

inline vtkSmartPointer<vtkTransportMap> makeMapBetween(vtkDataObject* source, vtkDataObject* target)
{
  auto map = vtkSmartPointer<vtkTransportMap>::New();
  map->SetInputData(source);
  map->SetTargetData(target);
  return map;
}

// A bell on the unit cells of a square, which is product of two of one axis.
struct Bell
{
  double X;
  double Y;
  double Width;
  double Height = 1.0;

  vtkSmartPointer<vtkImageData> On(int side) const
  {
    const Bell bell = *this;
    return makeImage(side + 1, side + 1, 1, true, [side, bell](vtkIdType i) {
      const double x = static_cast<double>(i % side) + 0.5 - bell.X;
      const double y = static_cast<double>(i / side) + 0.5 - bell.Y;
      return bell.Height * std::exp(-0.5 * (x * x + y * y) / (bell.Width * bell.Width));
    });
  }
};

// The share of the mass of each cell of equal measure.
inline Values sharesOf(vtkImageData* image)
{
  Values shares = imageValues(image, "Density");
  const double sum = sumOf(shares);
  for (double& share : shares)
  {
    share /= sum;
  }
  return shares;
}

inline double squareAt(const Values& vectors, std::size_t i)
{
  const double* v = vectors.data() + 3 * i;
  return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

#endif
