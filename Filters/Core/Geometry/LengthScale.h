// SPDX-License-Identifier: BSD-3-Clause
// Lengths in units of about the size of a domain, so that their squares neither overflow nor
// underflow.
#ifndef RectifiedTransport_LengthScale_h
#define RectifiedTransport_LengthScale_h

#include "ImageGrid.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace RectifiedTransport
{

// The unit is a power of two, so that a change of units does not round.
class LengthScale
{
public:
  explicit LengthScale(const ImageGrid& grid)
    : Exponent(std::clamp(std::ilogb(grid.Diagonal()), -most, most))
    , UnitsALength(std::ldexp(1.0, -this->Exponent))
  {
  }

  // Units = length 2^-Exponent; exact, as the factor is a power of two.
  double ToUnits(double length) const { return length * this->UnitsALength; }

  // The squared length of a vector, in squared units.
  double SquareInUnits(const double* vector) const
  {
    const double v[3] = { this->ToUnits(vector[0]), this->ToUnits(vector[1]),
      this->ToUnits(vector[2]) };
    return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  }

  // |a - b|^2 in squared units.
  double SquaredDistanceInUnits(const double* a, const double* b) const
  {
    const double offset[3] = { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
    return this->SquareInUnits(offset);
  }

  double LengthFromUnits(double length) const { return std::ldexp(length, this->Exponent); }

  // A square in physical units; infinite beyond the largest double.
  double SquareFromUnits(double square) const { return std::ldexp(square, 2 * this->Exponent); }

  // A mean of such squares in physical units. Throws std::overflow_error beyond the largest double.
  double CostFromUnits(double squares) const
  {
    const double cost = this->SquareFromUnits(squares);
    if (!std::isfinite(cost))
    {
      throw std::overflow_error(
        "TransportCost, the mean of the squared displacements, passes the largest "
        "double; the spacing of the density must be smaller");
    }
    return cost;
  }

private:
  static constexpr int most = 1000; // 2^most and its inverse are normal doubles

  int Exponent;
  double UnitsALength;
};

} // namespace RectifiedTransport

#endif
