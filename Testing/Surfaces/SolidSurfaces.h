// SPDX-License-Identifier: BSD-3-Clause
// Closed surfaces for the tests of solids, and what lines cover of convex ones.
#ifndef SolidSurfaces_h
#define SolidSurfaces_h

#include "Surfaces/Solid/SolidCoverage.h"
#include "TestMesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

namespace RectifiedTransport
{

inline Mesh makeTetrahedron(
  const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d)
{
  Mesh mesh{ { a, b, c, d }, { { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 } } };
  return mesh.Volume() < 0.0 ? mesh.Turned() : mesh;
}

// Corner i of a box is high along axis a where bit a of i is set.
inline Mesh makeBox(const Point<3>& low, const Point<3>& high)
{
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
  {
    mesh.Points.push_back(
      { i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2] });
  }
  mesh.Triangles = { { 0, 2, 1 }, { 1, 2, 3 }, { 4, 5, 6 }, { 5, 7, 6 }, { 0, 1, 4 }, { 1, 5, 4 },
    { 2, 6, 3 }, { 3, 6, 7 }, { 0, 4, 2 }, { 2, 4, 6 }, { 1, 3, 5 }, { 3, 7, 5 } };
  return mesh;
}

// Rings of a surface that closes around both ways; `place(u, v)` for u and v from 0 to 1.
template <class Place>
Mesh makeTorus(std::int64_t around, std::int64_t across, const Place& place)
{
  Mesh mesh;
  for (std::int64_t i = 0; i < around; ++i)
  {
    for (std::int64_t j = 0; j < across; ++j)
    {
      mesh.Points.push_back(place(static_cast<double>(i) / static_cast<double>(around),
        static_cast<double>(j) / static_cast<double>(across)));
      const std::int64_t k = (i + 1) % around;
      const std::int64_t l = (j + 1) % across;
      mesh.Triangles.push_back({ i * across + j, k * across + j, k * across + l });
      mesh.Triangles.push_back({ i * across + j, k * across + l, i * across + l });
    }
  }
  return mesh;
}

inline Mesh makeSphere(const Point<3>& centre, double radius, std::int64_t rings)
{
  const std::int64_t around = 2 * rings;
  Mesh mesh;
  const auto at = [&](double polar, double angle) {
    mesh.Points.push_back({ centre[0] + radius * std::sin(polar) * std::cos(angle),
      centre[1] + radius * std::sin(polar) * std::sin(angle),
      centre[2] + radius * std::cos(polar) });
  };
  at(0.0, 0.0);
  at(pi, 0.0);
  for (std::int64_t i = 1; i < rings; ++i)
  {
    for (std::int64_t j = 0; j < around; ++j)
    {
      at(pi * static_cast<double>(i) / static_cast<double>(rings),
        2.0 * pi * static_cast<double>(j) / static_cast<double>(around));
      const std::int64_t here = 2 + (i - 1) * around + j;
      const std::int64_t next = 2 + (i - 1) * around + (j + 1) % around;
      if (i == 1)
      {
        mesh.Triangles.push_back({ 0, here, next });
      }
      if (i + 1 == rings)
      {
        mesh.Triangles.push_back({ 1, next, here });
      }
      else
      {
        mesh.Triangles.push_back({ here, here + around, next });
        mesh.Triangles.push_back({ next, here + around, next + around });
      }
    }
  }
  return mesh;
}

inline std::vector<double> cover(const Mesh& mesh, const GridSize<3>& cells, int supersampling,
  const Executor& executor = SerialExecutor(), std::int64_t* openLines = nullptr)
{
  std::vector<double> coverage(static_cast<std::size_t>(numberOfCells<3>(cells)), -1.0);
  const CoverageReport report =
    coverSolid(mesh.Surface(), cells, supersampling, coverage.data(), executor);
  if (openLines)
  {
    *openLines = report.OpenLines;
  }
  return coverage;
}

inline double sum(const std::vector<double>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// The part of the line (y, z) that is inside of a convex surface, by its planes; empty if first is
// not below second.
inline std::array<double, 2> clipLine(const Mesh& convex, double y, double z)
{
  std::array<double, 2> part{ -HUGE_VAL, HUGE_VAL };
  for (const auto& t : convex.Triangles)
  {
    const Point<3>& a = convex.Points[t[0]];
    const Point<3>& b = convex.Points[t[1]];
    const Point<3>& c = convex.Points[t[2]];
    Point<3> n;
    for (int i = 0; i < 3; ++i)
    {
      const int j = (i + 1) % 3;
      const int k = (i + 2) % 3;
      n[i] = (b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]);
    }
    const double offset = n[0] * a[0] + n[1] * (a[1] - y) + n[2] * (a[2] - z);
    if (n[0] > 0.0)
    {
      part[1] = std::min(part[1], offset / n[0]);
    }
    else if (n[0] < 0.0)
    {
      part[0] = std::max(part[0], offset / n[0]);
    }
    else if (offset < 0.0)
    {
      return { 0.0, 0.0 };
    }
  }
  return part;
}

// What the lines cover of each cell, where `inside(y, z)` gives disjoint parts of a line.
template <class Inside>
std::vector<double> coverByLines(
  const GridSize<3>& cells, std::int64_t supersampling, const Inside& inside)
{
  std::vector<double> coverage(static_cast<std::size_t>(numberOfCells<3>(cells)), 0.0);
  const auto squares = static_cast<double>(supersampling);
  for (std::int64_t k = 0; k < cells[2] * supersampling; ++k)
  {
    for (std::int64_t j = 0; j < cells[1] * supersampling; ++j)
    {
      double* row =
        coverage.data() + ((k / supersampling) * cells[1] + j / supersampling) * cells[0];
      const auto parts =
        inside((static_cast<double>(j) + 0.5) / squares, (static_cast<double>(k) + 0.5) / squares);
      for (const std::array<double, 2>& part : parts)
      {
        for (std::int64_t i = 0; i < cells[0]; ++i)
        {
          const auto x = static_cast<double>(i);
          row[i] +=
            std::max(0.0, std::min(part[1], x + 1.0) - std::max(part[0], x)) / (squares * squares);
        }
      }
    }
  }
  return coverage;
}

} // namespace RectifiedTransport

#endif
