// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Seams/HoleFans.h"

#include "Core/Parallel/Progress.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <utility>

namespace RectifiedTransport
{

namespace
{

using Eigen::Vector3d;
using Loop = std::vector<std::int64_t>; // points of a boundary in order

// Up to so many holes of a component are left open.
constexpr std::size_t mostOpen = 8;

// Returns the position of a point, in units of the largest coordinate.
Vector3d at(const SeamMesh& mesh, std::int64_t point)
{
  return Vector3d(mesh.Position(point).data());
}

// The boundary as closed curves. Each of its points has two boundary edges, as the triangles about
// a point form one fan; following unused neighbours walks around each curve.
std::vector<Loop> findLoops(const SeamMesh& mesh, Progress& progress)
{
  std::vector<std::array<std::int64_t, 2>> beside(
    static_cast<std::size_t>(mesh.NumberOfPoints()), { -1, -1 });
  // By points: the two neighbours on the boundary, -1 until found.
  const auto add = [&beside](std::int64_t point, std::int64_t neighbour) {
    std::array<std::int64_t, 2>& known = beside[static_cast<std::size_t>(point)];
    known[known[0] < 0 ? 0 : 1] = neighbour;
  };
  for (std::int64_t side = 0; side < mesh.NumberOfSides(); ++side)
  {
    if (mesh.Other(side) < 0)
    {
      add(mesh.From(side), mesh.To(side));
      add(mesh.To(side), mesh.From(side));
    }
  }
  progress.Check();
  std::vector<Loop> loops;
  for (std::int64_t point = 0; point < mesh.NumberOfPoints(); ++point)
  {
    if (beside[static_cast<std::size_t>(point)][0] < 0)
    {
      continue;
    }
    Loop& loop = loops.emplace_back();
    for (std::int64_t next = point; next >= 0;)
    {
      loop.push_back(next);
      // Taking the neighbours marks the point as visited.
      const auto [a, b] = std::exchange(beside[static_cast<std::size_t>(next)], { -1, -1 });
      const auto isLeft = [&beside](std::int64_t neighbour) {
        return neighbour >= 0 && beside[static_cast<std::size_t>(neighbour)][0] >= 0;
      };
      next = isLeft(a) ? a : isLeft(b) ? b : -1;
    }
  }
  return loops;
}

// The length of a closed curve.
double lengthOf(const SeamMesh& mesh, const Loop& loop)
{
  double length = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i)
  {
    length += (at(mesh, loop[i]) - at(mesh, loop[(i + 1) % loop.size()])).norm();
  }
  return length;
}

// The area of the component in space.
double areaOf(const SeamMesh& mesh)
{
  double area = 0.0;
  for (std::int64_t side = 0; side < mesh.NumberOfSides(); side += 3)
  {
    const Vector3d a = at(mesh, mesh.From(side));
    const Vector3d b = at(mesh, mesh.From(side + 1)) - a;
    const Vector3d c = at(mesh, mesh.From(side + 2)) - a;
    area += 0.5 * b.cross(c).norm();
  }
  return area;
}

// The apex of a hole's fan: off the middle by half of the mean radius, length / (2 pi), along the
// normal of the loop's vector area, sum of x_i x x_(i+1). The fan is a cone, whose triangles have
// areas even if the loop is straight.
Vector3d pointFor(const SeamMesh& mesh, const Loop& loop, double length)
{
  Vector3d middle = Vector3d::Zero();
  for (const std::int64_t point : loop)
  {
    middle += at(mesh, point) / static_cast<double>(loop.size());
  }
  Vector3d normal = Vector3d::Zero();
  for (std::size_t i = 0; i < loop.size(); ++i)
  {
    normal += (at(mesh, loop[i]) - middle).cross(at(mesh, loop[(i + 1) % loop.size()]) - middle);
  }
  // A slit has no vector area; any direction across it will do.
  if (!(normal.norm() > 1e-6 * length * length))
  {
    normal = (at(mesh, loop[1]) - at(mesh, loop[0])).unitOrthogonal();
  }
  constexpr double turn = 6.283185307179586;
  return middle + 0.5 * (length / turn) * normal.normalized();
}

} // namespace

HoleFans closeManyHoles(const SeamMesh& mesh, Progress& progress)
{
  HoleFans fans;
  if (mesh.IsClosed())
  {
    return fans;
  }
  std::vector<Loop> holes;
  std::vector<double> lengths;
  // Length of a circle around 1/(4 pi) = 1/13 of the area.
  const double most = std::sqrt(areaOf(mesh));
  for (Loop& loop : findLoops(mesh, progress))
  {
    const double length = lengthOf(mesh, loop);
    // Long boundaries are no holes.
    if (length <= most)
    {
      lengths.push_back(length);
      holes.push_back(std::move(loop));
    }
  }
  if (holes.size() <= mostOpen)
  {
    return fans;
  }
  for (std::size_t hole = 0; hole < holes.size(); ++hole)
  {
    const Loop& loop = holes[hole];
    const auto number = mesh.NumberOfPoints() + static_cast<std::int64_t>(fans.Points.size());
    const Vector3d x = pointFor(mesh, loop, lengths[hole]);
    fans.Points.push_back({ x[0], x[1], x[2] });
    for (std::size_t i = 0; i < loop.size(); ++i)
    {
      // The fan's sides run against the loop; orientations need not agree.
      fans.Triangles.insert(fans.Triangles.end(), { loop[(i + 1) % loop.size()], loop[i], number });
      // Each triangle its own origin: an edge of the fan may become a seam.
      fans.Origins.push_back(-1 - static_cast<std::int64_t>(fans.Origins.size()));
    }
    progress.Check();
  }
  return fans;
}

} // namespace RectifiedTransport
