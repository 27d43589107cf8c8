// SPDX-License-Identifier: BSD-3-Clause
// On which side of a line a point of the plane is, without rounding errors.
#ifndef RectifiedTransport_Turn_h
#define RectifiedTransport_Turn_h

namespace RectifiedTransport
{

// Twice the area of the triangle a, b, c in the plane: above 0 if it turns left, below 0 if it
// turns right, 0 if the points are collinear. The sign is exact if products of coordinates neither
// overflow nor underflow.
double turnOf(const double* a, const double* b, const double* c);

} // namespace RectifiedTransport

#endif
