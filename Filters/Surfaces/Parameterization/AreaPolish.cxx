// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Parameterization/MapPolish.h"

#include "Core/Parallel/Stages.h"
#include "Surfaces/Parameterization/MapRegions.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace RectifiedTransport
{

namespace
{

// A region has at most so many points: a factorization of its Gauss-Newton matrix stays in the
// cache, and there are enough regions for all threads.
constexpr std::int64_t tilePoints = 5000;
constexpr int polishSteps = 3; // Gauss-Newton steps on a region in a sweep
// Triangles with smaller shares weigh as this one: their areas have no accuracy.
constexpr double leastShare = 1e-13;

using Cotangents = std::array<double, 3>;

// The least s > 0 where c0 + c1 s + c2 s^2 = 0, for c0 > 0.
double firstRoot(double c0, double c1, double c2)
{
  constexpr double none = std::numeric_limits<double>::infinity();
  const double discriminant = c1 * c1 - 4.0 * c2 * c0;
  if (discriminant < 0.0)
  {
    return none;
  }
  // The stable form of the quadratic's roots, q / c2 and c0 / q: no difference of nearly equal
  // numbers. q / 0 is no root.
  const double q = -0.5 * (c1 + std::copysign(std::sqrt(discriminant), c1));
  double root = none;
  for (const double candidate : { q / c2, c0 / q })
  {
    if (candidate > 0.0 && candidate < root)
    {
      root = candidate;
    }
  }
  return root;
}

// Gauss-Newton steps on the points of one region, with all others fixed. The energy is E(u) = sum
// over triangles of (A(u) - s)^2 / s, plus nu u^T K u: A is the area in the square, s the share of
// the surface's area, u the positions, K the surface's cotangent matrix. A step d solves (J^T W J +
// (mu + nu) K) d = -J^T W (A - s) - nu K u, where J has the gradients of the areas and W = diag(1 /
// s). mu K is Levenberg-Marquardt damping with the Dirichlet form in the place of the identity: it
// resists shear and lets a region move as a whole.
class TilePolish
{
public:
  TilePolish(const MapParts& parts, LocalMap& map, bool isFirst)
    : Map(map)
    // The first sweep starts from the flow's result, whose triangles are sheared: there the
    // Dirichlet form smooths as well (nu = 1e-2). Later sweeps only damp.
    , Damping(isFirst ? 1e-2 : 1e-3)
    , Smoothing(isFirst ? 1e-2 : 0.0)
  {
    for (std::size_t t = 0; t < map.NumberOfTriangles(); ++t)
    {
      // The three values of the surface's cotangent matrix for each triangle.
      this->Weights.push_back(cotangentsOf(parts.Disk, map.IdOf(t)));
    }
  }

  void Run(Progress& progress)
  {
    if (this->Map.NumberOfUnknowns() == 0)
    {
      return;
    }
    LocalSystem system = this->Map.MakeSystem();
    std::vector<double> solution;
    for (int step = 0; step < polishSteps; ++step)
    {
      this->Assemble(system);
      if (!system.Solve(solution, progress))
      {
        return;
      }
      this->Step(solution);
    }
  }

private:
  // The weights of the sides in the Dirichlet form of a triangle, cot(angle opposite) / 2. Twice
  // the area, their denominator, is taken as at least 0.02 of the two sides' squares: a needle's
  // weights would otherwise outweigh everything else.
  static Cotangents cotangentsOf(const DiskMesh& disk, std::int64_t triangle)
  {
    constexpr double thinnest = 0.02;
    const ConstPointSpan<3> points = disk.Surface().Points;
    const auto point = [&](std::size_t i) {
      return Eigen::Map<const Eigen::Vector3d>(points[disk.Triangle(triangle)[i % 3]]);
    };
    const Eigen::Vector3d first = point(1) - point(0);
    const Eigen::Vector3d second = point(2) - point(0);
    const double twiceArea =
      std::max(thinnest * (first.squaredNorm() + second.squaredNorm()), first.cross(second).norm());
    Cotangents cotangents;
    for (std::size_t i = 0; i < 3; ++i)
    {
      // The dot product of the two sides that meet opposite to side i, by twice the area: a
      // cotangent.
      cotangents[i] = 0.5 * (point(i) - point(i + 2)).dot(point(i + 1) - point(i + 2)) / twiceArea;
    }
    return cotangents;
  }

  // 1 / s makes the terms the squares of relative deviations, weighted by area. A triangle on one
  // side of the square cannot get an area; it must not pull on its neighbours.
  double WeightOf(std::size_t triangle) const
  {
    return this->Map.IsCollapsed(triangle)
      ? 0.0
      : 1.0 / std::max(this->Map.ShareOf(triangle), leastShare);
  }

  // E at any positions of the region's points, for the line search.
  double Energy(const std::vector<Point<2>>& positions) const
  {
    double energy = 0.0;
    for (std::size_t t = 0; t < this->Map.NumberOfTriangles(); ++t)
    {
      const double missing = this->Map.AreaOf(t, positions) - this->Map.ShareOf(t);
      energy += this->WeightOf(t) * missing * missing;
      for (std::size_t i = 0; this->Smoothing > 0.0 && i < 3; ++i)
      {
        const auto& corners = this->Map.CornersOf(t);
        const Point<2>& a = positions[static_cast<std::size_t>(corners[i])];
        const Point<2>& b = positions[static_cast<std::size_t>(corners[(i + 1) % 3])];
        const double square = (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
        energy += this->Smoothing * this->Weights[t][i] * square;
      }
    }
    return energy;
  }

  // The normal equations at the current positions; their pattern does not change from step to step.
  void Assemble(LocalSystem& system) const
  {
    const std::vector<Point<2>>& positions = this->Map.Positions();
    const double form = this->Damping + this->Smoothing;
    system.Clear();
    for (std::size_t t = 0; t < this->Map.NumberOfTriangles(); ++t)
    {
      const TriangleVector gradient = this->Map.AreaGradient(t);
      const double weight = this->WeightOf(t);
      const double missing = this->Map.AreaOf(t, positions) - this->Map.ShareOf(t);
      TriangleMatrix matrix;
      TriangleVector right;
      // The area term contributes (1 / s) g g^T and -(1 / s) (A - s) g, g the gradient of the area
      // by the corners' six coordinates.
      for (std::size_t i = 0; i < 6; ++i)
      {
        right[i] = -weight * missing * gradient[i];
        for (std::size_t j = 0; j < 6; ++j)
        {
          matrix[i][j] = weight * gradient[i] * gradient[j];
        }
      }
      // The Dirichlet form has w ((a - b)^2) for each side, so that w goes to the diagonal, -w
      // beside it. The right side has only the smoothing's part: damping has no gradient at d = 0.
      for (std::size_t i = 0; i < 3; ++i)
      {
        const std::size_t next = (i + 1) % 3;
        const auto& corners = this->Map.CornersOf(t);
        const Point<2>& a = positions[static_cast<std::size_t>(corners[i])];
        const Point<2>& b = positions[static_cast<std::size_t>(corners[next])];
        const double value = this->Weights[t][i];
        for (std::size_t axis = 0; axis < 2; ++axis)
        {
          const std::size_t m = 2 * i + axis;
          const std::size_t n = 2 * next + axis;
          matrix[m][m] += form * value;
          matrix[n][n] += form * value;
          matrix[m][n] -= form * value;
          matrix[n][m] -= form * value;
          right[m] -= this->Smoothing * value * (a[axis] - b[axis]);
          right[n] += this->Smoothing * value * (a[axis] - b[axis]);
        }
      }
      system.Add(t, matrix, right);
    }
  }

  // The part of a step at which no healthy triangle has lost most of its area, but not less than
  // half of it: the energy decides further.
  double LargestStep(const std::vector<double>& solution) const
  {
    constexpr double healthy = 0.2; // area by share; smaller ones have to move
    // A triangle may lose this part of its area in a step; beyond it, the linear model of areas
    // fails.
    constexpr double loss = 0.9;
    // Without this floor, a few thin triangles would stop the whole region.
    constexpr double least = 0.5;
    const std::vector<Point<2>>& positions = this->Map.Positions();
    double step = 1.0;
    for (std::size_t t = 0; t < this->Map.NumberOfTriangles(); ++t)
    {
      const double area = this->Map.AreaOf(t, positions);
      if (area <= healthy * this->Map.ShareOf(t))
      {
        continue;
      }
      const auto& corners = this->Map.CornersOf(t);
      const auto side = [&](int to) {
        const Point<2>& a = positions[static_cast<std::size_t>(corners[0])];
        const Point<2>& b = positions[static_cast<std::size_t>(to)];
        return Point<2>{ b[0] - a[0], b[1] - a[1] };
      };
      const auto change = [&](int to) {
        const Point<2> a = this->Map.MoveOf(corners[0], solution);
        const Point<2> b = this->Map.MoveOf(to, solution);
        return Point<2>{ b[0] - a[0], b[1] - a[1] };
      };
      const auto cross = [](const Point<2>& a, const Point<2>& b) {
        return a[0] * b[1] - a[1] * b[0];
      };
      // The area along the step is cross(e + s d, f + s g) / 2, a quadratic in s. It loses the part
      // `loss` where loss cross(e, f) + s (cross(e, g) + cross(d, f)) + s^2 cross(d, g) = 0.
      const Point<2> e = side(corners[1]);
      const Point<2> f = side(corners[2]);
      const Point<2> d = change(corners[1]);
      const Point<2> g = change(corners[2]);
      step = std::min(step, firstRoot(loss * cross(e, f), cross(e, g) + cross(d, f), cross(d, g)));
    }
    return std::max(step, least);
  }

  // The trust region by damping: mu falls by 4 after a full step, grows by 4 after a short one, by
  // 10 if the energy does not fall along the direction.
  void Step(const std::vector<double>& solution)
  {
    constexpr int halvings = 10;
    constexpr double easier = 0.25;
    constexpr double harder = 4.0;
    constexpr double leastDamping = 1e-4;
    constexpr double fade = 0.3; // the factor of the smoothing after a step
    const double step = this->Map.Descend(solution, this->LargestStep(solution), halvings,
      [this](const std::vector<Point<2>>& positions) { return this->Energy(positions); });
    if (step == 0.0)
    {
      this->Damping *= 10.0;
      return;
    }
    // 0.24: less than a quarter of the direction was taken. 0.99: all of it, but for rounding.
    if (step < 0.24)
    {
      this->Damping *= harder;
    }
    else if (step > 0.99)
    {
      this->Damping = std::max(leastDamping, easier * this->Damping);
    }
    this->Smoothing *= fade;
  }

  LocalMap& Map;
  std::vector<Cotangents> Weights; // by triangles of the region
  double Damping;                  // mu, without a unit
  double Smoothing;                // nu, without a unit
};

} // namespace

void polishAreas(
  const MapParts& parts, int sweep, std::vector<Point<2>>& positions, const Context& context)
{
  Progress progress(context);
  // Regions of a group have no triangle in common, so they can move at the same time; the groups
  // follow each other. The result does not depend on the number of threads.
  const auto groups = makeRegions(parts.Disk, positions, tilePoints, sweep);
  Parts stages(progress, static_cast<std::int64_t>(groups.size()));
  std::int64_t number = 0;
  for (const std::vector<MapRegion>& group : groups)
  {
    const auto regions = static_cast<std::int64_t>(group.size());
    Progress& stage = stages[number++];
    stage.ForEach(
      regions, 1,
      [&](std::int64_t region) {
        LocalMap map(parts, group[static_cast<std::size_t>(region)], positions);
        TilePolish(parts, map, sweep == 0).Run(stage);
        map.Store(positions);
      },
      1);
  }
}

} // namespace RectifiedTransport
