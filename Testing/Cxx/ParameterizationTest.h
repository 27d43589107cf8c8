// SPDX-License-Identifier: BSD-3-Clause
// What the tests of vtkAreaPreservingParameterization share.
#ifndef ParameterizationTest_h
#define ParameterizationTest_h

#include "SurfaceTest.h"

#include "vtkAreaPreservingParameterization.h"
#include "vtkIdList.h"

#include <algorithm>
#include <cmath>

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
inline Values squareValues(Parameterization* filter, const char* name = "AreaPreservingExact")
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

// By hand, from the points and the coordinates; triangles without area are not distorted.
struct Figures
{
  Values Area; // of the output's cells
  Values Angle;
  Values Flipped;
  double AreaRootMeanSquare = 0.0;
  double AngleMean = 0.0;
};

inline Figures figuresOf(Parameterization* filter)
{
  vtkPolyData* output = filter->GetOutput();
  const Values square = squareValues(filter);
  const vtkIdType cells = output->GetNumberOfCells();
  Figures figures{ Values(static_cast<std::size_t>(cells), 1.0),
    Values(static_cast<std::size_t>(cells), 1.0), Values(static_cast<std::size_t>(cells), 0.0) };
  Values areas(static_cast<std::size_t>(cells), 0.0);
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < cells; ++cell)
  {
    const auto i = static_cast<std::size_t>(cell);
    output->GetCellPoints(cell, ids);
    if (output->GetCellType(cell) != VTK_TRIANGLE)
    {
      continue;
    }
    double x[3][3];
    double u[3][2];
    for (int k = 0; k < 3; ++k)
    {
      output->GetPoint(ids->GetId(k), x[k]);
      std::copy_n(square.begin() + 2 * ids->GetId(k), 2, u[k]);
    }
    // The plane's axes: e along the first edge, f across.
    double e[3];
    double f[3];
    double length = 0.0;
    double along = 0.0;
    for (int a = 0; a < 3; ++a)
    {
      e[a] = x[1][a] - x[0][a];
      f[a] = x[2][a] - x[0][a];
      length += e[a] * e[a];
      along += e[a] * f[a];
    }
    length = std::sqrt(length);
    along /= length;
    double across = 0.0;
    for (int a = 0; a < 3; ++a)
    {
      const double off = f[a] - along * e[a] / length;
      across += off * off;
    }
    across = std::sqrt(across);
    if (across < 1e-9 * length)
    {
      continue;
    }
    const double a = (u[1][0] - u[0][0]) / length;
    const double c = (u[1][1] - u[0][1]) / length;
    const double b = (u[2][0] - u[0][0] - along * a) / across;
    const double d = (u[2][1] - u[0][1] - along * c) / across;
    const double sum = a * a + b * b + c * c + d * d;
    const double determinant = a * d - b * c;
    const double root = std::sqrt(std::max(0.0, sum * sum - 4.0 * determinant * determinant));
    areas[i] = 0.5 * length * across;
    figures.Area[i] = determinant * areas[i]; // to be divided by the share
    figures.Angle[i] = std::min(1e3, (sum + root) / (2.0 * std::abs(determinant)));
    figures.Flipped[i] = determinant > 0.0 ? 0.0 : 1.0;
  }
  const double total = sumOf(areas);
  for (std::size_t i = 0; i < areas.size(); ++i)
  {
    if (areas[i] > 0.0)
    {
      const double share = areas[i] / total;
      figures.Area[i] /= share;
      figures.AreaRootMeanSquare += share * (figures.Area[i] - 1.0) * (figures.Area[i] - 1.0);
      figures.AngleMean += share * figures.Angle[i];
    }
  }
  figures.AreaRootMeanSquare = std::sqrt(figures.AreaRootMeanSquare);
  return figures;
}

inline void expectFigures(Checks& checks, Parameterization* filter, int line)
{
  const Figures figures = figuresOf(filter);
  vtkPolyData* output = filter->GetOutput();
  const auto expect = [&](bool holds, const char* what) { checks.That(holds, what, line); };
  expect(largestDifference(cellValues(filter, "AreaDistortion"), figures.Area) < 1e-9, "areas");
  expect(largestDifference(cellValues(filter, "AngleDistortion"), figures.Angle) < 1e-6, "angles");
  expect(cellValues(filter, "Flipped") == figures.Flipped, "flipped");
  expect(fieldValue(output, "FlippedCount") == sumOf(figures.Flipped), "number of flipped");
  checks.Near(fieldValue(output, "AreaDistortionRMS"), figures.AreaRootMeanSquare, 1e-9,
    "root mean square", line);
  checks.Near(
    fieldValue(output, "AngleDistortionMean"), figures.AngleMean, 1e-6, "mean of angles", line);
}

inline bool isInSquare(const Values& values)
{
  return !values.empty() &&
    std::all_of(values.begin(), values.end(), [](double x) { return x >= 0.0 && x <= 1.0; });
}

#endif
