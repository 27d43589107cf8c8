// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Algebra/GraphLaplacian.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace RectifiedTransport
{

void GraphLaplacian::RemoveEdges()
{
  std::fill(this->Diagonal.begin(), this->Diagonal.end(), 0.0);
  this->Edges.clear();
}

bool GraphLaplacian::Factorize(double damping, Progress& progress)
{
  // The Laplacian has constants as its null space. Adding damping * (mean of the diagonal) to the
  // diagonal, as in a Levenberg step, makes the matrix positive definite; the mean makes the
  // damping relative, so that it does not depend on the unit of the strengths.
  const auto count = static_cast<Eigen::Index>(this->Diagonal.size());
  const double trace = std::accumulate(this->Diagonal.begin(), this->Diagonal.end(), 0.0);
  const double added = damping * trace / static_cast<double>(count);
  SparseCholesky::Matrix lower(count, count);
  {
    std::vector<Eigen::Triplet<InterruptibleReal>> entries = this->Edges;
    for (Eigen::Index i = 0; i < count; ++i)
    {
      entries.emplace_back(i, i, this->Diagonal[static_cast<std::size_t>(i)] + added);
    }
    progress.Check();
    lower.setFromTriplets(entries.begin(), entries.end());
  }
  progress.Check();
  this->Analyze(lower, progress);
  progress.Check();
  return this->System.Factorize(lower, progress);
}

void GraphLaplacian::Analyze(const SparseCholesky::Matrix& lower, Progress& progress)
{
  // A factor in the old order may have 10 % more non-zeros than in the order that was found for its
  // own pattern. Below that, the search for a new order would cost more than it saves.
  constexpr double mostGrowth = 1.1;
  if (this->Ordered > 0)
  {
    this->System.AnalyzeInOrder(lower);
    if (static_cast<double>(this->System.NonZeros()) <=
      mostGrowth * static_cast<double>(this->Ordered))
    {
      return;
    }
  }
  progress.Check();
  this->System.Analyze(lower, progress);
  this->Ordered = this->System.NonZeros();
}

bool GraphLaplacian::Solve(std::vector<double>& values) const
{
  SparseCholesky::Vector right(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), right.begin());
  const SparseCholesky::Vector solution = this->System.Solve(right);
  std::copy(solution.begin(), solution.end(), values.begin());
  // LDL^T takes pivots of either sign, so a matrix that is singular up to rounding shows only in
  // the solution.
  return std::all_of(
    values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

} // namespace RectifiedTransport
