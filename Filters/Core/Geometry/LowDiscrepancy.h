// SPDX-License-Identifier: BSD-3-Clause
// The additive recurrence of Roberts (2018): the fractions of i / phi^k, where phi is the root of
// phi^(Dimension + 1) = phi + 1, in 64-bit fixed point, so that large i lose no digits.
#ifndef RectifiedTransport_LowDiscrepancy_h
#define RectifiedTransport_LowDiscrepancy_h

#include <cstdint>

namespace RectifiedTransport
{

// The step of coordinate `axis` from one point to the next, in units of 2^-64.
template <int Dimension>
std::uint64_t lowDiscrepancyStep(int axis)
{
  constexpr std::uint64_t steps[3][3] = {
    { 0x9E3779B97F4A7C16u, 0, 0 },
    { 0xC13FA9A902A6328Fu, 0x91E10DA5C79E7B1Du, 0 },
    { 0xD1B54A32D192ED04u, 0xABC98388FB8FAC03u, 0x8CB92BA72F3D8DD7u },
  };
  return steps[Dimension - 1][axis];
}

} // namespace RectifiedTransport

#endif
