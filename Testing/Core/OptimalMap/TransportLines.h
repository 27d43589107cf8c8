// SPDX-License-Identifier: BSD-3-Clause
// The exact optimal cost between densities along a line, by their quantile functions, and random
// lines of every kind.
#ifndef TransportLines_h
#define TransportLines_h

#include "Core/Geometry/ReproducibleMath.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Between piecewise-constant densities of equal mass on the cells of [0, length].
inline double lineCost(
  const std::vector<double>& source, const std::vector<double>& target, double length)
{
  struct Knot
  {
    double Mass; // up to the place
    double Place;
  };
  const auto knotsOf = [length](const std::vector<double>& values) {
    double all = 0.0;
    for (const double value : values)
    {
      all += value;
    }
    std::vector<Knot> knots{ { 0.0, 0.0 } };
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      sum += values[i];
      const bool isLast = i + 1 == values.size();
      knots.push_back({ isLast ? 1.0 : sum / all,
        length * static_cast<double>(i + 1) / static_cast<double>(values.size()) });
    }
    return knots;
  };
  const auto placeAt = [](const std::vector<Knot>& knots, std::size_t i, double mass) {
    const Knot& a = knots[i];
    const Knot& b = knots[i + 1];
    return a.Place + (b.Place - a.Place) * (mass - a.Mass) / (b.Mass - a.Mass);
  };
  const std::vector<Knot> a = knotsOf(source);
  const std::vector<Knot> b = knotsOf(target);
  double cost = 0.0;
  double at = 0.0;
  for (std::size_t i = 0, j = 0; i + 1 < a.size() && j + 1 < b.size();)
  {
    if (a[i + 1].Mass <= at)
    {
      ++i;
    }
    else if (b[j + 1].Mass <= at)
    {
      ++j;
    }
    else
    {
      const double to = std::min(a[i + 1].Mass, b[j + 1].Mass);
      const double p = placeAt(a, i, at) - placeAt(b, j, at);
      const double q = placeAt(a, i, to) - placeAt(b, j, to);
      cost += (to - at) * (p * p + p * q + q * q) / 3.0;
      at = to;
    }
  }
  return cost;
}

class RandomLines
{
public:
  explicit RandomLines(std::uint64_t seed)
    : Seed(seed)
  {
  }

  double Uniform() { return unitReal(randomWord(this->Seed, this->Counter++)); }
  int Below(int count) { return static_cast<int>(this->Uniform() * count); }

  // Noise, noise with voids, a bump, one cell, 16 decades, a step, the first cell, or constant.
  std::vector<double> Line(int cells)
  {
    const int kind = this->Below(8);
    const double centre = this->Uniform();
    const double width = 0.03 + 0.3 * this->Uniform();
    std::vector<double> values(static_cast<std::size_t>(cells));
    double sum = 0.0;
    for (int i = 0; i < cells; ++i)
    {
      const double x = (i + 0.5) / cells;
      const double random = this->Uniform();
      double& value = values[static_cast<std::size_t>(i)];
      switch (kind)
      {
        case 0:
          value = random;
          break;
        case 1:
          value = this->Uniform() < 0.5 ? 0.0 : random;
          break;
        case 2:
          value = std::exp(-(x - centre) * (x - centre) / (2.0 * width * width));
          break;
        case 3:
          value = i == static_cast<int>(centre * cells) ? 1.0 : 0.0;
          break;
        case 4:
          value = std::pow(10.0, -16.0 * random);
          break;
        case 5:
          value = x < centre ? 1.0 : 0.0;
          break;
        case 6:
          value = i == 0 ? 1.0 : 0.0;
          break;
        default:
          value = 1.0;
      }
      sum += value;
    }
    if (sum == 0.0)
    {
      values[values.size() / 2] = 1.0;
    }
    return values;
  }

private:
  std::uint64_t Seed;
  std::uint64_t Counter = 0;
};

} // namespace RectifiedTransport

#endif
