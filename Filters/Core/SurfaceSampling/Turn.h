// SPDX-License-Identifier: BSD-3-Clause
// On which side of a line a point of the plane is, without an error of rounding.
#ifndef RectifiedTransport_Turn_h
#define RectifiedTransport_Turn_h

namespace RectifiedTransport
{

// Twice the area of the triangle a, b, c, points of the plane: above 0 where it turns left, below 0
// where it turns right, 0 where the points are on one line. The sign is exact, of coordinates whose
// products neither overflow nor underflow.
double turnOf(const double* a, const double* b, const double* c);

} // namespace RectifiedTransport

#endif
