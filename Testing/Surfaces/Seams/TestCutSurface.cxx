// SPDX-License-Identifier: BSD-3-Clause
// Surfaces of any topology, cut into disks: each triangle is in one disk, points are copies of the
// given ones, seams are short, disks have none, and nothing depends on threads.
#include "DiskSurfaces.h"
#include "RecordingContext.h"
#include "SeamSurfaces.h"
#include "Surfaces/Parameterization/MapDistortion.h"
#include "Surfaces/Parameterization/TutteEmbedding.h"
#include "Surfaces/Seams/CutSurface.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>

namespace RectifiedTransport
{
namespace
{

const SerialExecutor serial;

double areaOf(const Mesh& mesh)
{
  double area = 0.0;
  for (const auto& t : mesh.Triangles)
  {
    Point<3> u;
    Point<3> v;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const Point<3>& a = mesh.Points[static_cast<std::size_t>(t[0])];
      u[i] = mesh.Points[static_cast<std::size_t>(t[1])][i] - a[i];
      v[i] = mesh.Points[static_cast<std::size_t>(t[2])][i] - a[i];
    }
    area += 0.5 *
      std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
  }
  return area;
}

// Each triangle is in one disk, with copies of its points; each point of the disks is a copy of one
// given point. Returns the length of the boundaries.
double expectDisks(const Mesh& mesh, const CutSurface& cut, std::size_t disks)
{
  EXPECT_EQ(cut.Disks().size(), disks);
  std::vector<std::int64_t> triangles(cut.Disks().size(), 0);
  std::vector<std::int64_t> originOf(static_cast<std::size_t>(cut.NumberOfPoints()), -1);
  for (std::size_t t = 0; t < mesh.Triangles.size(); ++t)
  {
    const std::int64_t disk = cut.DiskOf(static_cast<std::int64_t>(t));
    EXPECT_GE(disk, 0) << t;
    ++triangles[static_cast<std::size_t>(disk)];
    const CutDisk& found = cut.Disks()[static_cast<std::size_t>(disk)];
    const std::int64_t* corners = cut.CornersOf(static_cast<std::int64_t>(t));
    for (std::size_t i = 0; i < 3; ++i)
    {
      EXPECT_GE(corners[i], found.FirstPoint);
      EXPECT_LT(corners[i], found.FirstPoint + found.NumberOfPoints);
      std::int64_t& origin = originOf[static_cast<std::size_t>(corners[i])];
      EXPECT_TRUE(origin < 0 || origin == mesh.Triangles[t][i]);
      origin = mesh.Triangles[t][i];
    }
  }
  double length = 0.0;
  for (std::size_t i = 0; i < disks; ++i)
  {
    const CutDisk& disk = cut.Disks()[i];
    EXPECT_EQ(triangles[i], disk.Mesh ? disk.Mesh->NumberOfTriangles() : 1);
    if (disk.Mesh)
    {
      const std::vector<std::int64_t>& loop = disk.Mesh->Boundary();
      for (std::size_t k = 0; k < loop.size(); ++k)
      {
        const auto placeOf = [&](std::int64_t point) {
          return mesh.Points[static_cast<std::size_t>(
            originOf[static_cast<std::size_t>(disk.FirstPoint + point)])];
        };
        const Point<3> a = placeOf(loop[k]);
        const Point<3> b = placeOf(loop[(k + 1) % loop.size()]);
        length += std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
      }
    }
  }
  return length;
}

double boundaryOf(const Mesh& mesh, std::size_t disks = 1)
{
  return expectDisks(mesh, CutSurface(mesh.Surface()), disks);
}

TEST(CutSurface, DisksHaveNoSeams)
{
  for (const Mesh& mesh : { makeTerrain(20, 30), makeCap(12, 2.5), makeCap(12, 3.0) })
  {
    const CutSurface cut(mesh.Surface());
    expectDisks(mesh, cut, 1);
    EXPECT_EQ(cut.NumberOfPoints(), static_cast<std::int64_t>(mesh.Points.size()));
    const DiskMesh& disk = *cut.Disks()[0].Mesh;
    EXPECT_EQ(disk.NumberOfPoints(), DiskMesh(mesh.Surface()).NumberOfPoints());
    EXPECT_EQ(disk.Boundary().size(), DiskMesh(mesh.Surface()).Boundary().size());
  }
}

TEST(CutSurface, SphereIsCutAlongHalfAGreatCircle)
{
  // The boundary has both sides of the seam. Edges in other directions make it a little longer.
  const double length = boundaryOf(makeSphere({ 1.0, 2.0, 3.0 }, 1.0, 16));
  EXPECT_GT(length, 2.0 * 3.0);
  EXPECT_LT(length, 2.0 * 3.5);
}

TEST(CutSurface, TorusIsCutAlongAMeridianAndAShortParallel)
{
  const Mesh mesh = makeRing(48, 24, 0.4);
  const double shortest = 2.0 * (2.0 * pi * 0.4 + 2.0 * pi * 0.6);
  const double length = boundaryOf(mesh);
  EXPECT_GT(length, 0.98 * shortest);
  EXPECT_LT(length, 1.15 * shortest);
}

TEST(CutSurface, HandlesAreCutOpen)
{
  for (const std::int64_t handles : { 1, 2, 3 })
  {
    const Mesh mesh = makeHandles(handles, 3);
    // Each handle: around the hole, and around a bar beside it; and ways between them.
    EXPECT_LT(boundaryOf(mesh), 2.0 * static_cast<double>(handles) * (4.0 + 4.0 + 3.0)) << handles;
  }
}

TEST(CutSurface, HolesAreJoined)
{
  SeamOptions once;
  once.MaximumRounds = 0;
  const Mesh cube = makeOpenCube(10);
  const double length = expectDisks(cube, CutSurface(cube.Surface(), once), 1);
  EXPECT_GT(length, 6.0 * 1.6 + 5.0 * 2.0 * 0.6 - 1e-9); // loops, and seams between them
  EXPECT_LT(length, 6.0 * 1.6 + 5.0 * 2.0 * 0.9);
  const Mesh tube = makeBand(40, 8, 0);
  EXPECT_NEAR(boundaryOf(tube), 2.0 * (2.0 * pi + 0.6), 0.3);
}

TEST(CutSurface, SurfacesWithOneSideAreCutOpen)
{
  const Mesh band = makeBand(40, 8, 1);
  EXPECT_NEAR(boundaryOf(band), 4.0 * pi + 2.0 * 0.6, 0.8);
  // A Klein bottle.
  constexpr std::int64_t around = 24;
  constexpr std::int64_t across = 12;
  Mesh klein = makeTorus(around, across, [](double u, double v) {
    const double r =
      2.0 + std::cos(pi * u) * std::sin(2.0 * pi * v) - std::sin(pi * u) * std::sin(4.0 * pi * v);
    return Point<3>{ r * std::cos(2.0 * pi * u), r * std::sin(2.0 * pi * u),
      std::sin(pi * u) * std::sin(2.0 * pi * v) + std::cos(pi * u) * std::sin(4.0 * pi * v) };
  });
  for (auto& t : klein.Triangles) // the last ring meets the first one turned
  {
    const bool isLast = std::max({ t[0], t[1], t[2] }) >= (around - 1) * across;
    for (std::int64_t& id : t)
    {
      id = isLast && id < across ? (across - id) % across : id;
    }
  }
  boundaryOf(klein);
}

// The projective plane has the Euler characteristic of a disk.
TEST(CutSurface, ProjectivePlanesAreCutOpen)
{
  const Mesh plane = makeProjectivePlane(3);
  EXPECT_GT(boundaryOf(plane), 0.0);
  boundaryOf(makeProjectivePlane(0)); // of six points
  Mesh several = makeSphere({ 9.0, 0.0, 0.0 }, 1.0, 6);
  several.Add(plane);
  several.Add(shifted(makeProjectivePlane(2), { 0.0, 9.0, 0.0 }));
  expectDisks(several, CutSurface(several.Surface()), 3);
  const Mesh soup = apart(plane);
  const CutSurface cut(soup.Surface());
  ASSERT_EQ(cut.Disks().size(), 1u);
  EXPECT_EQ(cut.NumberOfPoints(), CutSurface(plane.Surface()).NumberOfPoints());
  EXPECT_TRUE(cut.Disks()[0].HasSeams);
}

// In either direction, with the same points or others at their places.
TEST(CutSurface, RepeatedTrianglesLieOnTheFirstOnes)
{
  const Mesh sphere = makeSphere({ 0.0, 0.0, 0.0 }, 1.0, 8);
  Mesh mesh = sphere;
  const std::array<std::size_t, 3> first{ 3, 20, 21 };
  const auto& t = sphere.Triangles;
  mesh.Triangles.push_back(t[first[0]]);
  mesh.Triangles.push_back({ t[first[1]][2], t[first[1]][1], t[first[1]][0] });
  const auto own = static_cast<std::int64_t>(mesh.Points.size());
  for (const std::int64_t id : { t[first[2]][1], t[first[2]][0], t[first[2]][2] })
  {
    mesh.Points.push_back(sphere.Points[static_cast<std::size_t>(id)]);
  }
  mesh.Triangles.push_back({ own, own + 1, own + 2 });

  const CutSurface cut(mesh.Surface());
  const CutSurface once(sphere.Surface());
  EXPECT_EQ(cut.NumberOfPoints(), once.NumberOfPoints());
  EXPECT_EQ(cut.Cuts().Repeated, 3);
  EXPECT_EQ(cut.Cuts().NonManifoldEdges, 0);
  EXPECT_EQ(cut.Cuts().FlatTriangles, 0);
  ASSERT_EQ(cut.Repeated().size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
  {
    const auto triangle = static_cast<std::int64_t>(t.size() + i);
    EXPECT_EQ(cut.Repeated()[i].Triangle, triangle);
    EXPECT_EQ(cut.Repeated()[i].First, static_cast<std::int64_t>(first[i]));
    EXPECT_EQ(cut.DiskOf(triangle), 0);
    const std::array<std::size_t, 3> order = i == 0 ? std::array<std::size_t, 3>{ 0, 1, 2 }
      : i == 1                                      ? std::array<std::size_t, 3>{ 2, 1, 0 }
                                                    : std::array<std::size_t, 3>{ 1, 0, 2 };
    for (std::size_t k = 0; k < 3; ++k)
    {
      EXPECT_EQ(
        cut.CornersOf(triangle)[k], cut.CornersOf(static_cast<std::int64_t>(first[i]))[order[k]]);
    }
  }
}

TEST(CutSurface, ManyHolesAreClosed)
{
  const Mesh few = makePerforated(24, 2);
  const CutSurface cutOpen(few.Surface());
  EXPECT_TRUE(cutOpen.Disks()[0].HasSeams);
  EXPECT_EQ(cutOpen.Disks()[0].AreaShareOfHoles, 0.0);

  const Mesh many = makePerforated(24, 4);
  const CutSurface cut(many.Surface());
  ASSERT_EQ(cut.Disks().size(), 1u);
  const CutDisk& disk = cut.Disks()[0];
  EXPECT_FALSE(disk.HasSeams);
  EXPECT_NEAR(disk.Area, areaOf(many), 1e-12);
  EXPECT_EQ(disk.Mesh->Boundary().size(), 4u * 24u);
  const auto given = static_cast<std::int64_t>(many.Triangles.size());
  EXPECT_EQ(disk.Mesh->NumberOfTriangles(), given + 16 * 8);
  double share = 0.0;
  for (std::int64_t t = 0; t < given; ++t)
  {
    share += disk.Mesh->AreaShare(t);
  }
  EXPECT_NEAR(share, 1.0 - disk.AreaShareOfHoles, 1e-12);
  EXPECT_NEAR(disk.AreaShareOfHoles, 0.02, 1e-12);
}

TEST(CutSurface, EveryComponentIsADisk)
{
  Mesh mesh = makeSphere({ 0.0, 0.0, 0.0 }, 1.0, 8);
  mesh.Add(shifted(makeRing(16, 8, 0.4), { 4.0, 0.0, 0.0 }));
  mesh.Add(shifted(makeTerrain(5, 5), { 8.0, 0.0, 0.0 }).Turned());
  mesh.Add(shifted(makeOpenCube(5), { 12.0, 0.0, 0.0 }));
  mesh.Add(Mesh{ { { 20.0, 0.0, 0.0 }, { 21.0, 0.0, 0.0 }, { 20.0, 1.0, 0.0 } }, { { 0, 1, 2 } } });
  const CutSurface cut(mesh.Surface());
  expectDisks(mesh, cut, 5);
  EXPECT_FALSE(cut.Disks()[4].Mesh);
  EXPECT_NEAR(cut.Disks()[4].Area / cut.Disks()[2].Area, 0.5 / areaOf(makeTerrain(5, 5)), 1e-12);
}

TEST(CutSurface, OrientationsNeedNotAgree)
{
  Mesh mesh = makeRing(16, 8, 0.4);
  for (std::size_t t = 0; t < mesh.Triangles.size(); t += 3)
  {
    std::swap(mesh.Triangles[t][1], mesh.Triangles[t][2]);
  }
  const CutSurface cut(mesh.Surface());
  expectDisks(mesh, cut, 1);
  for (std::int64_t t = 0; t < static_cast<std::int64_t>(mesh.Triangles.size()); ++t)
  {
    EXPECT_EQ(cut.IsTurned(t), t % 3 == 0) << t;
  }
}

TEST(CutSurface, SheetsPartWhereMoreThanTwoMeet)
{
  // Two cubes that share an edge, and two that share a corner.
  const auto cubes = [](std::int64_t x, std::int64_t y, std::int64_t z) {
    return x == y && (z == 0 || x == z);
  };
  const Mesh edge = makeCubes({ 2, 2, 1 }, 2, cubes);
  const CutSurface cut(edge.Surface());
  expectDisks(edge, cut, 2);
  EXPECT_EQ(cut.Cuts().NonManifoldEdges, 2);
  const Mesh corner = makeCubes({ 2, 2, 2 }, 2,
    [](std::int64_t x, std::int64_t y, std::int64_t z) { return x == y && y == z; });
  expectDisks(corner, CutSurface(corner.Surface()), 2);
  // Three sheets at one edge, each on its own.
  Mesh fan;
  for (int i = 0; i < 3; ++i)
  {
    const double angle = 2.0 * pi * i / 3.0;
    fan.Add(makeRectangle(3, 1).Mapped([angle](const Point<3>& p) {
      return Point<3>{ p[0], p[1] * std::cos(angle), p[1] * std::sin(angle) };
    }));
  }
  const CutSurface sheets(fan.Surface());
  EXPECT_EQ(sheets.Disks().size(), 3u);
  EXPECT_EQ(sheets.Cuts().NonManifoldEdges, 3);
}

TEST(CutSurface, RepairsAsDisksAre)
{
  // Triangles with points of their own, one without area, and a point of none.
  const Mesh sphere = makeSphere({ 0.0, 0.0, 0.0 }, 1.0, 8);
  Mesh soup = apart(sphere);
  soup.Triangles.push_back({ 0, 1, 1 });
  soup.Points.push_back({ 5.0, 5.0, 5.0 });
  const CutSurface cut(soup.Surface());
  ASSERT_EQ(cut.Disks().size(), 1u);
  EXPECT_EQ(cut.NumberOfPoints(), CutSurface(sphere.Surface()).NumberOfPoints());
  EXPECT_EQ(cut.Cuts().FlatTriangles, 1);
  EXPECT_EQ(cut.Cuts().UnusedPoints, 1);
  EXPECT_EQ(cut.Cuts().MergedPoints,
    static_cast<std::int64_t>(soup.Points.size() - sphere.Points.size()) - 1);
  const auto flat = static_cast<std::int64_t>(soup.Triangles.size()) - 1;
  EXPECT_EQ(cut.DiskOf(flat), -1);
  EXPECT_EQ(cut.PointOf(static_cast<std::int64_t>(soup.Points.size()) - 1), -1);
  EXPECT_GE(cut.PointOf(0), 0);
}

TEST(CutSurface, SmallestSurfaces)
{
  const Point<3> o{ 0.0, 0.0, 0.0 };
  const Mesh tetrahedron =
    makeTetrahedron(o, { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 });
  boundaryOf(tetrahedron);
  boundaryOf(makeBox(o, { 1.0, 1.0, 1.0 }));
  // Three points on the boundary, and one inside.
  Mesh open = tetrahedron;
  open.Triangles.pop_back();
  const CutSurface cut(open.Surface());
  expectDisks(open, cut, 1);
  EXPECT_EQ(cut.Disks()[0].Mesh->Boundary().size(), 5u);
}

TEST(CutSurface, SeamsGrowToTheTipsOfLimbs)
{
  const Mesh mesh = makeLimbs(24);
  SeamOptions once;
  once.MaximumRounds = 0;
  const CutSurface first(mesh.Surface(), once);
  const CutSurface cut(mesh.Surface());
  expectDisks(mesh, cut, 1);
  const auto squeezed = [](const CutSurface& made) {
    const CutDisk& disk = made.Disks()[0];
    double share = 0.0;
    for (std::int64_t t = 0; t < disk.Mesh->NumberOfTriangles(); ++t)
    {
      const double change = distortionOf(*disk.Mesh, disk.Conformal->Square.Positions, t).Area;
      share += change < 0.05 ? disk.Mesh->AreaShare(t) : 0.0;
    }
    return share;
  };
  EXPECT_GT(cut.NumberOfPoints(), first.NumberOfPoints() + 20);
  EXPECT_LT(squeezed(cut), 0.7 * squeezed(first));
}

TEST(CutSurface, CornersAreTheMostEvenOnes)
{
  for (const Mesh& mesh : { makeLimbs(16), makeHandles(2, 3), makeRing(24, 12, 0.4) })
  {
    const CutSurface cut(mesh.Surface());
    const DiskMesh& disk = *cut.Disks()[0].Mesh;
    const double found = areaDistortion(disk, cut.Disks()[0].Conformal->Square.Positions);
    const double chosen = areaDistortion(disk, mapped(disk).Square.Positions);
    EXPECT_LE(found, chosen);
  }
}

TEST(CutSurface, SameBitsOnAnyNumberOfThreads)
{
  Mesh mesh = makeLimbs(16);
  mesh.Add(shifted(makeHandles(2, 3), { 9.0, 0.0, 0.0 }));
  const CutSurface one(mesh.Surface(), {}, serial);
  for (const int threads : { 2, 3 })
  {
    const ThreadsExecutor executor(threads);
    const CutSurface other(mesh.Surface(), {}, executor);
    ASSERT_EQ(one.NumberOfPoints(), other.NumberOfPoints());
    for (std::int64_t t = 0; t < static_cast<std::int64_t>(mesh.Triangles.size()); ++t)
    {
      ASSERT_TRUE(std::equal(one.CornersOf(t), one.CornersOf(t) + 3, other.CornersOf(t)));
    }
    for (std::size_t i = 0; i < one.Disks().size(); ++i)
    {
      EXPECT_TRUE(sameBits(
        one.Disks()[i].Conformal->Square.Positions, other.Disks()[i].Conformal->Square.Positions));
    }
  }
}

TEST(CutSurface, ScaleAndPlaceDoNotMatter)
{
  const Mesh mesh = makeHandles(1, 3);
  const CutSurface cut(mesh.Surface());
  for (const double scale : { 0x1p-400, 0x1p400 })
  {
    const Mesh scaled = mesh.Mapped([scale](const Point<3>& p) {
      return Point<3>{ scale * p[0], scale * p[1], scale * p[2] };
    });
    const CutSurface other(scaled.Surface());
    ASSERT_EQ(cut.NumberOfPoints(), other.NumberOfPoints());
    for (std::int64_t t = 0; t < static_cast<std::int64_t>(mesh.Triangles.size()); ++t)
    {
      ASSERT_TRUE(std::equal(cut.CornersOf(t), cut.CornersOf(t) + 3, other.CornersOf(t)));
    }
  }
}

TEST(CutSurface, Refused)
{
  Mesh mesh = makeSphere({ 0.0, 0.0, 0.0 }, 1.0, 4);
  const auto defectOf = [](const Mesh& surface) {
    try
    {
      const CutSurface cut(surface.Surface());
    }
    catch (const NotADisk& defect)
    {
      return defect.Defect();
    }
    return DiskDefect::Closed;
  };
  EXPECT_EQ(defectOf(Mesh{ mesh.Points, {} }), DiskDefect::NoTriangles);
  EXPECT_EQ(
    defectOf(Mesh{ { { 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 2.0, 0.0, 0.0 } }, { { 0, 1, 2 } } }),
    DiskDefect::TrianglesWithoutArea);
  Mesh wrong = mesh;
  wrong.Points[3][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(defectOf(wrong), DiskDefect::PointsNotFinite);
  wrong = mesh;
  wrong.Triangles[2][1] = 1000;
  EXPECT_THROW(CutSurface(wrong.Surface()), std::invalid_argument);
}

TEST(CutSurface, ReportsAndIsCancelled)
{
  const Mesh mesh = makeRing(96, 48, 0.4);
  RecordingContext recorded(serial);
  const CutSurface cut(mesh.Surface(), {}, recorded.Context());
  recorded.ExpectReported(0.0, 1.0);
  for (const double limit : { 0.0, 0.2, 0.4, 0.6, 0.8 })
  {
    double reached = 0.0;
    const Context context(
      serial, [&](double done) { reached = done; }, [&]() { return reached >= limit; });
    EXPECT_THROW(CutSurface(mesh.Surface(), {}, context), Cancelled) << limit;
  }
}

} // namespace
} // namespace RectifiedTransport
