// SPDX-License-Identifier: BSD-3-Clause
// Poisson's equation on cells: the solution's residual is the one that is reported.
#include "Core/Grid/FaceSystem.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <vector>

namespace RectifiedTransport
{
namespace
{

constexpr double tolerance = 0.05;

struct Solved
{
  FaceSolution Reported;
  double Residual; // recomputed
};

// `weight` is that of a face across an axis, `right` the right-hand side of a cell before its mean
// is subtracted.
Solved solve(const GridSize<2>& size, const std::function<double(int)>& weight,
  const std::function<double(std::int64_t, std::int64_t)>& right)
{
  FaceSystem<2> system(size);
  const std::int64_t cells = size[0] * size[1];
  std::vector<double> b(static_cast<std::size_t>(cells));
  double mean = 0.0;
  for (std::int64_t q = 0; q < cells; ++q)
  {
    b[static_cast<std::size_t>(q)] = right(q % size[0], q / size[0]);
    mean += b[static_cast<std::size_t>(q)] / static_cast<double>(cells);
  }
  std::vector<double> weights[2];
  for (int axis = 0; axis < 2; ++axis)
  {
    for (std::int64_t q = 0; q < cells; ++q)
    {
      const bool isLast = (axis == 0 ? q % size[0] : q / size[0]) + 1 == size[axis];
      const double w = isLast ? 0.0 : weight(axis);
      system.Weights(axis)[q] = static_cast<float>(w);
      weights[axis].push_back(static_cast<double>(system.Weights(axis)[q]));
    }
  }
  for (std::int64_t q = 0; q < cells; ++q)
  {
    double& value = b[static_cast<std::size_t>(q)];
    system.RightHandSide()[q] = static_cast<float>(value - mean);
    value = static_cast<double>(system.RightHandSide()[q]);
  }
  const SerialExecutor serial;
  Progress progress(serial);
  system.Prepare(progress);
  Solved solved{ system.Solve(tolerance, 50, progress), 0.0 };
  const double* x = system.Solution();
  std::vector<double> rest(b);
  for (int axis = 0; axis < 2; ++axis)
  {
    const std::int64_t stride = axis == 0 ? 1 : size[0];
    for (std::int64_t q = 0; q + stride < cells; ++q)
    {
      const double flux = weights[axis][static_cast<std::size_t>(q)] * (x[q + stride] - x[q]);
      rest[static_cast<std::size_t>(q)] += flux;
      rest[static_cast<std::size_t>(q + stride)] -= flux;
    }
  }
  double sums[2] = { 0.0, 0.0 };
  for (std::size_t q = 0; q < b.size(); ++q)
  {
    sums[0] += rest[q] * rest[q];
    sums[1] += b[q] * b[q];
  }
  solved.Residual = sums[1] > 0.0 ? std::sqrt(sums[0] / sums[1]) : 0.0;
  return solved;
}

double one(int)
{
  return 1.0;
}

std::function<double(std::int64_t, std::int64_t)> noise()
{
  auto random = std::make_shared<std::mt19937>(7);
  return [random](std::int64_t, std::int64_t) {
    return std::uniform_real_distribution<double>(-0.5, 0.5)(*random);
  };
}

TEST(FaceSystem, TakesFewIterations)
{
  for (const GridSize<2>& size :
    std::vector<GridSize<2>>{ { 128, 128 }, { 255, 3 }, { 257, 193 }, { 1, 300 } })
  {
    for (const auto& right : { noise(),
           std::function<double(std::int64_t, std::int64_t)>(
             [](std::int64_t i, std::int64_t j) { return i + j < 90 ? 1.0 : 0.0; }) })
    {
      const Solved solved = solve(size, one, right);
      EXPECT_LE(solved.Reported.Iterations, 6) << size[0] << " x " << size[1];
      EXPECT_LE(solved.Residual, tolerance);
      EXPECT_NEAR(solved.Reported.Residual, solved.Residual, 1e-4);
    }
  }
}

// Values of the solution reach 1e7 along the longer side, where floats are apart by one.
TEST(FaceSystem, LongGrid)
{
  const Solved solved =
    solve({ 2, 8192 }, one, [](std::int64_t, std::int64_t j) { return j < 3000 ? 1.0 : 0.0; });
  EXPECT_LE(solved.Residual, tolerance);
  EXPECT_NEAR(solved.Reported.Residual, solved.Residual, 1e-3);
  EXPECT_LE(solved.Reported.Iterations, 6);
}

// Point relaxation does not like them, but few iterations do.
TEST(FaceSystem, UnlikeAxes)
{
  const Solved solved = solve(
    { 128, 128 }, [](int axis) { return axis == 0 ? 0.5 : 4.0; }, noise());
  EXPECT_LE(solved.Reported.Iterations, 9);
  EXPECT_LE(solved.Residual, tolerance);
}

// What is not solved is not said to be.
TEST(FaceSystem, SaysWhatIsLeft)
{
  const Solved solved = solve(
    { 128, 128 }, [](int axis) { return axis == 0 ? 1e-5 : 8.0; }, noise());
  EXPECT_GT(solved.Residual, 0.5);
  EXPECT_NEAR(solved.Reported.Residual / solved.Residual, 1.0, 1e-3);
}

TEST(FaceSystem, NothingToSolve)
{
  const Solved solved = solve({ 20, 30 }, one, [](std::int64_t, std::int64_t) { return 0.0; });
  EXPECT_EQ(solved.Reported.Iterations, 0);
  EXPECT_EQ(solved.Reported.Residual, 0.0);
}

} // namespace
} // namespace RectifiedTransport
