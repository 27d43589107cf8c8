// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Parameterization/MapDistortion.h"

#include "Core/Parallel/Reduction.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Mesh/TriangleShape.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace RectifiedTransport
{

namespace
{

using Vector2 = Eigen::Vector2d;

// What is summed over the triangles; the first two are weighted by area.
struct Sums
{
  double Square;
  double Angle;
  std::int64_t Flipped;
  std::int64_t FlippedNeedles;
};

// A needle's height is within rounding of coarse input: its flip says nothing about the map.
bool isNeedle(const TriangleSurface& surface, std::int64_t triangle)
{
  const std::int64_t* corners = surface.Triangles + 3 * triangle;
  const auto at = [&](int i) { return pointAt(surface.Points, corners[i]); };
  const TriangleShape shape(at(0), at(1), at(2));
  return shape.Height < MapDistortion::NeedleHeight * shape.Length;
}

// The weighted quantile of ascending pairs of a value and its weight: the least value at which the
// weights up to it reach `part`. The weights sum to 1.
double quantile(const std::vector<std::pair<double, double>>& ascending, double part)
{
  double sum = 0.0;
  for (const auto& [value, weight] : ascending)
  {
    sum += weight;
    if (sum >= part)
    {
      return value;
    }
  }
  return ascending.back().first;
}

} // namespace

MeasuredTriangles measuredTriangles(const DiskMesh& disk)
{
  return { disk.Surface(), disk.AreaShares() };
}

TriangleDistortion distortionOf(
  const DiskMesh& disk, ConstPointSpan<2> positions, std::int64_t triangle)
{
  return distortionOf(measuredTriangles(disk), positions, triangle);
}

TriangleDistortion distortionOf(
  const MeasuredTriangles& triangles, ConstPointSpan<2> positions, std::int64_t triangle)
{
  const std::int64_t* corners = triangles.Surface.Triangles + 3 * triangle;
  const ConstPointSpan<3> points = triangles.Surface.Points;
  const auto point = [&](int i) { return Eigen::Map<const Eigen::Vector3d>(points[corners[i]]); };
  const auto image = [&](int i) { return Eigen::Map<const Vector2>(positions[corners[i]]); };
  const Vector2 first = image(1) - image(0);
  const Vector2 second = image(2) - image(0);
  const double determinant = first[0] * second[1] - first[1] * second[0];

  // The map's derivative F = (x y) in an orthonormal frame of the triangle's plane, along its first
  // side and across: the images of the frame's vectors.
  const Eigen::Vector3d base = point(1) - point(0);
  const Eigen::Vector3d other = point(2) - point(0);
  const double length = base.norm();
  const double along = other.dot(base) / length;
  const double across = base.cross(other).norm() / length;
  const Vector2 x = first / length;
  const Vector2 y = (second - x * along) / across;
  const double sum = x.squaredNorm() + y.squaredNorm();
  const double twice = 2.0 * std::abs(x[0] * y[1] - x[1] * y[0]);
  // The singular values s1 >= s2 of F have s1^2 + s2^2 = |F|^2 = sum and 2 s1 s2 = 2 |det F| =
  // twice. So s1^2 is the larger root of z^2 - sum z + twice^2 / 4, and s1 / s2 = s1^2 / (s1 s2).
  const double larger = 0.5 * (sum + std::sqrt(std::max(0.0, (sum - twice) * (sum + twice))));
  const double angle = 2.0 * larger / twice;

  TriangleDistortion distortion;
  distortion.Area = 0.5 * determinant / triangles.AreaShares[triangle];
  distortion.Angle = angle <= MaximumAngleDistortion ? std::max(1.0, angle)
                                                     : MaximumAngleDistortion; // also without area
  distortion.IsFlipped = !(determinant > 0.0);
  return distortion;
}

MapDistortion measureDistortion(
  const DiskMesh& disk, ConstPointSpan<2> positions, const Context& context)
{
  return measureDistortion(measuredTriangles(disk), positions, context);
}

MapDistortion measureDistortion(
  const MeasuredTriangles& triangles, ConstPointSpan<2> positions, const Context& context)
{
  const std::int64_t count = triangles.Surface.NumberOfTriangles;
  // A fixed grain makes the order of sums independent of the number of threads.
  constexpr std::int64_t grain = std::int64_t{ 1 } << 12;
  Progress progress(context);
  std::vector<std::pair<double, double>> deviations(static_cast<std::size_t>(count));
  Stages stages(progress, { { "sums", 1 }, { "quantiles", 1 } });
  const Sums sums = reduceEach(
    stages["sums"], count, grain, Sums{ 0.0, 0.0, 0, 0 },
    [&](std::int64_t t, Sums& part) {
      const TriangleDistortion distortion = distortionOf(triangles, positions, t);
      const double weight = triangles.AreaShares[t];
      const double deviation = std::abs(distortion.Area - 1.0);
      deviations[static_cast<std::size_t>(t)] = { deviation, weight };
      part.Square += weight * deviation * deviation;
      part.Angle += weight * distortion.Angle;
      part.Flipped += distortion.IsFlipped ? 1 : 0;
      part.FlippedNeedles += distortion.IsFlipped && isNeedle(triangles.Surface, t) ? 1 : 0;
    },
    [](const Sums& a, const Sums& b) {
      return Sums{ a.Square + b.Square, a.Angle + b.Angle, a.Flipped + b.Flipped,
        a.FlippedNeedles + b.FlippedNeedles };
    });
  std::sort(deviations.begin(), deviations.end());
  stages["quantiles"].EndSlice(1);
  return { std::sqrt(sums.Square), quantile(deviations, 0.5), quantile(deviations, 0.95),
    sums.Angle, sums.Flipped, sums.FlippedNeedles };
}

} // namespace RectifiedTransport
