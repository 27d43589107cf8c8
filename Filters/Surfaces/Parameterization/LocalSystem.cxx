// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Parameterization/LocalSystem.h"

#include "Core/Geometry/Trees/Bins.h"

#include <algorithm>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// Calls visit(row, column, k, i, j) for the k-th pair i >= j of a triangle's six coordinates if
// both are unknown. Only the lower triangle of the matrix is stored: row >= column.
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
  // The pattern in compressed columns: the rows of each column, ascending, each once.
  Bins<int> rows;
  rows.Fill(static_cast<std::size_t>(unknowns), [this](const auto& add) {
    for (const TriangleUnknowns& triangle : this->Triangles)
    {
      visitPairs(triangle,
        [&](int row, int column, auto...) { add(static_cast<std::size_t>(column), row); });
    }
  });
  std::vector<int> once;
  int* outer = this->Matrix.outerIndexPtr();
  outer[0] = 0;
  for (int column = 0; column < unknowns; ++column)
  {
    const auto all = rows[static_cast<std::size_t>(column)];
    const auto begin = once.insert(once.end(), all.begin(), all.end());
    std::sort(begin, once.end());
    once.erase(std::unique(begin, once.end()), once.end());
    outer[column + 1] = static_cast<int>(once.size());
  }
  const int count = outer[unknowns];
  this->Matrix.resizeNonZeros(count);
  std::copy_n(once.begin(), count, this->Matrix.innerIndexPtr());
  std::fill_n(this->Matrix.valuePtr(), count, InterruptibleReal(0.0));

  // A table of where each triangle's 21 products go makes the assembly of every step a mere
  // addition, without searches.
  const int* inner = this->Matrix.innerIndexPtr();
  for (std::size_t triangle = 0; triangle < this->Triangles.size(); ++triangle)
  {
    visitPairs(this->Triangles[triangle], [&](int row, int column, std::size_t k, auto...) {
      this->Places[triangle][k] = static_cast<int>(
        std::lower_bound(inner + outer[column], inner + outer[column + 1], row) - inner);
    });
  }
  // The fill-reducing order and the elimination tree depend on the pattern alone, which all steps
  // share.
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
