// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Algebra/GraphLaplacian.h"

#include "Core/Parallel/Progress.h"

#include "RecordingContext.h"

#include <gtest/gtest.h>

#include <numeric>

namespace RectifiedTransport
{
namespace
{

// A ring with a chord.
GraphLaplacian makeSystem()
{
  GraphLaplacian system(6);
  for (int i = 0; i < 5; ++i)
  {
    system.AddEdge(i, i + 1, 1.0 + i);
  }
  system.AddEdge(0, 5, 0.5);
  system.AddEdge(1, 4, 7.0);
  return system;
}

// The right side that has x as its solution.
std::vector<double> product(const std::vector<double>& x, double added)
{
  std::vector<double> right(6);
  const auto add = [&](std::size_t a, std::size_t b, double strength) {
    right[a] += strength * (x[a] - x[b]);
    right[b] += strength * (x[b] - x[a]);
  };
  for (std::size_t i = 0; i < 5; ++i)
  {
    add(i, i + 1, 1.0 + static_cast<double>(i));
  }
  add(0, 5, 0.5);
  add(1, 4, 7.0);
  for (std::size_t i = 0; i < 6; ++i)
  {
    right[i] += added * x[i];
  }
  return right;
}

TEST(GraphLaplacian, IsSolvedWithItsDamping)
{
  const std::vector<double> expected = { 1.0, -2.0, 0.5, 3.0, -1.0, 4.0 };
  constexpr double trace = 2.0 * (1.0 + 2.0 + 3.0 + 4.0 + 5.0 + 0.5 + 7.0);
  for (const double damping : { 1e-6, 0.3, 10.0 })
  {
    std::vector<double> x = product(expected, damping * trace / 6.0);
    Progress progress{ Context() };
    ASSERT_TRUE(makeSystem().Solve(damping, x, progress));
    for (std::size_t i = 0; i < 6; ++i)
    {
      EXPECT_NEAR(x[i], expected[i], 1e-8) << damping;
    }
  }
}

TEST(GraphLaplacian, WithoutEdgesIsSingular)
{
  std::vector<double> x = { 1.0, 2.0 };
  Progress progress{ Context() };
  EXPECT_FALSE(GraphLaplacian(2).Solve(0.0, x, progress));
}

TEST(GraphLaplacian, IsCancelled)
{
  const SerialExecutor serial;
  RecordingContext stopped(serial);
  stopped.MaximumQueries = 0;
  Progress progress(stopped.Context());
  std::vector<double> x(6, 0.0);
  EXPECT_THROW(makeSystem().Solve(1.0, x, progress), Cancelled);
}

} // namespace
} // namespace RectifiedTransport
