// SPDX-License-Identifier: BSD-3-Clause
// Random choices that a number decides alone: the same on every machine, compiler and library.
#ifndef Campaign_RandomSource_h
#define Campaign_RandomSource_h

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <iterator>

namespace Campaign
{

class RandomSource
{
public:
  explicit RandomSource(std::uint64_t seed)
    : State(seed)
  {
  }

  // Splitmix64 (Steele, Lea and Flood, 2014).
  std::uint64_t Next()
  {
    this->State += 0x9e3779b97f4a7c15;
    std::uint64_t z = this->State;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }

  // In [0,1).
  double Unit() { return static_cast<double>(this->Next() >> 11) * 0x1p-53; }

  double Real(double low, double high) { return low + (high - low) * this->Unit(); }

  // A positive number between two powers of two, evenly in its exponent.
  double Magnitude(int lowest, int highest)
  {
    const auto exponent = static_cast<int>(this->Whole(lowest, highest));
    return std::ldexp(1.0 + this->Unit(), exponent);
  }

  // Both ends included.
  std::int64_t Whole(std::int64_t low, std::int64_t high)
  {
    const auto count = static_cast<std::uint64_t>(high - low) + 1;
    return low + static_cast<std::int64_t>(this->Next() % count);
  }

  bool Chance(double probability) { return this->Unit() < probability; }

  template <class T>
  T Of(std::initializer_list<T> choices)
  {
    return *std::next(
      choices.begin(), this->Whole(0, static_cast<std::int64_t>(choices.size()) - 1));
  }

private:
  std::uint64_t State;
};

} // namespace Campaign

#endif
