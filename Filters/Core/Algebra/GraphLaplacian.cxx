// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Algebra/GraphLaplacian.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace RectifiedTransport
{

bool GraphLaplacian::Solve(double damping, std::vector<double>& values, Progress& progress) const
{
  const auto count = static_cast<Eigen::Index>(this->Diagonal.size());
  const double trace = std::accumulate(this->Diagonal.begin(), this->Diagonal.end(), 0.0);
  const double added = damping * trace / static_cast<double>(count);
  std::vector<Eigen::Triplet<InterruptibleReal>> entries = this->Edges;
  for (Eigen::Index i = 0; i < count; ++i)
  {
    entries.emplace_back(i, i, this->Diagonal[static_cast<std::size_t>(i)] + added);
  }
  progress.Check();
  SparseCholesky::Matrix lower(count, count);
  lower.setFromTriplets(entries.begin(), entries.end());
  progress.Check();
  SparseCholesky system;
  system.Analyze(lower);
  progress.Check();
  if (!system.Factorize(lower, progress))
  {
    return false;
  }
  SparseCholesky::Vector right(count);
  std::copy(values.begin(), values.end(), right.begin());
  const SparseCholesky::Vector solution = system.Solve(right);
  std::transform(solution.begin(), solution.end(), values.begin(),
    [](const InterruptibleReal& value) { return value.Value; });
  return std::all_of(
    values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

} // namespace RectifiedTransport
