// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Algebra/LimitedMemoryBfgs.h"

#include "Core/Parallel/Reduction.h"

#include <algorithm>
#include <functional>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 12;

// to += factor * from
void addMultiple(
  double factor, const std::vector<double>& from, std::vector<double>& to, Progress& progress)
{
  progress.For(
    static_cast<std::int64_t>(to.size()), grain, [&](std::int64_t first, std::int64_t last) {
      for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
      {
        to[i] += factor * from[i];
      }
    });
}

// The sum of term(i) of [0, count), bitwise the same for any number of threads.
template <class Term>
double sumOf(std::size_t count, const Term& term, Progress& progress)
{
  return reduceChunks(
    progress, static_cast<std::int64_t>(count), grain, 0.0,
    [&](std::int64_t first, std::int64_t last) {
      double sum = 0.0;
      for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
      {
        sum += term(i);
      }
      return sum;
    },
    std::plus<>());
}

double innerProduct(const std::vector<double>& a, const std::vector<double>& b, Progress& progress)
{
  return sumOf(
    a.size(), [&](std::size_t i) { return a[i] * b[i]; }, progress);
}

} // namespace

void LimitedMemoryBfgs::Add(
  const std::vector<double>& step, const std::vector<double>& change, Progress& progress)
{
  const double curvature = innerProduct(step, change, progress);
  if (!(curvature > 0.0))
  {
    return;
  }
  if (this->Pairs.size() == this->Most)
  {
    // The oldest pair gives its memory to the new one.
    std::rotate(this->Pairs.begin(), this->Pairs.begin() + 1, this->Pairs.end());
  }
  else
  {
    this->Pairs.emplace_back();
  }
  Pair& pair = this->Pairs.back();
  pair.Step = step;
  pair.Change = change;
  pair.Curvature = curvature;
}

void LimitedMemoryBfgs::FindDirection(const std::vector<double>& gradient,
  const std::vector<double>& diagonal, std::vector<double>& direction, Progress& progress) const
{
  direction = gradient;
  std::vector<double> parts(this->Pairs.size());
  for (std::size_t i = this->Pairs.size(); i-- > 0;)
  {
    const Pair& pair = this->Pairs[i];
    parts[i] = innerProduct(pair.Step, direction, progress) / pair.Curvature;
    addMultiple(-parts[i], pair.Change, direction, progress);
  }
  double scale = 1.0;
  if (!this->Pairs.empty())
  {
    const Pair& last = this->Pairs.back();
    const std::vector<double>& change = last.Change;
    scale = last.Curvature /
      sumOf(
        change.size(), [&](std::size_t i) { return change[i] * change[i] * diagonal[i]; },
        progress);
  }
  for (std::size_t i = 0; i < direction.size(); ++i)
  {
    direction[i] *= scale * diagonal[i];
  }
  for (std::size_t i = 0; i < this->Pairs.size(); ++i)
  {
    const Pair& pair = this->Pairs[i];
    const double part = innerProduct(pair.Change, direction, progress) / pair.Curvature;
    addMultiple(parts[i] - part, pair.Step, direction, progress);
  }
  for (double& value : direction)
  {
    value = -value;
  }
}

} // namespace RectifiedTransport
