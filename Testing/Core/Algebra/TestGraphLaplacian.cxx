// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Algebra/GraphLaplacian.h"

#include "Core/Parallel/Progress.h"

#include "RecordingContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace RectifiedTransport
{
namespace
{

struct Edge
{
  std::int64_t First;
  std::int64_t Second;
  double Strength;
};

// A ring with a chord.
std::vector<Edge> ringOfSix()
{
  return { { 0, 1, 1.0 }, { 1, 2, 2.0 }, { 2, 3, 3.0 }, { 3, 4, 4.0 }, { 4, 5, 5.0 }, { 0, 5, 0.5 },
    { 1, 4, 7.0 } };
}

// A square grid, its nodes numbered along the rows or in any order.
std::vector<Edge> grid(std::int64_t side, bool isShuffled)
{
  std::vector<std::int64_t> number(static_cast<std::size_t>(side * side));
  std::iota(number.begin(), number.end(), 0);
  std::mt19937 engine(1);
  for (std::size_t i = number.size(); isShuffled && i > 1; --i)
  {
    std::swap(number[i - 1], number[engine() % i]);
  }
  std::vector<Edge> edges;
  const auto add = [&](std::int64_t a, std::int64_t b) {
    const std::int64_t first = number[static_cast<std::size_t>(a)];
    const std::int64_t second = number[static_cast<std::size_t>(b)];
    edges.push_back({ std::min(first, second), std::max(first, second),
      1.0 + static_cast<double>((first + second) % 5) });
  };
  for (std::int64_t i = 0; i < side * side; ++i)
  {
    if (i % side > 0)
    {
      add(i - 1, i);
    }
    if (i >= side)
    {
      add(i - side, i);
    }
  }
  return edges;
}

void setEdges(GraphLaplacian& system, const std::vector<Edge>& edges)
{
  system.RemoveEdges();
  for (const Edge& edge : edges)
  {
    system.AddEdge(edge.First, edge.Second, edge.Strength);
  }
}

// The right side that has x as its solution.
std::vector<double> product(
  const std::vector<Edge>& edges, const std::vector<double>& x, double damping)
{
  std::vector<double> right(x.size(), 0.0);
  double trace = 0.0;
  for (const Edge& edge : edges)
  {
    const auto a = static_cast<std::size_t>(edge.First);
    const auto b = static_cast<std::size_t>(edge.Second);
    right[a] += edge.Strength * (x[a] - x[b]);
    right[b] += edge.Strength * (x[b] - x[a]);
    trace += 2.0 * edge.Strength;
  }
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    right[i] += damping * trace / static_cast<double>(x.size()) * x[i];
  }
  return right;
}

void expectSolution(GraphLaplacian& system, const std::vector<Edge>& edges, std::size_t nodes)
{
  std::vector<double> expected(nodes);
  for (std::size_t i = 0; i < nodes; ++i)
  {
    expected[i] = 2.0 - static_cast<double>(i * i % 7);
  }
  for (const double damping : { 1e-6, 0.3, 10.0 })
  {
    setEdges(system, edges);
    Progress progress{ Context() };
    ASSERT_TRUE(system.Factorize(damping, progress));
    for (const double factor : { 1.0, -0.5 })
    {
      std::vector<double> x = product(edges, expected, damping);
      std::transform(x.begin(), x.end(), x.begin(), [=](double b) { return factor * b; });
      ASSERT_TRUE(system.Solve(x));
      for (std::size_t i = 0; i < nodes; ++i)
      {
        EXPECT_NEAR(x[i], factor * expected[i], 1e-8) << damping;
      }
    }
  }
}

TEST(GraphLaplacian, IsSolvedWithItsDamping)
{
  GraphLaplacian system(6);
  expectSolution(system, ringOfSix(), 6);
}

// Those of the same nodes, with which the last order fits well or badly.
TEST(GraphLaplacian, GraphAfterGraph)
{
  GraphLaplacian system(400);
  const std::vector<Edge> edges = grid(20, false);
  std::vector<Edge> fewer = edges;
  fewer.erase(fewer.begin() + 100, fewer.begin() + 110);
  expectSolution(system, edges, 400);
  expectSolution(system, fewer, 400);
  expectSolution(system, grid(20, true), 400);
  expectSolution(system, edges, 400);
}

TEST(GraphLaplacian, WithoutEdgesIsSingular)
{
  Progress progress{ Context() };
  EXPECT_FALSE(GraphLaplacian(2).Factorize(0.0, progress));
}

TEST(GraphLaplacian, IsCancelled)
{
  const SerialExecutor serial;
  RecordingContext stopped(serial);
  stopped.MaximumQueries = 0;
  Progress progress(stopped.Context());
  GraphLaplacian system(6);
  setEdges(system, ringOfSix());
  EXPECT_THROW(system.Factorize(1.0, progress), Cancelled);
}

// Between any two of: the entries, the matrix, the pattern in the last order, another order, the
// pattern in that, the factors.
TEST(GraphLaplacian, PollsBetweenItsSteps)
{
  const SerialExecutor serial;
  RecordingContext recorded(serial);
  Progress progress(recorded.Context());
  GraphLaplacian system(400);
  setEdges(system, grid(20, false));
  EXPECT_TRUE(system.Factorize(1.0, progress));
  EXPECT_GE(recorded.Queries, 4);
  recorded.Queries = 0;
  setEdges(system, grid(20, true)); // for which the order is a bad one
  EXPECT_TRUE(system.Factorize(1.0, progress));
  EXPECT_GE(recorded.Queries, 5);
}

} // namespace
} // namespace RectifiedTransport
