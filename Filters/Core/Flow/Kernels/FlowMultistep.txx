// SPDX-License-Identifier: BSD-3-Clause
// Graded Adams-Bashforth-Moulton 3 (PEC). Included by FlowKernels.txx.

// v(x, 1) = x - S/2.
template <int Dimension>
RT_INLINE void finalVelocity(
  const FlowJob<Dimension>& job, const LaneVectors<Dimension>& x, LaneVectors<Dimension>& v)
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double half = 0.5 * job.Tables.Size[axis];
#pragma omp simd
    for (int i = 0; i < BlockSize; ++i)
    {
      v[axis][i] = x[axis][i] - half;
    }
  }
}

// v(x, 0) = M - x.
template <int Dimension>
RT_INLINE void initialVelocity(
  const FlowJob<Dimension>& job, const LaneVectors<Dimension>& x, LaneVectors<Dimension>& v)
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double centroid = job.Tables.Centroid[axis];
#pragma omp simd
    for (int i = 0; i < BlockSize; ++i)
    {
      v[axis][i] = centroid - x[axis][i];
    }
  }
}

// The weights of a run of `steps` steps: a look-up where they are those of the job.
template <int Dimension>
class RunWeights
{
public:
  RunWeights(const FlowJob<Dimension>& job, int pass)
    : Steps(pass > 0 ? job.Steps << pass : job.Steps)
    , Known(pass > 0 ? nullptr : job.Weights)
  {
  }
  // Of particles that hand over.
  explicit RunWeights(const FlowMapView<Dimension>& map)
    : Steps(map.Steps)
    , Known(map.Weights)
  {
  }

  StepWeights operator[](std::int64_t step) const
  {
    return this->Known ? this->Known[step] : multistepWeights(step, this->Steps);
  }

  const std::int64_t Steps;

private:
  const StepWeights* Known;
};

// Takes the positions of the lanes to the end of a step: predictor, velocity there (left in V[3]),
// and whether the box was empty. Lanes that are done have no velocity.
template <int Dimension>
RT_INLINE void predictStep(const FlowJob<Dimension>& job, const StepWeights& weights,
  const Lanes& start, int count, const bool* active, MultistepLanes<Dimension>& lanes)
{
  const auto& v0 = *lanes.V[0];
  lanes.Advance(job, weights.Predictor, weights.Length, v0, *lanes.V[1], *lanes.V[2], lanes.Trial);
#pragma omp simd
  for (int i = 0; i < BlockSize; ++i)
  {
    lanes.Time[i] = start[i] + lanes.Span[i] * weights.Time;
  }
  evaluateVelocity<Dimension>(
    job, lanes.Field, count, lanes.Trial, lanes.Time, v0, *lanes.V[3], active);
}

// Time 0 to 1 by graded Adams-Bashforth-Moulton 3 (PEC), from the end of the straight start, or in
// a pass before 0 from a level of the flow map. The last step is implicit and closed, as the
// velocity at time 1 is x - S/2.
template <int Dimension>
std::int64_t multistepForward(const FlowJob<Dimension>& job, const double* seeds,
  const std::int64_t* index, int count, int pass, bool* unresolved)
{
  MultistepLanes<Dimension> lanes;
  PathWriter<Dimension> writer(job, seeds, index, count);
  PlateauLanes<Dimension> plateau;
  alignas(64) Lanes start;
  const bool fromStates = pass < 0 && job.FromStates;
  if (!fromStates)
  {
    loadPositions<Dimension>(job, seeds, count, lanes.Position);
  }
  const RunWeights<Dimension> run =
    pass < 0 ? RunWeights<Dimension>(*job.Map) : RunWeights<Dimension>(job, pass);
  const std::int64_t steps = run.Steps;
  std::int64_t step = 0;
  bool deferred[BlockSize] = {};
  if (pass < 0)
  {
    const FlowMapLevel<Dimension>& level = job.Map->Levels[-1 - pass];
    if (fromStates)
    {
      loadStates<Dimension>(job, seeds, count, lanes);
    }
    else
    {
      loadFromMap<Dimension>(job, level, count, lanes, deferred);
    }
    plateau.Exclude(deferred);
    step = steps - level.HandOver;
    const double handOver = commonStart + (1.0 - commonStart) * run[step - 1].Time;
#pragma omp simd
    for (int i = 0; i < BlockSize; ++i)
    {
      start[i] = commonStart;
      lanes.Time[i] = handOver;
    }
  }
  else
  {
    startStraight<Dimension>(job, lanes.Position, *lanes.V[0], start);
    if (writer.IsDense())
    {
      writer.WriteStraight(*lanes.V[0], start);
    }
#pragma omp simd
    for (int i = 0; i < BlockSize; ++i)
    {
      lanes.Time[i] = start[i];
    }
  }
#pragma omp simd
  for (int i = 0; i < BlockSize; ++i)
  {
    lanes.Span[i] = 1.0 - start[i];
  }

  const bool hasPlateaus = job.Tables.Occupied && !job.Nearest;
  constexpr double leastPart = 1e-3; // of the largest value that others may have
  std::int64_t evaluations = 0;
  for (; step + 1 < steps && plateau.Left > 0; ++step)
  {
    if (shouldStop<Dimension>(job, step))
    {
      return evaluations;
    }
    const StepWeights weights = run[step];
    alignas(64) Lanes before;
    std::memcpy(before, lanes.Time, sizeof(before));
    const bool* active = plateau.Left < BlockSize ? plateau.Active : nullptr;
    predictStep<Dimension>(job, weights, start, count, active, lanes);
    evaluations += plateau.Left < count ? plateau.Left : count;
#pragma omp simd
    for (int i = 0; i < BlockSize; ++i)
    {
      // A box so small that it may count as empty though it is not is no sign of a void; where it
      // is in one, the particle ends in an empty cell.
      double mostMass = leastPart * job.Tables.Largest;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        mostMass *= lanes.Field.To[axis][i] - lanes.Field.From[axis][i];
      }
      const double isVoid = mostMass > job.Tables.VoidMass ? lanes.Field.Void[i] : 0.0;
      const double isWrong = larger(isVoid, lanes.Field.Outside[i]);
      lanes.Unresolved[i] = larger(lanes.Unresolved[i], plateau.Done[i] > 0.0 ? 0.0 : isWrong);
    }
    const auto& v0 = *lanes.V[0];
    const auto& newest = *lanes.V[3];
    if (writer.IsDense())
    {
      std::memcpy(lanes.Trial, lanes.Position, sizeof(lanes.Trial));
    }
    lanes.Advance(job, weights.Corrector, weights.Length, newest, v0, *lanes.V[1], lanes.Position);
    if (writer.IsDense())
    {
      for (int i = 0; i < count; ++i)
      {
        writer.WriteHermite(i, before[i], lanes.Time[i], lanes.Trial, v0, lanes.Position, newest);
      }
    }
    if (hasPlateaus && 3 * step >= steps) // before, boxes are wide
    {
      alignas(64) Lanes found;
      const bool any = plateau.Find(job, lanes.Field, lanes.Position, found);
      for (int i = 0; any && writer.IsDense() && i < count; ++i)
      {
        if (found[i] > 0.0)
        {
          writer.WriteUntil(i, 1.0, [&](double s, int axis) {
            return s * plateau.End[axis][i] + (1.0 - s) * (0.5 * job.Tables.Size[axis]);
          });
        }
      }
    }
    lanes.Rotate();
  }
  for (int i = 0; i < count; ++i)
  {
    unresolved[i] = deferred[i] || lanes.Unresolved[i] > 0.0;
  }

  const StepWeights last = run[steps - 1];
  const double* c = last.Corrector;
  auto& final = *lanes.V[3];
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double half = 0.5 * job.Tables.Size[axis];
#pragma omp simd
    for (int i = 0; i < BlockSize; ++i)
    {
      const double lambda = lanes.Span[i] * last.Length;
      const double known =
        c[1] * (*lanes.V[0])[axis][i] + c[2] * (*lanes.V[1])[axis][i] - c[0] * half;
      const double end = (lanes.Position[axis][i] + lambda * known) / (1.0 - lambda * c[0]);
      lanes.Trial[axis][i] = plateau.Done[i] > 0.0 ? plateau.End[axis][i] : end;
      final[axis][i] = lanes.Trial[axis][i] - half;
    }
  }
  finishPositions<Dimension>(job, count, lanes.Trial, unresolved);
  if (writer.IsDense())
  {
    for (int i = 0; i < count; ++i)
    {
      writer.WriteHermite(i, lanes.Time[i], 1.0, lanes.Position, *lanes.V[0], lanes.Trial, final);
    }
  }
  else
  {
    writer.WriteEnd(lanes.Trial);
  }
  return evaluations;
}

// Whether a lane's box is the whole domain; x then lies on a straight path from its seed.
template <int Dimension>
RT_INLINE bool isBoxWhole(
  const FlowJob<Dimension>& job, const LaneVectors<Dimension>& x, int lane, double t)
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double size = job.Tables.Size[axis];
    if (size - x[axis][lane] < t * size || x[axis][lane] < t * size)
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
  const double seed = (x[axis][lane] - t * job.Tables.Centroid[axis]) / (1.0 - t);
  return smaller(larger(seed, 0.0), job.Tables.Size[axis]);
}

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

// One step of a backward run to `time`: the velocity there is left in V[0].
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
RT_INLINE void finishWhole(const FlowJob<Dimension>& job, int count,
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
    const double time = step + 1 == run.Steps ? 0.0 : 1.0 - weights.Time;
    stepBackward<Dimension>(job, weights, time, count, active, lanes);
    evaluations += time > 0.0 ? left : 0;
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
    finishWhole<Dimension>(job, count, lanes.Position, time, active, left, write);
  }
  return evaluations;
}
