// SPDX-License-Identifier: BSD-3-Clause
// Triangles that a surface has twice: in either direction, with points of their own, in a disk.
#include "DiskSurfaces.h"
#include "Surfaces/Mesh/Repair/MergePoints.h"
#include "Surfaces/Mesh/Repair/RepairedDisk.h"

#include <gtest/gtest.h>

#include <array>
#include <utility>
#include <vector>

namespace RectifiedTransport
{
namespace
{

TEST(RepeatedTriangles, AreFoundInAnyDirection)
{
  Mesh mesh = makeTerrain(6, 6);
  const auto given = static_cast<std::int64_t>(mesh.Triangles.size());
  EXPECT_TRUE(findRepeatedTriangles(mesh.Surface()).empty());
  const auto [a, b, c] = mesh.Triangles[20];
  mesh.Triangles.push_back({ b, a, c });
  mesh.Triangles.push_back({ a, a, b }); // no triangle
  mesh.Triangles.push_back({ a, a, b });
  mesh.Triangles.push_back({ b, c, a });
  const std::vector<RepeatedTriangle> repeated = findRepeatedTriangles(mesh.Surface());
  ASSERT_EQ(repeated.size(), 2u);
  EXPECT_EQ(repeated[0].Triangle, given);
  EXPECT_EQ(repeated[1].Triangle, given + 3);
  for (const RepeatedTriangle& one : repeated)
  {
    EXPECT_EQ(one.First, 20);
  }
}

TEST(RepeatedTriangles, CountOnceInADisk)
{
  const Mesh sheet = makeTerrain(6, 6);
  const auto given = static_cast<std::int64_t>(sheet.Triangles.size());
  for (const bool hasOwnPoints : { false, true })
  {
    Mesh mesh = sheet;
    std::array<std::int64_t, 3> repeated = sheet.Triangles[20];
    std::swap(repeated[0], repeated[1]);
    for (std::int64_t& id : repeated)
    {
      if (hasOwnPoints)
      {
        mesh.Points.push_back(sheet.Points[static_cast<std::size_t>(id)]);
        id = static_cast<std::int64_t>(mesh.Points.size()) - 1;
      }
    }
    mesh.Triangles.push_back(repeated);
    const RepairedDisk disk(mesh.Surface(), 0.0);
    EXPECT_EQ(disk.Mesh().NumberOfTriangles(), given);
    EXPECT_EQ(disk.Mesh().NumberOfPoints(), static_cast<std::int64_t>(sheet.Points.size()));
    EXPECT_EQ(disk.Repairs().Repeated, 1);
    EXPECT_EQ(disk.Repairs().FlatTriangles, 0);
    EXPECT_EQ(disk.Repairs().MergedPoints, hasOwnPoints ? 3 : 0);
    ASSERT_EQ(disk.Repeated().size(), 1u);
    EXPECT_EQ(disk.Repeated()[0].Triangle, given);
    EXPECT_EQ(disk.Repeated()[0].First, 20);
  }
}

} // namespace
} // namespace RectifiedTransport
