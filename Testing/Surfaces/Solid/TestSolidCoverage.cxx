// SPDX-License-Identifier: BSD-3-Clause
// Coverage by closed surfaces: against planes, volumes and each other, where surfaces lie on
// lines, with any turn, and on any number of threads.
#include "SolidSurfaces.h"

#include <gtest/gtest.h>

#include <atomic>

#ifdef _OPENMP
#include <omp.h>
#endif

namespace RectifiedTransport
{
namespace
{

void expectNear(
  const std::vector<double>& a, const std::vector<double>& b, double tolerance, const char* what)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    ASSERT_NEAR(a[i], b[i], tolerance) << what << ", cell " << i;
  }
}

// A covering from 0 to 1 without leaks.
std::vector<double> coverClosed(const Mesh& mesh, const GridSize<3>& cells, int supersampling)
{
  std::int64_t open = -1;
  std::vector<double> coverage = cover(mesh, cells, supersampling, SerialExecutor(), &open);
  EXPECT_EQ(open, 0);
  for (const double value : coverage)
  {
    EXPECT_TRUE(value >= 0.0 && value <= 1.0) << value;
  }
  return coverage;
}

Point<3> randomPoint(std::mt19937_64& random, double low, double high, double step)
{
  std::uniform_real_distribution<double> between(low, high);
  Point<3> point;
  for (double& x : point)
  {
    x = between(random);
    x = step > 0.0 ? std::round(x / step) * step : x;
  }
  return point;
}

TEST(SolidCoverage, TetrahedraByPlanes)
{
  const GridSize<3> cells{ 9, 8, 7 };
  std::mt19937_64 random(3);
  for (int i = 0; i < 40; ++i)
  {
    Point<3> corners[4];
    for (Point<3>& corner : corners)
    {
      corner = randomPoint(random, 0.1, 6.9, 0.0);
    }
    const Mesh mesh = makeTetrahedron(corners[0], corners[1], corners[2], corners[3]);
    const int supersampling = 1 + i % 4;
    const auto truth = coverByLines(cells, 32, [&mesh](double y, double z) {
      return std::vector<std::array<double, 2>>{ clipLine(mesh, y, z) };
    });
    const std::vector<double> found = coverClosed(mesh, cells, supersampling);
    expectNear(found, truth, 1e-2, "tetrahedron");
    EXPECT_NEAR(sum(found), mesh.Volume(), 1e-12);
    expectNear(coverClosed(mesh.Turned(), cells, supersampling), found, 1e-14, "inside out");
  }
}

// Faces on the borders of cells, on lines and on rows of lines: all lines count once.
TEST(SolidCoverage, BoxesOnBordersAndLines)
{
  const GridSize<3> cells{ 6, 6, 6 };
  const auto boxCoverage = [&cells](const Point<3>& low, const Point<3>& high) {
    return coverClosed(makeBox(low, high), cells, 2);
  };
  const std::vector<double> whole = boxCoverage({ 1, 2, 3 }, { 4, 5, 5 });
  for (std::int64_t i = 0; i < 216; ++i)
  {
    const std::int64_t x = i % 6;
    const std::int64_t y = i / 6 % 6;
    const std::int64_t z = i / 36;
    const bool inside = x >= 1 && x < 4 && y >= 2 && y < 5 && z >= 3 && z < 5;
    ASSERT_EQ(whole[static_cast<std::size_t>(i)], inside ? 1.0 : 0.0);
  }
  // Lines are at quarters. Two boxes that meet on lines have what their union has.
  const std::vector<double> left = boxCoverage({ 1, 0.75, 1.25 }, { 5, 2.25, 4.75 });
  const std::vector<double> right = boxCoverage({ 1, 2.25, 1.25 }, { 5, 5.25, 4.75 });
  std::vector<double> both = boxCoverage({ 1, 0.75, 1.25 }, { 5, 5.25, 4.75 });
  for (std::size_t i = 0; i < both.size(); ++i)
  {
    ASSERT_EQ(left[i] + right[i], both[i]);
  }
  EXPECT_EQ(sum(both), 4.0 * 4.5 * 3.5);
  // Within one cell: the exact length along x.
  EXPECT_NEAR(sum(boxCoverage({ 1.2, 1, 1 }, { 1.5, 2, 2 })), 0.3, 1e-15);
  // The grid's own box, and one that is larger.
  EXPECT_EQ(sum(boxCoverage({ 0, 0, 0 }, { 6, 6, 6 })), 216.0);
  EXPECT_EQ(sum(boxCoverage({ -3, -1, -2 }, { 7, 9, 6.5 })), 216.0);
}

// A box is the sum of the tetrahedra that it is cut into, whose corners are all on lines and rows.
TEST(SolidCoverage, PartsAddUpOnLines)
{
  const GridSize<3> cells{ 8, 8, 8 };
  std::mt19937_64 random(7);
  for (int run = 0; run < 50; ++run)
  {
    Point<3> low = randomPoint(random, 1.0, 3.0, 0.25);
    Point<3> high = randomPoint(random, 4.0, 7.0, 0.25);
    const Mesh box = makeBox(low, high);
    // Somewhere inside, joined with every triangle of the box.
    const Point<3> centre = randomPoint(random, 3.25, 3.75, 0.25);
    std::vector<double> parts(512, 0.0);
    for (const auto& t : box.Triangles)
    {
      const std::vector<double> part = coverClosed(
        makeTetrahedron(box.Points[t[0]], box.Points[t[1]], box.Points[t[2]], centre), cells, 2);
      for (std::size_t i = 0; i < part.size(); ++i)
      {
        parts[i] += part[i];
      }
    }
    expectNear(parts, coverClosed(box, cells, 2), 1e-13, "parts");
  }
}

// Every triangle's corners are on lines: what a careless rule would leak on. What is on a line
// counts as below it, so that the surface covers what it does a trifle lower.
TEST(SolidCoverage, NoLeaksOnLattices)
{
  const GridSize<3> cells{ 12, 12, 12 };
  const double step = 0.25;
  std::mt19937_64 random(11);
  for (int run = 0; run < 60; ++run)
  {
    std::uniform_real_distribution<double> radius(1.0, 5.0);
    const double r = radius(random);
    const Mesh sphere = makeSphere({ 6, 6, 6 }, r, 4 + run % 9).Mapped([&](const Point<3>& p) {
      return Point<3>{ std::round(p[0] / step) * step, std::round(p[1] / step) * step,
        std::round(p[2] / step) * step };
    });
    const std::vector<double> coverage = coverClosed(sphere, cells, 2);
    const Mesh lower = sphere.Mapped([](const Point<3>& p) {
      return Point<3>{ p[0], p[1] - 1e-7, p[2] - 1e-10 };
    });
    expectNear(coverage, coverClosed(lower, cells, 2), 1e-5, "a trifle lower");
    EXPECT_NEAR(sum(coverage), sphere.Volume(), 0.02 * sphere.Volume());
    for (std::int64_t i = 0; i < 1728; ++i)
    {
      const double low[3] = { static_cast<double>(i % 12), static_cast<double>(i / 12 % 12),
        static_cast<double>(i / 144) };
      for (const double x : low)
      {
        if (x >= 6.0 + r + 1.0 || x + 1.0 <= 6.0 - r - 1.0)
        {
          ASSERT_EQ(coverage[static_cast<std::size_t>(i)], 0.0);
        }
      }
    }
  }
}

// Edges that pass lines within the last bits: both triangles must see them on the same side.
TEST(SolidCoverage, NoLeaksAlongEdges)
{
  const GridSize<3> cells{ 4, 4, 4 };
  std::mt19937_64 random(13);
  for (int run = 0; run < 20000; ++run)
  {
    const Point<3> a = randomPoint(random, 0.1, 3.9, 0.0);
    const Point<3> line = randomPoint(random, 1.0, 2.0, 1.0);
    const double t = randomPoint(random, 1.1, 1.6, 0.0)[0];
    Point<3> b;
    for (int i = 0; i < 3; ++i)
    {
      b[i] = a[i] + t * (line[i] + 0.5 - a[i]);
    }
    const Mesh mesh =
      makeTetrahedron(a, b, randomPoint(random, 0.1, 3.9, 0.0), randomPoint(random, 0.1, 3.9, 0.0));
    coverClosed(mesh, cells, 1);
  }
}

// Parts of a cell that add up to all of it do not pass it.
TEST(SolidCoverage, SlabsOfOneCell)
{
  std::mt19937_64 random(17);
  for (int run = 0; run < 200; ++run)
  {
    std::vector<double> cuts{ 0.0, 1.0 };
    for (int i = 0; i < 9; ++i)
    {
      cuts.push_back(randomPoint(random, 0.0, 1.0, 0.0)[0]);
    }
    std::sort(cuts.begin(), cuts.end());
    Mesh slabs;
    for (std::size_t i = 1; i < cuts.size(); ++i)
    {
      slabs.Add(makeBox({ cuts[i - 1], 0, 0 }, { cuts[i], 1, 1 }));
    }
    EXPECT_NEAR(coverClosed(slabs, { 1, 1, 1 }, 1 + run % 3)[0], 1.0, 1e-14);
  }
}

// Flat triangles and needles, rotated at random.
TEST(SolidCoverage, NoLeaksOfRotatedNeedles)
{
  const GridSize<3> cells{ 40, 40, 40 };
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (int run = 0; run < 20; ++run)
  {
    double q[4];
    double norm = 0.0;
    for (double& part : q)
    {
      part = normal(random);
      norm += part * part;
    }
    const double thin = std::pow(10.0, -(run % 6));
    const Mesh mesh = makeSphere({ 0, 0, 0 }, 1.0, 24).Mapped([&](const Point<3>& p) {
      const double v[3] = { 18.0 * p[0], 18.0 * thin * p[1], (run % 2 ? 18.0 : thin) * p[2] };
      const double w = q[0];
      const double* u = q + 1;
      const double dot = u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
      const double square = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
      const double cross[3] = { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
        u[0] * v[1] - u[1] * v[0] };
      Point<3> rotated;
      for (int i = 0; i < 3; ++i)
      {
        rotated[i] =
          20.0 + (2.0 * dot * u[i] + (w * w - square) * v[i] + 2.0 * w * cross[i]) / norm;
      }
      return rotated;
    });
    const double volume = mesh.Volume();
    EXPECT_NEAR(sum(coverClosed(mesh, cells, 3)), volume, 1e-11 * volume + 1e-9) << run;
  }
}

TEST(SolidCoverage, Torus)
{
  const Mesh mesh = makeTorus(64, 32, [](double u, double v) {
    const double r = 10.0 + 4.0 * std::cos(2.0 * pi * v);
    return Point<3>{ 15.9 + r * std::cos(2.0 * pi * u), 16.2 + r * std::sin(2.0 * pi * u),
      16.3 + 4.0 * std::sin(2.0 * pi * v) };
  });
  const std::vector<double> coverage = coverClosed(mesh, { 32, 32, 32 }, 2);
  EXPECT_NEAR(sum(coverage) / mesh.Volume(), 1.0, 1e-12);
  EXPECT_EQ(coverage[(16 * 32 + 16) * 32 + 16], 0.0); // the hole
}

// A turned component within another is a cavity; one that is not changes nothing.
TEST(SolidCoverage, Cavity)
{
  const GridSize<3> cells{ 24, 24, 24 };
  const Mesh outer = makeSphere({ 12, 12, 12 }, 10.3, 20);
  const Mesh inner = makeSphere({ 13, 12, 11 }, 5.1, 20);
  const std::vector<double> ball = coverClosed(outer, cells, 2);
  const std::vector<double> hole = coverClosed(inner, cells, 2);
  std::vector<double> difference(ball.size());
  for (std::size_t i = 0; i < ball.size(); ++i)
  {
    difference[i] = ball[i] - hole[i];
  }
  Mesh shell = outer;
  shell.Add(inner.Turned());
  expectNear(coverClosed(shell, cells, 2), difference, 1e-13, "shell");
  expectNear(coverClosed(shell.Turned(), cells, 2), difference, 1e-13, "shell inside out");
  Mesh nested = outer;
  nested.Add(inner);
  expectNear(coverClosed(nested, cells, 2), ball, 1e-13, "nested");
}

TEST(SolidCoverage, OverlapIsUnited)
{
  const GridSize<3> cells{ 20, 16, 16 };
  const Mesh a = makeBox({ 1.3, 2.2, 3.1 }, { 10.4, 9.7, 12.6 });
  const Mesh b =
    makeTetrahedron({ 5.1, 1.2, 1.3 }, { 18.2, 4.1, 9.9 }, { 7.3, 14.2, 3.8 }, { 8.8, 6.1, 14.7 });
  Mesh both = a;
  both.Add(b);
  const auto truth = coverByLines(cells, 40, [&](double y, double z) {
    const std::array<double, 2> p = clipLine(a, y, z);
    const std::array<double, 2> q = clipLine(b, y, z);
    std::vector<std::array<double, 2>> parts{ p, q };
    if (p[0] < p[1] && q[0] < q[1] && std::max(p[0], q[0]) < std::min(p[1], q[1]))
    {
      parts = { { std::min(p[0], q[0]), std::max(p[1], q[1]) } };
    }
    return parts;
  });
  expectNear(coverClosed(both, cells, 16), truth, 4e-2, "union");
  expectNear(coverClosed(both, cells, 2), truth, 0.3, "union by few lines");
  // Twice the same component, one way and the other way.
  Mesh twice = b;
  twice.Add(b);
  const std::vector<double> once = coverClosed(b, cells, 2);
  EXPECT_EQ(coverClosed(twice, cells, 2), once);
  Mesh none = b;
  none.Add(b.Turned());
  EXPECT_EQ(sum(coverClosed(none, cells, 2)), 0.0);
}

TEST(SolidCoverage, MirroredAndPermuted)
{
  const GridSize<3> cells{ 16, 16, 16 };
  const Mesh mesh = makeSphere({ 7.13, 8.39, 8.81 }, 6.2, 14);
  const std::vector<double> coverage = coverClosed(mesh, cells, 2);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::vector<double> mirrored = coverClosed(mesh.Mapped([axis](Point<3> p) {
      p[axis] = 16.0 - p[axis];
      return p;
    }),
      cells, 2);
    const std::int64_t stride = axis == 0 ? 1 : axis == 1 ? 16 : 256;
    for (std::int64_t i = 0; i < 4096; ++i)
    {
      const std::int64_t at = i / stride % 16;
      ASSERT_NEAR(mirrored[static_cast<std::size_t>(i + (15 - 2 * at) * stride)],
        coverage[static_cast<std::size_t>(i)], 1e-12);
    }
  }
  // Lines of all axes are as good as each other, and exact in the limit.
  const std::vector<double> fine = coverClosed(mesh, cells, 16);
  const std::vector<double> permuted = coverClosed(mesh.Mapped([](const Point<3>& p) {
    return Point<3>{ p[1], p[2], p[0] };
  }),
    cells, 16);
  double largest = 0.0;
  for (std::int64_t i = 0; i < 4096; ++i)
  {
    const std::int64_t x = i % 16;
    const std::int64_t y = i / 16 % 16;
    const std::int64_t z = i / 256;
    largest = std::max(largest,
      std::abs(fine[static_cast<std::size_t>(i)] -
        permuted[static_cast<std::size_t>((x * 16 + z) * 16 + y)]));
  }
  EXPECT_LT(largest, 0.02);
  EXPECT_GT(largest, 0.0);
}

TEST(SolidCoverage, SameBitsOnAnyThreads)
{
  const GridSize<3> cells{ 50, 47, 61 };
  Mesh mesh = makeSphere({ 25, 23, 30 }, 21.0, 40);
  mesh.Add(makeSphere({ 30, 25, 40 }, 15.0, 30));
  const std::vector<double> serial = cover(mesh, cells, 3);
#ifdef _OPENMP
  const int before = omp_get_max_threads();
  for (const int threads : { 1, 2, 3 })
  {
    omp_set_num_threads(threads);
    EXPECT_EQ(cover(mesh, cells, 3, OpenMPExecutor()), serial);
  }
  omp_set_num_threads(before);
#endif
  EXPECT_GT(sum(serial), 1000.0);
}

TEST(SolidCoverage, OpenSurfacesAreTold)
{
  Mesh mesh = makeBox({ 1, 1, 1 }, { 5, 5, 5 });
  mesh.Triangles.pop_back();
  std::int64_t open = 0;
  const std::vector<double> coverage = cover(mesh, { 6, 6, 6 }, 2, SerialExecutor(), &open);
  EXPECT_GT(open, 0);
  EXPECT_LT(open, 64); // half of the face's lines
  for (const double value : coverage)
  {
    EXPECT_TRUE(value >= 0.0 && value <= 1.0);
  }
  EXPECT_EQ(sum(cover(Mesh{}, { 6, 6, 6 }, 2, SerialExecutor(), &open)), 0.0);
  EXPECT_EQ(open, 0);
}

// The same bits as of the whole, whichever boxes of the grid are covered.
TEST(SolidCoverage, PartsAreThoseOfTheWhole)
{
  const Mesh mesh = makeSphere({ 6.3, 5.1, 7.2 }, 4.7, 30);
  const GridSize<3> cells{ 13, 11, 15 };
  const std::vector<double> whole = cover(mesh, cells, 3, SerialExecutor());
  const LatticePart<3> parts[] = { { {}, cells }, { { 0, 0, 7 }, { 13, 11, 8 } },
    { { 0, 4, 0 }, { 13, 3, 15 } }, { { 5, 0, 0 }, { 6, 11, 15 } }, { { 2, 3, 4 }, { 7, 5, 6 } },
    { { 12, 10, 14 }, { 1, 1, 1 } }, { { 3, 3, 3 }, { 0, 4, 4 } } };
  for (const LatticePart<3>& part : parts)
  {
    std::vector<double> coverage(static_cast<std::size_t>(part.Count()), -1.0);
    coverPartOfSolid(mesh.Surface(), cells, part, 3, coverage.data());
    for (std::int64_t i = 0; i < part.Count(); ++i)
    {
      const GridSize<3> cell = part.CellOf(i);
      const std::int64_t number = cell[0] + cells[0] * (cell[1] + cells[1] * cell[2]);
      EXPECT_EQ(coverage[static_cast<std::size_t>(i)], whole[static_cast<std::size_t>(number)]);
    }
  }
}

TEST(SolidCoverage, ProgressAndCancel)
{
  const Mesh mesh = makeSphere({ 40, 40, 40 }, 35.0, 200);
  const GridSize<3> cells{ 80, 80, 80 };
  std::vector<double> coverage(512000);
  std::vector<double> reported;
  double limit = 2.0;
  const OpenMPExecutor threads;
  const Context context(
    threads, [&reported](double progress) { reported.push_back(progress); },
    [&]() { return !reported.empty() && reported.back() >= limit; });
  coverSolid(mesh.Surface(), cells, 4, coverage.data(), context);
  EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end()));
  EXPECT_GE(reported.front(), 0.0);
  EXPECT_EQ(reported.back(), 1.0);
  for (const double from : { 0.0, 0.06, 0.2, 0.5 })
  {
    reported.clear();
    limit = from;
    EXPECT_THROW(coverSolid(mesh.Surface(), cells, 4, coverage.data(), context), Cancelled) << from;
  }
  // In the middle of the work, without progress.
  for (const int most : { 1, 3, 10 })
  {
    std::atomic<int> asked{ 0 };
    const Context impatient(threads, {}, [&asked, most]() { return ++asked > most; });
    EXPECT_THROW(coverSolid(mesh.Surface(), cells, 16, coverage.data(), impatient), Cancelled)
      << most;
    // Once more for each other thread, and at the end of the slice.
    EXPECT_LE(asked, most + 1 + threads.Concurrency());
  }
}

} // namespace
} // namespace RectifiedTransport
