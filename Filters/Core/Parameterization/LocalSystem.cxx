// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Parameterization/LocalSystem.h"

#include <algorithm>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// Calls visit(row, column, k, i, j) for the k-th pair of corners' coordinates i >= j of a triangle
// whose values are both unknown, row >= column.
template <class Visit>
void visitPairs(const TriangleUnknowns& unknowns, const Visit& visit)
{
  std::size_t k = 0;
  for (std::size_t i = 0; i < unknowns.size(); ++i)
  {
    for (std::size_t j = 0; j <= i; ++j, ++k)
    {
      if (unknowns[i] >= 0 && unknowns[j] >= 0)
      {
        visit(std::max(unknowns[i], unknowns[j]), std::min(unknowns[i], unknowns[j]), k, i, j);
      }
    }
  }
}

} // namespace

LocalSystem::LocalSystem(std::vector<TriangleUnknowns> triangles, int unknowns)
  : Triangles(std::move(triangles))
  , Places(this->Triangles.size())
  , Matrix(unknowns, unknowns)
  , Right(unknowns)
{
  // The rows of each column: a counting sort, then without repetitions.
  std::vector<int> first(static_cast<std::size_t>(unknowns) + 1, 0);
  const auto visitAll = [this](const auto& visit) {
    for (const TriangleUnknowns& triangle : this->Triangles)
    {
      visitPairs(triangle,
        [&](int row, int column, auto...) { visit(row, static_cast<std::size_t>(column)); });
    }
  };
  visitAll([&](int, std::size_t column) { ++first[column + 1]; });
  for (std::size_t column = 1; column < first.size(); ++column)
  {
    first[column] += first[column - 1];
  }
  std::vector<int> rows(static_cast<std::size_t>(first.back()));
  std::vector<int> next(first.begin(), first.end() - 1);
  visitAll(
    [&](int row, std::size_t column) { rows[static_cast<std::size_t>(next[column]++)] = row; });
  int count = 0;
  int* outer = this->Matrix.outerIndexPtr();
  outer[0] = 0;
  for (std::size_t column = 0; column + 1 < first.size(); ++column)
  {
    const auto begin = rows.begin() + first[column];
    const auto end = rows.begin() + first[column + 1];
    std::sort(begin, end);
    for (auto row = begin; row < end; ++row)
    {
      if (row == begin || *row != row[-1])
      {
        rows[static_cast<std::size_t>(count++)] = *row; // not past the place that is read
      }
    }
    outer[column + 1] = count;
  }
  this->Matrix.resizeNonZeros(count);
  std::copy_n(rows.begin(), count, this->Matrix.innerIndexPtr());
  std::fill_n(this->Matrix.valuePtr(), count, InterruptibleReal(0.0));

  const int* inner = this->Matrix.innerIndexPtr();
  for (std::size_t triangle = 0; triangle < this->Triangles.size(); ++triangle)
  {
    visitPairs(this->Triangles[triangle], [&](int row, int column, std::size_t k, auto...) {
      this->Places[triangle][k] = static_cast<int>(
        std::lower_bound(inner + outer[column], inner + outer[column + 1], row) - inner);
    });
  }
  this->Factor.Analyze(this->Matrix);
}

void LocalSystem::Clear()
{
  std::fill_n(this->Matrix.valuePtr(), this->Matrix.nonZeros(), InterruptibleReal(0.0));
  this->Right.setZero();
}

void LocalSystem::Add(
  std::size_t triangle, const TriangleMatrix& matrix, const TriangleVector& right)
{
  const TriangleUnknowns& unknowns = this->Triangles[triangle];
  visitPairs(unknowns, [&](int, int, std::size_t k, std::size_t i, std::size_t j) {
    this->Matrix.valuePtr()[this->Places[triangle][k]] += matrix[i][j];
  });
  for (std::size_t i = 0; i < unknowns.size(); ++i)
  {
    if (unknowns[i] >= 0)
    {
      this->Right[unknowns[i]] += right[i];
    }
  }
}

void LocalSystem::Damp(double part)
{
  for (int column = 0; column < this->Matrix.cols(); ++column)
  {
    // The first value of a column of the lower triangle is that of the diagonal.
    InterruptibleReal& value = this->Matrix.valuePtr()[this->Matrix.outerIndexPtr()[column]];
    value *= 1.0 + part;
  }
}

bool LocalSystem::Solve(std::vector<double>& solution, Progress& progress)
{
  if (!this->Factor.Factorize(this->Matrix, progress))
  {
    return false;
  }
  const SparseCholesky::Vector found = this->Factor.Solve(this->Right);
  solution.resize(static_cast<std::size_t>(found.size()));
  std::transform(found.begin(), found.end(), solution.begin(),
    [](const InterruptibleReal& value) { return value.Value; });
  return true;
}

} // namespace RectifiedTransport
