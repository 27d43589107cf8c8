// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/SurfaceRelaxation/TriangleMasses.h"

#include "Core/Parallel/Reduction.h"

#include <array>

namespace RectifiedTransport
{

namespace
{

// The mean of a linear density is its value at the centre; for a part of a triangle, that of the
// centre in the given triangle.
double meanOf(const TriangleDomain& surface, const double* values, std::int64_t triangle)
{
  if (surface.IsPart(triangle))
  {
    constexpr double third = 1.0 / 3.0;
    const PointWeights centre = surface.InGiven({ triangle, { third, third, third } });
    double mean = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      mean += centre.Weights[i] * values[centre.Points[i]];
    }
    return mean;
  }
  const std::array<std::int64_t, 3> corners = surface.CornersOf(triangle);
  return (values[corners[0]] + values[corners[1]] + values[corners[2]]) / 3.0;
}

} // namespace

// mass = share of the area times mean density
TriangleMasses massesOf(const TriangleDomain& surface, const SurfaceDensityValues& density,
  const std::function<bool(std::int64_t)>& isEmpty, Progress& progress)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
  const std::int64_t count = surface.NumberOfTriangles();
  const double* shares = surface.Areas().Shares;
  const auto densityOf = [&](std::int64_t triangle) {
    if (isEmpty && isEmpty(triangle))
    {
      return 0.0;
    }
    // Without values, the density is 1.
    const double ofTriangle = density.OfTriangles ? density.OfTriangles[triangle] : 1.0;
    return density.AtPoints ? meanOf(surface, density.AtPoints, triangle) : ofTriangle;
  };
  TriangleMasses made{ LargeBuffer<double>(count), 0.0 };
  double* masses = made.Masses.data();
  made.Sum = reduceEach(
    progress, count, grain, 0.0,
    [&](std::int64_t triangle, double& sum) {
      masses[triangle] = shares[triangle] * densityOf(triangle);
      sum += masses[triangle];
    },
    std::plus<>());
  return made;
}

} // namespace RectifiedTransport
