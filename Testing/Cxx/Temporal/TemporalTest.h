// SPDX-License-Identifier: BSD-3-Clause
// What the tests of vtkTransportTemporalInterpolator share.
#ifndef TemporalTest_h
#define TemporalTest_h

#include "SeriesTest.h"

#include "vtkTransportTemporalInterpolator.h"

#include <array>
#include <cmath>

constexpr int temporalMethods[] = { vtkTransportTemporalInterpolator::OPTIMAL,
  vtkTransportTemporalInterpolator::RECTIFIED_FLOW };

// Cells of width 1 along x and y.
constexpr int blobSide = 48;

inline double blobValue(double dx, double dy, double width)
{
  const double value = std::exp(-(dx * dx + dy * dy) / (2.0 * width * width));
  return value > 1e-4 ? value : 0.0;
}

// A bell of a standard deviation, cut off where little is left. Those around integers are exact
// translations of each other, if the whole bell is within the image. It is on cells, or on the
// points half a spacing within them.
inline vtkSmartPointer<vtkImageData> makeBlob(
  double x, double y, double width = 5.0, double height = 1.0, bool cells = true)
{
  const int points = cells ? blobSide + 1 : blobSide;
  auto image = makeImage(points, points, 1, cells, [=](vtkIdType i) {
    return height *
      blobValue(static_cast<double>(i % blobSide) + 0.5 - x,
        static_cast<double>(i / blobSide) + 0.5 - y, width);
  });
  if (!cells)
  {
    image->SetOrigin(0.5, 0.5, 0.0);
  }
  return image;
}

// Three steps at times 0, 1 and 2: the blob moves, grows and spreads.
inline Images movingBlobs()
{
  return { makeBlob(12, 14), makeBlob(30, 22, 5.0, 1.5), makeBlob(34, 34, 6.0) };
}

const Times blobTimes = { 0.0, 1.0, 2.0 };

inline vtkSmartPointer<vtkTransportTemporalInterpolator> makeInterpolator(
  ImageSeries& series, int method = vtkTransportTemporalInterpolator::OPTIMAL)
{
  auto filter = vtkSmartPointer<vtkTransportTemporalInterpolator>::New();
  filter->SetInputConnection(series.Port());
  filter->SetMethod(method);
  return filter;
}

inline Values densityAt(vtkTransportTemporalInterpolator* filter, double time)
{
  filter->UpdateTimeStep(time);
  return imageValues(filter->GetDensity(), "Density");
}

inline Values particleValues(vtkTransportTemporalInterpolator* filter, const char* name)
{
  return arrayValues(pointArray(filter->GetParticles(), name));
}

// The numbers of both outputs, as they are.
inline Values outputsAt(vtkTransportTemporalInterpolator* filter, double time)
{
  Values all = densityAt(filter, time);
  for (const Values& part : { coordinates(filter->GetParticles()), particleValues(filter, "Mass"),
         particleValues(filter, "Velocity") })
  {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

using Place = std::array<double, 2>;

// The centre of the mass of a density of blobSide by blobSide values.
inline Place centroidOf(const Values& density)
{
  Place sum = { 0.0, 0.0 };
  for (std::size_t i = 0; i < density.size(); ++i)
  {
    sum[0] += density[i] * (static_cast<double>(i % blobSide) + 0.5);
    sum[1] += density[i] * (static_cast<double>(i / blobSide) + 0.5);
  }
  return { sum[0] / sumOf(density), sum[1] / sumOf(density) };
}

// The sum of the differences, as a part of the sum of `wanted`.
inline double relativeDifference(const Values& found, const Values& wanted)
{
  double sum = found.size() == wanted.size() ? 0.0 : HUGE_VAL;
  for (std::size_t i = 0; i < std::min(found.size(), wanted.size()); ++i)
  {
    sum += std::abs(found[i] - wanted[i]);
  }
  return sum / sumOf(wanted);
}

// Lets the next Update of a test request a time.
inline void requestTime(vtkAlgorithm* filter, double time)
{
  filter->UpdateInformation();
  for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
  {
    filter->GetOutputInformation(port)->Set(Pipeline::UPDATE_TIME_STEP(), time);
  }
}

#endif
