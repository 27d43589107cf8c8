// SPDX-License-Identifier: BSD-3-Clause
// The velocity of the rectified flow (paper, Eqs. (11) and (12)) of one particle, in the parts that
// lie before and after the sums over its box (BoxMoments.h), most of them along one axis.
#ifndef RectifiedTransport_Velocity_h
#define RectifiedTransport_Velocity_h

// Least distance of positions from the domain's faces, in grid cells: the box of a particle on a
// face has no volume; close to it the velocity is that of the limit.
#define RT_FACE_DISTANCE (1.0 / 1048576.0)

// Away from the faces, where boxes have no volume.
RT_FUNCTION double clampToDomain(double x, double size)
{
  return smaller(larger(x, RT_FACE_DISTANCE), size - RT_FACE_DISTANCE);
}

// 1 / t and 1 / (1 - t), by one division.
RT_FUNCTION void invertTimes(double t, double* inverseTime, double* inverseRest)
{
  const double rest = 1.0 - t;
  const double inverse = 1.0 / (t * rest);
  *inverseTime = rest * inverse;
  *inverseRest = t * inverse;
}

// The sides of the box along an axis, clipped to the domain (paper, Eq. (10) and "Integration
// bounds"):
//   a = max(0, S - (S - x) / t),   b = min(S, x / t),
// and the centre c of the box before clipping, whose sides are S (1 - t) / t.
RT_FUNCTION void findSides(
  double x, double size, double inverseTime, double* from, double* to, double* centre)
{
  const double a = size - (size - x) * inverseTime;
  const double b = x * inverseTime;
  *centre = 0.5 * (a + b);
  *from = larger(a, 0.0);
  *to = smaller(b, size);
}

// The coarsest level whose cells are no wider than the box's narrowest side over CoarseRatio, and
// the width of its cells: the greatest power of 4 that is not above the ratio, by its exponent of 2
// alone. The biased exponent is odd where the exponent is even.
RT_FUNCTION void findLevel(double narrowest, double inverseRatio, double widest, double* width,
  double* inverseWidth, Int32* level)
{
  const double ratio = smaller(larger(narrowest * inverseRatio, 1.0), widest);
  const Bits64 exponent = ((bitsOf(ratio) >> 52) - 1) | 1;
  *width = fromBits(exponent << 52);
  *inverseWidth = fromBits((2046 - exponent) << 52);
  *level = ((Int32)exponent - 1023) >> 1;
}

// The number of the last cell of a level, and its width. Where the widths of all levels divide the
// size (even) no last cell is narrower; the general form gives the same bits.
RT_FUNCTION void findLastCell(double size, double width, double inverseWidth, int even,
  double* last, double* lastWidth, double* inverseLastWidth)
{
  *last = truncated((size - 1.0) * inverseWidth);
  *lastWidth = even ? width : size - *last * width;
  *inverseLastWidth = even ? inverseWidth : 1.0 / *lastWidth;
}

// b of a place r in a cell (BoxMoments.txx).
RT_FUNCTION double quadraticWeightAt(double place, double width)
{
  return (-0.5 * width) * (place * (1.0 - place));
}

// The node below a side of a box, the place r of the side in the cell above that node, and b.
RT_FUNCTION void findNode(double side, double width, double inverseWidth, double last,
  double lastWidth, double inverseLastWidth, int even, double* node, double* place,
  double* quadraticWeight)
{
  const double below = smaller(truncated(side * inverseWidth), last);
  const double inverse = below == last ? inverseLastWidth : inverseWidth;
  const double cell = below == last ? lastWidth : width;
  const double inCell = (side - below * width) * inverse;
  // The reciprocal of a width that is no power of 2 is rounded: r might exceed 1.
  const double r = even ? inCell : smaller(inCell, 1.0);
  *node = below;
  *place = r;
  *quadraticWeight = quadraticWeightAt(r, cell);
}

// q = r (i + r/2) / (i + 1/2) of BoxMoments.txx for both sides, by one division.
RT_FUNCTION void findMomentWeights(double lowNode, double lowPlace, double highNode,
  double highPlace, double* lowWeight, double* highWeight)
{
  const double lowCentre = lowNode + 0.5;
  const double highCentre = highNode + 0.5;
  const double inverse = 1.0 / (lowCentre * highCentre);
  *lowWeight = lowPlace * (lowNode + 0.5 * lowPlace) * (highCentre * inverse);
  *highWeight = highPlace * (highNode + 0.5 * highPlace) * (lowCentre * inverse);
}

// v = (c - S/2) + (m - c) / (1 - t) with m the box's centre of mass, clamped to the box, and c the
// centre of the unclipped box; for t < 1/2, where c grows without bound, (m - x) / (1 - t). In
// exact arithmetic the mean of Eq. (11) lies in the box. A nearly empty box magnifies rounding in
// the sums: the clamp bounds that, and with it the velocity. Empty boxes keep their place in the
// box (m = c).
RT_FUNCTION double velocityInBox(double x, double t, double middle, double from, double to,
  double centre, double moment, double inverseMass, double isVoid, double inverseRest)
{
  const double clamped = smaller(larger(moment * inverseMass, from), to);
  const double m = isVoid > 0.0 ? centre : clamped;
  // Eq. (12), and the same with x = t c + (1 - t) S/2 put in. The late form tends to x - S/2 at
  // t = 1, where the early one is 0/0.
  const double early = (m - x) * inverseRest;
  const double late = (centre - middle) + (m - centre) * inverseRest;
  return t < 0.5 ? early : late;
}

#endif
