// SPDX-License-Identifier: BSD-3-Clause
// Surfaces that are no disks, for the tests of seams.
#ifndef SeamSurfaces_h
#define SeamSurfaces_h

#include "DiskSurfaces.h"
#include "SolidSurfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

inline Mesh makeRing(std::int64_t around, std::int64_t across, double radius)
{
  return makeTorus(around, across, [radius](double u, double v) {
    const double r = 1.0 + radius * std::cos(2.0 * pi * v);
    return Point<3>{ r * std::cos(2.0 * pi * u), r * std::sin(2.0 * pi * u),
      radius * std::sin(2.0 * pi * v) };
  });
}

// Triangles with points of their own.
inline Mesh apart(const Mesh& mesh)
{
  Mesh soup;
  for (const auto& t : mesh.Triangles)
  {
    const auto first = static_cast<std::int64_t>(soup.Points.size());
    for (const std::int64_t id : t)
    {
      soup.Points.push_back(mesh.Points[static_cast<std::size_t>(id)]);
    }
    soup.Triangles.push_back({ first, first + 1, first + 2 });
  }
  return soup;
}

// Opposite faces of an icosahedron are one: six points, which are apart in space, each two of which
// an edge joins. Then each triangle is divided into four, several times.
inline Mesh makeProjectivePlane(int divisions)
{
  Mesh mesh{ { { 1.0, 0.2, 0.1 }, { -0.3, 1.1, 0.0 }, { -0.9, -0.4, 0.6 }, { 0.5, -1.2, -0.3 },
               { 0.1, 0.3, 1.4 }, { 0.0, -0.2, -1.0 } },
    { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 4 }, { 0, 4, 5 }, { 0, 5, 1 }, { 1, 2, 4 }, { 2, 3, 5 },
      { 3, 4, 1 }, { 4, 5, 2 }, { 5, 1, 3 } } };
  for (int i = 0; i < divisions; ++i)
  {
    std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> middles;
    const auto middleOf = [&](std::int64_t a, std::int64_t b) {
      const auto found =
        middles.emplace(std::minmax(a, b), static_cast<std::int64_t>(mesh.Points.size()));
      if (found.second)
      {
        Point<3> middle = mesh.Points[static_cast<std::size_t>(a)];
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          middle[axis] = 0.5 * (middle[axis] + mesh.Points[static_cast<std::size_t>(b)][axis]);
        }
        mesh.Points.push_back(middle);
      }
      return found.first->second;
    };
    const auto coarse = std::exchange(mesh.Triangles, {});
    for (const auto& [a, b, c] : coarse)
    {
      const std::int64_t ab = middleOf(a, b);
      const std::int64_t bc = middleOf(b, c);
      const std::int64_t ca = middleOf(c, a);
      mesh.Triangles.insert(
        mesh.Triangles.end(), { { a, ab, ca }, { ab, b, bc }, { ca, bc, c }, { ab, bc, ca } });
    }
  }
  return mesh;
}

// A sheet of n x n squares with holes x holes holes of two squares an axis.
inline Mesh makePerforated(std::int64_t n, std::int64_t holes)
{
  Mesh mesh = makeTerrain(n, n);
  const auto isInHole = [&](std::int64_t square) {
    const std::int64_t each = n / holes;
    const auto isNear = [&](std::int64_t x) {
      return x % each == each / 2 || x % each == each / 2 - 1;
    };
    return isNear(square % n) && isNear(square / n);
  };
  const auto all = std::exchange(mesh.Triangles, {});
  std::vector<std::int64_t> numbers(mesh.Points.size(), -1);
  const auto points = std::exchange(mesh.Points, {});
  for (std::size_t t = 0; t < all.size(); ++t)
  {
    if (isInHole(static_cast<std::int64_t>(t / 2)))
    {
      continue;
    }
    auto triangle = all[t];
    for (std::int64_t& id : triangle)
    {
      std::int64_t& number = numbers[static_cast<std::size_t>(id)];
      if (number < 0)
      {
        number = static_cast<std::int64_t>(mesh.Points.size());
        mesh.Points.push_back(points[static_cast<std::size_t>(id)]);
      }
      id = number;
    }
    mesh.Triangles.push_back(triangle);
  }
  return mesh;
}

// The surface of the cubes of a lattice for which isSolid(x, y, z) is true, each cut into n^3 ones.
template <class IsSolid>
Mesh makeCubes(const std::array<std::int64_t, 3>& size, std::int64_t n, const IsSolid& isSolid)
{
  Mesh mesh;
  std::map<std::array<std::int64_t, 3>, std::int64_t> ids;
  const auto idOf = [&](const std::array<std::int64_t, 3>& place) {
    const auto found = ids.emplace(place, static_cast<std::int64_t>(mesh.Points.size()));
    if (found.second)
    {
      const auto at = [&](std::size_t i) {
        return static_cast<double>(place[i]) / static_cast<double>(n);
      };
      mesh.Points.push_back({ at(0), at(1), at(2) });
    }
    return found.first->second;
  };
  const auto has = [&](const std::array<std::int64_t, 3>& cell) {
    for (std::size_t i = 0; i < 3; ++i)
    {
      if (cell[i] < 0 || cell[i] >= n * size[i])
      {
        return false;
      }
    }
    return static_cast<bool>(isSolid(cell[0] / n, cell[1] / n, cell[2] / n));
  };
  std::array<std::int64_t, 3> cell;
  for (cell[2] = 0; cell[2] < n * size[2]; ++cell[2])
  {
    for (cell[1] = 0; cell[1] < n * size[1]; ++cell[1])
    {
      for (cell[0] = 0; cell[0] < n * size[0]; ++cell[0])
      {
        for (std::size_t face = 0; face < 6 && has(cell); ++face)
        {
          const std::size_t axis = face / 2;
          const auto high = static_cast<std::int64_t>(face % 2);
          std::array<std::int64_t, 3> beside = cell;
          beside[axis] += 2 * high - 1;
          if (has(beside))
          {
            continue;
          }
          const auto corner = [&](std::int64_t u, std::int64_t v) {
            std::array<std::int64_t, 3> place = cell;
            place[axis] += high;
            place[(axis + 1) % 3] += u;
            place[(axis + 2) % 3] += v;
            return idOf(place);
          };
          std::array<std::int64_t, 4> quad{ corner(0, 0), corner(1, 0), corner(1, 1),
            corner(0, 1) };
          if (high == 0)
          {
            std::swap(quad[1], quad[3]);
          }
          mesh.Triangles.push_back({ quad[0], quad[1], quad[2] });
          mesh.Triangles.push_back({ quad[0], quad[2], quad[3] });
        }
      }
    }
  }
  return mesh;
}

// A plate with holes in a row: as many handles.
inline Mesh makeHandles(std::int64_t handles, std::int64_t n)
{
  return makeCubes({ 2 * handles + 1, 3, 1 }, n,
    [](std::int64_t x, std::int64_t y, std::int64_t) { return x % 2 == 0 || y != 1; });
}

// A strip of quads around a circle; its ends are joined after a number of half turns.
inline Mesh makeBand(std::int64_t around, std::int64_t across, int halfTurns)
{
  Mesh mesh;
  for (std::int64_t i = 0; i < around; ++i)
  {
    const double u = 2.0 * pi * static_cast<double>(i) / static_cast<double>(around);
    for (std::int64_t j = 0; j <= across; ++j)
    {
      const double v = 0.6 * (static_cast<double>(j) / static_cast<double>(across) - 0.5);
      const double r = 1.0 + v * std::cos(0.5 * halfTurns * u);
      mesh.Points.push_back(
        { r * std::cos(u), r * std::sin(u), v * std::sin(0.5 * halfTurns * u + 0.3) });
    }
  }
  const auto at = [&](std::int64_t i, std::int64_t j) {
    const bool isTurned = i == around && halfTurns % 2 != 0;
    return (i % around) * (across + 1) + (isTurned ? across - j : j);
  };
  for (std::int64_t i = 0; i < around; ++i)
  {
    for (std::int64_t j = 0; j < across; ++j)
    {
      mesh.Triangles.push_back({ at(i, j), at(i + 1, j), at(i + 1, j + 1) });
      mesh.Triangles.push_back({ at(i, j), at(i + 1, j + 1), at(i, j + 1) });
    }
  }
  return mesh;
}

// Without the triangles for whose centre isLeftOut is true.
template <class IsLeftOut>
Mesh without(const Mesh& mesh, const IsLeftOut& isLeftOut)
{
  Mesh rest{ mesh.Points, {} };
  for (const auto& t : mesh.Triangles)
  {
    Point<3> centre{ 0.0, 0.0, 0.0 };
    for (const std::int64_t id : t)
    {
      for (std::size_t i = 0; i < 3; ++i)
      {
        centre[i] += mesh.Points[static_cast<std::size_t>(id)][i] / 3.0;
      }
    }
    if (!isLeftOut(centre))
    {
      rest.Triangles.push_back(t);
    }
  }
  return rest;
}

// A cube with a square hole in each face.
inline Mesh makeOpenCube(std::int64_t n)
{
  const Mesh cube =
    makeCubes({ 1, 1, 1 }, n, [](std::int64_t, std::int64_t, std::int64_t) { return true; });
  return without(cube, [](const Point<3>& p) {
    int middle = 0;
    for (const double x : p)
    {
      middle += std::abs(x - 0.5) < 0.2 ? 1 : 0;
    }
    return middle == 2;
  });
}

inline Mesh shifted(const Mesh& mesh, const Point<3>& by)
{
  return mesh.Mapped([&by](const Point<3>& p) {
    return Point<3>{ p[0] + by[0], p[1] + by[1], p[2] + by[2] };
  });
}

// A ball with six limbs along the axes.
inline Mesh makeLimbs(std::int64_t rings)
{
  return makeSphere({ 0.0, 0.0, 0.0 }, 1.0, rings).Mapped([](const Point<3>& p) {
    double reach = 0.0;
    for (const double x : p)
    {
      reach = std::max(reach, std::abs(x));
    }
    const double scale = 0.5 + 2.0 * std::pow(reach, 24.0);
    return Point<3>{ scale * p[0], scale * p[1], scale * p[2] };
  });
}

} // namespace RectifiedTransport

#endif
