// SPDX-License-Identifier: BSD-3-Clause
// Places that cover the unit box evenly. Mirror images and rotations of the box by right angles map
// them onto themselves, so that what is measured there does not depend on how data lie.
#ifndef RectifiedTransport_SymmetricPlace_h
#define RectifiedTransport_SymmetricPlace_h

#include "Core/Geometry/LowDiscrepancy.h"
#include "Core/Geometry/Points.h"
#include "Core/Geometry/ReproducibleMath.h"

#include <cmath>
#include <cstdint>

namespace RectifiedTransport
{

template <int Dimension>
class SymmetricPlace
{
public:
  // How many places are images of one.
  static constexpr std::int64_t Images = Dimension == 1 ? 2 : Dimension == 2 ? 8 : 48;

  // Consecutive numbers, from a multiple of Images on, are the images of one place.
  explicit SymmetricPlace(std::int64_t number)
    : Mirrored(static_cast<int>(number % Images) & ((1 << Dimension) - 1))
  {
    constexpr std::uint64_t middle = std::uint64_t{ 1 } << 63;
    constexpr int orders[6][3] = { { 0, 1, 2 }, { 1, 0, 2 }, { 0, 2, 1 }, { 2, 1, 0 }, { 1, 2, 0 },
      { 2, 0, 1 } };
    const auto place = static_cast<std::uint64_t>(number / Images + 1);
    const int* order = orders[number % Images >> Dimension];
    for (int axis = 0; axis < Dimension; ++axis)
    {
      this->Place[axis] = unitReal(middle + place * lowDiscrepancyStep<Dimension>(order[axis]));
    }
  }

  // One of the integers from 0 to `last`.
  double Integer(int axis, double last) const
  {
    const double found = std::floor(this->Place[axis] * (last + 1.0));
    return this->IsMirrored(axis) ? last - found : found;
  }

  // From 0 to a size.
  double Real(int axis, double size) const
  {
    const double found = this->Place[axis] * size;
    return this->IsMirrored(axis) ? size - found : found;
  }

private:
  bool IsMirrored(int axis) const { return (this->Mirrored >> axis & 1) != 0; }

  Point<Dimension> Place;
  int Mirrored; // a bit for each axis
};

} // namespace RectifiedTransport

#endif
