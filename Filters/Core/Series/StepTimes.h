// SPDX-License-Identifier: BSD-3-Clause
// The times of a series' steps, and between which of them a time is.
#ifndef RectifiedTransport_StepTimes_h
#define RectifiedTransport_StepTimes_h

#include <cstddef>
#include <vector>

namespace RectifiedTransport
{

// A time within an interval between two consecutive steps; of one step, both are that one.
struct TimeInterval
{
  int First = 0;
  int Second = 0;
  double Part = 0.0; // 0 at the first step, 1 at the second one
};

class StepTimes
{
public:
  // A series without steps.
  StepTimes() = default;
  // Takes the finite times, in ascending order, without repeated ones.
  StepTimes(const double* times, std::size_t count);
  // A series of one step.
  explicit StepTimes(double time)
    : Times{ time }
  {
  }

  bool operator==(const StepTimes& other) const { return this->Times == other.Times; }
  int Count() const { return static_cast<int>(this->Times.size()); }
  double operator[](int step) const { return this->Times[static_cast<std::size_t>(step)]; }
  // There is at least one step. A time before the first one or after the last one is that one; at a
  // step, the place is in the interval that begins there, if there is one.
  TimeInterval Find(double time) const;
  double Clamp(double time) const;
  // Returns the times of `each` equal parts of every interval.
  std::vector<double> Resampled(int each) const;

private:
  std::vector<double> Times;
};

} // namespace RectifiedTransport

#endif
