// SPDX-License-Identifier: BSD-3-Clause
// Mass and first moments of a density over a box in 2D, from interpolated summed-area tables
// (paper, Section 3.3; Algorithm 1): the two integrals of Eq. (11). BoxMoments.txx explains the
// interpolation.
#ifndef RectifiedTransport_BoxMoments_h
#define RectifiedTransport_BoxMoments_h

// Which sides of a box lie on the faces of the domain, along one axis: the bits of `faces`.
#define RT_NO_FACE 0
#define RT_LOW_FACE 1
#define RT_HIGH_FACE 2
#define RT_BOTH_FACES 3

// One axis of a box. [0] is the low side, [1] the high side.
typedef struct
{
  double Place[2];           // r
  double QuadraticWeight[2]; // b
  Int64 Offset[2];           // of the node below each side, in doubles
  Int64 Stride;              // from a node to the next, in doubles
} BoxAxis;

// The sums of a box at one row of nodes along axis 0, from the pairs of nodes around its two sides,
// or around the high one alone.
RT_FUNCTION Real4 sumRow(RT_GLOBAL const double* low, RT_GLOBAL const double* high, int isOnLowFace,
  const Real8* lowWeights, const Real8* highWeights)
{
  const Real8 sum = RT_LOAD8(high) * *highWeights;
  return isOnLowFace ? RT_ADD_HALVES(sum) : RT_ADD_HALVES(sum - RT_LOAD8(low) * *lowWeights);
}

// Weights of the nodes {below, above} a side: {1 - r, r} for the entries E, E_0 and E_1, and {-b,
// b} for the repeated E, which gives Q_0[E] = b (E_i+1 - E_i) in the same product.
RT_FUNCTION Real8 pairWeights(double place, double quadraticWeight)
{
  const Real4 second = RT_FILL4_BUT(3, place, quadraticWeight);
  return RT_JOIN(RT_VECTOR4(1.0, 1.0, 1.0, 0.0) - second, second);
}

// The fourth entry of a record repeats the mass, so that one product with the weights of a pair of
// neighbouring nodes along axis 0 gives the linear sums and the quadratic one of that axis.
RT_FUNCTION void sumBox2D(RT_GLOBAL const double* nodes, const BoxAxis* axis0, const BoxAxis* axis1,
  int isOnLowFace0, int faces1, double* mass, double* moment0, double* moment1)
{
  RT_GLOBAL const double* low = nodes + axis0->Offset[0];
  RT_GLOBAL const double* high = nodes + axis0->Offset[1];
  const Real8 highWeights = pairWeights(axis0->Place[1], axis0->QuadraticWeight[1]);
  const Real8 lowWeights = pairWeights(axis0->Place[0], axis0->QuadraticWeight[0]);
  Real4 linear;
  Real4 quadratic;
  if (faces1 & RT_HIGH_FACE)
  {
    const Int64 row = axis1->Offset[1] + axis1->Stride;
    linear = sumRow(low + row, high + row, isOnLowFace0, &lowWeights, &highWeights);
    quadratic = RT_ZERO4;
  }
  else
  {
    const Int64 row = axis1->Offset[1];
    const Int64 next = row + axis1->Stride;
    const Real4 below = sumRow(low + row, high + row, isOnLowFace0, &lowWeights, &highWeights);
    const Real4 step =
      sumRow(low + next, high + next, isOnLowFace0, &lowWeights, &highWeights) - below;
    linear = below + step * axis1->Place[1];
    quadratic = step * axis1->QuadraticWeight[1];
  }
  if (!(faces1 & RT_LOW_FACE))
  {
    const Int64 row = axis1->Offset[0];
    const Int64 next = row + axis1->Stride;
    const Real4 below = sumRow(low + row, high + row, isOnLowFace0, &lowWeights, &highWeights);
    const Real4 step =
      sumRow(low + next, high + next, isOnLowFace0, &lowWeights, &highWeights) - below;
    linear = linear - (below + step * axis1->Place[0]);
    quadratic = quadratic - step * axis1->QuadraticWeight[0];
  }
  // m_0 = L_0 L_1 E_0 + Q_0 L_1 E and m_1 = L_0 L_1 E_1 + L_0 Q_1 E.
  *mass = RT_ENTRY(linear, 0);
  *moment0 = RT_ENTRY(linear, 1) + RT_ENTRY(linear, 3);
  *moment1 = RT_ENTRY(linear, 2) + RT_ENTRY(quadratic, 0);
}

#endif
