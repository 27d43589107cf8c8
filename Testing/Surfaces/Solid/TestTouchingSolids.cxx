// SPDX-License-Identifier: BSD-3-Clause
// Edges of four triangles and more, triangles that are there twice, and seams of rounding, up to
// the volume.
#include "ClosedMeshes.h"
#include "SolidSurfaces.h"

#include <gtest/gtest.h>

namespace RectifiedTransport
{
namespace
{

std::vector<double> coverClosed(const Mesh& mesh, const GridSize<3>& cells)
{
  ClosedMesh closed = closedMesh(mesh.Surface());
  EXPECT_TRUE(closed.IsClosed()) << closed.OpenEdges() << " " << closed.NonManifoldEdges();
  EXPECT_TRUE(closed.Orient());
  std::vector<double> coverage(static_cast<std::size_t>(numberOfCells<3>(cells)), -1.0);
  EXPECT_EQ(coverSolid(closed.Solid(), cells, 2, coverage.data(), SerialExecutor()).OpenLines, 0);
  return coverage;
}

// Triangles in another order with other first corners, some of them turned.
Mesh shuffled(Mesh mesh, double turned, std::mt19937_64& random)
{
  std::shuffle(mesh.Triangles.begin(), mesh.Triangles.end(), random);
  std::uniform_real_distribution<double> unit;
  for (auto& triangle : mesh.Triangles)
  {
    std::rotate(
      triangle.begin(), triangle.begin() + static_cast<int>(random() % 3), triangle.end());
    if (unit(random) < turned)
    {
      std::swap(triangle[0], triangle[1]);
    }
  }
  return mesh;
}

// Voxels of a lattice, and the faces of those that have another one or none beside.
struct Voxels
{
  GridSize<3> Size;
  std::vector<double> Values; // 1 or 0

  bool At(std::int64_t x, std::int64_t y, std::int64_t z) const
  {
    return x >= 0 && y >= 0 && z >= 0 && x < this->Size[0] && y < this->Size[1] &&
      z < this->Size[2] &&
      this->Values[static_cast<std::size_t>(x + this->Size[0] * (y + this->Size[1] * z))] > 0.0;
  }

  // Each face with points of its own, turned outward.
  Mesh Surface() const
  {
    Mesh mesh;
    const auto count = static_cast<std::int64_t>(numberOfCells<3>(this->Size));
    for (std::int64_t i = 0; i < count; ++i)
    {
      const std::int64_t at[3] = { i % this->Size[0], i / this->Size[0] % this->Size[1],
        i / this->Size[0] / this->Size[1] };
      for (int face = 0; this->At(at[0], at[1], at[2]) && face < 6; ++face)
      {
        const int axis = face / 2;
        const int side = face % 2;
        std::int64_t beside[3] = { at[0], at[1], at[2] };
        beside[axis] += side == 1 ? 1 : -1;
        if (!this->At(beside[0], beside[1], beside[2]))
        {
          addFace(at, axis, side, mesh);
        }
      }
    }
    return mesh;
  }

  static void addFace(const std::int64_t (&at)[3], int axis, int side, Mesh& mesh)
  {
    const auto first = static_cast<std::int64_t>(mesh.Points.size());
    for (int corner = 0; corner < 4; ++corner)
    {
      double place[3] = { static_cast<double>(at[0]), static_cast<double>(at[1]),
        static_cast<double>(at[2]) };
      place[axis] += side;
      place[(axis + 1) % 3] += corner == 1 || corner == 2 ? 1.0 : 0.0;
      place[(axis + 2) % 3] += corner > 1 ? 1.0 : 0.0;
      mesh.Points.push_back({ place[0], place[1], place[2] });
    }
    const std::int64_t second = side == 1 ? first + 1 : first + 3;
    mesh.Triangles.push_back({ first, second, first + 2 });
    mesh.Triangles.push_back({ first, first + 2, side == 1 ? first + 3 : first + 1 });
  }
};

Voxels randomVoxels(std::mt19937_64& random, double share)
{
  Voxels voxels{ { 2 + static_cast<std::int64_t>(random() % 6),
                   2 + static_cast<std::int64_t>(random() % 6),
                   2 + static_cast<std::int64_t>(random() % 6) },
    {} };
  std::uniform_real_distribution<double> unit;
  const auto count = static_cast<std::int64_t>(numberOfCells<3>(voxels.Size));
  for (std::int64_t i = 0; i < count; ++i)
  {
    voxels.Values.push_back(unit(random) < share ? 1.0 : 0.0);
  }
  return voxels;
}

// As a threshold leaves them: they touch along edges and at points, and have cavities.
TEST(TouchingSolids, RandomVoxels)
{
  std::mt19937_64 random(4);
  for (int run = 0; run < 60; ++run)
  {
    const Voxels voxels = randomVoxels(random, 0.1 + 0.013 * run);
    const Mesh surface = voxels.Surface();
    ASSERT_EQ(coverClosed(surface, voxels.Size), voxels.Values) << run;
    ASSERT_EQ(coverClosed(shuffled(surface, 0.0, random), voxels.Size), voxels.Values) << run;
    ASSERT_EQ(coverClosed(surface.Turned(), voxels.Size), voxels.Values) << run;
  }
}

// Without the orientation inside is what an odd number of crossings says; cavities that lie apart
// from the rest are as they are turned.
TEST(TouchingSolids, TurnedAtRandom)
{
  std::mt19937_64 random(5);
  for (int run = 0; run < 60; ++run)
  {
    const Voxels voxels = randomVoxels(random, 0.05 + 0.003 * run);
    ASSERT_EQ(coverClosed(shuffled(voxels.Surface(), 0.5, random), voxels.Size), voxels.Values)
      << run;
  }
  // A shell with a cavity that touches its outside along an edge.
  Voxels shell{ { 4, 4, 4 }, std::vector<double>(64, 1.0) };
  shell.Values[1 + 4 * (1 + 4)] = 0.0;
  shell.Values[0 + 4 * (0 + 4)] = 0.0;
  for (int run = 0; run < 20; ++run)
  {
    ASSERT_EQ(coverClosed(shuffled(shell.Surface(), 0.5, random), shell.Size), shell.Values);
  }
}

// Solids that share faces or edges, of one direction and of two.
TEST(TouchingSolids, SharedFacesAndEdges)
{
  const GridSize<3> cells{ 5, 5, 5 };
  const auto together = [&cells](const Mesh& a, const Mesh& b) {
    Mesh both = a;
    both.Add(b);
    return sum(coverClosed(both, cells));
  };
  const Mesh cube = makeBox({ 1, 1, 1 }, { 2, 2, 2 });
  for (const Mesh& one : { cube, cube.Turned() })
  {
    EXPECT_EQ(together(one, makeBox({ 2, 1, 1 }, { 3, 2, 2 })), 2.0) << "face";
    EXPECT_EQ(together(one, makeBox({ 2, 2, 1 }, { 3, 3, 2 })), 2.0) << "edge";
    EXPECT_EQ(together(one, makeBox({ 2, 2, 2 }, { 3, 3, 3 })), 2.0) << "point";
  }
  EXPECT_EQ(together(cube, cube), 1.0) << "twice";
  // An L of two beams that overlap where they share an edge.
  EXPECT_NEAR(
    together(makeBox({ 1, 0, 1 }, { 2, 5, 4 }), makeBox({ 1, 0, 1 }, { 4, 5, 2 })), 25.0, 1e-12);
}

TEST(TouchingSolids, TrianglesThatAreThereTwice)
{
  Mesh box = makeBox({ 1, 1, 1 }, { 3, 3, 3 });
  const auto volume = [&box]() { return sum(coverClosed(box, { 4, 4, 4 })); };
  box.Triangles.push_back(box.Triangles[4]);
  EXPECT_EQ(volume(), 8.0);
  box.Triangles.push_back(box.Triangles[4]);
  box.Triangles.push_back({ box.Triangles[7][1], box.Triangles[7][0], box.Triangles[7][2] });
  EXPECT_EQ(volume(), 8.0);
  // All of it in both directions encloses nothing.
  Mesh none = makeBox({ 1, 1, 1 }, { 3, 3, 3 });
  none.Add(none.Turned());
  ClosedMesh closed = closedMesh(none.Surface());
  EXPECT_TRUE(closed.IsClosed());
  EXPECT_EQ(closed.Surface().NumberOfTriangles, 0);
}

// A fin of three triangles about an edge is refused, whatever else has four.
TEST(TouchingSolids, OddEdges)
{
  Mesh mesh = makeBox({ 0, 0, 0 }, { 1, 1, 1 });
  mesh.Add(makeBox({ 1, 1, 0 }, { 2, 2, 1 }));
  mesh.Points.push_back({ 3, 3, 3 });
  mesh.Triangles.push_back({ 0, 1, static_cast<std::int64_t>(mesh.Points.size()) - 1 });
  ClosedMesh fin = closedMesh(mesh.Surface());
  EXPECT_FALSE(fin.IsClosed());
  EXPECT_EQ(fin.OpenEdges(), 2);
  EXPECT_EQ(fin.NonManifoldEdges(), 1);
}

// A torus whose ends are computed apart, as from the sine of 2 pi.
TEST(TouchingSolids, SeamsOfRounding)
{
  const auto torus = [](double seam) {
    Mesh mesh;
    const std::int64_t n = 30;
    for (std::int64_t i = 0; i <= n; ++i)
    {
      for (std::int64_t j = 0; j <= n; ++j)
      {
        const double u = 2.0 * pi * static_cast<double>(i) / n + (i == n ? seam : 0.0);
        const double v = 2.0 * pi * static_cast<double>(j) / n + (j == n ? seam : 0.0);
        const double r = 3.0 + std::cos(v);
        mesh.Points.push_back({ 5.0 + r * std::cos(u), 5.0 + r * std::sin(u), 2.0 + std::sin(v) });
        if (i < n && j < n)
        {
          const std::int64_t at = i * (n + 1) + j;
          mesh.Triangles.push_back({ at, at + n + 1, at + n + 2 });
          mesh.Triangles.push_back({ at, at + n + 2, at + 1 });
        }
      }
    }
    return mesh;
  };
  for (const double seam : { 0.0, 1e-12, 5e-10 }) // of a longest side of 8
  {
    const Mesh mesh = torus(seam);
    const double volume = mesh.Volume();
    EXPECT_NEAR(sum(coverClosed(mesh, { 10, 10, 4 })), volume, 1e-7 * volume) << seam;
    // Points that no triangle has do not count.
    Mesh far = mesh;
    far.Points.push_back({ 1e20, 0.0, 0.0 });
    EXPECT_TRUE(closedMesh(far.Surface()).IsClosed());
  }
  ClosedMesh open = closedMesh(torus(1e-6).Surface());
  EXPECT_FALSE(open.IsClosed());
  EXPECT_EQ(open.OpenEdges(), 120);
}

// A plate thinner than points that are merged where edges are open: nothing is merged.
TEST(TouchingSolids, ThinnerThanTheSeams)
{
  const Mesh plate = makeBox({ 1, 1, 1 }, { 4, 4, 1.0 + 1e-10 });
  EXPECT_NEAR(sum(coverClosed(plate, { 5, 5, 5 })) / 9e-10, 1.0, 1e-5);
}

} // namespace
} // namespace RectifiedTransport
