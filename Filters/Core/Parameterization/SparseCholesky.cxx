// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Parameterization/SparseCholesky.h"

#include "Core/Parallel/Progress.h"

namespace RectifiedTransport
{

thread_local int DivisionPoll::Divisions = 0;
thread_local Progress* DivisionPoll::Current = nullptr;

DivisionPoll::DivisionPoll(Progress& progress)
{
  Current = &progress;
}

DivisionPoll::~DivisionPoll()
{
  Current = nullptr;
}

void DivisionPoll::Poll()
{
  Divisions = 0;
  if (Current && Current->ShouldStop())
  {
    throw Cancelled();
  }
}

void SparseCholesky::Analyze(const Matrix& lower)
{
  this->Factor.analyzePattern(lower);
}

bool SparseCholesky::Factorize(const Matrix& lower, Progress& progress)
{
  const DivisionPoll poll(progress);
  this->Factor.factorize(lower);
  return this->Factor.info() == Eigen::Success;
}

SparseCholesky::Vector SparseCholesky::Solve(const Vector& right) const
{
  return this->Factor.solve(right);
}

} // namespace RectifiedTransport
