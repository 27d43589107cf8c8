// SPDX-License-Identifier: BSD-3-Clause
// Interpolation of a flow map by cubics through four nodes an axis (FlowMapLanes.txx).
#ifndef RectifiedTransport_MapRead_h
#define RectifiedTransport_MapRead_h

// The cell of the lattice that a particle is in along an axis, the first of its four nodes and
// their weights. The particle lies between the second and the third of its nodes, if its cell is
// not at an end.
RT_FUNCTION void findStencil(double x, double size, double layer, double length,
  double inverseSpacing, double last, Int32* cell, Int32* first, float* weight0, float* weight1,
  float* weight2, float* weight3)
{
  // u(x) of LatticeAxis, in which the nodes are evenly spaced.
  const double fromEnd = size - x;
  const double inLayer = 2.0 * rootOf(layer * smaller(x, fromEnd));
  const double inside = x + layer;
  const double belowEnd = fromEnd < layer ? length - inLayer : inside;
  const double u = x < layer ? inLayer : belowEnd;
  const double place = u * inverseSpacing;
  const double at = smaller(truncated(place), last);
  const double start = smaller(larger(at - 1.0, 0.0), last - 2.0);
  // The Lagrange weights of the nodes 0, 1, 2, 3 at the place a.
  const double a = place - start;
  const double b = a - 1.0;
  const double c = a - 2.0;
  const double d = a - 3.0;
  *cell = (Int32)at;
  *first = (Int32)start;
  *weight0 = (float)(b * c * d * (-1.0 / 6.0));
  *weight1 = (float)(a * c * d * 0.5);
  *weight2 = (float)(a * b * d * -0.5);
  *weight3 = (float)(a * b * c * (1.0 / 6.0));
}

#endif
