// SPDX-License-Identifier: BSD-3-Clause
// Eigen's sparse Cholesky factorization, with cancellation.
#ifndef RectifiedTransport_SparseCholesky_h
#define RectifiedTransport_SparseCholesky_h

#include "Core/Algebra/InterruptibleReal.h"

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <memory>

namespace RectifiedTransport
{

class Progress;

// Solves A x = b for symmetric matrices, given by their lower triangles.
class SparseCholesky
{
public:
  using Matrix = Eigen::SparseMatrix<InterruptibleReal>;
  using Vector = Eigen::Matrix<InterruptibleReal, Eigen::Dynamic, 1>;

  // Finds the order of elimination and the pattern of the factor for the pattern of later matrices.
  void Analyze(const Matrix& lower);
  // The same, with a poll between the two steps. Throws Cancelled.
  void Analyze(const Matrix& lower, Progress& progress);
  // Finds the pattern of the factor for another pattern, in the order that was found last.
  void AnalyzeInOrder(const Matrix& lower);
  // The number of non-zeros of the factor, known after the analysis.
  Eigen::Index NonZeros() const { return this->Factor->NonZeros(); }
  // Returns false for a matrix that has a pivot of zero. On any thread; reports a part of the
  // progress's stage. Throws Cancelled and std::bad_alloc.
  bool Factorize(const Matrix& lower, Progress& progress, const StagePart& part = { 0.0, 0.0 });
  Vector Solve(const Vector& right) const;

private:
  // L D L^T needs no square roots and exposes the protected permutation m_P to AnalyzeInOrder().
  struct Factorization : Eigen::SimplicialLDLT<Matrix, Eigen::Lower>
  {
    void Analyze(const Matrix& lower, Progress& progress);
    void AnalyzeInOrder(const Matrix& lower);
    Eigen::Index NonZeros() const { return this->m_matrix.nonZeros(); }
  };

  // It is held by a pointer, because Eigen's factorizations do not move.
  std::unique_ptr<Factorization> Factor = std::make_unique<Factorization>();
};

} // namespace RectifiedTransport

#endif
