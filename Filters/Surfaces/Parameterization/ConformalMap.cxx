// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Parameterization/ConformalMap.h"

#include "Core/Algebra/SparseCholesky.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Parameterization/IntrinsicDelaunay.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

namespace
{

constexpr unsigned char onVertical = 1;
constexpr unsigned char onHorizontal = 2;
// On larger surfaces, the number of values of a factor passes what Eigen's indices hold.
constexpr std::int64_t mostPoints = std::int64_t{ 1 } << 24;

// Calls visit(a, b, weight) for each side between two different points. The weight of an edge in
// the cotangent Laplacian is (cot alpha + cot beta) / 2, alpha and beta being the angles opposite
// to it; each of its two sides has one of the terms.
template <class Visit>
void visitSides(const IntrinsicTriangles& triangles, const Visit& visit)
{
  for (std::int64_t t = 0; t < triangles.Points.size(); ++t)
  {
    const auto& corners = triangles.Points.data()[t];
    const auto cotangents = triangles.Cotangents(t);
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::int64_t a = corners[i];
      const std::int64_t b = corners[(i + 1) % 3];
      if (a != b)
      {
        visit(static_cast<std::size_t>(a), static_cast<std::size_t>(b), 0.5 * cotangents[i]);
      }
    }
  }
}

// Makes `values` harmonic where they are not known: for each unknown point i, sum over its edges of
// w_ij (u_i - u_j) = 0. These are the conditions for the least Dirichlet energy of linear finite
// elements, with no normal derivative on the boundary where nothing is prescribed.
class HarmonicProblem
{
public:
  HarmonicProblem(const IntrinsicTriangles& triangles, std::vector<double>& values,
    const std::vector<unsigned char>& isKnown)
    : Triangles(triangles)
    , Values(values)
    , Unknowns(values.size(), -1)
  {
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      if (!isKnown[i])
      {
        this->Unknowns[i] = this->Count++;
      }
    }
  }

  void Solve(Progress& progress, const StagePart& part)
  {
    if (this->Count == 0)
    {
      return;
    }
    SparseCholesky factor;
    {
      const SparseCholesky::Matrix matrix = this->MakeMatrix();
      check(progress);
      factor.Analyze(matrix);
      check(progress);
      if (!factor.Factorize(matrix, progress, part))
      {
        throw std::invalid_argument("has triangles that are too thin for a conformal map");
      }
    }
    // Iterative refinement: each solution is that of the residual. The first, from values of 0, is
    // the solution itself; the second is of what rounding left.
    constexpr int refinements = 2;
    for (int i = 0; i < refinements; ++i)
    {
      const SparseCholesky::Vector residual = this->Residual();
      check(progress);
      const SparseCholesky::Vector change = factor.Solve(residual);
      check(progress);
      for (std::size_t point = 0; point < this->Values.size(); ++point)
      {
        if (this->Unknowns[point] >= 0)
        {
          this->Values[point] += change[this->Unknowns[point]].Value;
        }
      }
    }
  }

private:
  // Unlike Progress::Check, this may be called on any thread.
  static void check(Progress& progress)
  {
    if (progress.ShouldStop())
    {
      throw Cancelled();
    }
  }

  // The lower triangle of the Laplacian on the unknowns: w_ij summed on the diagonal, -w_ij beside
  // it. Known values are in the residual.
  SparseCholesky::Matrix MakeMatrix() const
  {
    std::vector<double> diagonal(static_cast<std::size_t>(this->Count), 0.0);
    std::vector<Eigen::Triplet<InterruptibleReal>> entries;
    entries.reserve(static_cast<std::size_t>(3 * this->Triangles.Points.size() + this->Count));
    visitSides(this->Triangles, [&](std::size_t a, std::size_t b, double weight) {
      const int row = this->Unknowns[a];
      const int column = this->Unknowns[b];
      for (const int unknown : { row, column })
      {
        if (unknown >= 0)
        {
          diagonal[static_cast<std::size_t>(unknown)] += weight;
        }
      }
      if (row >= 0 && column >= 0)
      {
        entries.emplace_back(std::max(row, column), std::min(row, column), -weight);
      }
    });
    for (int i = 0; i < this->Count; ++i)
    {
      entries.emplace_back(i, i, diagonal[static_cast<std::size_t>(i)]);
    }
    SparseCholesky::Matrix matrix(this->Count, this->Count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  // -sum over j of w_ij (u_i - u_j) for each unknown i: what flows out of it at present.
  SparseCholesky::Vector Residual() const
  {
    SparseCholesky::Vector residual = SparseCholesky::Vector::Zero(this->Count);
    visitSides(this->Triangles, [&](std::size_t a, std::size_t b, double weight) {
      const double flow = weight * (this->Values[a] - this->Values[b]);
      if (this->Unknowns[a] >= 0)
      {
        residual[this->Unknowns[a]] -= flow;
      }
      if (this->Unknowns[b] >= 0)
      {
        residual[this->Unknowns[b]] += flow;
      }
    });
    return residual;
  }

  const IntrinsicTriangles& Triangles;
  std::vector<double>& Values;
  std::vector<int> Unknowns; // by points; -1 where the value is known
  int Count = 0;             // number of unknowns
};

// sum over edges of w_ij (u_i - u_j)^2: twice the energy, as only a ratio of two is needed.
double dirichletEnergy(const IntrinsicTriangles& triangles, const std::vector<double>& values)
{
  double energy = 0.0;
  visitSides(triangles, [&](std::size_t a, std::size_t b, double weight) {
    energy += weight * (values[a] - values[b]) * (values[a] - values[b]);
  });
  return energy;
}

// Walks the boundary from the first corner on, and puts its points on the sides.
void placeSides(const DiskMesh& disk, const SquareCorners& corners, SquareMap& map,
  std::array<std::vector<double>, 2>& values)
{
  const std::vector<std::int64_t>& loop = disk.Boundary();
  const auto start = std::find(loop.begin(), loop.end(), corners[0]) - loop.begin();
  std::size_t side = 0;
  // The first corner comes again at the end (<=): the last side ends there, in the last corner's
  // place.
  for (std::size_t i = 0; i <= loop.size(); ++i)
  {
    const std::int64_t id = loop[(static_cast<std::size_t>(start) + i) % loop.size()];
    const auto point = static_cast<std::size_t>(id);
    // Sides 0 to 3 are lower, right, upper, left. A horizontal side prescribes y (values[1]), a
    // vertical one x.
    const auto put = [&](std::size_t on) {
      const bool horizontal = on % 2 == 0; // the lower and the upper side
      map.OnSides[point] |= horizontal ? onHorizontal : onVertical;
      values[horizontal ? 1 : 0][point] = on == 1 || on == 2 ? 1.0 : 0.0;
    };
    put(side);
    if (side < 3 && id == corners[side + 1])
    {
      put(++side);
    }
  }
  if (side != 3)
  {
    throw std::invalid_argument("has other corners than points of its boundary in their order");
  }
}

} // namespace

ConformalMap mapConformally(
  const DiskMesh& disk, const SquareCorners& corners, const Context& context)
{
  if (disk.NumberOfPoints() > mostPoints)
  {
    throw std::invalid_argument("has " + std::to_string(disk.NumberOfPoints()) +
      " points; a conformal map takes at most " + std::to_string(mostPoints));
  }
  const auto points = static_cast<std::size_t>(disk.NumberOfPoints());
  Progress progress(context);
  // The aspect ratio follows below.
  ConformalMap map{ { {}, std::vector<unsigned char>(points, 0), corners }, 1.0 };
  std::array<std::vector<double>, 2> values;
  values.fill(std::vector<double>(points, 0.0));
  placeSides(disk, corners, map.Square, values);

  Stages stages(progress, { { "triangles", 1 }, { "solution", 9 } });
  const IntrinsicTriangles triangles = triangulateDelaunay(disk, stages["triangles"]);
  Progress& solution = stages["solution"];
  // u has the values 0 and 1 on the left and the right side, v on the lower and the upper side;
  // elsewhere they are free.
  const auto solve = [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t axis = first; axis < last; ++axis)
    {
      const unsigned char known = axis == 0 ? onVertical : onHorizontal;
      std::vector<unsigned char> isKnown(points);
      std::transform(map.Square.OnSides.begin(), map.Square.OnSides.end(), isKnown.begin(),
        [known](unsigned char sides) { return (sides & known) != 0; });
      const double begin = 0.5 * static_cast<double>(axis);
      HarmonicProblem(triangles, values[static_cast<std::size_t>(axis)], isKnown)
        .Solve(solution, { begin, begin + 0.5 });
    }
  };
  // Large problems are solved one after the other on this thread, which reports: memory is that of
  // one factor. Below, two threads have one axis each.
  constexpr std::size_t large = 100000;
  if (points > large)
  {
    solve(0, 2);
  }
  else
  {
    solution.For(2, 1, solve, 1);
  }

  map.Square.Positions.resize(points);
  // Values are within 0 and 1 by the maximum principle, up to rounding and weights that are
  // negative.
  for (std::size_t i = 0; i < points; ++i)
  {
    map.Square.Positions[i] = { std::clamp(values[0][i], 0.0, 1.0),
      std::clamp(values[1][i], 0.0, 1.0) };
  }
  // A conformal map onto a rectangle of width a and height 1 has u = x / a and v = y. Their
  // energies over the rectangle are 1 / a^2 and 1 times its area a, and Dirichlet energies are
  // conformal invariants: E(v) / E(u) = a^2.
  map.AspectRatio =
    std::sqrt(dirichletEnergy(triangles, values[1]) / dirichletEnergy(triangles, values[0]));
  return map;
}

} // namespace RectifiedTransport
