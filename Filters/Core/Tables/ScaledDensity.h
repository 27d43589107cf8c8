// SPDX-License-Identifier: BSD-3-Clause
// Moments of very large values overflow, and those of very small values lose bits. Scaling by a
// power of two prevents both without rounding.
#ifndef RectifiedTransport_ScaledDensity_h
#define RectifiedTransport_ScaledDensity_h

#include "Core/Tables/Density.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace RectifiedTransport
{

// The exponent of the power of two to scale a density of this maximum by; 0 for usual maxima.
inline int scalingOf(double maximum)
{
  // Sums of f times a centre and a number of cells stay in the range of doubles up to here.
  constexpr double extreme = 1e200;
  return maximum > extreme || maximum < 1.0 / extreme
    ? std::max(-1000, std::min(1000, -std::ilogb(maximum)))
    : 0;
}

// A density times a power of two, with the exponent 0 the density itself.
class ScaledDensity final : public DensityValues
{
public:
  ScaledDensity(const DensityValues& density, int exponent)
    : Density(density)
    , Exponent(exponent)
  {
  }
  void Read(std::int64_t first, std::int64_t count, double* values) const override
  {
    this->Density.Read(first, count, values);
    if (this->Exponent != 0)
    {
      const double scale = std::ldexp(1.0, this->Exponent);
      std::transform(values, values + count, values, [=](double value) { return value * scale; });
    }
  }

private:
  const DensityValues& Density;
  const int Exponent;
};

} // namespace RectifiedTransport

#endif
