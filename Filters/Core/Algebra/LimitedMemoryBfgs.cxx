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
  progress.For(
    static_cast<std::int64_t>(to.size()), grain, [&](std::int64_t first, std::int64_t last) {
      for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
      {
        to[i] += factor * from[i];
      }
    });
}

// The sum of a^2 * d.
double weightedSquare(
  const std::vector<double>& a, const std::vector<double>& d, Progress& progress)
{
  return reduceChunks(
    progress, static_cast<std::int64_t>(a.size()), grain, 0.0,
    [&](std::int64_t first, std::int64_t last) {
      double sum = 0.0;
      for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
      {
        sum += a[i] * a[i] * d[i];
      }
      return sum;
    },
    [](double x, double y) { return x + y; });
}

} // namespace

double innerProduct(const std::vector<double>& a, const std::vector<double>& b, Progress& progress)
{
  return reduceChunks(
    progress, static_cast<std::int64_t>(a.size()), grain, 0.0,
    [&](std::int64_t first, std::int64_t last) {
      double sum = 0.0;
      for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
      {
        sum += a[i] * b[i];
      }
      return sum;
    },
    [](double x, double y) { return x + y; });
}

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
    scale = last.Curvature / weightedSquare(last.Change, diagonal, progress);
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
