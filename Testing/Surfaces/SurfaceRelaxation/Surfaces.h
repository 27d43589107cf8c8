// SPDX-License-Identifier: BSD-3-Clause
// Surfaces that points are spread over.
#ifndef Surfaces_h
#define Surfaces_h

#include "TestMesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace RectifiedTransport
{

// Quads in columns and rows, cut along their diagonals; `place(u, v)` for u and v from 0 to 1. The
// ends of u, and of v, are the same points if they are closed.
template <class Place>
Mesh makeQuads(std::int64_t columns, std::int64_t rows, const Place& place, bool closesU = false,
  bool closesV = false)
{
  Mesh mesh;
  const std::int64_t across = columns + (closesU ? 0 : 1);
  const std::int64_t along = rows + (closesV ? 0 : 1);
  for (std::int64_t j = 0; j < along; ++j)
  {
    for (std::int64_t i = 0; i < across; ++i)
    {
      mesh.Points.push_back(place(static_cast<double>(i) / static_cast<double>(columns),
        static_cast<double>(j) / static_cast<double>(rows)));
    }
  }
  for (std::int64_t j = 0; j < rows; ++j)
  {
    for (std::int64_t i = 0; i < columns; ++i)
    {
      const auto number = [=](std::int64_t u, std::int64_t v) {
        return v % along * across + u % across;
      };
      const std::int64_t a = number(i, j);
      const std::int64_t c = number(i + 1, j + 1);
      mesh.Triangles.push_back({ a, number(i + 1, j), c });
      mesh.Triangles.push_back({ a, c, number(i, j + 1) });
    }
  }
  return mesh;
}

inline Mesh makeTorus(std::int64_t around, std::int64_t across, double radius = 0.4)
{
  return makeQuads(
    around, across,
    [radius](double u, double v) {
      const double r = 1.0 + radius * std::cos(2.0 * pi * v);
      return Point<3>{ r * std::cos(2.0 * pi * u), r * std::sin(2.0 * pi * u),
        radius * std::sin(2.0 * pi * v) };
    },
    true, true);
}

// A part of the unit sphere, from its pole to a polar angle; the pole is many points at one place.
inline Mesh makeGlobe(std::int64_t around, std::int64_t rows, double polar = pi)
{
  return makeQuads(around, rows, [polar](double u, double v) {
    const double sine = v == 0.0 || (v == 1.0 && polar == pi) ? 0.0 : std::sin(polar * v);
    const double turn = u == 1.0 ? 0.0 : 2.0 * pi * u; // closed by equal coordinates
    return Point<3>{ sine * std::cos(turn), sine * std::sin(turn), std::cos(polar * v) };
  });
}

// Six sides of a cube, with `quads` by `quads` quads each; edges by equal coordinates.
inline Mesh makeBox(std::int64_t quads, const Point<3>& sides = { 1.0, 1.0, 1.0 })
{
  Mesh mesh;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (const double level : { 0.0, 1.0 })
    {
      mesh.Add(makeQuads(quads, quads, [=](double u, double v) {
        Point<3> x;
        x[axis] = level * sides[axis];
        x[(axis + 1) % 3] = u * sides[(axis + 1) % 3];
        x[(axis + 2) % 3] = v * sides[(axis + 2) % 3];
        return x;
      }));
    }
  }
  return mesh;
}

// Squares that have one edge in common.
inline Mesh makeLeaves(int leaves, std::int64_t quads)
{
  Mesh mesh;
  for (int leaf = 0; leaf < leaves; ++leaf)
  {
    const double turn = 2.0 * pi * leaf / leaves;
    mesh.Add(makeQuads(quads, quads, [=](double u, double v) {
      return Point<3>{ u * std::cos(turn), u * std::sin(turn), v };
    }));
  }
  return mesh;
}

// A cylinder of long triangles, open at both ends.
inline Mesh makeNeedles(std::int64_t around, double height)
{
  return makeQuads(
    around, 1,
    [=](double u, double v) {
      return Point<3>{ std::cos(2.0 * pi * u), std::sin(2.0 * pi * u), height * v };
    },
    true);
}

// Each triangle with three points of its own.
inline Mesh separated(const Mesh& mesh)
{
  Mesh soup;
  for (const auto& triangle : mesh.Triangles)
  {
    const auto first = static_cast<std::int64_t>(soup.Points.size());
    for (const std::int64_t point : triangle)
    {
      soup.Points.push_back(mesh.Points[static_cast<std::size_t>(point)]);
    }
    soup.Triangles.push_back({ first, first + 1, first + 2 });
  }
  return soup;
}

} // namespace RectifiedTransport

#endif
