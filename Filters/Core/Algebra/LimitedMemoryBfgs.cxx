// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Algebra/LimitedMemoryBfgs.h"

#include "Core/Parallel/Reduction.h"

#include <algorithm>

namespace RectifiedTransport
{

namespace
{

// Sums over chunks of this many entries are the same for any number of threads.
constexpr std::int64_t grain = std::int64_t{ 1 } << 12;

// to += factor * from
void addMultiple(
  double factor, const std::vector<double>& from, std::vector<double>& to, Progress& progress)
{
  progress.ForEach(static_cast<std::int64_t>(to.size()), grain,
    [factor, a = from.data(), b = to.data()](std::int64_t i) { b[i] += factor * a[i]; });
}

double innerProduct(const std::vector<double>& a, const std::vector<double>& b, Progress& progress)
{
  return sumTerms(progress, static_cast<std::int64_t>(a.size()), grain,
    [&](std::int64_t i) { return a.data()[i] * b.data()[i]; });
}

} // namespace

void LimitedMemoryBfgs::Add(
  const std::vector<double>& step, const std::vector<double>& change, Progress& progress)
{
  // A secant pair (s, y) keeps the approximate Hessian positive definite only if s . y > 0. An
  // Armijo search alone does not ensure that, so other pairs are left out.
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
  // Nocedal's two-loop recursion. The first loop, from the newest pair to the oldest, computes a_i
  // = s_i . q / (s_i . y_i) and q <- q - a_i y_i.
  direction = gradient;
  std::vector<double> parts(this->Pairs.size());
  for (std::size_t i = this->Pairs.size(); i-- > 0;)
  {
    const Pair& pair = this->Pairs[i];
    parts[i] = innerProduct(pair.Step, direction, progress) / pair.Curvature;
    addMultiple(-parts[i], pair.Change, direction, progress);
  }
  // The first inverse Hessian is scale * D with the diagonal D. The scale (s . y) / (y . D y) of
  // the newest pair satisfies the secant condition along y; with D = 1 it is the usual (s . y) / (y
  // . y).
  double scale = 1.0;
  if (!this->Pairs.empty())
  {
    const Pair& last = this->Pairs.back();
    const double* change = last.Change.data();
    const double square = sumTerms(progress, static_cast<std::int64_t>(diagonal.size()), grain,
      [&](std::int64_t i) { return change[i] * change[i] * diagonal.data()[i]; });
    scale = last.Curvature / square;
  }
  for (std::size_t i = 0; i < direction.size(); ++i)
  {
    direction[i] *= scale * diagonal[i];
  }
  // The second loop, from the oldest pair to the newest: r <- r + (a_i - y_i . r / (s_i . y_i))
  // s_i. Then r is H times the gradient, and -r is the direction of descent.
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
