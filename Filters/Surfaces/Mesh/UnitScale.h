// SPDX-License-Identifier: BSD-3-Clause
// Coordinates of a surface from the centre of its bounds, in units of their longest side, so that
// areas neither underflow nor pass the largest double.
#ifndef RectifiedTransport_UnitScale_h
#define RectifiedTransport_UnitScale_h

#include <Eigen/Geometry>

namespace RectifiedTransport
{

class UnitScale
{
public:
  // For the bounds of finite points, or of none.
  explicit UnitScale(const Eigen::AlignedBox3d& bounds)
    : Centre(0.5 * bounds.max() + 0.5 * bounds.min())
  {
    // Halves of the bounds: their difference may overflow where the bounds do not.
    const double half = (0.5 * bounds.max() - 0.5 * bounds.min()).maxCoeff();
    this->Half = half > 0.0 ? half : 0.5;
  }

  // The longest side; 1 if all points are one.
  double Unit() const { return 2.0 * this->Half; }
  Eigen::Vector3d operator()(const Eigen::Vector3d& point) const
  {
    return 0.5 * ((point - this->Centre) / this->Half);
  }

private:
  Eigen::Vector3d Centre;
  double Half;
};

} // namespace RectifiedTransport

#endif
