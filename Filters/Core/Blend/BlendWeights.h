// SPDX-License-Identifier: BSD-3-Clause
// The mass of what is between densities, and how it becomes one of them.
#ifndef RectifiedTransport_BlendWeights_h
#define RectifiedTransport_BlendWeights_h

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// The mass of what is between densities of masses m_i, by their weights w_i with the sum 1.
enum class BlendedMass
{
  Linear,    // sum of w_i m_i
  Geometric, // product of m_i^w_i
  Source,    // that of the first density
  Normalize  // 1
};

inline double blendedMass(
  BlendedMass mode, const std::vector<double>& masses, const std::vector<double>& weights)
{
  if (mode == BlendedMass::Source || mode == BlendedMass::Normalize)
  {
    return mode == BlendedMass::Source ? masses.front() : 1.0;
  }
  double sum = 0.0;
  double product = 1.0;
  for (std::size_t i = 0; i < weights.size(); ++i)
  {
    sum += weights[i] * masses[i];
    product *= std::pow(masses[i], weights[i]);
  }
  return mode == BlendedMass::Linear ? sum : product;
}

// The part of the mass that the cells of the density of the largest weight carry; particles carry
// the rest. It grows from 0 at a weight of .9 to 1 at a weight of 1, so that there is no jump.
inline double shareOfHeaviest(double weight)
{
  constexpr double nearby = 0.1; // how far below 1 a weight is near it
  constexpr double rounding = 1e-9;
  const double share = 1.0 - (1.0 - weight) / nearby;
  return share > rounding ? share : 0.0;
}

// Gives a density of mass `own` another mass. In this order no density overflows, however far apart
// the masses are; equal masses change no bit.
inline void rescaleMass(double own, double mass, double* density, std::int64_t count)
{
  if (mass != own)
  {
    std::transform(
      density, density + count, density, [=](double value) { return value / own * mass; });
  }
}

} // namespace RectifiedTransport

#endif
