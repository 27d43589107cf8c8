// SPDX-License-Identifier: BSD-3-Clause
// Interpolation of a flow map by cubics through four nodes an axis: Lagrange polynomials of the
// place of a particle in the lattice, tensor products of those of the axes. Weights and records are
// floats: a map's error is far above their rounding, and half of the memory is read. Included by
// FlowKernels.txx.

// Where the particles of a block lie in a lattice.
template <int Dimension>
struct StencilLanes
{
  alignas(64) float Weights[Dimension][4][BlockSize];   // for the four nodes of each axis
  alignas(64) std::int32_t First[Dimension][BlockSize]; // number of the first of the four nodes
  alignas(64) std::int32_t Cell[Dimension][BlockSize];  // the lattice's, that the particle is in
};

// The four nodes around each particle; next to the ends of an axis, its first or last four.
template <int Dimension>
RT_INLINE void findStencils(const FlowMapLevel<Dimension>& level,
  const LaneVectors<Dimension>& positions, StencilLanes<Dimension>& stencils)
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const LatticeAxis nodes = level.Axes[axis];
    const double* position = positions[axis];
    const auto last = static_cast<double>(nodes.Cells - 1);
    std::int32_t* cells = stencils.Cell[axis];
    std::int32_t* firsts = stencils.First[axis];
    float(*weights)[BlockSize] = stencils.Weights[axis];
#pragma omp simd
    for (int i = 0; i < BlockSize; ++i)
    {
      findStencil(position[i], nodes.Size, nodes.Layer, nodes.Length, nodes.InverseSpacing, last,
        &cells[i], &firsts[i], &weights[0][i], &weights[1][i], &weights[2][i], &weights[3][i]);
    }
  }
}

// Whether the cell of a lane may be interpolated.
template <int Dimension>
RT_INLINE bool isGood(
  const FlowMapLevel<Dimension>& level, const StencilLanes<Dimension>& stencils, int lane)
{
  std::int64_t cell = 0;
  for (int axis = Dimension; axis-- > 0;)
  {
    cell = cell * level.Axes[axis].Cells + stencils.Cell[axis][lane];
  }
  return level.Bad[cell] == 0;
}

// The interpolant along one axis, where record(k) is that of node k.
template <int N, class RecordAt>
RT_INLINE Vector<N, float> sumNodes(
  const float (&weights)[4][BlockSize], int lane, const RecordAt& record)
{
  return (record(0) * weights[0][lane] + record(1) * weights[1][lane]) +
    (record(2) * weights[2][lane] + record(3) * weights[3][lane]);
}

// Interpolates records of N floats, axis by axis, axis 0 last. Where consecutive lanes differ along
// axis 0 alone, as those of a lattice of particles do, they share what was summed along the others.
template <int N, int Dimension>
class RecordInterpolation
{
public:
  // The records are `record` floats apart.
  RecordInterpolation(const FlowMapLevel<Dimension>& level, const LaneVectors<Dimension>& positions,
    const StencilLanes<Dimension>& stencils, int record = N)
    : Level(level)
    , Stencils(stencils)
  {
    // The strides of nodes along each axis.
    std::int64_t stride = record;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      this->Strides[axis] = stride;
      stride *= level.Axes[axis].Cells + 1;
    }
    // Equal places along all axes but 0 have equal weights and nodes there. Comparing positions for
    // equality is right: lanes of a lattice have the same bits.
    this->SharesRow[0] = false;
    for (int i = 1; i < BlockSize; ++i)
    {
      this->SharesRow[i] = true;
      for (int axis = 1; axis < Dimension; ++axis)
      {
        this->SharesRow[i] = this->SharesRow[i] && positions[axis][i] == positions[axis][i - 1];
      }
    }
  }

  // The record at the place of a lane; fastest in ascending order of lanes.
  RT_INLINE Vector<N, float> operator()(int lane)
  {
    // A column is the record at one node of axis 0, interpolated along all other axes. Of the lane
    // before, those are taken over that both have.
    const std::int32_t first = this->Stencils.First[0][lane];
    const std::int32_t shift = first - this->First;
    int kept = 0;
    if (lane == this->Last + 1 && this->SharesRow[lane] && shift >= 0 && shift < 4)
    {
      kept = 4 - shift;
      for (int k = 0; k < kept; ++k)
      {
        this->Columns[k] = this->Columns[k + shift];
      }
    }
    // The first of the 4^d nodes.
    std::int64_t start = first * this->Strides[0];
    for (int axis = 1; axis < Dimension; ++axis)
    {
      start += this->Stencils.First[axis][lane] * this->Strides[axis];
    }
    for (int k = kept; k < 4; ++k)
    {
      this->Columns[k] =
        this->SumAxes<Dimension - 1>(lane, this->Level.Records + start + k * this->Strides[0]);
    }
    this->First = first;
    this->Last = lane;
    return sumNodes<N>(
      this->Stencils.Weights[0],
      lane, [&](int k) __attribute__((always_inline)) { return this->Columns[k]; });
  }

private:
  // Along the last Axis axes, the last of them innermost.
  template <int Axis>
  RT_INLINE Vector<N, float> SumAxes(int lane, const float* record) const
  {
    if constexpr (Axis == 0)
    {
      return loadVector<N>(record);
    }
    else
    {
      return sumNodes<N>(
        this->Stencils.Weights[Dimension - Axis], lane, [&](int k) __attribute__((always_inline)) {
          return this->template SumAxes<Axis - 1>(
            lane, record + k * this->Strides[Dimension - Axis]);
        });
    }
  }

  const FlowMapLevel<Dimension>& Level;
  const StencilLanes<Dimension>& Stencils;
  std::int64_t Strides[Dimension]; // in floats
  bool SharesRow[BlockSize];       // with the lane before
  Vector<N, float> Columns[4];
  std::int32_t First = 0; // number of the first column
  int Last = -2;          // lane
};

// Positions and the last three velocities at a level's time of the particles with the seeds in
// lanes.Position. Lanes whose cell of the lattice is bad, and those from `count` on, are not
// changed, and marked as deferred.
template <int Dimension>
void loadFromMap(const FlowJob<Dimension>& job, const FlowMapLevel<Dimension>& level, int count,
  MultistepLanes<Dimension>& lanes, bool (&deferred)[BlockSize])
{
  constexpr int record = FlowMapLevel<Dimension>::ForwardRecord;
  StencilLanes<Dimension> stencils;
  findStencils<Dimension>(level, lanes.Position, stencils);
  RecordInterpolation<record, Dimension> interpolate(level, lanes.Position, stencils);
  for (int i = 0; i < BlockSize; ++i)
  {
    // Deferred lanes keep their seed; they are computed with the others, but not used.
    deferred[i] = i >= count || !isGood<Dimension>(level, stencils, i);
    if (deferred[i])
    {
      continue;
    }
    const Vector<record, float> state = interpolate(i);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      lanes.Position[axis][i] = clampToDomain(state[axis], job.Tables.Size[axis]);
      for (int k = 0; k < 3; ++k)
      {
        (*lanes.V[k])[axis][i] = state[(k + 1) * Dimension + axis];
      }
    }
  }
}

// The kernel ReadMap of FlowKernels.h: positions alone, the first entries of the records.
template <int Dimension>
void readMap(const FlowJob<Dimension>& job, const FlowMapLevel<Dimension>& level,
  const double* seeds, int count, double* positions, bool* deferred)
{
  constexpr int record = FlowMapLevel<Dimension>::ForwardRecord;
  alignas(64) LaneVectors<Dimension> x;
  loadPositions<Dimension>(job, seeds, count, x);
  StencilLanes<Dimension> stencils;
  findStencils<Dimension>(level, x, stencils);
  RecordInterpolation<4, Dimension> interpolate(level, x, stencils, record);
  for (int i = 0; i < count; ++i)
  {
    deferred[i] = !isGood<Dimension>(level, stencils, i);
    if (!deferred[i])
    {
      const Vector<4, float> state = interpolate(i);
      for (int axis = 0; axis < Dimension; ++axis)
      {
        positions[i * Dimension + axis] = clampToDomain(state[axis], job.Tables.Size[axis]);
      }
    }
  }
}

// The states of particles that are given in place of their seeds: position and three velocities of
// Dimension doubles each. Lanes from `count` on repeat the last one.
template <int Dimension>
void loadStates(
  const FlowJob<Dimension>& job, const double* states, int count, MultistepLanes<Dimension>& lanes)
{
  for (int i = 0; i < BlockSize; ++i)
  {
    const double* state = states + (i < count ? i : count - 1) * 4 * Dimension;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      lanes.Position[axis][i] = clampToDomain(state[axis], job.Tables.Size[axis]);
      for (int k = 0; k < 3; ++k)
      {
        (*lanes.V[k])[axis][i] = state[(k + 1) * Dimension + axis];
      }
    }
  }
}
