// SPDX-License-Identifier: BSD-3-Clause
// The functions of surfaces in one header, on plain data.
#include "Seams/SeamSurfaces.h"
#include "Surfaces/Surfaces.h"
#include "TestRefusal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

namespace RectifiedTransport
{
namespace
{

// The area of a triangle of a flat surface, positive if it turns left.
double flatArea(const Parameterization& flat, std::size_t triangle)
{
  const auto at = [&](std::size_t corner) {
    return flat.Positions[static_cast<std::size_t>(flat.Triangles[3 * triangle + corner])];
  };
  const Point<2> a = at(0);
  const Point<2> b = at(1);
  const Point<2> c = at(2);
  return 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]));
}

double area(const Mesh& mesh, std::size_t triangle)
{
  const auto& t = mesh.Triangles[triangle];
  const Point<3>& a = mesh.Points[static_cast<std::size_t>(t[0])];
  const Point<3>& b = mesh.Points[static_cast<std::size_t>(t[1])];
  const Point<3>& c = mesh.Points[static_cast<std::size_t>(t[2])];
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const std::size_t j = (i + 1) % 3;
    const double turn = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
    sum += turn * turn;
  }
  return 0.5 * std::sqrt(sum);
}

TEST(SurfaceFunctions, RingLiesFlatWithItsAreas)
{
  const Mesh ring = makeRing(40, 20, 0.4);
  const Parameterization flat = parameterize(ring.Surface());
  ASSERT_EQ(flat.Triangles.size(), 3 * ring.Triangles.size());
  ASSERT_EQ(flat.Origins.size(), flat.Positions.size());
  EXPECT_GT(flat.Positions.size(), ring.Points.size()) << "there is no seam";
  double whole = 0.0;
  double covered = 0.0;
  for (std::size_t i = 0; i < ring.Triangles.size(); ++i)
  {
    whole += area(ring, i);
    covered += std::abs(flatArea(flat, i));
    EXPECT_EQ(flat.Disks[i], 0);
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      const std::int64_t point = flat.Triangles[3 * i + corner];
      EXPECT_EQ(flat.Origins[static_cast<std::size_t>(point)], ring.Triangles[i][corner]);
    }
  }
  EXPECT_NEAR(covered, flat.Coverage, 1e-6);
  EXPECT_NEAR(flat.Coverage, 1.0, 1e-6);
  double squares = 0.0;
  for (std::size_t i = 0; i < ring.Triangles.size(); ++i)
  {
    const double share = area(ring, i) / whole;
    const double deviation = std::abs(flatArea(flat, i)) / covered / share - 1.0;
    squares += share * deviation * deviation;
  }
  EXPECT_NEAR(std::sqrt(squares), flat.Distortion.AreaRootMeanSquare, 1e-6);
  EXPECT_LT(flat.Distortion.AreaRootMeanSquare, 0.05);
  EXPECT_EQ(flat.Distortion.Flipped, 0);
}

// Two boxes are two disks, with areas in proportion; a triangle without area belongs to none.
TEST(SurfaceFunctions, EachComponentHasADisk)
{
  Mesh boxes = makeBox({ 0, 0, 0 }, { 1, 1, 1 });
  boxes.Add(makeBox({ 4, 0, 0 }, { 6, 2, 2 }));
  boxes.Triangles.push_back({ 0, 1, 1 });
  boxes.Points.push_back({ 9, 9, 9 });
  const Parameterization flat = parameterize(boxes.Surface());
  EXPECT_EQ(std::set<std::int64_t>(flat.Disks.begin(), flat.Disks.end()),
    (std::set<std::int64_t>{ -1, 0, 1 }));
  EXPECT_EQ(flat.Disks.back(), -1);
  double small = 0.0;
  double large = 0.0;
  for (std::size_t i = 0; i < 12; ++i)
  {
    small += std::abs(flatArea(flat, i));
    large += std::abs(flatArea(flat, i + 12));
  }
  EXPECT_NEAR(large / small, 4.0, 1e-6);
  EXPECT_NEAR(small + large, flat.Coverage, 1e-6);
  // No triangle has the last point.
  EXPECT_EQ(flat.Positions[boxes.Points.size() - 1], (Point<2>{ 0.0, 0.0 }));
}

TEST(SurfaceFunctions, SamplesFollowTheDensity)
{
  const Mesh box = makeBox({ 0, 0, 0 }, { 1, 1, 1 });
  EXPECT_EQ(sample(box.Surface(), 500).size(), 500u);
  // Three quarters of the mass on the first face, which has two triangles.
  std::vector<double> density(12, 1.0);
  density[0] = density[1] = 15.0;
  const std::vector<PlaceOnTriangle> places =
    sample(box.Surface(), 1000, { nullptr, density.data() });
  const auto first = std::count_if(
    places.begin(), places.end(), [](const PlaceOnTriangle& place) { return place.Triangle < 2; });
  EXPECT_NEAR(static_cast<double>(first), 750.0, 2.0);
  SurfaceSampleOptions other;
  other.RandomSeed = 2;
  other.Iterations = 0;
  EXPECT_NE(
    sample(box.Surface(), 100, {}, other)[0].Weights, sample(box.Surface(), 100)[0].Weights);
}

TEST(SurfaceFunctions, SolidHasItsVolume)
{
  const Mesh box = makeBox({ 1, 2, 3 }, { 5, 4, 4 });
  const SolidCells cells = solid(box.Surface(), 44);
  EXPECT_EQ(cells.Cells[0], 44);
  EXPECT_NEAR(cells.CellSide, 0.1, 1e-12);
  EXPECT_NEAR(cells.Low[0], 0.8, 1e-12);
  const double sum = std::accumulate(cells.Values.begin(), cells.Values.end(), 0.0);
  EXPECT_NEAR(sum * std::pow(cells.CellSide, 3), 8.0, 1e-9);
  // Boxes that intersect count once.
  Mesh two = box;
  two.Add(makeBox({ 3, 2, 3 }, { 6, 4, 4 }));
  SolidOptions options;
  options.Padding = 0.0;
  options.Supersampling = 4;
  const SolidCells united = solid(two.Surface(), 50, options);
  const double both = std::accumulate(united.Values.begin(), united.Values.end(), 0.0);
  EXPECT_NEAR(both * std::pow(united.CellSide, 3), 10.0, 1e-9);
}

// A slab of two unequal parts, tilted against the cells: no point is outside, and the parts have
// points in proportion to their volumes.
TEST(SurfaceFunctions, PointsFillASolid)
{
  Mesh boxes = makeBox({ 0, 0, 0 }, { 4, 2, 1 });
  boxes.Add(makeBox({ 6, 0, 0 }, { 7, 2, 1 }));
  constexpr double turn = 0.3;
  const auto turned = [](const Point<3>& x, double angle) {
    return Point<3>{ std::cos(angle) * x[0] - std::sin(angle) * x[1],
      std::sin(angle) * x[0] + std::cos(angle) * x[1], x[2] };
  };
  const Mesh tilted = boxes.Mapped([&](const Point<3>& x) { return turned(x, turn); });
  InsideOptions options;
  options.Resolution = 24;
  const std::vector<Point<3>> points = inside(tilted.Surface(), 2000, options);
  ASSERT_EQ(points.size(), 2000u);
  std::int64_t small = 0;
  for (const Point<3>& point : points)
  {
    const Point<3> x = turned(point, -turn);
    constexpr double rounding = 1e-9;
    const bool isIn = std::min({ x[0], x[1], x[2], 2.0 - x[1], 1.0 - x[2] }) > -rounding &&
      (x[0] < 4.0 + rounding || (x[0] > 6.0 - rounding && x[0] < 7.0 + rounding));
    EXPECT_TRUE(isIn) << x[0] << " " << x[1] << " " << x[2];
    small += x[0] > 5.0;
  }
  EXPECT_NEAR(static_cast<double>(small), 400.0, 8.0);
  // A surface with holes must be allowed.
  Mesh open = tilted;
  open.Triangles.erase(open.Triangles.begin());
  EXPECT_NE(
    refusal([&]() { inside(open.Surface(), 10, options); }).find("open edges"), std::string::npos);
  options.MayBeOpen = true;
  EXPECT_EQ(inside(open.Surface(), 10, options).size(), 10u);
  options.RandomSeed = 2;
  EXPECT_NE(inside(tilted.Surface(), 10, options), inside(tilted.Surface(), 10, { 24 }));
}

TEST(SurfaceFunctions, Refusals)
{
  Mesh box = makeBox({ 0, 0, 0 }, { 1, 1, 1 });
  const auto expect = [&box](const char* text, int resolution, const SolidOptions& options = {}) {
    const std::string found = refusal([&]() { solid(box.Surface(), resolution, options); });
    EXPECT_NE(found.find(text), std::string::npos) << found;
  };
  expect("Resolution is 0; it must be from 1 to", 0);
  expect("Padding is -1", 8, { -1.0 });
  expect("Supersampling is 0; it must be 1 or more", 8, { 0.0, 0 });
  EXPECT_NE(refusal([&]() { sample(box.Surface(), -1); }), "");
  box.Triangles.pop_back();
  expect("the surface is not closed: it has 3 open edges", 8);
  box = makeProjectivePlane(0);
  expect("the surface has one side only", 8);
  box.Points[0][1] = std::numeric_limits<double>::quiet_NaN();
  expect("point 0 is not finite", 8);
  EXPECT_THROW(parameterize(box.Surface()), NotADisk);
  box = {};
  expect("the surface has no triangles", 8);
}

} // namespace
} // namespace RectifiedTransport
