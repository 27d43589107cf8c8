// SPDX-License-Identifier: BSD-3-Clause
// Mass and first moments of a density over boxes, from interpolated summed-area tables (paper,
// Section 3.3; Algorithm 1): the two integrals of Eq. (11). Included by FlowKernels.txx.
//
// A table is interpolated along its own axis by a quadratic and linearly along the others, which is
// exact for a piecewise-constant density: with r in [0, 1] the place in a cell of width h, the part
// r of a cell's mass lies (h/2) (1-r) below the cell's centre, which linear interpolation puts it
// at:
//   L[F] = F_i + r (F_i+1 - F_i),    Q[F] = b (F_i+1 - F_i),    b = -(h/2) r (1-r),
//   E(x) = (L (x) L (x) L) E,        E_a(x) = (L (x) L (x) L) E_a + (Q_a (x) L (x) L) E.
// On the finest level (h = 1) E_a rises by i + 1/2 times as much as E from node i to the next, so
// that the quadratic is linear in E_a, with weight q:
//   L[E_a] + Q[E] = E_a,i + q (E_a,i+1 - E_a,i),    q = r (i + r/2) / (i + 1/2).
// The sum over a box is the difference of its two sides on every axis. A side on the low face of
// the domain reads no node (the tables are zero there), one on the high face a single node.

using Lanes = double[BlockSize];

// The bit of an axis in BoxLanes::Faces. In 2D and 3D only the low face of axis 0 has one.
constexpr int facesShift(int axis)
{
  return axis == 0 ? 0 : 2 * axis - 1;
}

// The boxes of a block of particles, input of the sums below, and their results. [0] is the low
// side, [1] the high side.
template <int Dimension>
struct BoxLanes
{
  alignas(64) double Place[Dimension][2][BlockSize];           // r
  alignas(64) double QuadraticWeight[Dimension][2][BlockSize]; // b
  alignas(64) double MomentWeight[Dimension][2][BlockSize];    // q, in 3D
  alignas(64) std::int32_t Node[Dimension][2][BlockSize];      // i, of the lane's level
  alignas(64) std::int64_t Faces[BlockSize];                   // bits at facesShift of each axis
  alignas(64) std::int32_t Level[BlockSize];                   // of the tables

  alignas(64) Lanes Mass;                          // integral of f, the density, over the box
  alignas(64) double Moment[Dimension][BlockSize]; // integral of y_a f
};

// A number as a type, for lambdas: each value of the faces gets code of its own, without branches.
template <int N>
struct Number
{
  static constexpr int Value = N;
};

// Calls function(Number<faces of axis 1>{}, Number<whether on the low face of axis 0>{}).
template <class Function>
RT_INLINE void dispatchFaces(std::int64_t faces, const Function& function)
{
  constexpr int low = 1;
  switch (faces & 7)
  {
    case RT_NO_FACE << 1:
      return function(Number<RT_NO_FACE>{}, Number<0>{});
    case (RT_NO_FACE << 1) | low:
      return function(Number<RT_NO_FACE>{}, Number<1>{});
    case RT_LOW_FACE << 1:
      return function(Number<RT_LOW_FACE>{}, Number<0>{});
    case (RT_LOW_FACE << 1) | low:
      return function(Number<RT_LOW_FACE>{}, Number<1>{});
    case RT_HIGH_FACE << 1:
      return function(Number<RT_HIGH_FACE>{}, Number<0>{});
    case (RT_HIGH_FACE << 1) | low:
      return function(Number<RT_HIGH_FACE>{}, Number<1>{});
    case RT_BOTH_FACES << 1:
      return function(Number<RT_BOTH_FACES>{}, Number<0>{});
    default:
      return function(Number<RT_BOTH_FACES>{}, Number<1>{});
  }
}

template <int Dimension>
RT_INLINE BoxAxis boxAxis(const BoxLanes<Dimension>& boxes, int axis, int lane, std::int64_t stride)
{
  return { { boxes.Place[axis][0][lane], boxes.Place[axis][1][lane] },
    { boxes.QuadraticWeight[axis][0][lane], boxes.QuadraticWeight[axis][1][lane] },
    { boxes.Node[axis][0][lane] * stride, boxes.Node[axis][1][lane] * stride }, stride };
}

// L and Q of N table entries at once. Each is linear in the values of the nodes: they may be
// applied axis by axis, in any order of axes, here from axis 0 (innermost) to the last.
template <int N>
struct AxisSums
{
  Vector<N> Linear;
  Vector<N> Quadratic;
};

// L and Q of one axis over the box, where value(offset) are the sums at the node of that offset.
template <int Faces, int N, class Value>
RT_INLINE AxisSums<N> sumAxis(const BoxAxis& axis, const Value& value)
{
  AxisSums<N> sums;
  if constexpr (Faces == RT_NO_FACE || Faces == RT_LOW_FACE)
  {
    const Vector<N> high = value(axis.Offset[1]);
    const Vector<N> step = value(axis.Offset[1] + axis.Stride) - high;
    sums.Linear = high + step * axis.Place[1];
    sums.Quadratic = step * axis.QuadraticWeight[1];
  }
  else
  {
    sums.Linear = value(axis.Offset[1] + axis.Stride);
    sums.Quadratic = {};
  }
  if constexpr (Faces == RT_NO_FACE || Faces == RT_HIGH_FACE)
  {
    const Vector<N> low = value(axis.Offset[0]);
    const Vector<N> step = value(axis.Offset[0] + axis.Stride) - low;
    sums.Linear = sums.Linear - (low + step * axis.Place[0]);
    sums.Quadratic = sums.Quadratic - step * axis.QuadraticWeight[0];
  }
  return sums;
}

// The sums in 1D, where a node has {E, E_0}: the node below a side is at [0] and [1], the one above
// it at [2] and [3].
RT_INLINE void sumBox(const TableView<1>& tables, BoxLanes<1>& boxes, int lane)
{
  const double* nodes = tables.Levels[boxes.Level[lane]].Nodes;
  const BoxAxis axis = boxAxis<1>(boxes, 0, lane, TableView<1>::Record);
  const std::int64_t faces = boxes.Faces[lane];
  const double* high = nodes + axis.Offset[1];
  double mass = high[2];
  double moment = high[3];
  if (!(faces & RT_HIGH_FACE))
  {
    const double step = high[2] - high[0];
    mass = high[0] + step * axis.Place[1];
    moment = (high[1] + (high[3] - high[1]) * axis.Place[1]) + step * axis.QuadraticWeight[1];
  }
  if (!(faces & RT_LOW_FACE))
  {
    const double* low = nodes + axis.Offset[0];
    const double step = low[2] - low[0];
    mass -= low[0] + step * axis.Place[0];
    moment -= (low[1] + (low[3] - low[1]) * axis.Place[0]) + step * axis.QuadraticWeight[0];
  }
  boxes.Mass[lane] = mass;
  boxes.Moment[0][lane] = moment;
}

// All levels alike: with the Q of both axes.
RT_INLINE void sumBox(const TableView<2>& tables, BoxLanes<2>& boxes, int lane)
{
  const auto& level = tables.Levels[boxes.Level[lane]];
  dispatchFaces(
    boxes.Faces[lane], [&](auto faces1, auto fromLowFace) __attribute__((always_inline)) {
      const BoxAxis axis0 = boxAxis<2>(boxes, 0, lane, TableView<2>::Record);
      const BoxAxis axis1 = boxAxis<2>(boxes, 1, lane, level.Stride[1]);
      sumBox2D(level.Nodes, &axis0, &axis1, fromLowFace.Value, faces1.Value, &boxes.Mass[lane],
        &boxes.Moment[0][lane], &boxes.Moment[1][lane]);
    });
}

// In 3D processors have a text of their own: in that of devices (Shared/BoxMoments3D.h), GCC keeps
// more values alive than there are registers.

// One axis other than 0 of a box on the finest level. There is no Q: each entry of a record has a
// linear weight of its own, q for the moment along this axis and r for the others.
struct FineAxis
{
  Vector4 Weights[2]; // weights of the sides' second nodes
  std::int64_t Offset[2];
  std::int64_t Stride;
};

// Entry 1 + Axis of a record is the moment along the axis.
template <int Axis>
RT_INLINE FineAxis fineAxis(const BoxLanes<3>& boxes, int lane, std::int64_t stride)
{
  const auto weights = [&](int side) __attribute__((always_inline))
  {
    return fillVector<Axis + 1>(
      boxes.Place[Axis][side][lane], boxes.MomentWeight[Axis][side][lane]);
  };
  return { { weights(0), weights(1) },
    { boxes.Node[Axis][0][lane] * stride, boxes.Node[Axis][1][lane] * stride }, stride };
}

// The record at one side of a box.
template <class Value>
RT_INLINE Vector4 interpolate(const FineAxis& axis, int side, const Value& value)
{
  const Vector4 first = value(axis.Offset[side]);
  return first + (value(axis.Offset[side] + axis.Stride) - first) * axis.Weights[side];
}

// The difference of both sides.
template <class Value>
RT_INLINE Vector4 sumFineAxis(const FineAxis& axis, std::int64_t faces, const Value& value)
{
  const Vector4 high =
    faces & RT_HIGH_FACE ? value(axis.Offset[1] + axis.Stride) : interpolate(axis, 1, value);
  return faces & RT_LOW_FACE ? high : high - interpolate(axis, 0, value);
}

// The sums in 3D on the finest level. A box reads 4 rows of nodes for each side of axes 1 and 2,
// and one or two pairs of each row.
template <int Faces1, bool FromLowFace>
RT_INLINE void sumFineBox(const TableView<3>::Level& level, BoxLanes<3>& boxes, int lane)
{
  const double* low = level.Nodes + boxes.Node[0][0][lane] * TableView<3>::Record;
  const double* high = level.Nodes + boxes.Node[0][1][lane] * TableView<3>::Record;
  const FineAxis axis1 = fineAxis<1>(boxes, lane, level.Stride[1]);
  const FineAxis axis2 = fineAxis<2>(boxes, lane, level.Stride[2]);
  const auto weights = [&](int side) __attribute__((always_inline))
  {
    const Vector4 second =
      fillVector<1>(boxes.Place[0][side][lane], boxes.MomentWeight[0][side][lane]);
    return joinVectors(fillVector(1.0) - second, second);
  };
  const Vector8 highWeights = weights(1);
  const Vector8 lowWeights = FromLowFace ? Vector8{} : weights(0);
  const Vector4 sums = sumFineAxis(
    axis2,
    boxes.Faces[lane] >> facesShift(2), [&](std::int64_t plane) __attribute__((always_inline)) {
      return sumFineAxis(
        axis1, Faces1, [&](std::int64_t row) __attribute__((always_inline)) {
          return sumRow(
            low + plane + row, high + plane + row, FromLowFace, &lowWeights, &highWeights);
        });
    });
  // Each entry has been summed with its own weights: E, E_0, E_1, E_2.
  boxes.Mass[lane] = sums[0];
  for (int axis = 0; axis < 3; ++axis)
  {
    boxes.Moment[axis][lane] = sums[1 + axis];
  }
}

// The sums of a pair of neighbouring nodes along axis 0 over the nodes of the other axes: linear
// along both, or quadratic along one.
struct PairSums
{
  Vector8 Linear;
  Vector8 Quadratic1;
  Vector8 Quadratic2;
};

// The sums at one side of axis 2, from the two planes of nodes around it.
template <int Faces1>
RT_INLINE PairSums sumSide(
  const double* nodes, const BoxAxis& axis1, const BoxAxis& axis2, int side)
{
  const auto plane = [&](std::int64_t offset) __attribute__((always_inline))
  {
    return sumAxis<Faces1, 8>(
      axis1, [&](std::int64_t row) __attribute__((always_inline)) {
        return loadVector<8>(nodes + offset + row);
      });
  };
  const AxisSums<8> first = plane(axis2.Offset[side]);
  const AxisSums<8> second = plane(axis2.Offset[side] + axis2.Stride);
  // L_2 of both sums, and Q_2 of the linear one.
  const Vector8 step = second.Linear - first.Linear;
  return { first.Linear + step * axis2.Place[side],
    first.Quadratic + (second.Quadratic - first.Quadratic) * axis2.Place[side],
    step * axis2.QuadraticWeight[side] };
}

// The sums over both sides of axes 1 and 2.
template <int Faces1>
RT_INLINE PairSums sumPair(
  const double* nodes, const BoxAxis& axis1, const BoxAxis& axis2, std::int64_t faces2)
{
  PairSums sums;
  if (faces2 & RT_HIGH_FACE)
  {
    const AxisSums<8> total = sumAxis<Faces1, 8>(
      axis1, [&](std::int64_t row) __attribute__((always_inline)) {
        return loadVector<8>(nodes + axis2.Offset[1] + axis2.Stride + row);
      });
    sums = { total.Linear, total.Quadratic, {} };
  }
  else
  {
    sums = sumSide<Faces1>(nodes, axis1, axis2, 1);
  }
  if (!(faces2 & RT_LOW_FACE))
  {
    const PairSums low = sumSide<Faces1>(nodes, axis1, axis2, 0);
    sums = { sums.Linear - low.Linear, sums.Quadratic1 - low.Quadratic1,
      sums.Quadratic2 - low.Quadratic2 };
  }
  return sums;
}

// The sums in 3D on a coarse level, where every axis has its Q. Axis 0 comes last, {1 - r, r} of a
// pair: Q_0[E] needs E at both nodes of the pair, before they are added.
template <int Faces1, bool FromLowFace>
RT_INLINE void sumCoarseBox(const TableView<3>::Level& level, BoxLanes<3>& boxes, int lane)
{
  const BoxAxis axis0 = boxAxis<3>(boxes, 0, lane, TableView<3>::Record);
  const BoxAxis axis1 = boxAxis<3>(boxes, 1, lane, level.Stride[1]);
  const BoxAxis axis2 = boxAxis<3>(boxes, 2, lane, level.Stride[2]);
  const std::int64_t faces2 = boxes.Faces[lane] >> facesShift(2);

  PairSums sums = sumPair<Faces1>(level.Nodes + axis0.Offset[1], axis1, axis2, faces2);
  Vector8 weights = joinVectors(fillVector(1.0 - axis0.Place[1]), fillVector(axis0.Place[1]));
  Vector8 linear = sums.Linear * weights;
  Vector8 quadratic1 = sums.Quadratic1 * weights;
  Vector8 quadratic2 = sums.Quadratic2 * weights;
  // Entries 0 and 4 are E at both nodes of the pair.
  double quadratic0 = axis0.QuadraticWeight[1] * (sums.Linear[4] - sums.Linear[0]);
  if constexpr (!FromLowFace)
  {
    sums = sumPair<Faces1>(level.Nodes + axis0.Offset[0], axis1, axis2, faces2);
    weights = joinVectors(fillVector(1.0 - axis0.Place[0]), fillVector(axis0.Place[0]));
    linear = linear - sums.Linear * weights;
    quadratic1 = quadratic1 - sums.Quadratic1 * weights;
    quadratic2 = quadratic2 - sums.Quadratic2 * weights;
    quadratic0 -= axis0.QuadraticWeight[0] * (sums.Linear[4] - sums.Linear[0]);
  }
  // m_a = (L L L) E_a + Q_a E, the halves of a vector being the nodes of the pair.
  boxes.Mass[lane] = linear[0] + linear[4];
  boxes.Moment[0][lane] = (linear[1] + linear[5]) + quadratic0;
  boxes.Moment[1][lane] = (linear[2] + linear[6]) + (quadratic1[0] + quadratic1[4]);
  boxes.Moment[2][lane] = (linear[3] + linear[7]) + (quadratic2[0] + quadratic2[4]);
}

// Boxes on the finest level are summed without Q, those on coarser ones with it.
RT_INLINE void sumBox(const TableView<3>& tables, BoxLanes<3>& boxes, int lane)
{
  const auto& level = tables.Levels[boxes.Level[lane]];
  dispatchFaces(
    boxes.Faces[lane], [&](auto faces1, auto fromLowFace) __attribute__((always_inline)) {
      if (boxes.Level[lane] == 0)
      {
        sumFineBox<faces1.Value, fromLowFace.Value != 0>(level, boxes, lane);
      }
      else
      {
        sumCoarseBox<faces1.Value, fromLowFace.Value != 0>(level, boxes, lane);
      }
    });
}

// Boxes on the finest level have nodes far apart in memory and out of the caches, at addresses
// known before they are summed. In 3D there are so many that prefetching pays only where
// neighbouring lanes' boxes have none in common.
template <int Dimension>
constexpr int prefetchDistance = Dimension == 2 ? 12 : 8;

template <int Dimension>
RT_INLINE bool shouldPrefetch(const TableView<Dimension>& tables, bool sparse)
{
  return tables.BeyondCaches && (Dimension == 2 || sparse);
}

// Prefetches the pairs of nodes along axis 0 around both sides of a box, in the rows and planes
// around its sides along the axes from Axis down.
template <int Dimension, int Axis>
RT_INLINE void prefetchPairs(const TableView<Dimension>& tables, const BoxLanes<Dimension>& boxes,
  int lane, const double* nodes)
{
  if constexpr (Axis == 0)
  {
    constexpr int lastOfPair = 2 * TableView<Dimension>::Record - 1;
    for (int side = 0; side < 2; ++side)
    {
      const double* pair = nodes + boxes.Node[0][side][lane] * TableView<Dimension>::Record;
      __builtin_prefetch(pair);
      __builtin_prefetch(pair + lastOfPair);
    }
  }
  else
  {
    const std::int64_t stride = tables.Levels[0].Stride[Axis];
    for (int side = 0; side < 2; ++side)
    {
      const double* row = nodes + boxes.Node[Axis][side][lane] * stride;
      prefetchPairs<Dimension, Axis - 1>(tables, boxes, lane, row);
      prefetchPairs<Dimension, Axis - 1>(tables, boxes, lane, row + stride);
    }
  }
}

// Sums the boxes of the first `count` lanes, of those that are active if `active` is given.
template <int Dimension, bool All>
__attribute__((noinline)) void sumBoxes(const TableView<Dimension>& tables,
  BoxLanes<Dimension>& boxes, int count, const bool* active, bool sparse)
{
  const bool prefetch = shouldPrefetch(tables, sparse);
  for (int i = 0; i < count; ++i)
  {
    if constexpr (Dimension > 1)
    {
      const int ahead = i + prefetchDistance<Dimension>;
      if (prefetch && ahead < count && boxes.Level[ahead] == 0 && (All || active[ahead]))
      {
        prefetchPairs<Dimension, Dimension - 1>(tables, boxes, ahead, tables.Levels[0].Nodes);
      }
    }
    if (All || active[i])
    {
      sumBox(tables, boxes, i);
    }
  }
}
