// SPDX-License-Identifier: BSD-3-Clause
// Mass and first moments of a density over a box in 3D, as BoxMoments.txx sums them, in the same
// order of operations: for devices. Processors have a text of their own, as one that serves both
// needs more registers than they have; tests compare the two to the bit.
#ifndef RectifiedTransport_BoxMoments3D_h
#define RectifiedTransport_BoxMoments3D_h

// One axis of a box on the finest level, where each entry of a record has a linear weight of its
// own: q for the moment along the axis and r for the others.
typedef struct
{
  Real4 Weights[2]; // weights of the sides' second nodes
  Int64 Offset[2];
  Int64 Stride;
} FineAxis;

// One side of axis 0: the nodes below and above it.
RT_FUNCTION Real8 finePairWeights(double place, double momentWeight)
{
  const Real4 second = RT_FILL4_BUT(1, place, momentWeight);
  return RT_JOIN(RT_FILL4(1.0) - second, second);
}

// The sum over the nodes of a plane across axis 2: both sides of axis 0 in the rows about both
// sides of axis 1, high less low. Faces of the domain need fewer rows.
RT_FUNCTION Real4 sumFinePlane(RT_GLOBAL const double* low, RT_GLOBAL const double* high,
  const FineAxis* axis1, int isOnLowFace0, int faces1, const Real8* lowWeights,
  const Real8* highWeights)
{
  const Int64 upper = axis1->Offset[1];
  const Int64 upperNext = upper + axis1->Stride;
  Real4 sum = sumRow(low + upperNext, high + upperNext, isOnLowFace0, lowWeights, highWeights);
  if (!(faces1 & RT_HIGH_FACE))
  {
    const Real4 first = sumRow(low + upper, high + upper, isOnLowFace0, lowWeights, highWeights);
    sum = first + (sum - first) * axis1->Weights[1];
  }
  if (!(faces1 & RT_LOW_FACE))
  {
    const Int64 lower = axis1->Offset[0];
    const Int64 lowerNext = lower + axis1->Stride;
    const Real4 first = sumRow(low + lower, high + lower, isOnLowFace0, lowWeights, highWeights);
    const Real4 second =
      sumRow(low + lowerNext, high + lowerNext, isOnLowFace0, lowWeights, highWeights);
    sum = sum - (first + (second - first) * axis1->Weights[0]);
  }
  return sum;
}

// `low` and `high` are the nodes below the sides of axis 0.
RT_FUNCTION void sumFineBox3D(RT_GLOBAL const double* low, RT_GLOBAL const double* high,
  double lowPlace, double lowMomentWeight, double highPlace, double highMomentWeight,
  const FineAxis* axis1, const FineAxis* axis2, int isOnLowFace0, int faces1, int faces2,
  double* mass, double* moments)
{
  const Real8 lowWeights = finePairWeights(lowPlace, lowMomentWeight);
  const Real8 highWeights = finePairWeights(highPlace, highMomentWeight);
  // High side less low side, each interpolated between two planes of nodes.
  const Int64 upper = axis2->Offset[1];
  const Int64 upperNext = upper + axis2->Stride;
  Real4 sum = sumFinePlane(
    low + upperNext, high + upperNext, axis1, isOnLowFace0, faces1, &lowWeights, &highWeights);
  if (!(faces2 & RT_HIGH_FACE))
  {
    const Real4 first = sumFinePlane(
      low + upper, high + upper, axis1, isOnLowFace0, faces1, &lowWeights, &highWeights);
    sum = first + (sum - first) * axis2->Weights[1];
  }
  if (!(faces2 & RT_LOW_FACE))
  {
    const Int64 lower = axis2->Offset[0];
    const Int64 lowerNext = lower + axis2->Stride;
    const Real4 first = sumFinePlane(
      low + lower, high + lower, axis1, isOnLowFace0, faces1, &lowWeights, &highWeights);
    const Real4 second = sumFinePlane(
      low + lowerNext, high + lowerNext, axis1, isOnLowFace0, faces1, &lowWeights, &highWeights);
    sum = sum - (first + (second - first) * axis2->Weights[0]);
  }
  *mass = RT_ENTRY(sum, 0);
  moments[0] = RT_ENTRY(sum, 1);
  moments[1] = RT_ENTRY(sum, 2);
  moments[2] = RT_ENTRY(sum, 3);
}

// On coarse levels: the sums of a pair of neighbouring nodes along axis 0 over the nodes of the
// other axes, linear along both, or quadratic along one.
typedef struct
{
  Real8 Linear;
  Real8 Quadratic1;
  Real8 Quadratic2;
} PairSums;

// Sums one row along axis 1; Quadratic2 is not set.
RT_FUNCTION void sumPairRow(
  RT_GLOBAL const double* nodes, const BoxAxis* axis1, int faces1, PairSums* sums)
{
  const Real8 above = RT_LOAD8(nodes + axis1->Offset[1] + axis1->Stride);
  if (faces1 & RT_HIGH_FACE)
  {
    sums->Linear = above;
    sums->Quadratic1 = RT_JOIN(RT_ZERO4, RT_ZERO4);
  }
  else
  {
    const Real8 below = RT_LOAD8(nodes + axis1->Offset[1]);
    const Real8 step = above - below;
    sums->Linear = below + step * axis1->Place[1];
    sums->Quadratic1 = step * axis1->QuadraticWeight[1];
  }
  if (!(faces1 & RT_LOW_FACE))
  {
    const Real8 below = RT_LOAD8(nodes + axis1->Offset[0]);
    const Real8 step = RT_LOAD8(nodes + axis1->Offset[0] + axis1->Stride) - below;
    sums->Linear = sums->Linear - (below + step * axis1->Place[0]);
    sums->Quadratic1 = sums->Quadratic1 - step * axis1->QuadraticWeight[0];
  }
}

// At one side of axis 2, from the two planes of nodes around it.
RT_FUNCTION void sumPairSide(RT_GLOBAL const double* nodes, const BoxAxis* axis1,
  const BoxAxis* axis2, int side, int faces1, PairSums* sums)
{
  PairSums second;
  sumPairRow(nodes + axis2->Offset[side], axis1, faces1, sums);
  sumPairRow(nodes + axis2->Offset[side] + axis2->Stride, axis1, faces1, &second);
  const Real8 step = second.Linear - sums->Linear;
  sums->Linear = sums->Linear + step * axis2->Place[side];
  sums->Quadratic1 = sums->Quadratic1 + (second.Quadratic1 - sums->Quadratic1) * axis2->Place[side];
  sums->Quadratic2 = step * axis2->QuadraticWeight[side];
}

// High side less low side along axis 2. A side on a high face is a plane of nodes itself; one on a
// low face adds 0.
RT_FUNCTION void sumPair(RT_GLOBAL const double* nodes, const BoxAxis* axis1, const BoxAxis* axis2,
  int faces1, int faces2, PairSums* sums)
{
  if (faces2 & RT_HIGH_FACE)
  {
    sumPairRow(nodes + axis2->Offset[1] + axis2->Stride, axis1, faces1, sums);
    sums->Quadratic2 = RT_JOIN(RT_ZERO4, RT_ZERO4);
  }
  else
  {
    sumPairSide(nodes, axis1, axis2, 1, faces1, sums);
  }
  if (!(faces2 & RT_LOW_FACE))
  {
    PairSums low;
    sumPairSide(nodes, axis1, axis2, 0, faces1, &low);
    sums->Linear = sums->Linear - low.Linear;
    sums->Quadratic1 = sums->Quadratic1 - low.Quadratic1;
    sums->Quadratic2 = sums->Quadratic2 - low.Quadratic2;
  }
}

// {1 - r, r} for all four entries of the records of a pair.
RT_FUNCTION Real8 linearPairWeights(double place)
{
  return RT_JOIN(RT_FILL4(1.0 - place), RT_FILL4(place));
}

// Axis 0 comes last, {1 - r, r} of a pair: Q_0[E] needs E at both nodes of the pair, before they
// are added.
RT_FUNCTION void sumCoarseBox3D(RT_GLOBAL const double* nodes, const BoxAxis* axis0,
  const BoxAxis* axis1, const BoxAxis* axis2, int isOnLowFace0, int faces1, int faces2,
  double* mass, double* moments)
{
  PairSums sums;
  sumPair(nodes + axis0->Offset[1], axis1, axis2, faces1, faces2, &sums);
  Real8 weights = linearPairWeights(axis0->Place[1]);
  Real8 linear = sums.Linear * weights;
  Real8 quadratic1 = sums.Quadratic1 * weights;
  Real8 quadratic2 = sums.Quadratic2 * weights;
  // Entries 0 and 4 are E at both nodes of the pair.
  double quadratic0 =
    axis0->QuadraticWeight[1] * (RT_ENTRY(sums.Linear, 4) - RT_ENTRY(sums.Linear, 0));
  if (!isOnLowFace0)
  {
    sumPair(nodes + axis0->Offset[0], axis1, axis2, faces1, faces2, &sums);
    weights = linearPairWeights(axis0->Place[0]);
    linear = linear - sums.Linear * weights;
    quadratic1 = quadratic1 - sums.Quadratic1 * weights;
    quadratic2 = quadratic2 - sums.Quadratic2 * weights;
    quadratic0 = quadratic0 -
      axis0->QuadraticWeight[0] * (RT_ENTRY(sums.Linear, 4) - RT_ENTRY(sums.Linear, 0));
  }
  *mass = RT_ENTRY(linear, 0) + RT_ENTRY(linear, 4);
  moments[0] = (RT_ENTRY(linear, 1) + RT_ENTRY(linear, 5)) + quadratic0;
  moments[1] = (RT_ENTRY(linear, 2) + RT_ENTRY(linear, 6)) +
    (RT_ENTRY(quadratic1, 0) + RT_ENTRY(quadratic1, 4));
  moments[2] = (RT_ENTRY(linear, 3) + RT_ENTRY(linear, 7)) +
    (RT_ENTRY(quadratic2, 0) + RT_ENTRY(quadratic2, 4));
}

#endif
