// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Series/StepTimes.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace RectifiedTransport
{

StepTimes::StepTimes(const double* times, std::size_t count)
{
  std::copy_if(times, times + count, std::back_inserter(this->Times),
    [](double time) { return std::isfinite(time); });
  std::sort(this->Times.begin(), this->Times.end());
  this->Times.erase(std::unique(this->Times.begin(), this->Times.end()), this->Times.end());
}

TimeInterval StepTimes::Find(double time) const
{
  TimeInterval place;
  if (this->Count() < 2)
  {
    return place;
  }
  const auto after = std::upper_bound(this->Times.begin(), this->Times.end(), time);
  place.First = std::clamp(static_cast<int>(after - this->Times.begin()) - 1, 0, this->Count() - 2);
  place.Second = place.First + 1;
  const double begin = (*this)[place.First];
  const double end = (*this)[place.Second];
  // The difference of the largest doubles overflows; the difference of their halves does not.
  const double part = std::isfinite(end - begin)
    ? (time - begin) / (end - begin)
    : (0.5 * time - 0.5 * begin) / (0.5 * end - 0.5 * begin);
  place.Part = std::clamp(part, 0.0, 1.0);
  return place;
}

double StepTimes::Clamp(double time) const
{
  return std::clamp(time, this->Times.front(), this->Times.back());
}

std::vector<double> StepTimes::Resampled(int each) const
{
  std::vector<double> all;
  for (int step = 0; step + 1 < this->Count(); ++step)
  {
    const double begin = (*this)[step];
    const double end = (*this)[step + 1];
    const double length = end - begin;
    for (int part = 0; part < each; ++part)
    {
      all.push_back(std::isfinite(length)
          ? begin + length * part / each
          : 2.0 * (0.5 * begin + (0.5 * end - 0.5 * begin) * part / each));
    }
  }
  if (this->Count() > 0)
  {
    all.push_back(this->Times.back());
  }
  return all;
}

} // namespace RectifiedTransport
