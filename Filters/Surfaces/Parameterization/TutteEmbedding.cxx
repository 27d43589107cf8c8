// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Parameterization/TutteEmbedding.h"

#include "Core/Algebra/SparseCholesky.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Parameterization/LocalMap.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// Above this, factorizations are dear: 3 iterations must do.
constexpr std::int64_t manyPoints = std::int64_t{ 1 } << 17;

// Puts the boundary points of each side on it, spaced in proportion to the lengths on the surface.
void placeByLength(const DiskMesh& disk, const SquareMap& square, std::vector<Point<2>>& positions)
{
  const std::vector<std::int64_t>& loop = disk.Boundary();
  const ConstPointSpan<3> points = disk.Surface().Points;
  auto at =
    static_cast<std::size_t>(std::find(loop.begin(), loop.end(), square.Corners[0]) - loop.begin());
  for (std::size_t q = 0; q < square.Corners.size(); ++q)
  {
    const std::int64_t end = square.Corners[(q + 1) % square.Corners.size()];
    std::vector<std::pair<std::size_t, double>> side; // points, and lengths up to them
    double length = 0.0;
    while (loop[at] != end)
    {
      side.emplace_back(static_cast<std::size_t>(loop[at]), length);
      const std::size_t next = (at + 1) % loop.size();
      length += (Eigen::Map<const Eigen::Vector3d>(points[loop[next]]) -
        Eigen::Map<const Eigen::Vector3d>(points[loop[at]]))
                  .norm();
      at = next;
    }
    // The side's first point is a corner of the square, and `end` is the next one.
    const Point<2> from = square.Positions[side[0].first];
    const Point<2> to = square.Positions[static_cast<std::size_t>(end)];
    for (const auto& [point, before] : side)
    {
      const double part = before / length;
      positions[point] = { from[0] + part * (to[0] - from[0]), from[1] + part * (to[1] - from[1]) };
    }
  }
}

// An edge of the graph whose barycentric embedding is sought, with a weight above 0.
struct WeightedEdge
{
  std::int64_t Ends[2];
  double Weight;
};

// Finds the edges that have an inner point: those of the boundary are fixed at both ends.
std::vector<WeightedEdge> findEdges(
  const DiskMesh& disk, const std::vector<int>& unknowns, Progress& progress)
{
  // Positive weights keep points inside of their neighbours; large ones would hide all others.
  constexpr double least = 0.1;
  constexpr double most = 1e3;
  // The weights to begin with are the cotangent weights (cot alpha + cot beta) / 2, clamped.
  const TriangleSurface surface = disk.Surface();
  // The cotangent of the angle opposite to a side: dot product by cross product of the sides there.
  // A triangle without area cannot occur: a disk has none.
  const auto cotangent = [&](std::int64_t side) {
    const auto corner = [&](std::int64_t at) {
      return Eigen::Map<const Eigen::Vector3d>(surface.Points[surface.Triangles[at]]);
    };
    const Eigen::Vector3d a = corner(side) - corner(lastSide(side));
    const Eigen::Vector3d b = corner(nextSide(side)) - corner(lastSide(side));
    return a.dot(b) / a.cross(b).norm();
  };
  std::vector<WeightedEdge> edges;
  for (std::int64_t side = 0; side < 3 * surface.NumberOfTriangles; ++side)
  {
    const std::int64_t other = disk.Edges().Other(side);
    const std::int64_t a = surface.Triangles[side];
    const std::int64_t b = surface.Triangles[nextSide(side)];
    const bool isInner =
      unknowns[static_cast<std::size_t>(a)] >= 0 || unknowns[static_cast<std::size_t>(b)] >= 0;
    if (isInner && other > side)
    {
      // `other > side` takes each edge once, and drops the boundary, where it is -1.
      const double weight = 0.5 * (cotangent(side) + cotangent(other));
      edges.push_back({ { a, b }, std::clamp(weight, least, most) });
    }
    progress.Add(1);
  }
  return edges;
}

// The positions x_i of inner points with sum over j of w_ij (x_i - x_j) = 0: each is the weighted
// mean of its neighbours. Boundary points stay on the square, which is convex; Tutte's theorem then
// says that no triangle is flipped.
class Embedding
{
public:
  Embedding(const DiskMesh& disk, const SquareMap& square, std::vector<Point<2>> positions,
    Progress& progress)
    : Disk(disk)
    , Positions(std::move(positions))
    , Unknowns(this->Positions.size(), -1)
  {
    for (std::size_t point = 0; point < this->Unknowns.size(); ++point)
    {
      if (square.OnSides[point] == 0)
      {
        this->Unknowns[point] = this->Count++;
      }
    }
    progress.Expect(3 * disk.NumberOfTriangles());
    this->Edges = findEdges(disk, this->Unknowns, progress);
  }

  bool HasUnknowns() const { return this->Count > 0; }
  const std::vector<Point<2>>& Result() const { return this->Positions; }

  // Returns false if the weights differ by too much for numbers of this precision.
  // The pattern is the same for all weights, so that its analysis serves all iterations. x and y
  // share a factor.
  bool Solve(Progress& progress)
  {
    // The Laplacian of a connected graph with fixed boundary points and positive weights is
    // symmetric and positive definite.
    const SparseCholesky::Matrix matrix = this->MakeMatrix();
    progress.Check();
    if (!this->IsAnalyzed)
    {
      this->Factor.Analyze(matrix, progress);
      this->IsAnalyzed = true;
    }
    if (!this->Factor.Factorize(matrix, progress))
    {
      return false;
    }
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      progress.Check();
      const SparseCholesky::Vector solution = this->Factor.Solve(this->RightSide(axis));
      for (std::size_t point = 0; point < this->Positions.size(); ++point)
      {
        if (this->Unknowns[point] >= 0)
        {
          // Solutions are convex combinations of values in [0,1]; clamping removes what rounding
          // adds.
          this->Positions[point][axis] =
            std::clamp(solution[this->Unknowns[point]].Value, 0.0, 1.0);
        }
      }
    }
    return true;
  }

  // Multiplies each weight by the geometric mean of its ends' stretches. The stretch of a point is
  // the area of its triangles in the square by that on the surface: where triangles are too large,
  // stiffer edges contract them; where they are squeezed, softer ones let them grow.
  void ChangeWeights(Progress& progress)
  {
    // The largest factor, and the inverse of the least: one iteration must not change more.
    constexpr double most = 1e3;
    std::vector<double> images(this->Positions.size(), 0.0);
    std::vector<double> areas(this->Positions.size(), 0.0);
    for (std::int64_t t = 0; t < this->Disk.NumberOfTriangles(); ++t)
    {
      const double image = std::max(0.0, imageArea(this->Disk, this->Positions, t));
      for (int i = 0; i < 3; ++i)
      {
        const auto point = static_cast<std::size_t>(this->Disk.Triangle(t)[i]);
        images[point] += image;
        areas[point] += this->Disk.AreaShare(t);
      }
    }
    progress.Check();
    const auto stretch = [&](std::int64_t id) {
      const auto point = static_cast<std::size_t>(id);
      return std::clamp(images[point] / areas[point], 1.0 / most, most);
    };
    // Two factors of at most `most` under the root: an edge's weight changes by at most that much.
    for (WeightedEdge& edge : this->Edges)
    {
      edge.Weight *= std::sqrt(stretch(edge.Ends[0]) * stretch(edge.Ends[1]));
    }
  }

private:
  // The unknown of a point; -1 on the boundary.
  int UnknownOf(std::int64_t point) const
  {
    return this->Unknowns[static_cast<std::size_t>(point)];
  }

  // The lower triangle of the weighted Laplacian: sums of weights on the diagonal, -w_ij beside it.
  SparseCholesky::Matrix MakeMatrix() const
  {
    std::vector<Eigen::Triplet<InterruptibleReal>> entries;
    entries.reserve(3 * this->Edges.size());
    for (const WeightedEdge& edge : this->Edges)
    {
      const int a = this->UnknownOf(edge.Ends[0]);
      const int b = this->UnknownOf(edge.Ends[1]);
      for (const int unknown : { a, b })
      {
        if (unknown >= 0)
        {
          entries.emplace_back(unknown, unknown, edge.Weight);
        }
      }
      if (a >= 0 && b >= 0)
      {
        entries.emplace_back(std::max(a, b), std::min(a, b), -edge.Weight);
      }
    }
    SparseCholesky::Matrix matrix(this->Count, this->Count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  // The boundary's part of the equations: sum of w_ij x_j over the neighbours j whose places are
  // known.
  SparseCholesky::Vector RightSide(std::size_t axis) const
  {
    SparseCholesky::Vector right = SparseCholesky::Vector::Zero(this->Count);
    for (const WeightedEdge& edge : this->Edges)
    {
      for (int end = 0; end < 2; ++end)
      {
        const int unknown = this->UnknownOf(edge.Ends[end]);
        const std::int64_t other = edge.Ends[1 - end];
        if (unknown >= 0 && this->UnknownOf(other) < 0)
        {
          right[unknown] += edge.Weight * this->Positions[static_cast<std::size_t>(other)][axis];
        }
      }
    }
    return right;
  }

  const DiskMesh& Disk;
  std::vector<Point<2>> Positions;
  std::vector<int> Unknowns; // by points; -1 on the boundary
  int Count = 0;
  std::vector<WeightedEdge> Edges;
  SparseCholesky Factor;
  bool IsAnalyzed = false;
};

} // namespace

double areaDistortion(const DiskMesh& disk, const std::vector<Point<2>>& positions)
{
  constexpr double smallest = 1e-10; // smallest ratio of areas, also for flipped triangles
  double sum = 0.0;
  for (std::int64_t t = 0; t < disk.NumberOfTriangles(); ++t)
  {
    // 1 where the map keeps the area: both sums are 1.
    const double change = imageArea(disk, positions, t) / disk.AreaShare(t);
    const double logarithm = std::log(std::max(change, smallest));
    sum += disk.AreaShare(t) * logarithm * logarithm;
  }
  return std::sqrt(sum);
}

SquareMap tutteEmbedding(const DiskMesh& disk, const SquareMap& conformal, const Context& context)
{
  constexpr double enough = 0.95; // the largest unevenness, by that before, after which it goes on
  const int most = disk.NumberOfPoints() <= manyPoints ? 12 : 3;
  Progress progress(context);
  SquareMap best = conformal;
  placeByLength(disk, conformal, best.Positions);
  Stages stages(progress, { { "edges", 5 }, { "iterations", 95 } });
  Embedding embedding(disk, conformal, best.Positions, stages["edges"]);
  Parts iterations(stages["iterations"], most);
  // Weights that follow the stretch need not converge; the most even embedding is kept.
  double least = HUGE_VAL;
  for (int i = 0; i < most && embedding.HasUnknowns(); ++i)
  {
    Progress& iteration = iterations[i];
    if (!embedding.Solve(iteration))
    {
      break;
    }
    const double distortion = areaDistortion(disk, embedding.Result());
    // Less than 5 % better is not worth another factorization.
    const bool isLast = !(distortion < enough * least);
    if (distortion < least)
    {
      least = distortion;
      best.Positions = embedding.Result();
    }
    if (isLast)
    {
      break;
    }
    embedding.ChangeWeights(iteration);
  }
  progress.EndSlice(1);
  return best;
}

} // namespace RectifiedTransport
