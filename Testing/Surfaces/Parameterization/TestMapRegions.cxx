// SPDX-License-Identifier: BSD-3-Clause
// Regions of a map's points: each point is in one, and regions of a group touch no triangle
// together.
#include "DiskSurfaces.h"
#include "Surfaces/Parameterization/MapRegions.h"

#include <gtest/gtest.h>

#include <set>

namespace RectifiedTransport
{
namespace
{

using Positions = std::vector<Point<2>>;
using Groups = std::vector<std::vector<MapRegion>>;

Positions planeOf(const Mesh& mesh)
{
  Positions positions;
  for (const Point<3>& p : mesh.Points)
  {
    positions.push_back({ p[0], p[1] });
  }
  return positions;
}

// Returns the number of regions.
std::size_t expectRegions(const DiskMesh& disk, const Groups& groups, std::int64_t most)
{
  std::vector<int> regionOf(static_cast<std::size_t>(disk.NumberOfPoints()), -1);
  std::vector<std::size_t> groupOf;
  std::int64_t points = 0;
  for (std::size_t group = 0; group < groups.size(); ++group)
  {
    EXPECT_FALSE(groups[group].empty());
    for (const MapRegion& region : groups[group])
    {
      EXPECT_FALSE(region.empty());
      EXPECT_LE(static_cast<std::int64_t>(region.size()), most);
      EXPECT_TRUE(std::is_sorted(region.begin(), region.end()));
      for (const std::int64_t point : region)
      {
        EXPECT_EQ(regionOf[static_cast<std::size_t>(point)], -1) << point;
        regionOf[static_cast<std::size_t>(point)] = static_cast<int>(groupOf.size());
        ++points;
      }
      groupOf.push_back(group);
    }
  }
  EXPECT_EQ(points, disk.NumberOfPoints());
  for (std::int64_t t = 0; t < disk.NumberOfTriangles(); ++t)
  {
    for (int i = 0; i < 3; ++i)
    {
      const int a = regionOf[static_cast<std::size_t>(disk.Triangle(t)[i])];
      const int b = regionOf[static_cast<std::size_t>(disk.Triangle(t)[(i + 1) % 3])];
      EXPECT_TRUE(
        a == b || groupOf[static_cast<std::size_t>(a)] != groupOf[static_cast<std::size_t>(b)])
        << "triangle " << t;
    }
  }
  return groupOf.size();
}

TEST(MapRegions, PartsOfThePoints)
{
  const Mesh mesh = makeRandomTriangulation(40, 30, 1e-5);
  const DiskMesh disk(mesh.Surface());
  const Positions positions = planeOf(mesh);
  for (const std::int64_t most : { 1, 7, 100, 1270, 1271, 5000 })
  {
    for (int variant = 0; variant < 9; ++variant)
    {
      const Groups groups = makeRegions(disk, positions, most, variant);
      const std::size_t regions = expectRegions(disk, groups, most);
      // Not many more than there have to be.
      EXPECT_LE(regions, 4 * 1271 / static_cast<std::size_t>(most) + 1);
      EXPECT_EQ(groups, makeRegions(disk, positions, most, variant));
    }
  }
}

// Between two successive variants the regions' borders move.
TEST(MapRegions, VariantsDiffer)
{
  const Mesh mesh = makeRectangle(60, 60);
  const DiskMesh disk(mesh.Surface());
  const Positions positions = planeOf(mesh);
  const auto bordersOf = [&](int variant) {
    std::vector<std::size_t> regionOf(positions.size());
    std::size_t number = 0;
    for (const auto& group : makeRegions(disk, positions, 500, variant))
    {
      for (const MapRegion& region : group)
      {
        for (const std::int64_t point : region)
        {
          regionOf[static_cast<std::size_t>(point)] = number;
        }
        ++number;
      }
    }
    std::set<std::int64_t> borders;
    for (std::int64_t t = 0; t < disk.NumberOfTriangles(); ++t)
    {
      const auto region = [&](int i) {
        return regionOf[static_cast<std::size_t>(disk.Triangle(t)[i])];
      };
      if (region(0) != region(1) || region(1) != region(2))
      {
        borders.insert(t);
      }
    }
    return borders;
  };
  for (int variant = 0; variant < 8; ++variant)
  {
    const std::set<std::int64_t> first = bordersOf(variant);
    const std::set<std::int64_t> second = bordersOf(variant + 1);
    const auto both = std::count_if(
      first.begin(), first.end(), [&](std::int64_t t) { return second.count(t) > 0; });
    EXPECT_LT(both, static_cast<std::ptrdiff_t>(first.size()) / 2) << variant;
  }
}

// All points in one place, or on one line: their numbers decide.
TEST(MapRegions, EqualCoordinates)
{
  const Mesh mesh = makeRectangle(20, 20);
  const DiskMesh disk(mesh.Surface());
  Positions line = planeOf(mesh);
  for (Point<2>& position : line)
  {
    position[1] = 0.25;
  }
  for (const Positions& positions : { Positions(441, { 0.5, 0.5 }), line })
  {
    for (int variant = 0; variant < 4; ++variant)
    {
      const Groups groups = makeRegions(disk, positions, 10, variant);
      expectRegions(disk, groups, 10);
      EXPECT_EQ(groups, makeRegions(disk, positions, 10, variant));
    }
  }
}

} // namespace
} // namespace RectifiedTransport
