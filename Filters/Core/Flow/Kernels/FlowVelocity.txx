// SPDX-License-Identifier: BSD-3-Clause
// The velocity of the rectified flow (paper, Eqs. (11) and (12)) in a form without cancellation:
// boxes, then their nodes in the tables, then their sums (BoxMoments.txx), then v. Each of these
// steps loops over the lanes of a block, axis by axis. Included by FlowKernels.txx.

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

// B' = [a, b] of every lane, clipped to the domain (paper, Eq. (10) and "Integration bounds").
// Nearest rounds both corners to nodes (Section 4.3): its boxes may have no volume.
template <int Dimension>
RT_INLINE void findBoxes(const FlowJob<Dimension>& job, VelocityLanes<Dimension>& lanes,
  const LaneVectors<Dimension>& x, const Lanes& t)
{
#pragma omp simd
  for (int i = 0; i < BlockSize; ++i)
  {
    invertTimes(t[i], &lanes.InverseTime[i], &lanes.InverseRest[i]);
    // Wider than any domain: the minimum over the axes follows.
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
        findSides(position[i], size, lanes.InverseTime[i], &from[i], &to[i], &centre[i]);
        // Clamped first, so that truncation rounds to the nearest node.
        from[i] = truncated(smaller(from[i], size) + 0.5);
        to[i] = truncated(larger(to[i], 0.0) + 0.5);
        // Whole cells need nodes of the finest level.
        lanes.Narrowest[i] = 0.0;
      }
    }
    else
    {
#pragma omp simd
      for (int i = 0; i < BlockSize; ++i)
      {
        findSides(position[i], size, lanes.InverseTime[i], &from[i], &to[i], &centre[i]);
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
    const std::int64_t low = from <= 0.0 ? RT_LOW_FACE : RT_NO_FACE;
    const std::int64_t high =
      (Dimension == 1 || axis > 0) && to >= size ? RT_HIGH_FACE : RT_NO_FACE;
    const std::int64_t faces = (low | high) << facesShift(axis);
    boxes.Faces[i] = axis > 0 ? boxes.Faces[i] | faces : faces;
    for (int side = 0; side < 2; ++side)
    {
      const double plane = side == 0 ? from : to;
      const std::int32_t node =
        nodes.NodeBelow[static_cast<std::int64_t>(smaller(plane, size - 1.0))];
      const double below = nodes.Places[node];
      const double width = nodes.Places[node + 1] - below;
      // r = (x - x_i) / h, the place between the nodes, which interpolation is linear in.
      const double place = (plane - below) / width;
      boxes.Place[axis][side][i] = place;
      boxes.QuadraticWeight[axis][side][i] = quadraticWeightAt(place, width);
      boxes.Node[axis][side][i] = node;
    }
  }
}

// Nodes and weights along one axis. Even: EvenLevels of the axis.
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
    // Sides on the faces of what the tables cover need fewer nodes (BoxMoments.txx). In 2D and 3D
    // the high face of axis 0 has no case of its own.
    const std::int64_t low = from[i] <= lowest ? RT_LOW_FACE : RT_NO_FACE;
    const std::int64_t high =
      (Dimension == 1 || axis > 0) && to[i] >= size ? RT_HIGH_FACE : RT_NO_FACE;
    const std::int64_t faces = (low | high) << facesShift(axis);
    boxes.Faces[i] = axis > 0 ? boxes.Faces[i] | faces : faces;
    double last;
    double lastWidth;
    double inverseLastWidth;
    findLastCell(size, width[i], inverseWidth[i], Even, &last, &lastWidth, &inverseLastWidth);
    double nodes[2];
    double places[2];
#pragma GCC unroll 2
    for (int side = 0; side < 2; ++side)
    {
      findNode(side == 0 ? from[i] : to[i], width[i], inverseWidth[i], last, lastWidth,
        inverseLastWidth, Even, &nodes[side], &places[side], &boxes.QuadraticWeight[axis][side][i]);
      boxes.Place[axis][side][i] = places[side];
      boxes.Node[axis][side][i] = static_cast<std::int32_t>(nodes[side]);
    }
    // On coarse levels they are computed, but not used.
    if constexpr (Dimension == 3)
    {
      findMomentWeights(nodes[0], places[0], nodes[1], places[1], &boxes.MomentWeight[axis][0][i],
        &boxes.MomentWeight[axis][1][i]);
    }
  }
}

// Level, nodes and weights of every lane's box. Each lane has its own level, so that its result
// does not depend on its block.
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
  // The level is the coarsest one whose cells are at most 1 / CoarseRatio of the narrowest side.
  const double inverseRatio = 1.0 / job.CoarseRatio;
  const double widest =
    static_cast<double>(std::int64_t{ 1 } << ((job.Tables.LevelCount - 1) * levelShift));
  static_assert(levelShift == 2, "findLevel takes powers of 4");
  alignas(64) Lanes width;
  alignas(64) Lanes inverseWidth;
#pragma omp simd
  for (int i = 0; i < BlockSize; ++i)
  {
    findLevel(
      lanes.Narrowest[i], inverseRatio, widest, &width[i], &inverseWidth[i], &boxes.Level[i]);
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

// v(x, t). Lanes whose box is empty get `held`, and Void is set; going backward they keep their
// place in the box. Lanes that are not active are not computed. Needs 0 < t < 1.
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
  // The two instances differ in the test of each lane, which a block with all lanes active does not
  // need.
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
      const double value = velocityInBox(x[axis][i], t[i], half, lanes.From[axis][i],
        lanes.To[axis][i], lanes.Centre[axis][i], boxes.Moment[axis][i], boxes.Mass[i],
        lanes.Void[i], lanes.InverseRest[i]);
      v[axis][i] = lanes.Void[i] > hold ? held[axis][i] : value;
    }
  }
}
