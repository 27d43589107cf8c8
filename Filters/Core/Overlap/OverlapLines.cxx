// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Overlap/OverlapLines.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t linesPerCell = 4; // along axes 1 and 2
// Of the first line in a grid cell, in lines. Not quite the middle of its share: meshes have faces
// at round fractions of a cell, and a line within a face belongs to both sides or to none.
constexpr double firstLine = 0.5 + 0.0131;

double lineAt(std::int64_t line)
{
  return (static_cast<double>(line) + firstLine) / linesPerCell;
}

// Lines [First, Last) whose coordinates are from low to high.
struct LineRange
{
  std::int64_t First;
  std::int64_t Last;
};

LineRange linesBetween(double low, double high, std::int64_t firstCell, std::int64_t lastCell)
{
  const double begin = std::ceil(low * linesPerCell - firstLine);
  const double end = std::floor(high * linesPerCell - firstLine) + 1.0;
  return { std::max(firstCell * linesPerCell, static_cast<std::int64_t>(begin)),
    std::min(lastCell * linesPerCell, static_cast<std::int64_t>(end)) };
}

using Plane = std::array<double, 4>; // constant and factors of the coordinates

// The linear functions that are 1 at a vertex and 0 at the others.
std::array<Plane, 4> barycentricPlanes(const std::array<Point<3>, 4>& v)
{
  std::array<Plane, 4> planes;
  for (std::size_t i = 0; i < 4; ++i)
  {
    const Point<3>& o = v[(i + 1) % 4];
    const Point<3>& p = v[(i + 2) % 4];
    const Point<3>& q = v[(i + 3) % 4];
    double e[3];
    double f[3];
    double g[3];
    for (std::size_t a = 0; a < 3; ++a)
    {
      e[a] = p[a] - o[a];
      f[a] = q[a] - o[a];
      g[a] = v[i][a] - o[a];
    }
    const double normal[3] = { e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2],
      e[0] * f[1] - e[1] * f[0] };
    const double height = normal[0] * g[0] + normal[1] * g[1] + normal[2] * g[2];
    Plane& plane = planes[i];
    plane[0] = 0.0;
    for (std::size_t a = 0; a < 3; ++a)
    {
      plane[a + 1] = normal[a] / height;
      plane[0] -= plane[a + 1] * o[a];
    }
  }
  return planes;
}

// Adds weight times the integral of constant + slope x from low to high to the cells of a row.
void addAlongRow(double low, double high, double constant, double slope, double weight, double* row)
{
  const auto add = [&](std::int64_t cell, double from, double to) {
    row[cell] += weight * (to - from) * (constant + 0.5 * slope * (from + to));
  };
  const auto first = static_cast<std::int64_t>(low);
  const auto last = static_cast<std::int64_t>(high);
  if (first == last)
  {
    add(first, low, high);
    return;
  }
  add(first, low, static_cast<double>(first + 1));
  for (std::int64_t cell = first + 1; cell < last; ++cell)
  {
    row[cell] += weight * (constant + slope * (static_cast<double>(cell) + 0.5));
  }
  if (high > static_cast<double>(last))
  {
    add(last, static_cast<double>(last), high);
  }
}

} // namespace

bool isWideAlongLines(const LinearSimplex<3>& simplex)
{
  // The shadow is a triangle, or a quadrilateral: half the sum of its faces' shadows.
  double area = 0.0;
  double longest = 0.0;
  const auto& v = simplex.Vertices;
  for (std::size_t i = 0; i < 4; ++i)
  {
    const Point<3>& o = v[(i + 1) % 4];
    const Point<3>& p = v[(i + 2) % 4];
    const Point<3>& q = v[(i + 3) % 4];
    area += 0.25 * std::abs((p[1] - o[1]) * (q[2] - o[2]) - (p[2] - o[2]) * (q[1] - o[1]));
    for (std::size_t j = 0; j < i; ++j)
    {
      longest = std::max(longest, std::hypot(v[i][1] - v[j][1], v[i][2] - v[j][2]));
    }
  }
  constexpr double narrowest = 0.5;
  return area > narrowest * longest;
}

void addAlongLines(const LinearSimplex<3>& simplex, const GridSlab<3>& slab)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double weight = 1.0 / (linesPerCell * linesPerCell);
  const auto& v = simplex.Vertices;
  const std::array<Plane, 4> planes = barycentricPlanes(v);
  Plane function{};
  for (std::size_t i = 0; i < 4; ++i)
  {
    for (std::size_t c = 0; c < 4; ++c)
    {
      function[c] += simplex.Values[i] * planes[i][c];
    }
  }
  double low[3];
  double high[3];
  for (std::size_t a = 0; a < 3; ++a)
  {
    low[a] = std::min({ v[0][a], v[1][a], v[2][a], v[3][a] });
    high[a] = std::max({ v[0][a], v[1][a], v[2][a], v[3][a] });
  }
  low[0] = std::max(low[0], 0.0);
  high[0] = std::min(high[0], static_cast<double>(slab.Size[0]));
  const LineRange alongY = linesBetween(low[1], high[1], 0, slab.Size[1]);
  const LineRange alongZ = linesBetween(low[2], high[2], slab.First, slab.Last);
  constexpr std::int64_t atOnce = 64;
  double begin[atOnce];
  double end[atOnce];
  for (std::int64_t k = alongZ.First; k < alongZ.Last; ++k)
  {
    const double z = lineAt(k);
    double* plane = slab.Sums + (k / linesPerCell) * slab.Size[1] * slab.Size[0];
    for (std::int64_t first = alongY.First; first < alongY.Last; first += atOnce)
    {
      const auto count = static_cast<int>(std::min(atOnce, alongY.Last - first));
      std::fill_n(begin, count, low[0]);
      std::fill_n(end, count, high[0]);
      for (const Plane& face : planes)
      {
        const double scale = face[1] == 0.0 ? -1.0 : -1.0 / face[1];
        const double base = scale * (face[0] + face[3] * z);
        const double step = scale * face[2];
        for (int i = 0; i < count; ++i)
        {
          const double at = base + step * lineAt(first + i);
          // A face along the lines has each of them on one side.
          begin[i] = face[1] > 0.0 ? std::max(begin[i], at) : begin[i];
          end[i] = face[1] < 0.0 ? std::min(end[i], at) : end[i];
          end[i] = face[1] == 0.0 && at > 0.0 ? -infinity : end[i];
        }
      }
      for (int i = 0; i < count; ++i)
      {
        if (begin[i] < end[i])
        {
          const std::int64_t line = first + i;
          addAlongRow(begin[i], end[i], function[0] + function[2] * lineAt(line) + function[3] * z,
            function[1], weight, plane + (line / linesPerCell) * slab.Size[0]);
        }
      }
    }
  }
}

} // namespace RectifiedTransport
