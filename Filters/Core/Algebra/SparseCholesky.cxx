// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Algebra/SparseCholesky.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>

namespace RectifiedTransport
{

thread_local int DivisionPoll::Divisions = 0;
thread_local DivisionPoll* DivisionPoll::Current = nullptr;

DivisionPoll::DivisionPoll(Progress& progress, const StagePart& part, double divisions)
  : Polled(progress)
  , Part(part)
  , All(std::max(divisions, 1.0))
{
  Current = this;
}

DivisionPoll::~DivisionPoll()
{
  Current = nullptr;
}

void DivisionPoll::Poll()
{
  Divisions = 0;
  if (!Current)
  {
    return;
  }
  // The number of divisions that were expected is an estimate, so the reported part is limited to
  // 1.
  Current->Done += interval;
  Current->Polled.ReportFrom(Current->Part.Begin +
    (Current->Part.End - Current->Part.Begin) * std::min(Current->Done / Current->All, 1.0));
  if (Current->Polled.ShouldStop())
  {
    // Eigen's loops have no other way out than an exception.
    throw Cancelled();
  }
}

void SparseCholesky::Analyze(const Matrix& lower)
{
  this->Factor->analyzePattern(lower);
}

void SparseCholesky::Analyze(const Matrix& lower, Progress& progress)
{
  this->Factor->Analyze(lower, progress);
}

void SparseCholesky::AnalyzeInOrder(const Matrix& lower)
{
  this->Factor->AnalyzeInOrder(lower);
}

// Eigen's analyzePattern(), with a poll after its search of an order.
void SparseCholesky::Factorization::Analyze(const Matrix& lower, Progress& progress)
{
  // The order of elimination decides how many non-zeros the factor has; `pattern` becomes the
  // matrix in that order, only its upper triangle.
  Matrix upper(lower.rows(), lower.cols());
  CholMatrixType const* pattern = nullptr;
#if EIGEN_MAJOR_VERSION >= 5
  this->ordering<false>(lower, pattern, upper);
#else
  this->ordering(lower, pattern, upper);
#endif
  progress.Check();
  this->analyzePattern_preordered(*pattern, true);
}

// Skips the search for an order: it permutes the matrix by the last permutation P, to P A P^T, and
// finds only the pattern of its factor.
void SparseCholesky::Factorization::AnalyzeInOrder(const Matrix& lower)
{
  Matrix upper(lower.rows(), lower.cols());
  upper.selfadjointView<Eigen::Upper>() =
    lower.selfadjointView<Eigen::Lower>().twistedBy(this->m_P);
  this->analyzePattern_preordered(upper, true);
}

bool SparseCholesky::Factorize(const Matrix& lower, Progress& progress, const StagePart& part)
{
  // LDL^T divides once for each non-zero of the factor, which gives the progress its measure.
  const DivisionPoll poll(progress, part, static_cast<double>(this->NonZeros()));
  this->Factor->factorize(lower);
  return this->Factor->info() == Eigen::Success;
}

SparseCholesky::Vector SparseCholesky::Solve(const Vector& right) const
{
  // With P A P^T = L D L^T this solves L, D and L^T in turn, between P and P^T.
  return this->Factor->solve(right);
}

} // namespace RectifiedTransport
