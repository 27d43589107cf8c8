// SPDX-License-Identifier: BSD-3-Clause
// The bits of what Surfaces computes.
#include "SolidSurfaces.h"
#include "Surfaces/SurfaceRelaxation/SurfaceRelaxation.h"
#include "TestDigest.h"
#include "TestFlow.h"

#include <gtest/gtest.h>

#include <random>

namespace RectifiedTransport
{
namespace
{

TEST(Bits, Solid)
{
  const GridSize<3> cells{ 16, 15, 14 };
  const Points<3> corners = randomPoints<3>(cells, 40, 21);
  Mesh mesh = makeBox({ 2.3, 3.1, 4.7 }, { 11.9, 9.2, 10.4 });
  for (std::size_t i = 0; i < corners.size(); i += 4)
  {
    mesh.Add(Mesh{ { corners[i], corners[i + 1], corners[i + 2], corners[i + 3] },
      { { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 } } });
  }
  Digest digest;
  digest.Add(cover(mesh, cells, 3, OpenMPExecutor()));
  expectDigest({ { "solid", 0x9c993f6a23587daau } }, "solid", digest);
}

// Hills of a sheet with holes, with values of every kind.
TEST(Bits, SurfaceRelaxation)
{
  std::mt19937_64 engine(31);
  Mesh mesh;
  constexpr std::int64_t side = 40;
  std::vector<double> atPoints;
  for (std::int64_t i = 0; i < side * side; ++i)
  {
    const auto height = static_cast<double>(engine() >> 40) * 0x1p-24;
    mesh.Points.push_back({ static_cast<double>(i % side), static_cast<double>(i / side), height });
    atPoints.push_back(height);
  }
  std::vector<double> ofTriangles;
  for (std::int64_t i = 0; i + side < side * side; ++i)
  {
    if (i % side + 1 < side && engine() % 8 > 0)
    {
      mesh.Triangles.push_back({ i, i + 1, i + side });
      mesh.Triangles.push_back({ i + 1, i + side, i + side + 1 });
      ofTriangles.push_back(static_cast<double>(engine() % 5));
      ofTriangles.push_back(i % side < 20 ? 1.0 : 16.0);
    }
  }
  SurfaceRelaxationOptions options;
  options.NumberOfSamples = 1500;
  Digest digest;
  for (const SurfaceDensityValues& density :
    { SurfaceDensityValues{}, SurfaceDensityValues{ atPoints.data(), nullptr },
      SurfaceDensityValues{ nullptr, ofTriangles.data() } })
  {
    const SurfaceRelaxation relaxed = relaxOnSurface(mesh.Surface(), density, options);
    for (std::int64_t i = 0; i < relaxed.Places.size(); ++i)
    {
      const PlaceOnTriangle& place = relaxed.Places.data()[i];
      digest.Add(std::vector<std::int64_t>{ place.Triangle });
      digest.Add(std::vector<double>(place.Weights.begin(), place.Weights.end()));
    }
  }
  expectDigest({ { "surface relaxation", 0x3f9c87f5c94414adu } }, "surface relaxation", digest);
}

} // namespace
} // namespace RectifiedTransport
