// SPDX-License-Identifier: BSD-3-Clause
// What the tests of vtkTransportInterpolator and vtkTransportBarycenter share.
#ifndef BlendTest_h
#define BlendTest_h

#include "MapTest.h"

#include "vtkTransportBarycenter.h"
#include "vtkTransportInterpolator.h"

#include <array>
#include <numeric>

using Counts = std::array<int, 3>;

// An image with numbers of values along its axes, 1 where there is none.
inline vtkSmartPointer<vtkImageData> makeDensity(
  const Counts& values, bool cells, const std::function<double(vtkIdType)>& value)
{
  const auto points = [&](std::size_t axis) {
    return cells && values[axis] > 1 ? values[axis] + 1 : values[axis];
  };
  return makeImage(points(0), points(1), points(2), cells, value);
}

// Smooth, and not that of smoothDensity.
inline std::function<double(vtkIdType)> otherDensity(int nx, int ny, int nz = 1)
{
  return [=](vtkIdType i) {
    const double x = (static_cast<double>(i % nx) + 0.5) / nx;
    const double y = (static_cast<double>(i / nx % ny) + 0.5) / ny;
    const double z = (static_cast<double>(i / nx / ny) + 0.5) / nz;
    return 0.5 + x * y + 1.5 * std::exp(-12.0 * ((x - 0.7) * (x - 0.7) + y * y + z * z));
  };
}

// As many particles as cells, each spread over few of them.
inline void setSimplest(vtkTransportBlend* blend)
{
  blend->SetParticlesPerCell(1);
  blend->SetKernelToCloudInCell();
}

inline vtkSmartPointer<vtkTransportInterpolator> makeMorph(
  vtkImageData* source, vtkImageData* target, double parameter = 0.5)
{
  auto morph = vtkSmartPointer<vtkTransportInterpolator>::New();
  morph->SetInputData(source);
  morph->SetTargetData(target);
  morph->SetParameter(parameter);
  setSimplest(morph);
  return morph;
}

inline vtkSmartPointer<vtkTransportBarycenter> makeBarycenter(
  const std::vector<vtkImageData*>& images, const Values& weights = {})
{
  auto barycenter = vtkSmartPointer<vtkTransportBarycenter>::New();
  setSimplest(barycenter);
  for (vtkImageData* image : images)
  {
    barycenter->AddInputDataObject(image);
  }
  for (std::size_t i = 0; i < weights.size(); ++i)
  {
    barycenter->SetWeight(static_cast<int>(i), weights[i]);
  }
  return barycenter;
}

// The density as it is now.
inline Values densityValues(vtkTransportBlend* blend)
{
  return arrayValues(densityOf(blend->GetDensity()));
}

inline Values runDensity(vtkTransportBlend* blend)
{
  blend->Update();
  return densityValues(blend);
}

// An array of the particles as it is now.
inline Values particleValues(vtkTransportBlend* blend, const char* name)
{
  return arrayValues(blend->GetParticles()->GetPointData()->GetArray(name));
}

inline Values particlePlaces(vtkTransportBlend* blend)
{
  return coordinates(blend->GetParticles());
}

// The length, area or volume of a cell.
inline double cellMeasure(vtkImageData* image)
{
  double measure = 1.0;
  for (int a = 0; a < 3; ++a)
  {
    measure *= image->GetDimensions()[a] > 1 ? std::abs(image->GetSpacing()[a]) : 1.0;
  }
  return measure;
}

// Density times measure, summed.
inline double massOf(vtkImageData* image)
{
  return sumOf(imageValues(image, "Density")) * cellMeasure(image);
}

// Root mean square of the differences of the sums over blocks of 4 values a side, relative.
inline double blockError(const Values& found, const Values& wanted, const Counts& values)
{
  constexpr int side = 4;
  const auto blocks = [&](std::size_t axis) { return (values[axis] + side - 1) / side; };
  Values differences(static_cast<std::size_t>(blocks(0) * blocks(1) * blocks(2)), 0.0);
  Values sums = differences;
  if (found.size() != wanted.size())
  {
    return HUGE_VAL;
  }
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    const int at = static_cast<int>(i);
    const int x = at % values[0] / side;
    const int y = at / values[0] % values[1] / side;
    const int z = at / values[0] / values[1] / side;
    const auto block = static_cast<std::size_t>(x + blocks(0) * (y + blocks(1) * z));
    differences[block] += found[i] - wanted[i];
    sums[block] += wanted[i];
  }
  const auto norm = [](const Values& v) {
    return std::sqrt(std::inner_product(v.begin(), v.end(), v.begin(), 0.0));
  };
  return norm(differences) / norm(sums);
}

#endif
