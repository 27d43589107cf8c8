// SPDX-License-Identifier: BSD-3-Clause
// The way back of the multistep method, from the density to the uniform measure (Section 4.2): the
// same flow from time 1 to 0, in the steps t_k = 1 - G_k of [0, 1]. Where straight starts end is
// not known before, so that all particles have these times. A path ends where its box has become
// the whole domain: its seed follows in closed form. Included by FlowKernels.txx.

// Whether a lane's box is the whole domain.
template <int Dimension>
RT_INLINE bool isBoxWhole(
  const FlowJob<Dimension>& job, const LaneVectors<Dimension>& x, int lane, double t)
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    if (!isWhole(x[axis][lane], t, job.Tables.Size[axis]))
    {
      return false;
    }
  }
  return true;
}

// A coordinate of the seed of a particle whose box is the whole domain at time t.
template <int Dimension>
RT_INLINE double seedOf(
  const FlowJob<Dimension>& job, const LaneVectors<Dimension>& x, int lane, double t, int axis)
{
  return seedOfStraight(x[axis][lane], t, job.Tables.Size[axis], job.Tables.Centroid[axis]);
}

// Writes the seed of a lane to the place `index` of the output.
template <int Dimension>
RT_INLINE void writeSeed(const FlowJob<Dimension>& job, const LaneVectors<Dimension>& x, int lane,
  double t, std::int64_t index)
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    job.Output[index * Dimension + axis] = seedOf<Dimension>(job, x, lane, t, axis);
  }
}

// Lanes at a level's time whose cell of its lattice is good: the seeds of their positions are
// interpolated. Writes them, and marks the lanes as done.
template <int Dimension, class Write>
void finishFromMap(const FlowMapLevel<Dimension>& level, int count,
  const LaneVectors<Dimension>& positions, bool* active, int& left, const Write& write)
{
  constexpr int record = FlowMapLevel<Dimension>::BackwardRecord;
  StencilLanes<Dimension> stencils;
  findStencils<Dimension>(level, positions, stencils);
  RecordInterpolation<record, Dimension> interpolate(level, positions, stencils);
  for (int i = 0; i < count; ++i)
  {
    if (active[i] && isGood<Dimension>(level, stencils, i))
    {
      const Vector<record, float> seed = interpolate(i);
      write(i, [&](int axis) { return smaller(larger(seed[axis], 0.0), level.Axes[axis].Size); });
      active[i] = false;
      --left;
    }
  }
}

// One step of a backward run to `time`: predictor, velocity (at time 0 its limit M - x), corrector.
// The velocity is left in V[0]. Empty boxes do not hold the velocity here (evaluateVelocity).
template <int Dimension>
RT_INLINE void stepBackward(const FlowJob<Dimension>& job, const StepWeights& weights, double time,
  int count, const bool* active, MultistepLanes<Dimension>& lanes)
{
  const auto& v0 = *lanes.V[0];
  const auto& v1 = *lanes.V[1];
  auto& newest = *lanes.V[3];
  lanes.Advance(job, weights.Predictor, weights.Length, v0, v1, *lanes.V[2], lanes.Trial);
  if (time <= 0.0)
  {
    initialVelocity<Dimension>(job, lanes.Trial, newest);
  }
  else
  {
#pragma omp simd
    for (int i = 0; i < BlockSize; ++i)
    {
      lanes.Time[i] = time;
    }
    evaluateVelocity<Dimension>(
      job, lanes.Field, count, lanes.Trial, lanes.Time, v0, newest, active);
  }
  lanes.Advance(job, weights.Corrector, weights.Length, newest, v0, v1, lanes.Position);
  lanes.Rotate();
}

// Lanes whose box is the whole domain at `time`: their seed is known in closed form. Writes it, and
// marks the lanes as done.
template <int Dimension, class Write>
RT_INLINE void finishStraight(const FlowJob<Dimension>& job, int count,
  const LaneVectors<Dimension>& x, double time, bool* active, int& left, const Write& write)
{
  for (int i = 0; i < count; ++i)
  {
    if (active[i] && (time <= 0.0 || isBoxWhole<Dimension>(job, x, i, time)))
    {
      write(i, [&](int axis) { return seedOf<Dimension>(job, x, i, time, axis); });
      active[i] = false;
      --left;
    }
  }
}

// Time 1 to 0 over the reversed graded steps of [0,1]; a particle is done once the flow map, if
// there is one, gives its seed, or its box is the whole domain. If level l leaves less than half of
// a block in pass -1 - l, that is unresolved: it takes less time with what is left of other blocks.
template <int Dimension>
std::int64_t multistepBackward(const FlowJob<Dimension>& job, const double* seeds,
  const std::int64_t* index, int count, int pass, bool* unresolved)
{
  MultistepLanes<Dimension> lanes;
  loadPositions<Dimension>(job, seeds, count, lanes.Position);
  finalVelocity<Dimension>(job, lanes.Position, *lanes.V[0]);
  // Lanes that are not at their seed yet, and how many of them hold a particle.
  bool active[BlockSize];
  for (bool& lane : active)
  {
    lane = true;
  }
  int left = count;
#pragma omp simd
  for (int i = 0; i < BlockSize; ++i)
  {
    lanes.Span[i] = -1.0;
  }
  const auto write = [&](int lane, const auto& coordinate) {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      job.Output[index[lane] * Dimension + axis] = coordinate(axis);
    }
  };

  // The level of the map that comes next, the finest first: -1 if there is none.
  int level = job.Map ? job.Map->LevelCount - 1 : -1;
  const RunWeights<Dimension> run =
    job.Map ? RunWeights<Dimension>(*job.Map) : RunWeights<Dimension>(job, 0);
  std::int64_t evaluations = 0;
  for (std::int64_t step = 0; step < run.Steps && left > 0; ++step)
  {
    if (shouldStop<Dimension>(job, step))
    {
      return evaluations;
    }
    const StepWeights weights = run[step];
    // The last step ends at 0, whatever the rounding of G.
    const double time = step + 1 == run.Steps ? 0.0 : 1.0 - weights.Time;
    stepBackward<Dimension>(job, weights, time, count, active, lanes);
    evaluations += time > 0.0 ? left : 0;
    // The step ends at the time of a level, whose lattice gives seeds.
    if (level >= 0 && step + 1 == job.Map->Levels[level].HandOver)
    {
      if (job.Map->Levels[level].Records)
      {
        finishFromMap<Dimension>(
          job.Map->Levels[level], count, lanes.Position, active, left, write);
      }
      if (job.StopsAtMap)
      {
        for (int i = 0; i < count; ++i)
        {
          if (active[i])
          {
            write(i, [&](int axis) { return lanes.Position[axis][i]; });
          }
        }
      }
      if (job.StopsAtMap || (level == -1 - pass && 2 * left < count))
      {
        std::memcpy(unresolved, active, static_cast<std::size_t>(count) * sizeof(bool));
        return evaluations;
      }
      --level;
    }
    finishStraight<Dimension>(job, count, lanes.Position, time, active, left, write);
  }
  return evaluations;
}
