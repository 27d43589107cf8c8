// SPDX-License-Identifier: BSD-3-Clause
// The mass of a blend of densities, and how the blend becomes one of them.
#ifndef RectifiedTransport_BlendWeights_h
#define RectifiedTransport_BlendWeights_h

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// The mass of a blend of densities with masses m_i and weights w_i, whose sum is 1.
enum class BlendedMass
{
  Linear,    // sum of w_i m_i
  Geometric, // product of m_i^w_i
  Source,    // the mass of the first density
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

// Returns the part of the mass that the cells of the density with the largest weight carry;
// particles carry the rest. The part grows from 0 at a weight of .9 to 1 at a weight of 1, so that
// the blend is continuous.
inline double shareOfHeaviest(double weight)
{
  constexpr double nearby = 0.1; // how far below 1 a weight is near it
  constexpr double rounding = 1e-9;
  const double share = 1.0 - (1.0 - weight) / nearby;
  return share > rounding ? share : 0.0;
}

// Scales a density of mass `own` to another mass. In this order no value overflows, however
// different the masses are, and equal masses change no bit.
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
