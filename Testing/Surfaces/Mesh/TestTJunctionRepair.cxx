// SPDX-License-Identifier: BSD-3-Clause
// T-junctions of surfaces whose points are not merged, and those that triangles without area leave.
#include "Surfaces/Mesh/Repair/TJunctionRepair.h"

#include "HangingNodes.h"
#include "SurfaceRelaxation/SurfaceMeasures.h"
#include "Surfaces/Mesh/DiskMesh.h"
#include "Surfaces/Mesh/Repair/RepairedDisk.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace RectifiedTransport
{
namespace
{

// The surface with its repairs, as the same points.
Mesh repairedMesh(const Mesh& mesh, const TJunctionRepair& repair)
{
  Mesh made = mesh;
  if (repair.Parts)
  {
    made.Triangles.clear();
    for (std::int64_t t = 0; t < repair.Parts->NumberOfTriangles(); ++t)
    {
      const std::int64_t* ids = repair.Parts->Triangles() + 3 * t;
      made.Triangles.push_back({ ids[0], ids[1], ids[2] });
    }
  }
  return made;
}

// Each `every`-th edge between two triangles of a row is cut in the middle on its upper side alone;
// a triangle of three points on a line lies between both.
Mesh withCaps(Mesh mesh, std::size_t every)
{
  const std::size_t count = mesh.Triangles.size();
  for (std::size_t i = 0; i + 1 < count; i += 2 * every)
  {
    const auto [a, c, d] = mesh.Triangles[i + 1]; // beyond the diagonal from a to c
    const auto m = static_cast<std::int64_t>(mesh.Points.size());
    Point<3> middle;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      middle[axis] = 0.5 *
        (mesh.Points[static_cast<std::size_t>(a)][axis] +
          mesh.Points[static_cast<std::size_t>(c)][axis]);
    }
    mesh.Points.push_back(middle);
    mesh.Triangles[i + 1] = { a, m, d };
    mesh.Triangles.push_back({ m, c, d });
    mesh.Triangles.push_back({ a, c, m });
  }
  return mesh;
}

void expectCapsAreCut(const Mesh& plain, TJunctionScope scope, std::size_t every)
{
  const Mesh mesh = withCaps(plain, every);
  const auto caps = static_cast<std::int64_t>(mesh.Points.size() - plain.Points.size());
  const TJunctionRepair repair = repairTJunctions(mesh.Surface(), scope);
  EXPECT_EQ(repair.FlatTriangles, caps);
  EXPECT_EQ(repair.TJunctions, 0);
  ASSERT_TRUE(repair.Parts);
  const Mesh made = repairedMesh(mesh, repair);
  EXPECT_EQ(made.Triangles.size(), plain.Triangles.size() + 2 * static_cast<std::size_t>(caps));
  for (std::int64_t t = 0; t < made.Surface().NumberOfTriangles; ++t)
  {
    EXPECT_GT(areaOf(made.Surface(), t), 0.0);
  }
  EXPECT_NEAR(areaOf(made.Surface()), areaOf(plain.Surface()), 1e-12);
  EXPECT_EQ(SurfaceEdges(made.Surface()).Open(), SurfaceEdges(plain.Surface()).Open());
  EXPECT_EQ(SurfaceEdges(made.Surface()).NonManifold(), 0);
}

TEST(TJunctionRepair, FlatTriangles)
{
  for (const TJunctionScope scope : { TJunctionScope::All, TJunctionScope::OfDegenerateTriangles })
  {
    for (const std::size_t every : { 1, 3 })
    {
      expectCapsAreCut(makeTorus(12, 8), scope, every);
      expectCapsAreCut(makeQuads(6, 6,
                         [](double u, double v) {
                           return Point<3>{ u, v, u * v };
                         }),
        scope, every);
    }
  }
}

// On the boundary they are left as they are: nothing is across.
TEST(TJunctionRepair, DegenerateTrianglesOnTheBoundary)
{
  Mesh square = makeQuads(2, 2, [](double u, double v) { return Point<3>{ u, v, 0.0 }; });
  square.Triangles.push_back({ 0, 2, 1 });
  for (const TJunctionScope scope : { TJunctionScope::All, TJunctionScope::OfDegenerateTriangles })
  {
    EXPECT_FALSE(repairTJunctions(square.Surface(), scope).Parts);
  }
}

// Edges that were open stay open, unless all T-junctions are to be closed.
TEST(TJunctionRepair, Scope)
{
  const Mesh zigzag = makeZigzag({ 0.2, 0.4, 0.7 }, { 0.3, 0.6, 0.8 });
  EXPECT_FALSE(repairTJunctions(zigzag.Surface(), TJunctionScope::OfDegenerateTriangles).Parts);
  const TJunctionRepair repair = repairTJunctions(zigzag.Surface(), TJunctionScope::All);
  EXPECT_EQ(repair.TJunctions, 6);
  const RepairedDisk disk(repairedMesh(zigzag, repair).Surface(), 0.0);
  EXPECT_EQ(disk.Mesh().NumberOfTriangles(), 22);
}

// Each triangle has points of its own, and these differ by the rounding of float.
TEST(TJunctionRepair, PointsThatDifferByRounding)
{
  const Mesh square = makeZigzag({ 0.5 }, { 0.25, 0.5, 0.75 }).Mapped([](const Point<3>& x) {
    return Point<3>{ x[0] + 8.0, x[1], x[2] };
  });
  Mesh soup = separated(square);
  for (std::size_t i = 0; i < soup.Points.size(); i += 2)
  {
    soup.Points[i][0] = inFloat(soup.Points[i][0] * (1.0 + 1.2e-7));
  }
  const TJunctionRepair repair = repairTJunctions(soup.Surface(), TJunctionScope::All);
  EXPECT_EQ(repair.TJunctions, 2);
  const RepairedDisk disk(
    repairedMesh(soup, repair).Surface(), 4.0 * std::numeric_limits<float>::epsilon() * 9.0);
  EXPECT_NEAR(disk.Mesh().Area() * disk.Mesh().Unit() * disk.Mesh().Unit(), 1.0, 1e-5);
}

} // namespace
} // namespace RectifiedTransport
