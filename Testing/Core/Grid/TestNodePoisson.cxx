// SPDX-License-Identifier: BSD-3-Clause
// Poisson's equation on nodes against its discrete operator, its eigenfunctions and a direct
// solution.
#include "Core/Grid/NodePoisson.h"

#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Parallel/Progress.h"
#include "TestDimensions.h"
#include "ThreadsExecutor.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

namespace RectifiedTransport
{
namespace
{

template <class T>
using NodePoissonOf = DimensionTest<T>;
TYPED_TEST_SUITE(NodePoissonOf, Dimensions, );

const SerialExecutor serial;

template <int Dimension>
Point<Dimension> spacingFor(const Point<1>& line, const Point<2>& plane, const Point<3>& volume)
{
  return std::get<Point<Dimension>>(std::make_tuple(line, plane, volume));
}

template <int Dimension>
GridSize<Dimension> placeOf(const NodeGrid<Dimension>& grid, std::int64_t node)
{
  GridSize<Dimension> place;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    place[axis] = node % (grid.Cells[axis] + 1);
    node /= grid.Cells[axis] + 1;
  }
  return place;
}

// Of a box of volume 1.
template <int Dimension>
double volumeOf(const NodeGrid<Dimension>& grid, std::int64_t node, int without = -1)
{
  const GridSize<Dimension> place = placeOf<Dimension>(grid, node);
  double volume = 1.0 / static_cast<double>(grid.NumberOfCells());
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const bool isBorder = place[axis] == 0 || place[axis] == grid.Cells[axis];
    volume *= isBorder && axis != without ? 0.5 : 1.0;
  }
  return volume;
}

// visit(node, neighbour, conductance) of each edge of the grid.
template <int Dimension, class Visit>
void forEdges(
  const NodeGrid<Dimension>& grid, const std::vector<double>& weights, const Visit& visit)
{
  for (std::int64_t node = 0; node < grid.NumberOfNodes(); ++node)
  {
    const GridSize<Dimension> place = placeOf<Dimension>(grid, node);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      if (place[axis] < grid.Cells[axis])
      {
        const std::int64_t next = node + grid.Stride(axis);
        const double weight =
          0.5 * (weights[static_cast<std::size_t>(node)] + weights[static_cast<std::size_t>(next)]);
        visit(node, next,
          weight * volumeOf<Dimension>(grid, node, axis) /
            (grid.Spacing[axis] * grid.Spacing[axis]));
      }
    }
  }
}

// -div(weights grad p) as masses.
template <int Dimension>
std::vector<double> applied(
  const NodeGrid<Dimension>& grid, const std::vector<double>& weights, const std::vector<double>& p)
{
  std::vector<double> masses(p.size(), 0.0);
  forEdges<Dimension>(grid, weights, [&](std::int64_t node, std::int64_t next, double conductance) {
    const auto a = static_cast<std::size_t>(node);
    const auto b = static_cast<std::size_t>(next);
    masses[a] += conductance * (p[a] - p[b]);
    masses[b] += conductance * (p[b] - p[a]);
  });
  return masses;
}

template <int Dimension>
double meanOf(const NodeGrid<Dimension>& grid, const std::vector<double>& p)
{
  double mean = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    mean += volumeOf<Dimension>(grid, static_cast<std::int64_t>(i)) * p[i];
  }
  return mean;
}

std::vector<double> randomMasses(std::size_t count, std::uint64_t seed)
{
  std::vector<double> masses(count);
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i)
  {
    masses[i] = unitReal(randomWord(seed, i));
    sum += masses[i];
  }
  for (double& mass : masses)
  {
    mass /= sum;
  }
  return masses;
}

// The difference of two densities.
std::vector<double> randomExcess(std::size_t count)
{
  std::vector<double> masses = randomMasses(count, 1);
  const std::vector<double> others = randomMasses(count, 2);
  for (std::size_t i = 0; i < count; ++i)
  {
    masses[i] -= others[i];
  }
  return masses;
}

// The units of work that a solution adds: there and back along each axis, or loops along a line.
template <int Dimension>
std::int64_t unitsOf(const NodeGrid<Dimension>& grid)
{
  return (Dimension == 1 ? 4 : 2 * Dimension) * grid.NumberOfNodes();
}

template <int Dimension>
std::vector<double> solved(const NodeGrid<Dimension>& grid, const std::vector<double>& masses,
  const Context& context = Context(serial))
{
  NodePoisson<Dimension> poisson(grid);
  Progress progress(context);
  progress.Expect(unitsOf(grid));
  std::vector<double> p(masses.size());
  poisson.Solve(masses.data(), p.data(), progress);
  return p;
}

template <int Dimension>
std::vector<double> solvedWeighted(const NodeGrid<Dimension>& grid,
  const std::vector<double>& masses, const std::vector<double>& density, double floor,
  int iterations, const Context& context = Context(serial))
{
  NodePoisson<Dimension> poisson(grid);
  Progress progress(context);
  progress.Expect(grid.NumberOfNodes() + iterations * (unitsOf(grid) + 4 * grid.NumberOfNodes()));
  std::vector<double> p(masses.size());
  poisson.SolveWeighted(masses.data(), density.data(), floor, iterations, p.data(), progress);
  return p;
}

double largestOf(const std::vector<double>& values)
{
  double largest = 0.0;
  for (const double value : values)
  {
    largest = std::max(largest, std::abs(value));
  }
  return largest;
}

// All radices of the transform, odd ones and primes, and lengths of two cells.
template <int Dimension>
std::vector<NodeGrid<Dimension>> gridsOf()
{
  const auto spacing = spacingFor<Dimension>({ 0.3 }, { 0.3, 0.1 }, { 0.3, 0.1, 0.2 });
  std::vector<NodeGrid<Dimension>> grids;
  for (const std::int64_t m : { 2, 4, 6, 8, 10, 14, 22, 26, 30, 300 })
  {
    grids.push_back({ sizeFor<Dimension>({ m }, { m, 18 }, { m, 6, 2 }), spacing });
    grids.push_back({ sizeFor<Dimension>({ 2 * m }, { 34, m }, { 4, m, 10 }), spacing });
    grids.push_back({ sizeFor<Dimension>({ 34 * m }, { 2, m }, { 2, 16, m }), spacing });
  }
  return grids;
}

TYPED_TEST(NodePoissonOf, SolutionSolvesTheDiscreteEquation)
{
  constexpr int D = TypeParam::value;
  for (const NodeGrid<D>& grid : gridsOf<D>())
  {
    const auto count = static_cast<std::size_t>(grid.NumberOfNodes());
    const std::vector<double> ones(count, 1.0);
    const std::vector<double> masses = randomExcess(count);
    const std::vector<double> p = solved<D>(grid, masses);
    const std::vector<double> found = applied<D>(grid, ones, p);
    EXPECT_NEAR(meanOf<D>(grid, p), 0.0, 1e-14 * largestOf(p));
    // Rounding of p, times the largest entries of the operator.
    double conductance = 0.0;
    forEdges<D>(grid, ones, [&](std::int64_t, std::int64_t, double value) {
      conductance = std::max(conductance, value);
    });
    const double rounding = 1e-14 * largestOf(p) * conductance * 2 * D + 1e-14 * largestOf(masses);
    for (std::size_t i = 0; i < count; ++i)
    {
      ASSERT_NEAR(found[i], masses[i], rounding) << grid.Cells[0] << " " << grid.Cells[D - 1];
    }
  }
}

// A sum other than 0 is taken as a constant density too much.
TYPED_TEST(NodePoissonOf, ConstantDensityDoesNotMatter)
{
  constexpr int D = TypeParam::value;
  const NodeGrid<D> grid = gridsOf<D>()[1];
  std::vector<double> masses = randomExcess(static_cast<std::size_t>(grid.NumberOfNodes()));
  const std::vector<double> expected = solved<D>(grid, masses);
  for (std::size_t i = 0; i < masses.size(); ++i)
  {
    masses[i] += volumeOf<D>(grid, static_cast<std::int64_t>(i));
  }
  const std::vector<double> p = solved<D>(grid, masses);
  for (std::size_t i = 0; i < masses.size(); ++i)
  {
    EXPECT_NEAR(p[i], expected[i], 1e-13 * largestOf(p));
  }
}

TYPED_TEST(NodePoissonOf, ProductsOfCosinesAreEigenfunctions)
{
  constexpr int D = TypeParam::value;
  for (const NodeGrid<D>& grid : gridsOf<D>())
  {
    for (const std::int64_t wave : { 1, 2 })
    {
      double eigenvalue = 0.0;
      for (int axis = 0; axis < D; ++axis)
      {
        const double sine = cosineAndSine(wave, 4 * grid.Cells[axis]).Sine;
        eigenvalue += 4.0 * sine * sine / (grid.Spacing[axis] * grid.Spacing[axis]);
      }
      std::vector<double> expected;
      std::vector<double> masses;
      for (std::int64_t node = 0; node < grid.NumberOfNodes(); ++node)
      {
        double value = 1.0;
        const GridSize<D> place = placeOf<D>(grid, node);
        for (int axis = 0; axis < D; ++axis)
        {
          value *= cosineAndSine(place[axis] * wave, 2 * grid.Cells[axis]).Cosine;
        }
        expected.push_back(value);
        masses.push_back(value * eigenvalue * volumeOf<D>(grid, node));
      }
      const std::vector<double> p = solved<D>(grid, masses);
      for (std::size_t i = 0; i < p.size(); ++i)
      {
        ASSERT_NEAR(p[i], expected[i], 1e-12) << grid.Cells[0] << " " << grid.Cells[D - 1];
      }
    }
  }
}

template <int Dimension>
struct WeightedCase
{
  NodeGrid<Dimension> Grid = { sizeFor<Dimension>({ 30 }, { 12, 10 }, { 6, 4, 8 }),
    spacingFor<Dimension>({ 0.3 }, { 0.3, 0.2 }, { 0.3, 0.2, 0.25 }) };
  std::vector<double> Masses;
  std::vector<double> Density;
  std::vector<double> Weights;
  double Floor = 0.8;

  WeightedCase()
  {
    const auto count = static_cast<std::size_t>(this->Grid.NumberOfNodes());
    this->Masses = randomExcess(count);
    this->Density = randomMasses(count, 3);
    for (std::size_t i = 0; i < count; ++i)
    {
      const double volume = volumeOf<Dimension>(this->Grid, static_cast<std::int64_t>(i));
      this->Weights.push_back(std::max(this->Floor, this->Density[i] / volume));
    }
  }
  std::vector<double> Solved(int iterations, const Context& context = Context(serial)) const
  {
    return solvedWeighted<Dimension>(
      this->Grid, this->Masses, this->Density, this->Floor, iterations, context);
  }
};

// With the mean in place of the equation of the first node.
template <int Dimension>
Eigen::VectorXd direct(const WeightedCase<Dimension>& problem)
{
  const auto count = static_cast<Eigen::Index>(problem.Masses.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
  forEdges<Dimension>(
    problem.Grid, problem.Weights, [&](std::int64_t a, std::int64_t b, double conductance) {
      matrix(a, a) += conductance;
      matrix(b, b) += conductance;
      matrix(a, b) -= conductance;
      matrix(b, a) -= conductance;
    });
  Eigen::VectorXd masses = Eigen::Map<const Eigen::VectorXd>(problem.Masses.data(), count);
  for (Eigen::Index i = 0; i < count; ++i)
  {
    matrix(0, i) = volumeOf<Dimension>(problem.Grid, i);
  }
  masses(0) = 0.0;
  return matrix.fullPivLu().solve(masses);
}

TYPED_TEST(NodePoissonOf, WeightedConvergesToTheDirectSolution)
{
  constexpr int D = TypeParam::value;
  const WeightedCase<D> problem;
  const Eigen::VectorXd expected = direct<D>(problem);
  double before = std::numeric_limits<double>::infinity();
  for (const int iterations : { 0, 4, 8, 60 })
  {
    const std::vector<double> p = problem.Solved(iterations);
    const Eigen::Map<const Eigen::VectorXd> found(p.data(), expected.size());
    const double error = (found - expected).norm() / expected.norm();
    EXPECT_LT(error, 0.7 * before) << iterations;
    EXPECT_NEAR(meanOf<D>(problem.Grid, p), 0.0, 1e-13 * expected.norm());
    before = error;
  }
  EXPECT_LT(before, 1e-12);
}

TYPED_TEST(NodePoissonOf, WeightOfOneIsThePlainSolution)
{
  constexpr int D = TypeParam::value;
  const WeightedCase<D> problem;
  const std::vector<double> nothing(problem.Masses.size(), 0.0);
  const std::vector<double> p = solvedWeighted<D>(problem.Grid, problem.Masses, nothing, 1.0, 1);
  const std::vector<double> expected = solved<D>(problem.Grid, problem.Masses);
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    EXPECT_NEAR(p[i], expected[i], 1e-13 * largestOf(expected));
  }
}

TYPED_TEST(NodePoissonOf, NothingToMoveIsZero)
{
  constexpr int D = TypeParam::value;
  const WeightedCase<D> problem;
  const std::vector<double> nothing(problem.Masses.size(), 0.0);
  EXPECT_EQ(solved<D>(problem.Grid, nothing), nothing);
  EXPECT_EQ(solvedWeighted<D>(problem.Grid, nothing, problem.Density, 1.0, 4), nothing);
}

TYPED_TEST(NodePoissonOf, SameBitsOnEveryNumberOfThreads)
{
  constexpr int D = TypeParam::value;
  const NodeGrid<D> grid = { sizeFor<D>({ 30000 }, { 150, 210 }, { 30, 42, 26 }),
    spacingFor<D>({ 0.3 }, { 0.3, 0.2 }, { 0.3, 0.2, 0.25 }) };
  const auto count = static_cast<std::size_t>(grid.NumberOfNodes());
  const std::vector<double> masses = randomExcess(count);
  const std::vector<double> density = randomMasses(count, 3);
  const std::vector<double> expected = solved<D>(grid, masses);
  const std::vector<double> weighted = solvedWeighted<D>(grid, masses, density, 1.0, 3);
  for (const int number : { 1, 2, 3 })
  {
    const ThreadsExecutor threads(number);
    EXPECT_EQ(solved<D>(grid, masses, threads), expected) << number;
    EXPECT_EQ(solvedWeighted<D>(grid, masses, density, 1.0, 3, threads), weighted) << number;
  }
}

TYPED_TEST(NodePoissonOf, ReusableSolutionsDoNotDependOnEachOther)
{
  constexpr int D = TypeParam::value;
  const WeightedCase<D> problem;
  NodePoisson<D> poisson(problem.Grid);
  Progress progress{ Context(serial) };
  std::vector<double> p(problem.Masses.size());
  for (int again = 0; again < 2; ++again)
  {
    poisson.Solve(problem.Masses.data(), p.data(), progress);
    EXPECT_EQ(p, solved<D>(problem.Grid, problem.Masses));
    poisson.SolveWeighted(
      problem.Masses.data(), problem.Density.data(), problem.Floor, 5, p.data(), progress);
    EXPECT_EQ(p, problem.Solved(5));
  }
}

TYPED_TEST(NodePoissonOf, FillsItsStageAndStops)
{
  constexpr int D = TypeParam::value;
  const WeightedCase<D> problem;
  std::vector<double> heard;
  const Context context(serial, [&](double done) { heard.push_back(done); });
  const auto expectWhole = [&](std::size_t least) {
    EXPECT_GE(heard.size(), least);
    EXPECT_EQ(heard.back(), 1.0);
    EXPECT_LT(heard[heard.size() - 2], 1.0);
    EXPECT_TRUE(std::is_sorted(heard.begin(), heard.end()));
    heard.clear();
  };
  problem.Solved(3, context);
  expectWhole(6);
  solved<D>(problem.Grid, problem.Masses, context);
  expectWhole(3);
  const Context cancelled(serial, {}, [] { return true; });
  EXPECT_THROW(problem.Solved(1, cancelled), Cancelled);
  EXPECT_THROW(solved<D>(problem.Grid, problem.Masses, cancelled), Cancelled);
}

TYPED_TEST(NodePoissonOf, MemoryGrowsWithTheNodes)
{
  constexpr int D = TypeParam::value;
  const WeightedCase<D> problem;
  const double nodes = static_cast<double>(problem.Grid.NumberOfNodes());
  const double plain = NodePoisson<D>::MemoryFor(problem.Grid, false);
  EXPECT_EQ(NodePoisson<D>::MemoryFor(problem.Grid, true) - plain, 5.0 * sizeof(double) * nodes);
  EXPECT_EQ(plain > 0.0, D > 1); // one dimension needs no transforms
}

} // namespace
} // namespace RectifiedTransport
