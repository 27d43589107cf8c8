// SPDX-License-Identifier: BSD-3-Clause
// Mass and first moments of a density over boxes, from interpolated summed-area tables (paper,
// Section 3.3; Algorithm 1). Included by FlowKernels.txx.
//
// A table is interpolated along its own axis by a quadratic and linearly along the others, which
// is exact for a piecewise-constant density: with r the place in a cell of width h,
//   L[F] = (1-r) F_i + r F_i+1,    Q[F] = -(h/2) r (1-r) (F_i+1 - F_i),
//   E(x) = (L (x) L (x) L) E,      E_a(x) = (L (x) L (x) L) E_a + (Q_a (x) L (x) L) E.
// A box takes four nodes an axis, two at each side. Sides on a face of the domain take none (the
// tables are zero there) or one (they are total).

using Vector4 = double __attribute__((vector_size(32)));
using Vector8 = double __attribute__((vector_size(64)));
using Lanes = double[BlockSize];

// The boxes of a block of particles, as the sums below want them, and what they return.
template <int Dimension>
struct BoxLanes
{
  // Nodes of an axis in the order low side, low side + 1, high side + 1, high side; the sides on a
  // face drop out at the ends.
  alignas(64) double Weight[Dimension][4][BlockSize];
  alignas(64) double Quadratic[Dimension][4][BlockSize];
  alignas(64) std::int32_t Low[Dimension][BlockSize];
  alignas(64) std::int32_t High[Dimension][BlockSize];
  alignas(64) std::int32_t FirstNode[Dimension][BlockSize];
  alignas(64) std::int32_t EndNode[Dimension][BlockSize];
  alignas(64) std::int32_t Level[BlockSize];

  alignas(64) Lanes Mass;
  alignas(64) double Moment[Dimension][BlockSize];
};

// Two neighbouring nodes along axis 0.
template <int Dimension>
RT_INLINE Vector8 loadNodes(const double* node)
{
  Vector8 pair;
  if constexpr (Dimension == 1)
  {
    // {E, E_0} twice: spread to the layout of the higher dimensions.
    pair = Vector8{ node[0], node[1], 0.0, 0.0, node[2], node[3], 0.0, 0.0 };
  }
  else
  {
    std::memcpy(&pair, node, sizeof(pair));
  }
  return pair;
}

struct RowSums
{
  Vector8 Linear;
  Vector8 Quadratic;
};

// Sums over the nodes of axis 1.
template <int Dimension, int Rows>
RT_INLINE RowSums sumRows(
  const double* plane, const std::int64_t* offset, const double* weight, const double* quadratic)
{
  const Vector8 first = loadNodes<Dimension>(plane + offset[0]);
  RowSums sums{ first * weight[0], first * quadratic[0] };
  for (int row = 1; row < Rows; ++row)
  {
    const Vector8 nodes = loadNodes<Dimension>(plane + offset[row]);
    sums.Linear += nodes * weight[row * BlockSize];
    sums.Quadratic += nodes * quadratic[row * BlockSize];
  }
  return sums;
}

// Sums over the nodes of axes 1 and up of two neighbouring nodes along axis 0: linear along all
// of them, or quadratic along one.
template <int Dimension>
struct PairSums
{
  Vector8 Linear;
  Vector8 Quadratic[Dimension]; // [0] is not used
};

template <int Dimension>
struct NodeOffsets
{
  std::int64_t Of[Dimension][4];
  int First[Dimension];
  int Count[Dimension];
};

template <int Dimension, int Rows>
RT_INLINE void sumPlanes(PairSums<Dimension>& sums, const BoxLanes<Dimension>& boxes, int lane,
  const double* nodes, const NodeOffsets<Dimension>& offsets)
{
  const int firstRow = offsets.First[1];
  const std::int64_t* rows = offsets.Of[1] + firstRow;
  const double* weight = &boxes.Weight[1][firstRow][lane];
  const double* quadratic = &boxes.Quadratic[1][firstRow][lane];
  if constexpr (Dimension == 2)
  {
    const RowSums row = sumRows<Dimension, Rows>(nodes, rows, weight, quadratic);
    sums.Linear = row.Linear;
    sums.Quadratic[1] = row.Quadratic;
  }
  else
  {
    const int first = offsets.First[2];
    const int end = first + offsets.Count[2];
    RowSums row = sumRows<Dimension, Rows>(nodes + offsets.Of[2][first], rows, weight, quadratic);
    double w = boxes.Weight[2][first][lane];
    double q = boxes.Quadratic[2][first][lane];
    sums.Linear = row.Linear * w;
    sums.Quadratic[1] = row.Quadratic * w;
    sums.Quadratic[2] = row.Linear * q;
    for (int plane = first + 1; plane < end; ++plane)
    {
      row = sumRows<Dimension, Rows>(nodes + offsets.Of[2][plane], rows, weight, quadratic);
      w = boxes.Weight[2][plane][lane];
      q = boxes.Quadratic[2][plane][lane];
      sums.Linear += row.Linear * w;
      sums.Quadratic[1] += row.Quadratic * w;
      sums.Quadratic[2] += row.Linear * q;
    }
  }
}

template <int Dimension>
RT_INLINE PairSums<Dimension> sumPair(const BoxLanes<Dimension>& boxes, int lane,
  const double* nodes, const NodeOffsets<Dimension>& offsets)
{
  PairSums<Dimension> sums;
  if constexpr (Dimension == 1)
  {
    sums.Linear = loadNodes<Dimension>(nodes);
  }
  else
  {
    switch (offsets.Count[1])
    {
      case 1:
        sumPlanes<Dimension, 1>(sums, boxes, lane, nodes, offsets);
        break;
      case 2:
        sumPlanes<Dimension, 2>(sums, boxes, lane, nodes, offsets);
        break;
      case 3:
        sumPlanes<Dimension, 3>(sums, boxes, lane, nodes, offsets);
        break;
      default:
        sumPlanes<Dimension, 4>(sums, boxes, lane, nodes, offsets);
        break;
    }
  }
  return sums;
}

// Both nodes of a pair, weighted; record entry 0 (the mass) of each.
RT_INLINE double weighMass(Vector8 pair, double first, double second)
{
  return pair[0] * first + pair[4] * second;
}

RT_INLINE Vector8 spread(double first, double second)
{
  return Vector8{ first, first, first, first, second, second, second, second };
}

// The sums of one particle's box.
template <int Dimension>
RT_INLINE void sumBox(const TableView<Dimension>& tables, BoxLanes<Dimension>& boxes, int lane)
{
  const auto& level = tables.Levels[boxes.Level[lane]];
  NodeOffsets<Dimension> offsets;
  for (int axis = 1; axis < Dimension; ++axis)
  {
    std::int64_t* of = offsets.Of[axis];
    of[0] = boxes.Low[axis][lane] * level.Stride[axis];
    of[1] = of[0] + level.Stride[axis];
    of[3] = boxes.High[axis][lane] * level.Stride[axis];
    of[2] = of[3] + level.Stride[axis];
    offsets.First[axis] = boxes.FirstNode[axis][lane];
    offsets.Count[axis] = boxes.EndNode[axis][lane] - boxes.FirstNode[axis][lane];
  }
  constexpr std::int64_t record = TableView<Dimension>::Record;

  const double high[2] = { boxes.Weight[0][3][lane], boxes.Weight[0][2][lane] };
  const double quadratic = boxes.Quadratic[0][3][lane];
  const PairSums<Dimension> highSums =
    sumPair<Dimension>(boxes, lane, level.Nodes + boxes.High[0][lane] * record, offsets);
  Vector8 total = highSums.Linear * spread(high[0], high[1]);
  double correction[Dimension];
  correction[0] = weighMass(highSums.Linear, quadratic, -quadratic);
  for (int axis = 1; axis < Dimension; ++axis)
  {
    correction[axis] = weighMass(highSums.Quadratic[axis], high[0], high[1]);
  }

  if (boxes.FirstNode[0][lane] == 0)
  {
    const double low[2] = { boxes.Weight[0][0][lane], boxes.Weight[0][1][lane] };
    const double lowQuadratic = boxes.Quadratic[0][0][lane];
    const PairSums<Dimension> lowSums =
      sumPair<Dimension>(boxes, lane, level.Nodes + boxes.Low[0][lane] * record, offsets);
    total += lowSums.Linear * spread(low[0], low[1]);
    correction[0] += weighMass(lowSums.Linear, lowQuadratic, -lowQuadratic);
    for (int axis = 1; axis < Dimension; ++axis)
    {
      correction[axis] += weighMass(lowSums.Quadratic[axis], low[0], low[1]);
    }
  }

  boxes.Mass[lane] = total[0] + total[4];
  for (int axis = 0; axis < Dimension; ++axis)
  {
    boxes.Moment[axis][lane] = (total[1 + axis] + total[5 + axis]) + correction[axis];
  }
}
