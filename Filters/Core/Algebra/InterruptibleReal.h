// SPDX-License-Identifier: BSD-3-Clause
// Real numbers for Eigen whose divisions poll for cancellation. Eigen's factorizations may take
// many seconds and cannot be interrupted otherwise.
#ifndef RectifiedTransport_InterruptibleReal_h
#define RectifiedTransport_InterruptibleReal_h

#include <Eigen/Core>

namespace RectifiedTransport
{

class Progress;

// A part of the current stage of a progress.
struct StagePart
{
  double Begin;
  double End;
};

// While one exists, divisions on its thread report the given part of the stage, expecting
// `divisions` of them, and throw Cancelled as soon as the progress is cancelled.
class DivisionPoll
{
public:
  DivisionPoll(Progress& progress, const StagePart& part, double divisions);
  ~DivisionPoll();
  DivisionPoll(const DivisionPoll&) = delete;
  DivisionPoll& operator=(const DivisionPoll&) = delete;

  static void Count()
  {
    // A factor has a division for each of its values, and about a hundred other operations for each
    // division: a poll takes place every few milliseconds.
    if (++Divisions == interval)
    {
      Poll();
    }
  }

private:
  static constexpr int interval = 1 << 12;

  static void Poll();

  static thread_local int Divisions; // since the last poll
  static thread_local DivisionPoll* Current;

  Progress& Polled;
  const StagePart Part;
  const double All;
  double Done = 0.0;
};

// A double in all but its divisions.
struct InterruptibleReal
{
  double Value;

  InterruptibleReal(double value = 0.0) // NOLINT: a number
    : Value(value)
  {
  }
  operator double() const { return this->Value; } // NOLINT: a number

  InterruptibleReal& operator+=(double other)
  {
    this->Value += other;
    return *this;
  }
  InterruptibleReal& operator-=(double other)
  {
    this->Value -= other;
    return *this;
  }
  InterruptibleReal& operator*=(double other)
  {
    this->Value *= other;
    return *this;
  }
  InterruptibleReal& operator/=(double other)
  {
    DivisionPoll::Count();
    this->Value /= other;
    return *this;
  }
};

inline InterruptibleReal operator/(InterruptibleReal a, const InterruptibleReal& b)
{
  return a /= b;
}

} // namespace RectifiedTransport

template <>
struct Eigen::NumTraits<RectifiedTransport::InterruptibleReal> : Eigen::NumTraits<double>
{
  using Real = RectifiedTransport::InterruptibleReal;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = Real;
};

#endif
