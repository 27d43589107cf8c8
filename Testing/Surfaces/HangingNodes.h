// SPDX-License-Identifier: BSD-3-Clause
// Surfaces with T-junctions: parts of one side of a line are smaller than those on the other side.
#ifndef HangingNodes_h
#define HangingNodes_h

#include "SurfaceRelaxation/Surfaces.h"
#include "TestMesh.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// A box whose sides have `quads` by `quads` quads, and the one at the top of z `ratio` times as
// many along each of its edges.
inline Mesh makeRefinedBox(std::int64_t quads, std::int64_t ratio)
{
  Mesh mesh;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (const double level : { 0.0, 1.0 })
    {
      const std::int64_t count = axis == 2 && level == 1.0 ? quads * ratio : quads;
      const Mesh side = makeQuads(count, count, [=](double u, double v) {
        Point<3> x;
        x[axis] = level;
        x[(axis + 1) % 3] = u;
        x[(axis + 2) % 3] = v;
        return x;
      });
      mesh.Add(level == 1.0 ? side : side.Turned());
    }
  }
  return mesh;
}

// A sphere of radius 1 whose southern half has `ratio` times as many columns; along the equator
// they divide the edges of the northern half.
inline Mesh makeRefinedGlobe(std::int64_t around, std::int64_t rows, std::int64_t ratio)
{
  const auto onEquator = [around](double u) {
    const double column = u * static_cast<double>(around);
    const double before = std::min(std::floor(column), static_cast<double>(around - 1));
    const auto at = [around](double i) {
      const double turn =
        i == static_cast<double>(around) ? 0.0 : 2.0 * pi * i / static_cast<double>(around);
      return std::array<double, 2>{ std::cos(turn), std::sin(turn) };
    };
    const std::array<double, 2> a = at(before);
    const std::array<double, 2> b = at(before + 1.0);
    const double part = column - before;
    return Point<3>{ a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]), 0.0 };
  };
  const auto place = [&](double u, double v, double side) {
    if (v == 1.0)
    {
      return onEquator(u);
    }
    const double sine = std::sin(0.5 * pi * v);
    const double turn = u == 1.0 ? 0.0 : 2.0 * pi * u;
    return Point<3>{ sine * std::cos(turn), sine * std::sin(turn), side * std::cos(0.5 * pi * v) };
  };
  Mesh mesh =
    makeQuads(around, rows, [&](double u, double v) { return place(u, v, 1.0); }).Turned();
  mesh.Add(
    makeQuads(ratio * around, ratio * rows, [&](double u, double v) { return place(u, v, -1.0); }));
  return mesh;
}

// The unit square, of a row of triangles on each side of the line y = 1/2 that have corners on it
// at the places `below` and `above`, besides its ends.
inline Mesh makeZigzag(const std::vector<double>& below, const std::vector<double>& above)
{
  Mesh mesh;
  for (const double y : { 0.0, 1.0 })
  {
    const auto first = static_cast<std::int64_t>(mesh.Points.size());
    std::vector<double> places{ 0.0 };
    const std::vector<double>& inner = y == 0.0 ? below : above;
    places.insert(places.end(), inner.begin(), inner.end());
    places.push_back(1.0);
    for (const double x : places)
    {
      mesh.Points.push_back({ x, 0.5, 0.0 });
      mesh.Points.push_back({ x, y, 0.0 });
    }
    Mesh row;
    for (std::int64_t i = first; i + 2 < static_cast<std::int64_t>(mesh.Points.size()); i += 2)
    {
      row.Triangles.push_back({ i + 1, i + 3, i });
      row.Triangles.push_back({ i, i + 3, i + 2 });
    }
    for (const auto& t : (y == 0.0 ? row : row.Turned()).Triangles)
    {
      mesh.Triangles.push_back(t);
    }
  }
  return mesh;
}

// Volatile, as vectors of GCC 12 leave the rounding out.
inline double inFloat(double x)
{
  const volatile float rounded = static_cast<float>(x);
  return rounded;
}

// Turned about a skew axis, moved far away, and rounded to float.
inline Mesh farAwayInFloat(const Mesh& mesh, double distance)
{
  return mesh.Mapped([distance](const Point<3>& p) {
    const double c = std::cos(0.7);
    const double s = std::sin(0.7);
    const Point<3> q{ c * p[0] - s * p[1], s * p[0] + c * p[1], p[2] };
    const Point<3> far{ q[0] + distance, c * q[1] - s * q[2] - distance, s * q[1] + c * q[2] };
    return Point<3>{ inFloat(far[0]), inFloat(far[1]), inFloat(far[2]) };
  });
}

} // namespace RectifiedTransport

#endif
