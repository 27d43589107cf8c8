// SPDX-License-Identifier: BSD-3-Clause
// Coverage is exact, however thin a solid is, where bodies lie beside or within each other; where
// they overlap it converges.
#include "SolidSurfaces.h"

#include <gtest/gtest.h>

namespace RectifiedTransport
{
namespace
{

const GridSize<3> Cells{ 9, 8, 7 };

Mesh rotated(const Mesh& mesh, std::mt19937_64& random, const Point<3>& centre)
{
  std::normal_distribution<double> normal;
  const double q[4] = { normal(random), normal(random), normal(random), normal(random) };
  const double norm = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  return mesh.Mapped([&](const Point<3>& p) {
    Point<3> v;
    for (int i = 0; i < 3; ++i)
    {
      v[i] = p[i] - centre[i];
    }
    const double* u = q + 1;
    const double dot = u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    const double square = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
    const Point<3> cross{ u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
      u[0] * v[1] - u[1] * v[0] };
    Point<3> turned;
    for (int i = 0; i < 3; ++i)
    {
      turned[i] = centre[i] +
        (2.0 * dot * u[i] + (q[0] * q[0] - square) * v[i] + 2.0 * q[0] * cross[i]) / norm;
    }
    return turned;
  });
}

double overlap(double low, double high, double cell)
{
  return std::max(0.0, std::min(high, cell + 1.0) - std::max(low, cell));
}

// Every cell of a box along the axes: the product of what it covers along each.
void expectBox(const Point<3>& low, const Point<3>& high, double tolerance)
{
  for (const int supersampling : { 1, 2 })
  {
    const std::vector<double> found = cover(makeBox(low, high), Cells, supersampling);
    for (std::int64_t i = 0; i < static_cast<std::int64_t>(found.size()); ++i)
    {
      const auto x = static_cast<double>(i % Cells[0]);
      const auto y = static_cast<double>(i / Cells[0] % Cells[1]);
      const auto z = static_cast<double>(i / Cells[0] / Cells[1]);
      const double truth =
        overlap(low[0], high[0], x) * overlap(low[1], high[1], y) * overlap(low[2], high[2], z);
      ASSERT_NEAR(found[static_cast<std::size_t>(i)], truth, tolerance) << i;
    }
    EXPECT_NEAR(
      sum(found) / ((high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2])), 1.0, 1e-6);
  }
}

TEST(ExactCoverage, BoxesPlatesAndRods)
{
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(0.2, 2.5);
  std::uniform_real_distribution<double> side(0.1, 4.4);
  for (int run = 0; run < 40; ++run)
  {
    for (const double thin : { 1.0, 0.3, 1e-3, 1e-7 })
    {
      const Point<3> low{ place(random), place(random), place(random) };
      for (int plate = 1; plate < 8; ++plate) // of one, two or three thin sides
      {
        Point<3> high;
        for (int a = 0; a < 3; ++a)
        {
          high[a] = low[a] + ((plate >> a & 1) != 0 ? thin : 1.0) * side(random);
        }
        if (plate < 7 || thin > 1e-4) // sums are multiples of 2^-72
        {
          expectBox(low, high, 1e-14);
        }
      }
    }
  }
}

// Of any turn: the volume; and each cell against many lines.
TEST(ExactCoverage, TurnedBoxes)
{
  std::mt19937_64 random(2);
  for (int run = 0; run < 30; ++run)
  {
    const double thin = std::pow(10.0, -(run % 6));
    const Mesh box =
      rotated(makeBox({ 2.6, 2.3, 3.5 - 0.5 * thin }, { 5.8, 5.1, 3.5 + 0.5 * thin }), random,
        { 4.2, 3.9, 3.5 });
    const std::vector<double> found = cover(box, Cells, 1 + run % 3);
    EXPECT_NEAR(sum(found) / box.Volume(), 1.0, 1e-11 / thin) << run;
    if (thin == 1.0)
    {
      const auto truth = coverByLines(Cells, 40, [&box](double y, double z) {
        return std::vector<std::array<double, 2>>{ clipLine(box, y, z) };
      });
      for (std::size_t i = 0; i < found.size(); ++i)
      {
        ASSERT_NEAR(found[i], truth[i], 3e-3) << run << " " << i;
      }
    }
  }
}

// A sphere of many triangles, its cells against its refinement: eight cells have the mass of one.
TEST(ExactCoverage, RefinedGridsAgree)
{
  const Mesh mesh = makeSphere({ 4.3, 3.9, 3.6 }, 3.1, 24);
  const std::vector<double> coarse = cover(mesh, Cells, 1);
  const std::vector<double> fine = cover(mesh.Mapped([](const Point<3>& p) {
    return Point<3>{ 2.0 * p[0], 2.0 * p[1], 2.0 * p[2] };
  }),
    { 18, 16, 14 }, 2);
  std::vector<double> eighths(coarse.size(), 0.0);
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(fine.size()); ++i)
  {
    const std::int64_t parent = i % 18 / 2 + 9 * (i / 18 % 16 / 2 + 8 * (i / 18 / 16 / 2));
    eighths[static_cast<std::size_t>(parent)] += 0.125 * fine[static_cast<std::size_t>(i)];
  }
  for (std::size_t i = 0; i < coarse.size(); ++i)
  {
    ASSERT_NEAR(coarse[i], eighths[i], 1e-14) << i;
  }
  EXPECT_NEAR(sum(coarse), mesh.Volume(), 1e-11);
}

// Bodies beside and within each other need no lines: thin ones are exact, whichever way they are
// turned.
TEST(ExactCoverage, BodiesThatLinesMiss)
{
  const auto plate = [](double z, double thickness) {
    return makeBox({ 1.1, 1.2, z }, { 6.1, 5.2, z + thickness });
  };
  Mesh apart = plate(1.01, 1e-4);
  apart.Add(plate(3.02, 2e-4).Turned());
  apart.Add(plate(5.03, 1e-4));
  EXPECT_NEAR(sum(cover(apart, Cells, 2)), 20.0 * 4e-4, 1e-12);
  EXPECT_NEAR(sum(cover(apart.Turned(), Cells, 2)), 20.0 * 4e-4, 1e-12);
  // A slit, a plate that changes nothing, and a plate within the slit.
  const Mesh block = makeBox({ 0.5, 0.5, 0.5 }, { 7.5, 6.5, 6.5 });
  Mesh slit = block;
  slit.Add(plate(3.02, 3e-4).Turned());
  EXPECT_NEAR(sum(cover(slit, Cells, 2)), 252.0 - 20.0 * 3e-4, 1e-10);
  EXPECT_NEAR(sum(cover(slit.Turned(), Cells, 2)), 252.0 - 20.0 * 3e-4, 1e-10);
  Mesh filled = slit;
  filled.Add(makeBox({ 2.1, 2.2, 3.0201 }, { 5.1, 4.2, 3.0202 }));
  EXPECT_NEAR(sum(cover(filled, Cells, 2)), 252.0 - 20.0 * 3e-4 + 6e-4, 1e-10);
  Mesh nested = block;
  nested.Add(plate(3.02, 3e-4));
  EXPECT_NEAR(sum(cover(nested, Cells, 2)), 252.0, 1e-10);
}

// Where bodies pass through each other lines are needed: the error falls with the number of cells
// and of lines.
TEST(ExactCoverage, OverlapConverges)
{
  const auto error = [](std::int64_t side, int supersampling) {
    const auto scale = static_cast<double>(side);
    double largest = 0.0;
    for (int i = 0; i < 6; ++i)
    {
      const double at = 0.4 + 0.0037 * i;
      Mesh both = makeSphere({ at * scale, 0.5 * scale, 0.49 * scale }, 0.3 * scale, 60);
      both.Add(makeSphere({ (at + 0.2) * scale, 0.5 * scale, 0.49 * scale }, 0.3 * scale, 60));
      // Two balls of radius r, a distance d apart, share pi (4 r + d) (2 r - d)^2 / 12.
      const double lens = pi * 1.4 * 0.4 * 0.4 / 12.0;
      const double facets = both.Volume() / (2.0 * 4.0 / 3.0 * pi * 0.027);
      const double truth = both.Volume() - facets * lens;
      largest = std::max(
        largest, std::abs(sum(cover(both, { side, side, side }, supersampling)) / truth - 1.0));
    }
    return largest;
  };
  EXPECT_LT(error(8, 1), 0.1);
  EXPECT_LT(error(32, 1), error(8, 1) / 4.0);
  EXPECT_LT(error(8, 4), error(8, 1) / 4.0);
  EXPECT_LT(error(32, 4), 1e-3);
}

// However few lines find an overlap: no more than half of two boxes.
TEST(ExactCoverage, OverlapIsNoLoss)
{
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> low(0.05, 0.45);
  std::uniform_real_distribution<double> side(0.1, 0.5);
  for (int run = 0; run < 200; ++run)
  {
    const auto drawBox = [&]() {
      const Point<3> corner{ low(random), low(random), low(random) };
      return makeBox(
        corner, { corner[0] + side(random), corner[1] + side(random), corner[2] + side(random) });
    };
    Mesh both = drawBox();
    both.Add(drawBox());
    const double found = sum(cover(both, { 1, 1, 1 }, 1 + run % 3));
    EXPECT_GT(found, 0.4 * both.Volume()) << run;
    EXPECT_LT(found, 1.0000001 * both.Volume()) << run;
  }
}

// The order of the triangles is of no consequence, as of surfaces that ranks gather.
TEST(ExactCoverage, AnyOrder)
{
  Mesh mesh = makeSphere({ 4.1, 3.9, 3.3 }, 2.9, 17);
  mesh.Add(makeSphere({ 5.1, 4.0, 3.5 }, 2.2, 13));
  mesh.Add(makeSphere({ 4.1, 3.9, 3.3 }, 0.9, 5).Turned());
  const std::vector<double> wanted = cover(mesh, Cells, 2);
  std::mt19937_64 random(3);
  for (int run = 0; run < 5; ++run)
  {
    std::shuffle(mesh.Triangles.begin(), mesh.Triangles.end(), random);
    EXPECT_EQ(cover(mesh, Cells, 2), wanted);
  }
}

} // namespace
} // namespace RectifiedTransport
