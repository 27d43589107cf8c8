// SPDX-License-Identifier: BSD-3-Clause
// The triangle that contains a point, against a search through all triangles in whole numbers.
#include "Surfaces/SurfaceSampling/FlatLocator.h"

#include "TestRefusal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace RectifiedTransport
{
namespace
{

constexpr int bits = 20; // of a coordinate: multiples of 2^-20
constexpr std::int64_t unit = std::int64_t{ 1 } << bits;

using WholePoint = std::array<std::int64_t, 2>;

Point<2> scaled(const WholePoint& point)
{
  return { std::ldexp(static_cast<double>(point[0]), -bits),
    std::ldexp(static_cast<double>(point[1]), -bits) };
}

// Twice the area.
std::int64_t turn(const WholePoint& a, const WholePoint& b, const WholePoint& c)
{
  return (a[0] - c[0]) * (b[1] - c[1]) - (a[1] - c[1]) * (b[0] - c[0]);
}

// The triangles of a grid of quads, cut along either diagonal, in any order.
struct WholeMesh
{
  std::vector<WholePoint> Points;
  std::vector<std::array<std::int64_t, 3>> Triangles;
  std::vector<Point<2>> Positions;
  std::vector<double> Masses;
  std::mt19937_64 Random;

  // `power` 1: even columns and rows; above: crowded at the left and below.
  WholeMesh(int quads, double power, std::uint64_t seed)
    : Random(seed)
  {
    const auto place = [=](int i) {
      return std::llround(
        std::pow(static_cast<double>(i) / quads, power) * static_cast<double>(unit));
    };
    for (int j = 0; j <= quads; ++j)
    {
      for (int i = 0; i <= quads; ++i)
      {
        this->Points.push_back({ place(i), place(j) });
      }
    }
    const std::int64_t row = quads + 1;
    for (std::int64_t j = 0; j < quads; ++j)
    {
      for (std::int64_t i = 0; i < quads; ++i)
      {
        const std::int64_t p = j * row + i;
        const bool other = this->Random() % 2;
        this->Triangles.push_back({ p, p + 1, other ? p + row : p + row + 1 });
        this->Triangles.push_back({ other ? p + 1 : p, p + row + 1, p + row });
      }
    }
    for (auto& triangle : this->Triangles)
    {
      std::rotate(triangle.begin(), triangle.begin() + this->Random() % 3, triangle.end());
    }
    std::shuffle(this->Triangles.begin(), this->Triangles.end(), this->Random);
  }

  // Moves the points inside by up to a part of the square's side.
  void Jitter(double part)
  {
    const auto most = static_cast<std::int64_t>(part * static_cast<double>(unit));
    std::uniform_int_distribution<std::int64_t> by(-most, most);
    for (WholePoint& point : this->Points)
    {
      const bool isOnBorder =
        point[0] == 0 || point[0] == unit || point[1] == 0 || point[1] == unit;
      for (std::int64_t& x : point)
      {
        x = isOnBorder ? x : std::clamp<std::int64_t>(x + by(this->Random), 0, unit);
      }
    }
  }

  FlatMesh Flat()
  {
    this->Positions.clear();
    for (const WholePoint& point : this->Points)
    {
      this->Positions.push_back(scaled(point));
    }
    return { this->Positions, this->Triangles[0].data(),
      static_cast<std::int64_t>(this->Triangles.size()),
      this->Masses.empty() ? nullptr : this->Masses.data() };
  }

  const WholePoint& Corner(std::size_t triangle, std::size_t corner) const
  {
    return this->Points[static_cast<std::size_t>(this->Triangles[triangle][corner])];
  }

  std::int64_t Area(std::size_t t) const
  {
    return turn(this->Corner(t, 0), this->Corner(t, 1), this->Corner(t, 2));
  }

  // The first triangle that turns left and contains a point; -1 for none.
  std::int64_t Search(const WholePoint& point) const
  {
    for (std::size_t t = 0; t < this->Triangles.size(); ++t)
    {
      const WholePoint& a = this->Corner(t, 0);
      const WholePoint& b = this->Corner(t, 1);
      const WholePoint& c = this->Corner(t, 2);
      const bool isUsed = this->Masses.empty() || this->Masses[t] > 0.0;
      if (isUsed && this->Area(t) > 0 && turn(a, b, point) >= 0 && turn(b, c, point) >= 0 &&
        turn(c, a, point) >= 0)
      {
        return static_cast<std::int64_t>(t);
      }
    }
    return -1;
  }

  // Points anywhere, at the mesh's points, on its edges, and at the corners of the square.
  std::vector<WholePoint> Queries(int count)
  {
    std::uniform_int_distribution<std::int64_t> any(0, unit);
    std::vector<WholePoint> queries{ { 0, 0 }, { unit, 0 }, { 0, unit }, { unit, unit } };
    for (int i = 0; i < count; ++i)
    {
      const std::size_t t = this->Random() % this->Triangles.size();
      const WholePoint& a = this->Corner(t, 0);
      const WholePoint& b = this->Corner(t, 1);
      queries.push_back({ any(this->Random), any(this->Random) });
      queries.push_back(a);
      const std::int64_t even[2] = { b[0] - a[0], b[1] - a[1] };
      if (even[0] % 2 == 0 && even[1] % 2 == 0)
      {
        queries.push_back({ a[0] + even[0] / 2, a[1] + even[1] / 2 });
      }
    }
    return queries;
  }
};

Point<2> positionOf(const FlatMesh& mesh, const PlaceOnTriangle& place)
{
  Point<2> x{ 0.0, 0.0 };
  for (std::size_t r = 0; r < 2; ++r)
  {
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      const std::int64_t point =
        mesh.Triangles[3 * place.Triangle + static_cast<std::int64_t>(corner)];
      x[r] += place.Weights[corner] * mesh.Positions[point][r];
    }
  }
  return x;
}

void expectWeights(const PlaceOnTriangle& place)
{
  ASSERT_GE(*std::min_element(place.Weights.begin(), place.Weights.end()), 0.0);
  ASSERT_NEAR(place.Weights[0] + place.Weights[1] + place.Weights[2], 1.0, 1e-15);
}

void expectSearched(WholeMesh& mesh)
{
  const FlatMesh flat = mesh.Flat();
  const FlatLocator locator(flat);
  for (const WholePoint& query : mesh.Queries(1500))
  {
    const PlaceOnTriangle found = locator.Locate(scaled(query));
    const std::int64_t expected = mesh.Search(query);
    ASSERT_GE(expected, 0);
    ASSERT_EQ(found.Triangle, expected) << query[0] << " " << query[1];
    expectWeights(found);
    const Point<2> x = positionOf(flat, found);
    ASSERT_NEAR(x[0], scaled(query)[0], 1e-15);
    ASSERT_NEAR(x[1], scaled(query)[1], 1e-15);
  }
}

TEST(FlatLocator, EvenMesh)
{
  WholeMesh mesh(24, 1.0, 1);
  mesh.Jitter(0.01);
  expectSearched(mesh);
}

TEST(FlatLocator, OneSquare)
{
  WholeMesh mesh(1, 1.0, 2);
  expectSearched(mesh);
}

// Areas from 1e-12 of the mean, and triangles without area, in the crowded corner.
TEST(FlatLocator, CrowdedMesh)
{
  WholeMesh mesh(24, 5.0, 3);
  std::int64_t without = 0;
  for (std::size_t t = 0; t < mesh.Triangles.size(); ++t)
  {
    without += mesh.Area(t) == 0;
  }
  EXPECT_GT(without, 0);
  expectSearched(mesh);
}

// However a map folds, some triangle that turns left lies over every point of the square.
TEST(FlatLocator, FoldedMesh)
{
  WholeMesh mesh(16, 1.0, 4);
  mesh.Jitter(0.4);
  std::int64_t flipped = 0;
  for (std::size_t t = 0; t < mesh.Triangles.size(); ++t)
  {
    flipped += mesh.Area(t) < 0;
  }
  EXPECT_GT(flipped, 100);
  expectSearched(mesh);
}

// Points that are rounded, on edges and beside them, and the mesh's points, which are, too.
TEST(FlatLocator, RoundedPoints)
{
  WholeMesh mesh(40, 3.0, 5);
  FlatMesh flat = mesh.Flat();
  for (Point<2>& x : mesh.Positions)
  {
    x = { std::pow(x[0], 1.1), std::sin(1.5 * x[1]) / std::sin(1.5) };
  }
  const FlatLocator locator(flat);
  std::uniform_real_distribution<double> share;
  for (int k = 0; k < 200000; ++k)
  {
    const auto& triangle = mesh.Triangles[mesh.Random() % mesh.Triangles.size()];
    const Point<2>& a = mesh.Positions[static_cast<std::size_t>(triangle[0])];
    const Point<2>& b = mesh.Positions[static_cast<std::size_t>(triangle[1])];
    const double s = k % 10 == 0 ? 1.0 : share(mesh.Random);
    const Point<2> point{ a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]) };
    const PlaceOnTriangle found = locator.Locate(point);
    expectWeights(found);
    const Point<2> x = positionOf(flat, found);
    ASSERT_NEAR(x[0], point[0], 5e-16);
    ASSERT_NEAR(x[1], point[1], 5e-16);
  }
}

double squaredDistance(const FlatMesh& mesh, const PlaceOnTriangle& place, const Point<2>& point)
{
  const Point<2> x = positionOf(mesh, place);
  return std::pow(mesh.Lengths[0] * (x[0] - point[0]), 2.0) +
    std::pow(mesh.Lengths[1] * (x[1] - point[1]), 2.0);
}

// The nearest place of the triangles with mass, in a rectangle of 3 by 1: none is nearer among
// places on all edges, and the place itself is as near as that.
TEST(FlatLocator, NearestWithMass)
{
  WholeMesh mesh(12, 1.0, 6);
  mesh.Jitter(0.02);
  mesh.Masses.resize(mesh.Triangles.size());
  for (double& mass : mesh.Masses)
  {
    mass = mesh.Random() % 8 == 0 ? 0.5 : 0.0;
  }
  FlatMesh flat = mesh.Flat();
  flat.Lengths = { 3.0, 1.0 };
  const FlatLocator locator(flat);
  std::int64_t inside = 0;
  for (const WholePoint& query : mesh.Queries(400))
  {
    const PlaceOnTriangle found = locator.Locate(scaled(query));
    expectWeights(found);
    ASSERT_GT(mesh.Masses[static_cast<std::size_t>(found.Triangle)], 0.0);
    const std::int64_t expected = mesh.Search(query);
    if (expected >= 0)
    {
      ASSERT_EQ(found.Triangle, expected);
      ++inside;
      continue;
    }
    const double nearest = squaredDistance(flat, found, scaled(query));
    for (std::size_t t = 0; t < mesh.Triangles.size(); ++t)
    {
      for (std::size_t side = 0; side < 3 && mesh.Masses[t] > 0.0; ++side)
      {
        for (int i = 0; i <= 32; ++i)
        {
          PlaceOnTriangle place{ static_cast<std::int64_t>(t), { 0.0, 0.0, 0.0 } };
          place.Weights[side] = 1.0 - i / 32.0;
          place.Weights[(side + 1) % 3] = i / 32.0;
          ASSERT_GE(squaredDistance(flat, place, scaled(query)), nearest - 1e-12);
        }
      }
    }
  }
  EXPECT_GT(inside, 100);
}

// Outside of the square.
TEST(FlatLocator, Outside)
{
  WholeMesh mesh(8, 1.0, 7);
  const FlatMesh flat = mesh.Flat();
  const FlatLocator locator(flat);
  const Point<2> x = positionOf(flat, locator.Locate({ 1.25, 0.3 }));
  EXPECT_NEAR(x[0], 1.0, 1e-15);
  EXPECT_NEAR(x[1], 0.3, 1e-15);
  const Point<2> corner = positionOf(flat, locator.Locate({ -1.0, 3.0 }));
  EXPECT_EQ(corner, (Point<2>{ 0.0, 1.0 }));
}

TEST(FlatLocator, NoMass)
{
  WholeMesh mesh(3, 1.0, 8);
  mesh.Masses.assign(mesh.Triangles.size(), 0.0);
  EXPECT_EQ(refusal([&]() { FlatLocator locator(mesh.Flat()); }),
    "the plane mesh has no triangle with mass");
}

// Triangles that turn right or have no area contain no point, but are better than nothing.
TEST(FlatLocator, NothingTurnsLeft)
{
  const std::vector<Point<2>> positions{ { 0.25, 0.5 }, { 0.5, 0.5 }, { 0.75, 0.5 },
    { 0.5, 0.25 } };
  const std::int64_t flat[3] = { 0, 1, 2 };
  const FlatMesh line{ positions, flat, 1 };
  const PlaceOnTriangle onLine = FlatLocator(line).Locate({ 0.375, 0.0 });
  EXPECT_EQ(positionOf(line, onLine), (Point<2>{ 0.375, 0.5 }));
  EXPECT_EQ(positionOf(line, FlatLocator(line).Locate({ 1.0, 0.5 })), (Point<2>{ 0.75, 0.5 }));
  const std::int64_t turned[3] = { 0, 2, 3 };
  const FlatMesh right{ positions, turned, 1 };
  EXPECT_EQ(positionOf(right, FlatLocator(right).Locate({ 0.5, 0.48 })), (Point<2>{ 0.5, 0.5 }));
}

TEST(FlatLocator, Cancelled)
{
  WholeMesh mesh(200, 1.0, 9);
  Context context;
  context.IsCancelled = []() { return true; };
  EXPECT_THROW(FlatLocator(mesh.Flat(), context), Cancelled);
}

} // namespace
} // namespace RectifiedTransport
