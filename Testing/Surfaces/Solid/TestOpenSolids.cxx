// SPDX-License-Identifier: BSD-3-Clause
// Surfaces with holes: their winding numbers against sums over all triangles, and what they cover.
#include "SolidSurfaces.h"

#include "Surfaces/Solid/WindingTree.h"
#include "Surfaces/Surfaces.h"

#include <gtest/gtest.h>

namespace RectifiedTransport
{
namespace
{

// The triangles whose middle is in none of some balls.
Mesh withHoles(const Mesh& mesh, const std::vector<Point<3>>& centres, double radius)
{
  Mesh open = mesh;
  open.Triangles.clear();
  for (const auto& t : mesh.Triangles)
  {
    bool stays = true;
    for (const Point<3>& centre : centres)
    {
      double squared = 0.0;
      for (std::size_t i = 0; i < 3; ++i)
      {
        const double middle =
          (mesh.Points[t[0]][i] + mesh.Points[t[1]][i] + mesh.Points[t[2]][i]) / 3.0;
        squared += (middle - centre[i]) * (middle - centre[i]);
      }
      stays = stays && squared > radius * radius;
    }
    if (stays)
    {
      open.Triangles.push_back(t);
    }
  }
  return open;
}

// Five holes as large as those of a scan on its stand.
Mesh scanned()
{
  const double s = std::sqrt(0.5);
  return withHoles(makeSphere({ 0, 0, 0 }, 1.0, 80),
    { { 0, 0, -1 }, { 1, 0, 0 }, { 0, -s, s }, { -s, s, 0 }, { -s, -s, 0 } }, 0.15);
}

// The solid angles of all triangles, by the sides of their spherical triangles (L'Huilier).
double windingOf(const Mesh& mesh, const Point<3>& place)
{
  double sum = 0.0;
  for (const auto& t : mesh.Triangles)
  {
    Point<3> corner[3];
    for (std::size_t i = 0; i < 3; ++i)
    {
      double squared = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        corner[i][axis] = mesh.Points[t[i]][axis] - place[axis];
        squared += corner[i][axis] * corner[i][axis];
      }
      for (double& x : corner[i])
      {
        x /= std::sqrt(squared);
      }
    }
    const auto angle = [&](int i, int j) {
      double product = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        product += corner[i][axis] * corner[j][axis];
      }
      return std::acos(std::clamp(product, -1.0, 1.0));
    };
    const double a = angle(1, 2);
    const double b = angle(2, 0);
    const double c = angle(0, 1);
    const double s = (a + b + c) / 2.0;
    const double tangents = std::tan(s / 2.0) * std::tan((s - a) / 2.0) * std::tan((s - b) / 2.0) *
      std::tan((s - c) / 2.0);
    const double excess = 4.0 * std::atan(std::sqrt(std::max(0.0, tangents)));
    const double side = corner[0][0] * (corner[1][1] * corner[2][2] - corner[1][2] * corner[2][1]) +
      corner[0][1] * (corner[1][2] * corner[2][0] - corner[1][0] * corner[2][2]) +
      corner[0][2] * (corner[1][0] * corner[2][1] - corner[1][1] * corner[2][0]);
    sum += side < 0.0 ? -excess : excess;
  }
  return sum / (4.0 * pi);
}

TEST(OpenSolids, WindingNumbersAreThoseOfAllTriangles)
{
  const Mesh mesh = scanned();
  const WindingTree tree(mesh.Surface());
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> between(-1.5, 1.5);
  double worst = 0.0;
  for (int i = 0; i < 300; ++i)
  {
    const Point<3> place{ between(random), between(random), between(random) };
    worst = std::max(worst, std::abs(tree.At(place) - windingOf(mesh, place)));
  }
  EXPECT_LT(worst, 0.08);
}

TEST(OpenSolids, ClosedSurfacesHaveWholeNumbers)
{
  Mesh mesh = makeSphere({ 0, 0, 0 }, 1.0, 30);
  mesh.Add(makeSphere({ 0.2, 0, 0 }, 0.5, 20).Turned()); // a cavity
  const WindingTree tree(mesh.Surface());
  EXPECT_NEAR(tree.At({ -0.8, 0, 0 }), 1.0, 0.05);
  EXPECT_NEAR(tree.At({ 0.2, 0.1, 0 }), 0.0, 0.05);
  EXPECT_NEAR(tree.At({ 2, 1, 0 }), 0.0, 0.05);
  EXPECT_EQ(WindingTree(Mesh().Surface()).At({ 0, 0, 0 }), 0.0);
}

// Turned triangles and a surface that is inside out are the same solid.
TEST(OpenSolids, HolesCloseSmoothly)
{
  const Mesh open = scanned();
  Mesh turned = open.Turned();
  for (std::size_t i = 0; i < turned.Triangles.size(); i += 7)
  {
    std::swap(turned.Triangles[i][1], turned.Triangles[i][2]);
  }
  SolidOptions options;
  options.MayBeOpen = true;
  const double filled = makeSphere({ 0, 0, 0 }, 1.0, 80).Volume();
  for (const Mesh& mesh : { open, turned })
  {
    const SolidCells cells = solid(mesh.Surface(), 48, options);
    for (const double value : cells.Values)
    {
      ASSERT_TRUE(value >= 0.0 && value <= 1.0) << value;
    }
    EXPECT_NEAR(sum(cells.Values) * std::pow(cells.CellSide, 3) / filled, 1.0, 0.01);
  }
  EXPECT_THROW(solid(open.Surface(), 16), std::invalid_argument);
}

TEST(OpenSolids, LinesCoverClosedOnesAsEver)
{
  const Mesh mesh = makeSphere({ 4.1, 4.2, 3.9 }, 3.0, 24);
  const GridSize<3> cells{ 9, 8, 7 };
  std::vector<double> covered(static_cast<std::size_t>(numberOfCells<3>(cells)), -1.0);
  coverPartOfOpenSolid(mesh.Surface(), cells, LatticePart<3>::WholeOf(cells), 3, covered.data());
  const std::vector<double> expected =
    coverByLines(cells, 3, [&](double y, double z) -> std::vector<std::array<double, 2>> {
      const std::array<double, 2> part = clipLine(mesh, y, z);
      return { { std::max(part[0], 0.0), std::min(part[1], 9.0) } };
    });
  for (std::size_t i = 0; i < covered.size(); ++i)
  {
    EXPECT_NEAR(covered[i], expected[i], 1e-9) << i;
  }
}

} // namespace
} // namespace RectifiedTransport
