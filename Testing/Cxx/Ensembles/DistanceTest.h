// SPDX-License-Identifier: BSD-3-Clause
// What the tests of vtkTransportDistance share.
#ifndef DistanceTest_h
#define DistanceTest_h

#include "SeriesTest.h"

#include "vtkTable.h"
#include "vtkTransportDistance.h"

#include <cmath>
#include <string>
#include <vector>

using Matrix = std::vector<Values>;

constexpr int distanceMethods[] = { vtkTransportDistance::LINEARIZED,
  vtkTransportDistance::CERTIFIED };

// Along x and y; cells are 0.5 by 2.
constexpr int bellSide = 40;

// A bell around a place that is given in cells. It ends 8 cells from there, so that those around
// integers are exact translations of each other.
inline vtkSmartPointer<vtkImageData> makeBell(double x, double y, double height = 1.0)
{
  auto image = makeImage(bellSide + 1, bellSide + 1, 1, true, [=](vtkIdType i) {
    const double dx = static_cast<double>(i % bellSide) + 0.5 - x;
    const double dy = static_cast<double>(i / bellSide) + 0.5 - y;
    const double squared = dx * dx + dy * dy;
    return squared < 64.0 ? height * std::exp(-squared / 18.0) : 0.0;
  });
  image->SetSpacing(0.5, 2.0, 1.0);
  return image;
}

inline Images makeBells(const std::vector<std::array<double, 2>>& places)
{
  Images images;
  for (const auto& place : places)
  {
    images.push_back(makeBell(place[0], place[1]));
  }
  return images;
}

inline void connect(vtkTransportDistance* distance, const Images& images)
{
  distance->RemoveAllInputs();
  for (const auto& image : images)
  {
    distance->AddInputDataObject(image);
  }
}

inline vtkSmartPointer<vtkTransportDistance> makeDistance(
  const Images& images, int method = vtkTransportDistance::LINEARIZED)
{
  auto distance = vtkSmartPointer<vtkTransportDistance>::New();
  connect(distance, images);
  distance->SetMethod(method);
  return distance;
}

inline Values columnValues(vtkTable* table, const std::string& name)
{
  return arrayValues(vtkDataArray::SafeDownCast(table->GetColumnByName(name.c_str())));
}

inline std::vector<std::string> columnNames(vtkTable* table)
{
  std::vector<std::string> names;
  for (vtkIdType i = 0; i < table->GetNumberOfColumns(); ++i)
  {
    names.emplace_back(table->GetColumnName(i));
  }
  return names;
}

// Updates the filter. Returns the columns of its matrix.
inline Matrix distancesOf(vtkTransportDistance* distance)
{
  distance->Update();
  vtkTable* table = distance->GetDistances();
  Matrix matrix;
  for (vtkIdType i = 0; i < table->GetNumberOfColumns(); ++i)
  {
    matrix.push_back(arrayValues(vtkDataArray::SafeDownCast(table->GetColumn(i))));
  }
  return matrix;
}

#endif
