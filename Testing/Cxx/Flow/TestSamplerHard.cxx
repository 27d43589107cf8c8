// SPDX-License-Identifier: BSD-3-Clause
// Densities at the edge: extreme aspects and values, Diracs, holes.
#include "TestData.h"

#include <algorithm>

namespace
{

using Points = std::vector<double>;

// Runs without a message; all particles are finite and inside the domain of cells.
Points sampleQuietly(Checks& checks, vtkImageData* image, vtkIdType count, int line)
{
  vtkNew<vtkTransportSampler> sampler;
  Messages messages(sampler);
  sampler->SetInputData(image);
  sampler->SetNumberOfParticles(count);
  const Points points = sampleCoordinates(sampler);
  checks.That(messages.Errors.empty() && messages.Warnings.empty(), "no message", line);
  checks.That(points.size() == static_cast<std::size_t>(3 * count), "all particles", line);
  double bounds[6];
  image->GetBounds(bounds);
  bool inside = true;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    inside = inside && points[i] >= bounds[2 * (i % 3)] && points[i] <= bounds[2 * (i % 3) + 1];
  }
  checks.That(inside, "inside the domain", line);
  return points;
}

void checkAspect(Checks& checks)
{
  for (const bool wide : { true, false })
  {
    auto image = wide ? makeImage(40001, 5, 1, true, bumpy) : makeImage(5, 40001, 1, true, bumpy);
    sampleQuietly(checks, image, 2000, __LINE__);
  }
}

// A factor changes nothing but the mass; a power of two not even a bit.
void checkMagnitudes(Checks& checks)
{
  const Points expected = sampleQuietly(checks, makeImage(15, 12, 1, true, bumpy), 700, __LINE__);
  for (const double factor : { 1e-300, 1e300, 0x1p-1000, 0x1p1000 })
  {
    auto image = makeImage(15, 12, 1, true, [factor](vtkIdType i) { return factor * bumpy(i); });
    const Points points = sampleQuietly(checks, image, 700, __LINE__);
    int exponent;
    const bool exact = std::frexp(factor, &exponent) == 0.5;
    CHECK_NEAR(checks, largestDifference(points, expected), 0.0, exact ? 0.0 : 1e-6);
  }
  auto wide = makeImage(15, 12, 1, true,
    [](vtkIdType i) { return std::pow(10.0, static_cast<double>(i * 7 % 17) - 8.0); });
  sampleQuietly(checks, wide, 700, __LINE__);
}

// All mass is in one cell: all particles end there, evenly.
void checkDirac(Checks& checks)
{
  auto image = makeImage(12, 9, 6, true, [](vtkIdType i) { return i == 11 * (8 * 2 + 3) + 7; });
  const Points points = sampleQuietly(checks, image, 2000, __LINE__);
  const double low[3] = { 7, 3, 2 };
  double mean[3] = { 0, 0, 0 };
  bool there = true;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const double x = points[i] - low[i % 3];
    there = there && x >= 0.0 && x <= 1.0;
    mean[i % 3] += x / 2000.0;
  }
  CHECK(checks, there);
  for (const double x : mean)
  {
    CHECK_NEAR(checks, x, 0.5, 0.02);
  }
}

// No particle ends in a hole.
void checkHoles(Checks& checks)
{
  const auto solid = [](vtkIdType i) {
    const double x = static_cast<double>(i % 40) - 19.5;
    const double y = static_cast<double>(i / 40) - 14.5;
    const double r = std::hypot(x, y);
    return r < 14.0 && r > 9.0 && !(x > 0.0 && std::abs(y) < 2.0);
  };
  auto image = makeImage(41, 31, 1, true, solid);
  const Points points = sampleQuietly(checks, image, 5000, __LINE__);
  int lost = 0;
  for (std::size_t i = 0; i < points.size(); i += 3)
  {
    const auto column = static_cast<vtkIdType>(std::min(points[i], 39.0));
    const auto row = static_cast<vtkIdType>(std::min(points[i + 1], 29.0));
    lost += solid(row * 40 + column) ? 0 : 1;
  }
  CHECK(checks, lost == 0);
}

} // namespace

int TestSamplerHard(int, char*[])
{
  return runChecks({ checkAspect, checkMagnitudes, checkDirac, checkHoles });
}
