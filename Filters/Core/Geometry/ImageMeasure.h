// SPDX-License-Identifier: BSD-3-Clause
// The measure of the image of a box under a map that is known at its corners.
#ifndef RectifiedTransport_ImageMeasure_h
#define RectifiedTransport_ImageMeasure_h

#include "Core/Geometry/Points.h"

#include <cstddef>

namespace RectifiedTransport
{

// Length, area or volume of the multilinear image, with its sign: negative where it is turned over.
// Exact. Bit a of a corner's number tells whether it is at the upper end of axis a.
template <int Dimension>
double imageMeasure(const Point<Dimension>* corners)
{
  if constexpr (Dimension == 1)
  {
    return corners[1][0] - corners[0][0];
  }
  else if constexpr (Dimension == 2)
  {
    // Half the cross product of the diagonals, exact for a bilinear image.
    return 0.5 *
      ((corners[3][0] - corners[0][0]) * (corners[2][1] - corners[1][1]) -
        (corners[3][1] - corners[0][1]) * (corners[2][0] - corners[1][0]));
  }
  else
  {
    // The integral of det(dx/du) over the unit cube. The determinant is of the second degree in
    // each coordinate, so that two Gauss points along each axis, at the distance sqrt(1/12) from
    // the centre, integrate it exactly.
    constexpr double low = 0.21132486540518711775; // 1/2 - sqrt(1/12)
    constexpr double nodes[] = { low, 1.0 - low };
    double sum = 0.0;
    for (std::size_t at = 0; at < 8; ++at)
    {
      double d[3][3]; // derivative along each axis
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const std::size_t u = axis == 0 ? 1 : 0;
        const std::size_t v = axis == 2 ? 1 : 2;
        const double p = nodes[at >> u & 1];
        const double q = nodes[at >> v & 1];
        const double weights[] = { (1.0 - p) * (1.0 - q), p * (1.0 - q), (1.0 - p) * q, p * q };
        for (std::size_t x = 0; x < 3; ++x)
        {
          d[axis][x] = 0.0;
          for (std::size_t edge = 0; edge < 4; ++edge)
          {
            const std::size_t start = (edge & 1) << u | (edge >> 1) << v;
            // The derivative along an axis is the mean of the four edges in that direction, with
            // bilinear weights.
            d[axis][x] +=
              weights[edge] * (corners[start | std::size_t{ 1 } << axis][x] - corners[start][x]);
          }
        }
      }
      sum += d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) -
        d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
        d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
    }
    return sum / 8.0;
  }
}

} // namespace RectifiedTransport

#endif
