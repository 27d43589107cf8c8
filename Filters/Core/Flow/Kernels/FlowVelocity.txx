// SPDX-License-Identifier: BSD-3-Clause
// The velocity of the rectified flow (paper, Eqs. (11) and (12)) in a form without cancellation:
// boxes, then their nodes in the tables, then their sums (BoxMoments.txx), then v. Each of these
// steps loops over the lanes of a block, axis by axis. Included by FlowKernels.txx.

// Least distance of positions from the domain's faces, in grid cells: the box of a particle on a
// face has no volume; close to it the velocity is that of the limit.
constexpr double faceDistance = 1.0 / (1 << 20);

// A vector of each lane.
template <int Dimension>
using LaneVectors = double[Dimension][BlockSize];

// Intermediate results of the velocity of a block.
template <int Dimension>
struct VelocityLanes
{
  BoxLanes<Dimension> Boxes;
  alignas(64) LaneVectors<Dimension> From;   // a, the low corner of the clipped box
  alignas(64) LaneVectors<Dimension> To;     // b, the high corner
  alignas(64) LaneVectors<Dimension> Centre; // c, of the box before clipping
  alignas(64) Lanes InverseTime;             // 1 / t
  alignas(64) Lanes InverseRest;             // 1 / (1 - t)
  alignas(64) Lanes Narrowest;               // width of the clipped box along its narrowest axis
  alignas(64) Lanes Void;                    // 1 where the box has no mass, else 0
  alignas(64) Lanes Outside; // 1 where the box leaves the part of the domain with nodes, else 0
};

RT_INLINE double smaller(double a, double b)
{
  return a < b ? a : b;
}

RT_INLINE double larger(double a, double b)
{
  return a > b ? a : b;
}

// Of values from 0 to 2^31.
RT_INLINE double truncated(double value)
{
#if defined(__SSE4_1__)
  return __builtin_floor(value);
#else
  return static_cast<double>(static_cast<std::int32_t>(value));
#endif
}

RT_INLINE std::uint64_t bitsOf(double value)
{
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits;
}

RT_INLINE double fromBits(std::uint64_t bits)
{
  double value;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

// B' = [a, b] of every lane, clipped to the domain (paper, Eq. (10) and "Integration bounds"):
//   a = max(0, S - (S - x) / t),   b = min(S, x / t),
// and the centre c of the box before clipping, whose sides are S (1 - t) / t. Nearest rounds both
// corners to nodes (Section 4.3): its boxes may have no volume.
template <int Dimension>
RT_INLINE void findBoxes(const FlowJob<Dimension>& job, VelocityLanes<Dimension>& lanes,
  const LaneVectors<Dimension>& x, const Lanes& t)
{
#pragma omp simd
  for (int i = 0; i < BlockSize; ++i)
  {
    // One division for both: 1 / t and 1 / (1 - t) from 1 / (t (1 - t)).
    const double rest = 1.0 - t[i];
    const double inverse = 1.0 / (t[i] * rest);
    lanes.InverseTime[i] = rest * inverse;
    lanes.InverseRest[i] = t[i] * inverse;
    lanes.Narrowest[i] = 1e300;
  }
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double size = job.Tables.Size[axis];
    double* from = lanes.From[axis];
    double* to = lanes.To[axis];
    double* centre = lanes.Centre[axis];
    const double* position = x[axis];
    if (job.Nearest)
    {
#pragma omp simd
      for (int i = 0; i < BlockSize; ++i)
      {
        const double inverse = lanes.InverseTime[i];
        const double a = size - (size - position[i]) * inverse;
        const double b = position[i] * inverse;
        centre[i] = 0.5 * (a + b);
        from[i] = truncated(smaller(larger(a, 0.0), size) + 0.5);
        to[i] = truncated(smaller(larger(b, 0.0), size) + 0.5);
        // Whole cells need nodes of the finest level.
        lanes.Narrowest[i] = 0.0;
      }
    }
    else
    {
#pragma omp simd
      for (int i = 0; i < BlockSize; ++i)
      {
        const double inverse = lanes.InverseTime[i];
        const double a = size - (size - position[i]) * inverse;
        const double b = position[i] * inverse;
        centre[i] = 0.5 * (a + b);
        from[i] = larger(a, 0.0);
        to[i] = smaller(b, size);
        lanes.Narrowest[i] = smaller(lanes.Narrowest[i], to[i] - from[i]);
      }
    }
  }
}

// Where the tables cover a part of the domain, boxes are cut to it. A box that was not inside has
// lost mass: Outside tells, and the particle is computed anew elsewhere. Axis 0 begins with 0.
template <int Dimension>
RT_INLINE void cutBoxes(const FlowJob<Dimension>& job, VelocityLanes<Dimension>& lanes)
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double lowest = job.Tables.Low[axis];
    const double highest = job.Tables.High[axis];
    double* from = lanes.From[axis];
    double* to = lanes.To[axis];
#pragma omp simd
    for (int i = 0; i < BlockSize; ++i)
    {
      const double before = axis > 0 ? lanes.Outside[i] : 0.0;
      lanes.Outside[i] = ((from[i] < lowest) | (to[i] > highest)) ? 1.0 : before;
      from[i] = smaller(larger(from[i], lowest), highest);
      to[i] = smaller(larger(to[i], lowest), highest);
    }
  }
}

// Nodes and weights along one axis of tables of uneven nodes (GradedTables.h): the node below is
// looked up by the grid cell, as all nodes lie between cells, and the width is that to the next
// node.
template <int Dimension>
RT_INLINE void findUnevenNodes(
  const FlowJob<Dimension>& job, VelocityLanes<Dimension>& lanes, int axis)
{
  BoxLanes<Dimension>& boxes = lanes.Boxes;
  const auto& nodes = job.Tables.Uneven[axis];
  const double size = job.Tables.Size[axis];
  for (int i = 0; i < BlockSize; ++i)
  {
    const double from = lanes.From[axis][i];
    const double to = lanes.To[axis][i];
    const std::int64_t low = from <= 0.0 ? onLowFace : insideBoth;
    const std::int64_t high = (Dimension == 1 || axis > 0) && to >= size ? onHighFace : insideBoth;
    const std::int64_t faces = (low | high) << facesShift(axis);
    boxes.Faces[i] = axis > 0 ? boxes.Faces[i] | faces : faces;
    for (int side = 0; side < 2; ++side)
    {
      const double plane = side == 0 ? from : to;
      const std::int32_t node =
        nodes.NodeBelow[static_cast<std::int64_t>(smaller(plane, size - 1.0))];
      const double below = nodes.Places[node];
      const double width = nodes.Places[node + 1] - below;
      const double place = (plane - below) / width;
      boxes.Place[axis][side][i] = place;
      boxes.QuadraticWeight[axis][side][i] = (-0.5 * width) * (place * (1.0 - place));
      boxes.Node[axis][side][i] = node;
    }
  }
}

// Nodes and weights along one axis. Where the widths of all levels divide the size (EvenLevels) no
// last cell is narrower; the general form gives the same bits.
template <int Dimension, bool Even>
RT_INLINE void findAxisNodes(const FlowJob<Dimension>& job, VelocityLanes<Dimension>& lanes,
  int axis, const Lanes& width, const Lanes& inverseWidth)
{
  BoxLanes<Dimension>& boxes = lanes.Boxes;
  const double lowest = job.Tables.Low[axis];
  const double size = job.Tables.High[axis];
  const double* from = lanes.From[axis];
  const double* to = lanes.To[axis];
#pragma omp simd
  for (int i = 0; i < BlockSize; ++i)
  {
    // Sides on the faces of what the tables cover need fewer nodes (BoxMoments.txx). The high face
    // of axis 0 has no case of its own in 2D and 3D.
    const std::int64_t low = from[i] <= lowest ? onLowFace : insideBoth;
    const std::int64_t high =
      (Dimension == 1 || axis > 0) && to[i] >= size ? onHighFace : insideBoth;
    const std::int64_t faces = (low | high) << facesShift(axis);
    boxes.Faces[i] = axis > 0 ? boxes.Faces[i] | faces : faces;
    // The number and the width of the last cell of the lane's level.
    const double last = truncated((size - 1.0) * inverseWidth[i]);
    const double lastWidth = Even ? width[i] : size - last * width[i];
    const double inverseLastWidth = Even ? inverseWidth[i] : 1.0 / lastWidth;
    double nodes[2];
    double places[2];
#pragma GCC unroll 2
    for (int side = 0; side < 2; ++side)
    {
      const double plane = side == 0 ? from[i] : to[i];
      const double node = smaller(truncated(plane * inverseWidth[i]), last);
      const double inverse = node == last ? inverseLastWidth : inverseWidth[i];
      const double cell = node == last ? lastWidth : width[i];
      const double inCell = (plane - node * width[i]) * inverse;
      // The reciprocal of a width that is no power of 2 is rounded: r might exceed 1.
      const double place = Even ? inCell : smaller(inCell, 1.0);
      boxes.Place[axis][side][i] = place;
      boxes.QuadraticWeight[axis][side][i] = (-0.5 * cell) * (place * (1.0 - place));
      boxes.Node[axis][side][i] = static_cast<std::int32_t>(node);
      nodes[side] = node;
      places[side] = place;
    }
    // q = r (i + r/2) / (i + 1/2) of BoxMoments.txx. On coarse levels it is computed, but not used.
    if constexpr (Dimension == 3)
    {
      // One division for both sides.
      const double centre[2] = { nodes[0] + 0.5, nodes[1] + 0.5 };
      const double inverse = 1.0 / (centre[0] * centre[1]);
      boxes.MomentWeight[axis][0][i] =
        places[0] * (nodes[0] + 0.5 * places[0]) * (centre[1] * inverse);
      boxes.MomentWeight[axis][1][i] =
        places[1] * (nodes[1] + 0.5 * places[1]) * (centre[0] * inverse);
    }
  }
}

// Level, nodes and weights of every lane's box. Each lane has its own level: the coarsest whose
// cells are no wider than the box's narrowest side over CoarseRatio. So the result of a lane does
// not depend on its block.
template <int Dimension>
RT_INLINE void findNodes(const FlowJob<Dimension>& job, VelocityLanes<Dimension>& lanes)
{
  BoxLanes<Dimension>& boxes = lanes.Boxes;
  if (job.Tables.IsUneven)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      findUnevenNodes<Dimension>(job, lanes, axis);
    }
    for (int i = 0; i < BlockSize; ++i)
    {
      boxes.Level[i] = 1;
    }
    return;
  }
  const double inverseRatio = 1.0 / job.CoarseRatio;
  const double widest =
    static_cast<double>(std::int64_t{ 1 } << ((job.Tables.LevelCount - 1) * levelShift));
  static_assert(levelShift == 2, "the exponent is rounded down to an even one");
  alignas(64) Lanes width;
  alignas(64) Lanes inverseWidth;
#pragma omp simd
  for (int i = 0; i < BlockSize; ++i)
  {
    const double ratio = smaller(larger(lanes.Narrowest[i] * inverseRatio, 1.0), widest);
    // The greatest power of 4 that is not above the ratio, by its exponent of 2 alone. The biased
    // exponent is odd where the exponent is even.
    const std::uint64_t exponent = ((bitsOf(ratio) >> 52) - 1) | 1;
    width[i] = fromBits(exponent << 52);
    inverseWidth[i] = fromBits((2046 - exponent) << 52);
    boxes.Level[i] = (static_cast<std::int32_t>(exponent) - 1023) >> 1;
  }
  for (int axis = 0; axis < Dimension; ++axis)
  {
    if (job.Tables.EvenLevels[axis])
    {
      findAxisNodes<Dimension, true>(job, lanes, axis, width, inverseWidth);
    }
    else
    {
      findAxisNodes<Dimension, false>(job, lanes, axis, width, inverseWidth);
    }
  }
}

// v = (c - S/2) + (m - c) / (1 - t) with m the box's centre of mass, clamped to the box, and c the
// centre of the unclipped box; for t < 1/2, where c grows without bound, (m - x) / (1 - t). Lanes
// whose box is empty get `held`, and Void is set; going backward they keep their place in the box
// (m = c). Lanes that are not active are not computed. Needs 0 < t < 1.
template <int Dimension>
__attribute__((noinline)) void evaluateVelocity(const FlowJob<Dimension>& job,
  VelocityLanes<Dimension>& lanes, int count, const LaneVectors<Dimension>& x, const Lanes& t,
  const LaneVectors<Dimension>& held, LaneVectors<Dimension>& v, const bool* active = nullptr)
{
  findBoxes<Dimension>(job, lanes, x, t);
  if (job.Tables.IsPart)
  {
    cutBoxes<Dimension>(job, lanes);
  }
  findNodes<Dimension>(job, lanes);
  BoxLanes<Dimension>& boxes = lanes.Boxes;
  if (active)
  {
    sumBoxes<Dimension, false>(job.Tables, boxes, count, active, job.Sparse);
  }
  else
  {
    sumBoxes<Dimension, true>(job.Tables, boxes, count, nullptr, job.Sparse);
  }
  const double voidMass = job.Tables.VoidMass;
  const double hold = job.Backward ? 2.0 : 0.0; // Void is never above 2: nothing is held
#pragma omp simd
  for (int i = 0; i < BlockSize; ++i)
  {
    lanes.Void[i] = boxes.Mass[i] > voidMass ? 0.0 : 1.0;
    // From here on Mass is 1 / mass. That of empty boxes is not used.
    boxes.Mass[i] = 1.0 / boxes.Mass[i];
  }
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double half = 0.5 * job.Tables.Size[axis];
#pragma omp simd
    for (int i = 0; i < BlockSize; ++i)
    {
      // The mean of Eq. (11). In exact arithmetic it lies in the box. A nearly empty box magnifies
      // the rounding of the sums: the clamp bounds that, and with it the velocity.
      const double mean = boxes.Moment[axis][i] * boxes.Mass[i];
      const double clamped = smaller(larger(mean, lanes.From[axis][i]), lanes.To[axis][i]);
      const double rest = lanes.InverseRest[i];
      const double c = lanes.Centre[axis][i];
      const double m = lanes.Void[i] > 0.0 ? c : clamped;
      // Eq. (12), and the same with x = t c + (1 - t) S/2 put in. The late form tends to x - S/2 at
      // t = 1, where the early one is 0/0.
      const double early = (m - x[axis][i]) * rest;
      const double late = (c - half) + (m - c) * rest;
      const double value = t[i] < 0.5 ? early : late;
      v[axis][i] = lanes.Void[i] > hold ? held[axis][i] : value;
    }
  }
}
