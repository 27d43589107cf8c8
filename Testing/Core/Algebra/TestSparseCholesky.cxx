// SPDX-License-Identifier: BSD-3-Clause
// Sparse systems against dense ones, and factorizations that are cancelled on their way.
#include "Core/Algebra/SparseCholesky.h"
#include "Core/Parallel/Progress.h"
#include "RecordingContext.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <chrono>
#include <random>

namespace RectifiedTransport
{
namespace
{

const SerialExecutor serial;

using Matrix = SparseCholesky::Matrix;
using Vector = SparseCholesky::Vector;

// The lower triangle.
Matrix sparse(const Eigen::MatrixXd& dense)
{
  std::vector<Eigen::Triplet<InterruptibleReal>> entries;
  for (int column = 0; column < dense.cols(); ++column)
  {
    for (int row = column; row < dense.rows(); ++row)
    {
      if (dense(row, column) != 0.0)
      {
        entries.emplace_back(row, column, dense(row, column));
      }
    }
  }
  Matrix lower(static_cast<int>(dense.rows()), static_cast<int>(dense.cols()));
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

// A grid of nodes that each depend on their four neighbours.
Matrix gridMatrix(int side)
{
  std::vector<Eigen::Triplet<InterruptibleReal>> entries;
  for (int i = 0; i < side * side; ++i)
  {
    entries.emplace_back(i, i, 4.01);
    if (i % side + 1 < side)
    {
      entries.emplace_back(i + 1, i, -1.0);
    }
    if (i / side + 1 < side)
    {
      entries.emplace_back(i + side, i, -1.0);
    }
  }
  Matrix lower(side * side, side * side);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

TEST(SparseCholesky, AsDense)
{
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  Progress progress(serial);
  for (const int size : { 1, 2, 7, 40, 150 })
  {
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, size);
    for (int i = 0; i < 4 * size; ++i)
    {
      const auto row = static_cast<int>(random() % static_cast<unsigned>(size));
      const auto column = static_cast<int>(random() % static_cast<unsigned>(size));
      dense(row, column) = dense(column, row) = value(random);
    }
    for (int i = 0; i < size; ++i)
    {
      dense(i, i) = 8.0 * (i % 3 == 1 ? -1.0 : 1.0) + value(random); // not definite
    }
    SparseCholesky factor;
    factor.Analyze(sparse(dense));
    // Values may change, the pattern not.
    for (const double scale : { 1.0, 1e-150, 1e150 })
    {
      ASSERT_TRUE(factor.Factorize(sparse(scale * dense), progress));
      const Eigen::VectorXd right =
        Eigen::VectorXd::NullaryExpr(size, [&]() { return value(random); });
      const Vector found = factor.Solve(right.cast<InterruptibleReal>());
      const Eigen::VectorXd truth = dense.ldlt().solve(right) / scale;
      for (int i = 0; i < size; ++i)
      {
        ASSERT_NEAR(found[i].Value, truth[i], 1e-12 * truth.norm()) << size;
      }
    }
  }
}

TEST(SparseCholesky, WithoutSolution)
{
  Eigen::MatrixXd dense(2, 2);
  dense << 1.0, 2.0, 2.0, 4.0;
  SparseCholesky factor;
  factor.Analyze(sparse(dense));
  Progress progress(serial);
  EXPECT_FALSE(factor.Factorize(sparse(dense), progress));
  dense(1, 1) = 5.0;
  EXPECT_TRUE(factor.Factorize(sparse(dense), progress));
}

// Polls follow each other within a few milliseconds; one that is answered with a stop is the last,
// and none stays on the thread.
TEST(SparseCholesky, CancelledOnTheWay)
{
  using Clock = std::chrono::steady_clock;
  const Matrix matrix = gridMatrix(200);
  SparseCholesky factor;
  factor.Analyze(matrix);
  RecordingContext whole(serial);
  {
    Progress progress(whole.Context());
    ASSERT_TRUE(factor.Factorize(matrix, progress));
  }
  ASSERT_GT(whole.Queries, 50);
  for (const int maximum : { 0, 1, whole.Queries / 2, whole.Queries - 2 })
  {
    RecordingContext recorder(serial);
    recorder.MaximumQueries = maximum;
    Progress progress(recorder.Context());
    const Clock::time_point start = Clock::now();
    EXPECT_THROW(factor.Factorize(matrix, progress), Cancelled);
    EXPECT_EQ(recorder.Queries, maximum + 1);
    if (maximum <= 1)
    {
      EXPECT_LT(std::chrono::duration<double>(Clock::now() - start).count(), 0.2);
    }
    InterruptibleReal quotient = 1.0;
    for (int i = 0; i < 100000; ++i)
    {
      quotient /= 1.0 + 1e-6;
    }
    EXPECT_EQ(recorder.Queries, maximum + 1);
  }
  // It can be used again.
  Progress progress(serial);
  ASSERT_TRUE(factor.Factorize(matrix, progress));
  const Vector found = factor.Solve(Vector::Constant(matrix.rows(), 1.0));
  const Vector product = matrix.selfadjointView<Eigen::Lower>() * found;
  for (int i = 0; i < matrix.rows(); ++i)
  {
    ASSERT_NEAR(product[i].Value, 1.0, 1e-10);
  }
}

} // namespace
} // namespace RectifiedTransport
