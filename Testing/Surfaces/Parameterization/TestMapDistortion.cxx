// SPDX-License-Identifier: BSD-3-Clause
// How maps change areas and angles: maps whose singular values are known, and quantiles of a
// surface whose triangles all have areas of their own.
#include "DiskSurfaces.h"
#include "RecordingContext.h"
#include "Surfaces/Parameterization/MapDistortion.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

namespace RectifiedTransport
{
namespace
{

using Positions = std::vector<Point<2>>;

// The image of a flat surface by rotation * diagonal(first, second) * rotation.
Positions linearMap(const Mesh& mesh, double first, double second)
{
  Positions positions;
  for (const Point<3>& p : mesh.Points)
  {
    const Point<2> q{ first * (std::cos(0.4) * p[0] - std::sin(0.4) * p[1]),
      second * (std::sin(0.4) * p[0] + std::cos(0.4) * p[1]) };
    positions.push_back(
      { std::cos(1.1) * q[0] - std::sin(1.1) * q[1], std::sin(1.1) * q[0] + std::cos(1.1) * q[1] });
  }
  return positions;
}

TEST(MapDistortion, LinearMaps)
{
  const Mesh mesh = makeRandomTriangulation(9, 7, 1e-3); // of area 1
  const DiskMesh disk(turned(mesh)
                        .Mapped([](const Point<3>& p) {
                          return Point<3>{ 30.0 * p[0], 30.0 * p[1], 30.0 * p[2] };
                        })
                        .Surface());
  const double cases[][4] = { { 1.0, 1.0, 1.0, 1.0 }, { 2.0, 0.5, 1.0, 4.0 },
    { 0.3, 0.6, 0.18, 2.0 }, { 1e-3, 0.99, 9.9e-4, 990.0 }, { 1e-4, 1.0, 1e-4, 1000.0 },
    { -0.5, 1.5, -0.75, 3.0 }, { 1e30, 3e30, 3e60, 3.0 } };
  for (const auto& [first, second, area, angle] : cases)
  {
    const Positions positions = linearMap(mesh, first, second);
    const bool isFlipped = area < 0.0;
    for (std::int64_t t = 0; t < disk.NumberOfTriangles(); ++t)
    {
      const TriangleDistortion distortion = distortionOf(disk, positions, t);
      ASSERT_NEAR(distortion.Area, area, 1e-9 * std::abs(area));
      ASSERT_NEAR(distortion.Angle, angle, 1e-6 * angle);
      ASSERT_LE(distortion.Angle, MaximumAngleDistortion);
      ASSERT_GE(distortion.Angle, 1.0);
      ASSERT_EQ(distortion.IsFlipped, isFlipped);
    }
    const MapDistortion whole = measureDistortion(disk, positions);
    const double deviation = std::abs(area - 1.0);
    EXPECT_NEAR(whole.AreaRootMeanSquare, deviation, 1e-10 * (1.0 + deviation));
    EXPECT_NEAR(whole.AreaMedian, deviation, 1e-10 * (1.0 + deviation));
    EXPECT_NEAR(whole.Area95, deviation, 1e-10 * (1.0 + deviation));
    EXPECT_NEAR(whole.AngleMean, angle, 1e-6 * angle);
    EXPECT_EQ(whole.Flipped, isFlipped ? disk.NumberOfTriangles() : 0);
  }
}

TEST(MapDistortion, WithoutArea)
{
  const Mesh mesh = makeRectangle(3, 3);
  const DiskMesh disk(mesh.Surface());
  for (const double second : { 0.0, 1.0 })
  {
    const MapDistortion whole =
      measureDistortion(disk, linearMap(mesh, 0.0, second)); // a point, a line
    EXPECT_NEAR(whole.AngleMean, MaximumAngleDistortion, 1e-9);
    EXPECT_NEAR(whole.AreaMedian, 1.0, 1e-15);
    EXPECT_NEAR(whole.AreaRootMeanSquare, 1.0, 1e-15);
  }
  // Not flipped only where the area is positive.
  EXPECT_EQ(measureDistortion(disk, Positions(16, { 0.5, 0.5 })).Flipped, 18);
}

// A strip of triangles that has `shares` in the surface and `areas` in the square, in any unit.
struct Strip
{
  Strip(const std::vector<double>& shares, const std::vector<double>& areas)
  {
    this->Points = { { 0, 0, 0 }, { 0, 1, 0 } };
    this->Positions = { { 0, 0 }, { 0, 1 } };
    // The last points of the lower and the upper side.
    std::array<std::int64_t, 2> ends{ 0, 1 };
    for (std::size_t t = 0; t < shares.size(); ++t)
    {
      const std::size_t side = t % 2;
      const auto next = static_cast<std::int64_t>(this->Points.size());
      const auto last = static_cast<std::size_t>(ends[side]);
      this->Points.push_back(
        { this->Points[last][0] + 2.0 * shares[t], static_cast<double>(side), 0 });
      this->Positions.push_back(
        { this->Positions[last][0] + 2.0 * areas[t], static_cast<double>(side) });
      this->Triangles.push_back({ ends[0], next, ends[1] });
      ends[side] = next;
    }
  }

  std::vector<Point<3>> Points;
  std::vector<std::array<std::int64_t, 3>> Triangles;
  std::vector<Point<2>> Positions;
};

// Means and quantiles weigh triangles by their areas, and the quantiles are of |q - 1|.
TEST(MapDistortion, Weights)
{
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> number(0.0, 1.0);
  for (int run = 0; run < 50; ++run)
  {
    const std::size_t count = 5 + random() % 60;
    std::vector<double> shares(count);
    std::generate(shares.begin(), shares.end(), [&]() { return 0.02 + number(random); });
    const double total = std::accumulate(shares.begin(), shares.end(), 0.0);
    std::vector<double> areas(count);
    std::vector<std::pair<double, double>> deviations;
    double square = 0.0;
    std::int64_t flipped = 0;
    for (std::size_t t = 0; t < count; ++t)
    {
      shares[t] /= total;
      const double q = -0.2 + 2.5 * number(random);
      areas[t] = q * shares[t];
      deviations.emplace_back(std::abs(q - 1.0), shares[t]);
      square += shares[t] * (q - 1.0) * (q - 1.0);
      flipped += q < 0.0 ? 1 : 0;
    }
    const auto quantile = [&deviations](double part) {
      std::sort(deviations.begin(), deviations.end());
      double sum = 0.0;
      std::size_t i = 0;
      for (; i + 1 < deviations.size() && sum + deviations[i].second < part; ++i)
      {
        sum += deviations[i].second;
      }
      return deviations[i].first;
    };
    const Strip strip(shares, areas);
    const Mesh mesh{ strip.Points, strip.Triangles };
    const DiskMesh disk(mesh.Surface());
    const MapDistortion found = measureDistortion(disk, strip.Positions);
    EXPECT_NEAR(found.AreaRootMeanSquare, std::sqrt(square), 1e-12);
    EXPECT_NEAR(found.AreaMedian, quantile(0.5), 1e-12);
    EXPECT_NEAR(found.Area95, quantile(0.95), 1e-12);
    EXPECT_EQ(found.Flipped, flipped);
    double angle = 0.0;
    for (std::int64_t t = 0; t < disk.NumberOfTriangles(); ++t)
    {
      angle += disk.AreaShare(t) * distortionOf(disk, strip.Positions, t).Angle;
    }
    EXPECT_NEAR(found.AngleMean, angle, 1e-9 * angle);
  }
}

TEST(MapDistortion, ThreadsAndCancel)
{
  const Mesh mesh = makeTerrain(100, 90);
  const DiskMesh disk(mesh.Surface());
  Positions positions;
  for (const Point<3>& p : mesh.Points)
  {
    positions.push_back({ p[0], p[1] });
  }
  const SerialExecutor serial;
  const MapDistortion reference = measureDistortion(disk, positions, serial);
  for (const int threads : { 1, 2, 3 })
  {
    const MapDistortion found = measureDistortion(disk, positions, ThreadsExecutor(threads));
    EXPECT_EQ(found.AreaRootMeanSquare, reference.AreaRootMeanSquare);
    EXPECT_EQ(found.AreaMedian, reference.AreaMedian);
    EXPECT_EQ(found.Area95, reference.Area95);
    EXPECT_EQ(found.AngleMean, reference.AngleMean);
  }
  RecordingContext whole(serial);
  measureDistortion(disk, positions, whole.Context());
  whole.ExpectReported(0.0, 1.0);
  for (int maximum = 0; maximum < whole.Queries; ++maximum)
  {
    RecordingContext recorder(serial);
    recorder.MaximumQueries = maximum;
    EXPECT_THROW(measureDistortion(disk, positions, recorder.Context()), Cancelled);
  }
}

} // namespace
} // namespace RectifiedTransport
