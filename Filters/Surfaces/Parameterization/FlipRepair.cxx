// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Parameterization/MapPolish.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace RectifiedTransport
{

namespace
{

constexpr std::size_t largestPatch = 8000; // points; larger ones are more than a few flips
constexpr int mostSteps = 60;

using Patch = std::vector<std::int64_t>; // ascending ids of points

// A collapsed triangle does not count as flipped: no move of its points along their side gives it
// an area.
bool isFlipped(const MapParts& parts, std::int64_t t, const std::vector<Point<2>>& positions)
{
  const auto position = [&](int i) {
    return positions[static_cast<std::size_t>(parts.Disk.Triangle(t)[i])];
  };
  return !(crossProduct(position(0), position(1), position(2)) > 0.0) &&
    !isCollapsed(parts.Disk, parts.Square, t);
}

// Adds the points of the triangles about those of a patch.
void addRing(const MapParts& parts, std::vector<unsigned char>& isIn, Patch& points)
{
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    parts.Triangles.VisitCorners(points[i], [&](std::int64_t other) {
      if (std::exchange(isIn[static_cast<std::size_t>(other)], 1) == 0)
      {
        points.push_back(other);
      }
    });
  }
}

// The connected components of a set of points, by breadth first over triangles. Clears `isIn`. Each
// patch can then be repaired on its own.
std::vector<Patch> separate(
  const MapParts& parts, std::vector<unsigned char>& isIn, const Patch& points)
{
  std::vector<Patch> patches;
  for (const std::int64_t start : points)
  {
    if (!isIn[static_cast<std::size_t>(start)])
    {
      continue;
    }
    Patch patch{ start };
    isIn[static_cast<std::size_t>(start)] = 0;
    for (std::size_t next = 0; next < patch.size(); ++next)
    {
      parts.Triangles.VisitCorners(patch[next], [&](std::int64_t other) {
        if (std::exchange(isIn[static_cast<std::size_t>(other)], 0) != 0)
        {
          patch.push_back(other);
        }
      });
    }
    std::sort(patch.begin(), patch.end());
    patches.push_back(std::move(patch));
  }
  return patches;
}

// The residual whose square is the energy, where q = area / share of a triangle in the map: q - 1
// below 1, log q above. Both have the value 0 and the slope 1 at q = 1. The logarithm lets large
// triangles give area to flipped ones at little cost; a flipped triangle (q <= 0) has no logarithm,
// and is pulled linearly.
double residualOf(double q)
{
  return q < 1.0 ? q - 1.0 : std::log(q);
}

// Counts the triangles without a positive area, except those that no move can give one.
std::int64_t countFlipped(const LocalMap& map)
{
  std::int64_t count = 0;
  for (std::size_t t = 0; t < map.NumberOfTriangles(); ++t)
  {
    count += map.IsCollapsed(t) || map.AreaOf(t, map.Positions()) > 0.0 ? 0 : 1;
  }
  return count;
}

// sum of r(q_t)^2 over the triangles of a patch. All weigh the same, whatever their area: a flip of
// a tiny triangle counts as one of a large one.
double energyOf(const LocalMap& map, const std::vector<Point<2>>& positions)
{
  double energy = 0.0;
  for (std::size_t t = 0; t < map.NumberOfTriangles(); ++t)
  {
    if (!map.IsCollapsed(t))
    {
      const double residual = residualOf(map.AreaOf(t, positions) / map.ShareOf(t));
      energy += residual * residual;
    }
  }
  return energy;
}

// Gauss-Newton: matrix J^T J and right side -J^T r, where the row of a triangle in J is r'(q) /
// share times the gradient of its area.
void assemble(const LocalMap& map, LocalSystem& system)
{
  system.Clear();
  for (std::size_t t = 0; t < map.NumberOfTriangles(); ++t)
  {
    if (map.IsCollapsed(t))
    {
      continue;
    }
    const double q = map.AreaOf(t, map.Positions()) / map.ShareOf(t);
    // r'(q) = 1 below 1 and 1 / q above, by the chain rule over the share.
    const double slope = (q < 1.0 ? 1.0 : 1.0 / q) / map.ShareOf(t);
    TriangleVector gradient = map.AreaGradient(t);
    TriangleVector right;
    for (std::size_t i = 0; i < 6; ++i)
    {
      gradient[i] *= slope;
      right[i] = -residualOf(q) * gradient[i];
    }
    TriangleMatrix matrix;
    for (std::size_t i = 0; i < 6; ++i)
    {
      for (std::size_t j = 0; j < 6; ++j)
      {
        matrix[i][j] = gradient[i] * gradient[j];
      }
    }
    system.Add(t, matrix, right);
  }
}

// Levenberg-Marquardt steps, (J^T J + damping diag(J^T J)) d = -J^T r, until no triangle of the
// patch is flipped. Returns whether there are fewer than before.
bool repairPatch(LocalMap& map, Progress& progress)
{
  // Beyond this damping, steps are shorter than what could turn a triangle over.
  constexpr double mostDamping = 1e6;
  constexpr double leastDamping = 1e-6;
  constexpr double less = 1.0 / 3.0;
  constexpr int halvings = 8;
  if (map.NumberOfUnknowns() == 0)
  {
    return false;
  }
  const std::int64_t before = countFlipped(map);
  const auto energy = [&map](const std::vector<Point<2>>& moved) { return energyOf(map, moved); };
  LocalSystem system = map.MakeSystem();
  std::vector<double> solution;
  double damping = 1e-3;
  for (int i = 0; i < mostSteps && damping < mostDamping && countFlipped(map) > 0; ++i)
  {
    assemble(map, system);
    system.Damp(damping);
    const bool isBetter =
      system.Solve(solution, progress) && map.Descend(solution, 1.0, halvings, energy) > 0.0;
    // The damping falls threefold after a step that lowers the energy, grows tenfold otherwise.
    damping = isBetter ? std::max(leastDamping, less * damping) : 10.0 * damping;
  }
  return countFlipped(map) < before;
}

} // namespace

void repairFlips(
  const MapParts& parts, int rings, std::vector<Point<2>>& positions, const Context& context)
{
  Progress progress(context);
  // The points of flipped triangles, then `rings` times those around them.
  std::vector<unsigned char> isIn(positions.size(), 0);
  Patch points;
  for (std::int64_t t = 0; t < parts.Disk.NumberOfTriangles(); ++t)
  {
    if (!isFlipped(parts, t, positions))
    {
      continue;
    }
    for (int corner = 0; corner < 3; ++corner)
    {
      const std::int64_t point = parts.Disk.Triangle(t)[corner];
      if (std::exchange(isIn[static_cast<std::size_t>(point)], 1) == 0)
      {
        points.push_back(point);
      }
    }
  }
  for (int ring = 0; ring < rings; ++ring)
  {
    addRing(parts, isIn, points);
  }
  const std::vector<Patch> patches = separate(parts, isIn, points);
  // Patches share no triangle with points of another one that move, and can be repaired at the same
  // time.
  progress.ForEach(
    static_cast<std::int64_t>(patches.size()), 1,
    [&](std::int64_t i) {
      const Patch& patch = patches[static_cast<std::size_t>(i)];
      if (patch.size() <= largestPatch)
      {
        LocalMap map(parts, patch, positions);
        if (repairPatch(map, progress))
        {
          map.Store(positions);
        }
      }
    },
    1);
}

} // namespace RectifiedTransport
