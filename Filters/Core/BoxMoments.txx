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

using Lanes = double[BlockSize];

template <int N>
struct Number
{
  static constexpr int Value = N;
};

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

// Offsets of the four nodes of an axis.
RT_INLINE void findOffsets(
  std::int64_t low, std::int64_t high, std::int64_t stride, std::int64_t (&offset)[4])
{
  offset[0] = low * stride;
  offset[1] = offset[0] + stride;
  offset[3] = high * stride;
  offset[2] = offset[3] + stride;
}

RT_INLINE void sumBox(const TableView<1>& tables, BoxLanes<1>& boxes, int lane)
{
  const double* nodes = tables.Levels[boxes.Level[lane]].Nodes;
  std::int64_t offset[4];
  findOffsets(boxes.Low[0][lane], boxes.High[0][lane], TableView<1>::Record, offset);
  double mass = 0.0;
  double moment = 0.0;
  for (int node = boxes.FirstNode[0][lane]; node < boxes.EndNode[0][lane]; ++node)
  {
    const double* record = nodes + offset[node];
    const double weight = boxes.Weight[0][node][lane];
    mass += weight * record[0];
    moment += weight * record[1] + boxes.Quadratic[0][node][lane] * record[0];
  }
  boxes.Mass[lane] = mass;
  boxes.Moment[0][lane] = moment;
}

// In 2D the fourth entry of a record repeats the mass, so that one product with the weights of a
// pair of neighbouring nodes along axis 0 gives the linear sums and the quadratic one of that axis.
template <int Rows, bool BothSides>
RT_INLINE void sumRows2D(const double* low, const double* high, Vector8 lowWeights,
  Vector8 highWeights, const std::int64_t* offset, const double* weight, const double* quadratic,
  Vector8& linear, Vector8& bent)
{
  for (int row = 0; row < Rows; ++row)
  {
    Vector8 sum = loadVector(high + offset[row]) * highWeights;
    if constexpr (BothSides)
    {
      sum = sum + loadVector(low + offset[row]) * lowWeights;
    }
    const double w = weight[row * BlockSize];
    const double q = quadratic[row * BlockSize];
    linear = row == 0 ? sum * w : linear + sum * w;
    bent = row == 0 ? sum * q : bent + sum * q;
  }
}

RT_INLINE void sumBox(const TableView<2>& tables, BoxLanes<2>& boxes, int lane)
{
  const auto& level = tables.Levels[boxes.Level[lane]];
  std::int64_t offset[4];
  findOffsets(boxes.Low[1][lane], boxes.High[1][lane], level.Stride[1], offset);
  const int first = boxes.FirstNode[1][lane];
  const int rows = boxes.EndNode[1][lane] - first;
  const double* weight = &boxes.Weight[1][first][lane];
  const double* quadratic = &boxes.Quadratic[1][first][lane];
  const double* low = level.Nodes + std::int64_t{ boxes.Low[0][lane] } * 4;
  const double* high = level.Nodes + std::int64_t{ boxes.High[0][lane] } * 4;

  // {1-r, 1-r, 1-r, q, r, r, r, -q} with r and q of the high side, and the negative of that with
  // those of the low side.
  alignas(64) static constexpr double ones[8] = { 1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
  alignas(64) static constexpr double places[8] = { -1.0, -1.0, -1.0, 0.0, 1.0, 1.0, 1.0, 0.0 };
  alignas(64) static constexpr double bends[8] = { 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -1.0 };
  const Vector8 one = loadVector(ones);
  const Vector8 place = loadVector(places);
  const Vector8 bend = loadVector(bends);
  const Vector8 highWeights =
    (one + place * boxes.Weight[0][2][lane]) + bend * boxes.Quadratic[0][3][lane];
  const Vector8 lowWeights =
    (place * boxes.Weight[0][1][lane] - one) + bend * boxes.Quadratic[0][0][lane];

  Vector8 linear;
  Vector8 bent;
  const auto sum = [&](auto rowCount, auto bothSides) __attribute__((always_inline)) {
    sumRows2D<decltype(rowCount)::Value, decltype(bothSides)::Value>(low, high, lowWeights,
      highWeights, offset + first, weight, quadratic, linear, bent);
  };
  const auto sumAll = [&](auto bothSides) __attribute__((always_inline)) {
    switch (rows)
    {
      case 1:
        sum(Number<1>{}, bothSides);
        break;
      case 2:
        sum(Number<2>{}, bothSides);
        break;
      case 3:
        sum(Number<3>{}, bothSides);
        break;
      default:
        sum(Number<4>{}, bothSides);
        break;
    }
  };
  if (boxes.FirstNode[0][lane] == 0)
  {
    sumAll(Number<1>{});
  }
  else
  {
    sumAll(Number<0>{});
  }
  boxes.Mass[lane] = linear[0] + linear[4];
  boxes.Moment[0][lane] = (linear[1] + linear[5]) + (linear[3] + linear[7]);
  boxes.Moment[1][lane] = (linear[2] + linear[6]) + (bent[0] + bent[4]);
}

// The sums of a pair of neighbouring nodes along axis 0 over the nodes of the other axes: linear
// along both, or quadratic along one.
struct PairSums
{
  Vector8 Linear;
  Vector8 Bent1;
  Vector8 Bent2;
};

template <int Rows>
RT_INLINE PairSums sumPair(const double* nodes, const BoxLanes<3>& boxes, int lane,
  const std::int64_t (&rowOffset)[4], const std::int64_t (&planeOffset)[4])
{
  const int firstRow = boxes.FirstNode[1][lane];
  const int firstPlane = boxes.FirstNode[2][lane];
  const int endPlane = boxes.EndNode[2][lane];
  const double* weight = &boxes.Weight[1][firstRow][lane];
  const double* quadratic = &boxes.Quadratic[1][firstRow][lane];
  const Vector8 zero = fillVector(0.0, 0.0);
  PairSums sums = { zero, zero, zero };
  for (int plane = firstPlane; plane < endPlane; ++plane)
  {
    const double* rows = nodes + planeOffset[plane];
    Vector8 linear;
    Vector8 bent;
    for (int row = 0; row < Rows; ++row)
    {
      const Vector8 pair = loadVector(rows + rowOffset[firstRow + row]);
      const double w = weight[row * BlockSize];
      const double q = quadratic[row * BlockSize];
      linear = row == 0 ? pair * w : linear + pair * w;
      bent = row == 0 ? pair * q : bent + pair * q;
    }
    const double w = boxes.Weight[2][plane][lane];
    const double q = boxes.Quadratic[2][plane][lane];
    sums.Linear = sums.Linear + linear * w;
    sums.Bent1 = sums.Bent1 + bent * w;
    sums.Bent2 = sums.Bent2 + linear * q;
  }
  return sums;
}

template <int Rows>
RT_INLINE void sumBox3D(const TableView<3>::Level& level, BoxLanes<3>& boxes, int lane)
{
  std::int64_t rowOffset[4];
  std::int64_t planeOffset[4];
  findOffsets(boxes.Low[1][lane], boxes.High[1][lane], level.Stride[1], rowOffset);
  findOffsets(boxes.Low[2][lane], boxes.High[2][lane], level.Stride[2], planeOffset);

  const Vector8 weights = fillVector(boxes.Weight[0][3][lane], boxes.Weight[0][2][lane]);
  const double bend = boxes.Quadratic[0][3][lane];
  PairSums sums = sumPair<Rows>(level.Nodes + std::int64_t{ boxes.High[0][lane] } * 4, boxes, lane,
    rowOffset, planeOffset);
  Vector8 linear = sums.Linear * weights;
  Vector8 bent1 = sums.Bent1 * weights;
  Vector8 bent2 = sums.Bent2 * weights;
  double bent0 = bend * (sums.Linear[0] - sums.Linear[4]);
  if (boxes.FirstNode[0][lane] == 0)
  {
    const Vector8 lowWeights = fillVector(boxes.Weight[0][0][lane], boxes.Weight[0][1][lane]);
    const double lowBend = boxes.Quadratic[0][0][lane];
    sums = sumPair<Rows>(level.Nodes + std::int64_t{ boxes.Low[0][lane] } * 4, boxes, lane,
      rowOffset, planeOffset);
    linear = linear + sums.Linear * lowWeights;
    bent1 = bent1 + sums.Bent1 * lowWeights;
    bent2 = bent2 + sums.Bent2 * lowWeights;
    bent0 += lowBend * (sums.Linear[0] - sums.Linear[4]);
  }
  boxes.Mass[lane] = linear[0] + linear[4];
  boxes.Moment[0][lane] = (linear[1] + linear[5]) + bent0;
  boxes.Moment[1][lane] = (linear[2] + linear[6]) + (bent1[0] + bent1[4]);
  boxes.Moment[2][lane] = (linear[3] + linear[7]) + (bent2[0] + bent2[4]);
}

RT_INLINE void sumBox(const TableView<3>& tables, BoxLanes<3>& boxes, int lane)
{
  const auto& level = tables.Levels[boxes.Level[lane]];
  switch (boxes.EndNode[1][lane] - boxes.FirstNode[1][lane])
  {
    case 1:
      sumBox3D<1>(level, boxes, lane);
      break;
    case 2:
      sumBox3D<2>(level, boxes, lane);
      break;
    case 3:
      sumBox3D<3>(level, boxes, lane);
      break;
    default:
      sumBox3D<4>(level, boxes, lane);
      break;
  }
}

// Boxes on the finest level are the ones whose nodes are far apart in memory and not yet in the
// caches; their addresses are known well before they are summed.
constexpr int prefetchDistance = 3;

template <int Dimension>
RT_INLINE void prefetchBox(
  const TableView<Dimension>& tables, const BoxLanes<Dimension>& boxes, int lane)
{
  if constexpr (Dimension == 2)
  {
    if (boxes.Level[lane] != 0)
    {
      return;
    }
    const auto& level = tables.Levels[0];
    std::int64_t offset[4];
    findOffsets(boxes.Low[1][lane], boxes.High[1][lane], level.Stride[1], offset);
    const double* low = level.Nodes + std::int64_t{ boxes.Low[0][lane] } * 4;
    const double* high = level.Nodes + std::int64_t{ boxes.High[0][lane] } * 4;
    for (const std::int64_t row : offset)
    {
      __builtin_prefetch(low + row);
      __builtin_prefetch(low + row + 7);
      __builtin_prefetch(high + row);
      __builtin_prefetch(high + row + 7);
    }
  }
}
