// SPDX-License-Identifier: BSD-3-Clause
// Where maps squeeze areas: at the tips of spots of known places and strengths, and nowhere else.
#include "DiskSurfaces.h"
#include "Surfaces/Seams/CutOpenComponent.h"

#include <gtest/gtest.h>

namespace RectifiedTransport
{
namespace
{

constexpr std::int64_t cells = 80;

struct Spot
{
  Point<2> Centre;
  double Radius;
  double Power; // of the distance from the centre, in radii
};

std::vector<Point<2>> squeezed(const Mesh& mesh, const std::vector<Spot>& spots)
{
  std::vector<Point<2>> positions;
  for (const Point<3>& p : mesh.Points)
  {
    Point<2> position{ p[0], p[1] };
    for (const Spot& spot : spots)
    {
      const Point<2> from{ p[0] - spot.Centre[0], p[1] - spot.Centre[1] };
      const double part = std::hypot(from[0], from[1]) / spot.Radius;
      if (part > 0.0 && part < 1.0)
      {
        const double scale = std::pow(part, spot.Power - 1.0);
        position = { spot.Centre[0] + scale * from[0], spot.Centre[1] + scale * from[1] };
      }
    }
    positions.push_back(position);
  }
  return positions;
}

TEST(DistortionPeaks, TipsOfSpots)
{
  const Mesh mesh = makeRectangle(cells, cells);
  const DiskMesh disk(mesh.Surface());
  const PeakLimits limits;
  EXPECT_TRUE(findDistortionPeaks(disk, squeezed(mesh, {}), limits).empty());

  // The second one is squeezed more; the third one is too small.
  const std::vector<Spot> spots{ { { 0.25, 0.25 }, 0.2, 4.0 }, { { 0.7, 0.65 }, 0.25, 6.0 },
    { { 0.8, 0.2 }, 0.06, 4.0 } };
  const auto found = findDistortionPeaks(disk, squeezed(mesh, spots), limits);
  ASSERT_EQ(found.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i)
  {
    const Point<3>& place = mesh.Points[static_cast<std::size_t>(found[i].Point)];
    const Spot& spot = spots[1 - i];
    EXPECT_LT(std::hypot(place[0] - spot.Centre[0], place[1] - spot.Centre[1]), 2.0 / cells);
    // Squeezed 20 times or more: where power * part^(2 power - 2) is at most 1/20.
    const double part = std::pow(0.05 / spot.Power, 1.0 / (2.0 * spot.Power - 2.0));
    EXPECT_NEAR(
      found[i].AreaShare, pi * std::pow(part * spot.Radius, 2.0), 0.2 * found[i].AreaShare);
  }
}

TEST(DistortionPeaks, PeaksAreProminent)
{
  const Mesh mesh = makeRectangle(cells, cells);
  const DiskMesh disk(mesh.Surface());
  const std::vector<Point<2>> positions =
    squeezed(mesh, { { { 0.25, 0.25 }, 0.2, 4.0 }, { { 0.7, 0.65 }, 0.25, 6.0 } });
  PeakLimits limits;
  limits.Squeeze = 0.01; // all points: spots are squeezed inside and stretched at their rims
  EXPECT_EQ(findDistortionPeaks(disk, positions, limits).size(), 2u);
  limits.Prominence = 1e12; // the highest peak has no pass to a higher one
  EXPECT_EQ(findDistortionPeaks(disk, positions, limits).size(), 1u);
}

TEST(DistortionPeaks, BoundariesAreLeftOut)
{
  // Squeezed most at the boundary, and no tip inside is as high as the points next to it.
  const Mesh mesh = makeRectangle(cells, cells);
  const DiskMesh disk(mesh.Surface());
  std::vector<Point<2>> positions;
  for (const Point<3>& p : mesh.Points)
  {
    positions.push_back({ std::pow(p[0], 8.0), p[1] });
  }
  for (const DistortionPeak& found : findDistortionPeaks(disk, positions, PeakLimits()))
  {
    EXPECT_NEAR(mesh.Points[static_cast<std::size_t>(found.Point)][0], 1.0 / cells, 1e-12);
  }
}

} // namespace
} // namespace RectifiedTransport
