// SPDX-License-Identifier: BSD-3-Clause
// Surfaces that are disks, for the tests of their maps.
#ifndef DiskSurfaces_h
#define DiskSurfaces_h

#include "Surfaces/Mesh/DiskMesh.h"
#include "Surfaces/Parameterization/ConformalMap.h"
#include "Surfaces/Parameterization/LocalMap.h"
#include "TestMesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

// Quads in columns and rows, cut along their diagonals; `place(u, v)` for u and v from 0 to 1.
// Points are numbered along columns first; triangles turn left where u x v is up.
template <class Place>
Mesh makeSheet(std::int64_t columns, std::int64_t rows, const Place& place)
{
  Mesh mesh;
  for (std::int64_t j = 0; j <= rows; ++j)
  {
    for (std::int64_t i = 0; i <= columns; ++i)
    {
      mesh.Points.push_back(place(static_cast<double>(i) / static_cast<double>(columns),
        static_cast<double>(j) / static_cast<double>(rows)));
    }
  }
  for (std::int64_t j = 0; j < rows; ++j)
  {
    for (std::int64_t i = 0; i < columns; ++i)
    {
      const std::int64_t a = j * (columns + 1) + i;
      const std::int64_t d = a + columns + 1;
      mesh.Triangles.push_back({ a, a + 1, d + 1 });
      mesh.Triangles.push_back({ a, d + 1, d });
    }
  }
  return mesh;
}

// The corners of a sheet, from that of u = v = 0.
inline std::vector<std::int64_t> sheetCorners(std::int64_t columns, std::int64_t rows)
{
  return { 0, columns, (rows + 1) * (columns + 1) - 1, rows * (columns + 1) };
}

inline Mesh makeRectangle(
  std::int64_t columns, std::int64_t rows, double width = 1.0, double height = 1.0)
{
  return makeSheet(columns, rows, [=](double u, double v) {
    return Point<3>{ width * u, height * v, 0.0 };
  });
}

// Hills over the unit square, up to 60 degrees steep.
inline Mesh makeTerrain(std::int64_t columns, std::int64_t rows)
{
  return makeSheet(columns, rows, [](double u, double v) {
    return Point<3>{ u, v,
      0.12 * std::sin(7.0 * u + 3.0 * v) * std::cos(11.0 * v - 2.0 * u) + 0.2 * u * v };
  });
}

// Radii from 1 to `radius` along u, angles of 0 to 90 degrees along v.
inline Mesh makeQuarterAnnulus(double radius, std::int64_t across, std::int64_t around)
{
  return makeSheet(across, around, [radius](double u, double v) {
    const double r = 1.0 + (radius - 1.0) * u;
    return Point<3>{ r * std::cos(0.5 * pi * v), r * std::sin(0.5 * pi * v), 0.0 };
  });
}

// A centre and rings of 6, 12, 18 ... points; `place(radius, angle)` for radii from 0 to 1.
template <class Place>
Mesh makeRound(std::int64_t rings, const Place& place)
{
  Mesh mesh;
  mesh.Points.push_back(place(0.0, 0.0));
  for (std::int64_t ring = 1; ring <= rings; ++ring)
  {
    const std::int64_t inner = ring > 1 ? 1 + 3 * (ring - 1) * (ring - 2) : 0;
    const std::int64_t outer = 1 + 3 * ring * (ring - 1);
    for (std::int64_t sector = 0; sector < 6; ++sector)
    {
      for (std::int64_t i = 0; i < ring; ++i)
      {
        const std::int64_t number = sector * ring + i;
        mesh.Points.push_back(place(static_cast<double>(ring) / static_cast<double>(rings),
          2.0 * pi * static_cast<double>(number) / static_cast<double>(6 * ring)));
        const auto within = [&](std::int64_t k) {
          return inner + (sector * (ring - 1) + k) % std::max<std::int64_t>(6 * (ring - 1), 1);
        };
        const std::int64_t next = outer + (number + 1) % (6 * ring);
        mesh.Triangles.push_back({ within(i), outer + number, next });
        if (i + 1 < ring)
        {
          mesh.Triangles.push_back({ within(i), next, within(i + 1) });
        }
      }
    }
  }
  return mesh;
}

inline Mesh makeRoundDisk(std::int64_t rings)
{
  return makeRound(rings, [](double radius, double angle) {
    return Point<3>{ radius * std::cos(angle), radius * std::sin(angle), 0.0 };
  });
}

// The part of the unit sphere within an angle of its pole.
inline Mesh makeCap(std::int64_t rings, double polar)
{
  return makeRound(rings, [polar](double radius, double angle) {
    return Point<3>{ std::sin(polar * radius) * std::cos(angle),
      std::sin(polar * radius) * std::sin(angle), std::cos(polar * radius) };
  });
}

// Twice the area of a triangle in the plane of x and y.
inline double turn(const Point<3>& a, const Point<3>& b, const Point<3>& c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// Flips edges of a flat mesh at random, where triangles of at least `area` come of it.
inline void flipEdges(Mesh& mesh, int count, double area, std::uint64_t seed = 5)
{
  using Side = std::pair<std::int64_t, std::int64_t>;
  std::map<Side, std::size_t> triangleOf;
  const auto enter = [&](std::size_t t) {
    for (std::size_t i = 0; i < 3; ++i)
    {
      triangleOf[{ mesh.Triangles[t][i], mesh.Triangles[t][(i + 1) % 3] }] = t;
    }
  };
  for (std::size_t t = 0; t < mesh.Triangles.size(); ++t)
  {
    enter(t);
  }
  std::mt19937_64 random(seed);
  for (int flips = 0; flips < count; ++flips)
  {
    const std::size_t f = random() % mesh.Triangles.size();
    const std::size_t i = random() % 3;
    const std::int64_t a = mesh.Triangles[f][i];
    const std::int64_t b = mesh.Triangles[f][(i + 1) % 3];
    const std::int64_t c = mesh.Triangles[f][(i + 2) % 3];
    const auto other = triangleOf.find({ b, a });
    if (other == triangleOf.end())
    {
      continue;
    }
    const std::size_t g = other->second;
    const std::int64_t d =
      std::accumulate(mesh.Triangles[g].begin(), mesh.Triangles[g].end(), std::int64_t{ 0 }) - a -
      b;
    const auto twice = [&](std::int64_t p, std::int64_t q, std::int64_t r) {
      return turn(mesh.Points[p], mesh.Points[q], mesh.Points[r]);
    };
    if (twice(c, a, d) >= 2.0 * area && twice(d, b, c) >= 2.0 * area)
    {
      triangleOf.erase({ a, b });
      triangleOf.erase({ b, a });
      mesh.Triangles[f] = { c, a, d };
      mesh.Triangles[g] = { d, b, c };
      enter(f);
      enter(g);
    }
  }
}

// A flat rectangle whose points inside are moved at random, by less than half a quad, and whose
// edges are flipped at random.
inline Mesh makeRandomTriangulation(
  std::int64_t columns, std::int64_t rows, double leastArea, std::uint64_t seed = 5)
{
  Mesh mesh = makeRectangle(columns, rows);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> move(-0.3, 0.3);
  for (std::int64_t j = 1; j < rows; ++j)
  {
    for (std::int64_t i = 1; i < columns; ++i)
    {
      Point<3>& point = mesh.Points[static_cast<std::size_t>(j * (columns + 1) + i)];
      point[0] += move(random) / static_cast<double>(columns);
      point[1] += move(random) / static_cast<double>(rows);
    }
  }
  flipEdges(mesh, static_cast<int>(10 * mesh.Triangles.size()), leastArea, seed);
  return mesh;
}

// The same surface with other numbers of points and triangles, and other first corners.
struct RenumberedMesh
{
  Mesh Surface;
  std::vector<std::int64_t> NumberOf; // by the points' old numbers
};

inline RenumberedMesh renumber(const Mesh& mesh, std::uint64_t seed = 9)
{
  std::mt19937_64 random(seed);
  RenumberedMesh renumbered{ mesh, std::vector<std::int64_t>(mesh.Points.size()) };
  std::iota(renumbered.NumberOf.begin(), renumbered.NumberOf.end(), 0);
  std::shuffle(renumbered.NumberOf.begin(), renumbered.NumberOf.end(), random);
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    renumbered.Surface.Points[static_cast<std::size_t>(renumbered.NumberOf[i])] = mesh.Points[i];
  }
  auto& triangles = renumbered.Surface.Triangles;
  std::shuffle(triangles.begin(), triangles.end(), random);
  for (auto& triangle : triangles)
  {
    std::rotate(triangle.begin(), triangle.begin() + random() % 3, triangle.end());
    for (std::int64_t& id : triangle)
    {
      id = renumbered.NumberOf[static_cast<std::size_t>(id)];
    }
  }
  return renumbered;
}

// Turned about a skew axis.
inline Mesh turned(const Mesh& mesh)
{
  return mesh.Mapped([](const Point<3>& p) {
    const double c = std::cos(0.7);
    const double s = std::sin(0.7);
    const Point<3> q{ c * p[0] - s * p[1], s * p[0] + c * p[1], p[2] };
    return Point<3>{ q[0], c * q[1] - s * q[2], s * q[1] + c * q[2] };
  });
}

inline bool sameBits(const std::vector<Point<2>>& a, const std::vector<Point<2>>& b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

// The largest difference of a coordinate; point i of `a` is point numberOf[i] of `b`.
inline double largestDifference(const std::vector<Point<2>>& a, const std::vector<Point<2>>& b,
  const std::vector<std::int64_t>& numberOf = {})
{
  double largest = a.size() == b.size() ? 0.0 : HUGE_VAL;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    const std::size_t j = numberOf.empty() ? i : static_cast<std::size_t>(numberOf[i]);
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      const double difference = std::abs(a[i][axis] - b[j][axis]);
      largest = difference <= largest ? largest : difference; // NaN too
    }
  }
  return largest;
}

// Twice the area of a triangle of a map.
inline double turnOf(
  const DiskMesh& disk, std::int64_t triangle, const std::vector<Point<2>>& positions)
{
  const auto at = [&](int i) {
    const Point<2>& p = positions[static_cast<std::size_t>(disk.Triangle(triangle)[i])];
    return Point<3>{ p[0], p[1], 0.0 };
  };
  return turn(at(0), at(1), at(2));
}

// A map conformal for the given corners, or for those that are chosen.
inline ConformalMap mapped(const DiskMesh& disk, const std::vector<std::int64_t>& corners = {})
{
  return mapConformally(disk, corners.empty() ? chooseCorners(disk) : orderCorners(disk, corners));
}

// The unit square's own map, which may not be copied: parts refer to the rest.
struct SquareGrid
{
  explicit SquareGrid(std::int64_t cells)
    : Disk(makeRectangle(cells, cells).Surface())
    , Square(mapped(Disk, sheetCorners(cells, cells)).Square)
    , Parts(Disk, Square)
  {
  }

  SquareGrid(const SquareGrid&) = delete;
  SquareGrid& operator=(const SquareGrid&) = delete;

  DiskMesh Disk;
  SquareMap Square;
  MapParts Parts;
};

} // namespace RectifiedTransport

#endif
