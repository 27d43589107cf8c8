// SPDX-License-Identifier: BSD-3-Clause
// Systems that are summed up over triangles, against dense ones.
#include "Core/Parallel/Progress.h"
#include "Surfaces/Parameterization/LocalMap.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace RectifiedTransport
{
namespace
{

const SerialExecutor serial;

// Triangles between any of the unknowns, some of them fixed; every unknown is in one at least.
std::vector<TriangleUnknowns> randomTriangles(int unknowns, int count, std::mt19937_64& random)
{
  std::vector<int> numbers(static_cast<std::size_t>(unknowns));
  std::iota(numbers.begin(), numbers.end(), 0);
  std::vector<TriangleUnknowns> triangles;
  for (int t = 0; t < count || 3 * t < unknowns; ++t)
  {
    std::shuffle(numbers.begin(), numbers.end(), random);
    TriangleUnknowns triangle;
    for (int i = 0; i < 6; ++i)
    {
      const bool isFixed = i >= unknowns || random() % 4 == 0;
      triangle[static_cast<std::size_t>(i)] = isFixed ? -1 : numbers[static_cast<std::size_t>(i)];
    }
    // Those that would be in none otherwise.
    for (int i = 0; i < 3 && 3 * t + i < unknowns; ++i)
    {
      const int forced = 3 * t + i;
      const auto place = std::find(triangle.begin(), triangle.end(), forced);
      if (place == triangle.end())
      {
        triangle[static_cast<std::size_t>(i)] = forced;
      }
    }
    triangles.push_back(triangle);
  }
  return triangles;
}

TEST(LocalSystem, AsDense)
{
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  Progress progress(serial);
  for (const int unknowns : { 1, 2, 5, 30, 90 })
  {
    const std::vector<TriangleUnknowns> triangles = randomTriangles(unknowns, 40, random);
    LocalSystem system(triangles, unknowns);
    std::vector<double> solution;
    for (const double damping : { 0.0, 0.5, 3.0 }) // the pattern is used again
    {
      Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(unknowns, unknowns);
      Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns);
      system.Clear();
      for (std::size_t t = 0; t < triangles.size(); ++t)
      {
        const Eigen::Matrix<double, 6, 6> root =
          Eigen::Matrix<double, 6, 6>::NullaryExpr([&]() { return value(random); });
        const Eigen::Matrix<double, 6, 6> product =
          root * root.transpose() + 0.1 * Eigen::Matrix<double, 6, 6>::Identity();
        TriangleMatrix matrix;
        TriangleVector vector;
        for (std::size_t i = 0; i < 6; ++i)
        {
          vector[i] = value(random);
          for (std::size_t j = 0; j < 6; ++j)
          {
            const auto row = static_cast<int>(i);
            const auto column = static_cast<int>(j);
            matrix[i][j] = 0.5 * (product(row, column) + product(column, row));
            if (triangles[t][i] >= 0 && triangles[t][j] >= 0)
            {
              dense(triangles[t][i], triangles[t][j]) += matrix[i][j];
            }
          }
          if (triangles[t][i] >= 0)
          {
            right[triangles[t][i]] += vector[i];
          }
        }
        system.Add(t, matrix, vector);
      }
      system.Damp(damping);
      dense.diagonal() *= 1.0 + damping;
      ASSERT_TRUE(system.Solve(solution, progress));
      const Eigen::VectorXd truth = dense.ldlt().solve(right);
      ASSERT_EQ(solution.size(), static_cast<std::size_t>(unknowns));
      for (int i = 0; i < unknowns; ++i)
      {
        ASSERT_NEAR(solution[static_cast<std::size_t>(i)], truth[i], 1e-9 * truth.norm());
      }
    }
  }
}

// Without values there is no solution.
TEST(LocalSystem, WithoutSolution)
{
  LocalSystem system({ { 0, 1, -1, -1, 2, -1 } }, 3);
  system.Clear();
  std::vector<double> solution;
  Progress progress(serial);
  EXPECT_FALSE(system.Solve(solution, progress));
}

} // namespace
} // namespace RectifiedTransport
