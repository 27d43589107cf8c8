// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Algebra/LimitedMemoryBfgs.h"

#include "Core/Parallel/Reduction.h"

#include <algorithm>

namespace RectifiedTransport
{

namespace
{

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
    const double* change = last.Change.data();
    const double square = sumTerms(progress, static_cast<std::int64_t>(diagonal.size()), grain,
      [&](std::int64_t i) { return change[i] * change[i] * diagonal.data()[i]; });
    scale = last.Curvature / square;
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
