// SPDX-License-Identifier: BSD-3-Clause
// Graded Adams-Bashforth-Moulton 3 (PEC: predict, evaluate, correct), forward; the way back is in
// FlowMultistepBackward.txx. It solves dx/dt = v(x, t), Eq. (12), at the times
//   t_k = t* + (1 - t*) G_k,   G_k = sin^2(pi k / 2N),
// t* the end of a particle's straight start (FlowLanes.txx). Steps are short at both ends: after
// t*, where the velocity has a kink, and before 1, where boxes shrink to grid cells. One evaluation
// a step; weights are those of variable steps (AdamsWeights.h), which t* does not change, so that
// all particles share them. Included by FlowKernels.txx.

// v(x, 1) = x - S/2, the limit of Eq. (12): the box shrinks to x, along straight lines through c.
// Zero instead would end every path short of its end, by an error that falls with 1/N only.
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

// v(x, 0) = M - x: the box is the whole domain, whose mean is the centroid M.
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
  // The weights of particles that hand over.
  explicit RunWeights(const FlowMapView<Dimension>& map)
    : Steps(map.Steps)
    , Known(map.Weights)
  {
  }

  StepWeights operator[](std::int64_t step) const
  {
    return this->Known ? this->Known[step] : multistepWeights(step, this->Steps);
  }

  const std::int64_t Steps; // N

private:
  const StepWeights* Known; // weights of all steps, or null
};

// The predictor of a step: leaves the positions at its end in Trial, the velocity there in V[3],
// and whether the box was empty in Field. Lanes that are not active have no velocity. Those whose
// box is empty keep v_k.
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

// The seeds of a block, moved to the end t* of their straight start: v_0 = M - x_0 is left in V[0],
// and t* in `start`.
template <int Dimension>
RT_INLINE void startFromSeeds(const FlowJob<Dimension>& job, const double* seeds, int count,
  PathWriter<Dimension>& writer, MultistepLanes<Dimension>& lanes, Lanes& start)
{
  loadPositions<Dimension>(job, seeds, count, lanes.Position);
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

// The particles of a block at the hand-over of a level of the flow map: positions and the last
// three velocities are interpolated in its lattice, or given in place of the seeds. There t_k =
// commonStart + (1 - commonStart) G_k for all. Returns the step k that comes next.
template <int Dimension>
RT_INLINE std::int64_t startFromMap(const FlowJob<Dimension>& job,
  const FlowMapLevel<Dimension>& level, const RunWeights<Dimension>& run, const double* seeds,
  int count, MultistepLanes<Dimension>& lanes, Lanes& start, bool (&deferred)[BlockSize])
{
  if (job.FromStates)
  {
    loadStates<Dimension>(job, seeds, count, lanes);
  }
  else
  {
    loadPositions<Dimension>(job, seeds, count, lanes.Position);
    loadFromMap<Dimension>(job, level, count, lanes, deferred);
  }
  const std::int64_t step = run.Steps - level.HandOver;
  const double handOver = commonStart + (1.0 - commonStart) * run[step - 1].Time;
#pragma omp simd
  for (int i = 0; i < BlockSize; ++i)
  {
    start[i] = commonStart;
    lanes.Time[i] = handOver;
  }
  return step;
}

// Marks the lanes whose last box was empty, or left the part of the domain that the tables cover:
// their particles start again with smaller steps. Lanes that are done keep their mark.
template <int Dimension>
RT_INLINE void markUnresolved(const FlowJob<Dimension>& job, const PlateauLanes<Dimension>& plateau,
  MultistepLanes<Dimension>& lanes)
{
#pragma omp simd
  for (int i = 0; i < BlockSize; ++i)
  {
    // The mass of small boxes that are no sign of a void.
    double mostMass = RT_LEAST_PART * job.Tables.Largest;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      mostMass *= lanes.Field.To[axis][i] - lanes.Field.From[axis][i];
    }
    const double isVoid = mostMass > job.Tables.VoidMass ? lanes.Field.Void[i] : 0.0;
    const double isWrong = larger(isVoid, lanes.Field.Outside[i]);
    lanes.Unresolved[i] = larger(lanes.Unresolved[i], plateau.Done[i] > 0.0 ? 0.0 : isWrong);
  }
}

// The corrector of a step that began at the times `before`: positions at its end from the velocity
// that was evaluated there (V[3]) and the two before it. Writes the positions at the times within
// the step.
template <int Dimension>
RT_INLINE void correctForward(const FlowJob<Dimension>& job, const StepWeights& weights,
  const Lanes& before, int count, PathWriter<Dimension>& writer, MultistepLanes<Dimension>& lanes)
{
  const auto& v0 = *lanes.V[0];
  const auto& newest = *lanes.V[3];
  if (writer.IsDense())
  {
    // The predicted positions are no longer needed: Trial takes those at the step's start.
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
}

// Ends the paths of the lanes whose boxes have come to lie on a plateau. There c is constant, and
// x(t) = t c + (1 - t) S/2 is a straight line to x(1) = c.
template <int Dimension>
RT_INLINE void endOnPlateaus(const FlowJob<Dimension>& job, int count,
  const MultistepLanes<Dimension>& lanes, PlateauLanes<Dimension>& plateau,
  PathWriter<Dimension>& writer)
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

// The last step, to time 1, in closed form (closedEnd). Lanes that are done have their end already.
// Leaves x(1) in Trial and v(x(1), 1) in V[3].
template <int Dimension>
RT_INLINE void closeLastStep(const FlowJob<Dimension>& job, const StepWeights& last,
  const PlateauLanes<Dimension>& plateau, MultistepLanes<Dimension>& lanes)
{
  const double* c = last.Corrector;
  auto& final = *lanes.V[3];
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double half = 0.5 * job.Tables.Size[axis];
#pragma omp simd
    for (int i = 0; i < BlockSize; ++i)
    {
      const double end = closedEnd(lanes.Position[axis][i], lanes.Span[i], last.Length, c[0], c[1],
        c[2], (*lanes.V[0])[axis][i], (*lanes.V[1])[axis][i], half);
      lanes.Trial[axis][i] = plateau.Done[i] > 0.0 ? plateau.End[axis][i] : end;
      final[axis][i] = lanes.Trial[axis][i] - half;
    }
  }
}

// Time 0 to 1 by graded Adams-Bashforth-Moulton 3, from the end of the straight start, or in a pass
// before 0 from a level of the flow map. In a step, the predictor extrapolates the last three
// velocities, the velocity is evaluated once, at the predicted position (PEC), and the corrector
// interpolates it and the two before it.
template <int Dimension>
std::int64_t multistepForward(const FlowJob<Dimension>& job, const double* seeds,
  const std::int64_t* index, int count, int pass, bool* unresolved)
{
  MultistepLanes<Dimension> lanes;
  PathWriter<Dimension> writer(job, seeds, index, count);
  PlateauLanes<Dimension> plateau;
  alignas(64) Lanes start; // time at which the graded interval of each lane begins
  bool deferred[BlockSize] = {};
  const RunWeights<Dimension> run =
    pass < 0 ? RunWeights<Dimension>(*job.Map) : RunWeights<Dimension>(job, pass);
  const std::int64_t steps = run.Steps;
  std::int64_t step = 0;
  if (pass < 0)
  {
    step = startFromMap<Dimension>(
      job, job.Map->Levels[-1 - pass], run, seeds, count, lanes, start, deferred);
    plateau.Exclude(deferred);
  }
  else
  {
    startFromSeeds<Dimension>(job, seeds, count, writer, lanes, start);
  }
#pragma omp simd
  for (int i = 0; i < BlockSize; ++i)
  {
    lanes.Span[i] = 1.0 - start[i];
  }

  // Plateaus are looked for where there are empty cells; that costs a little in each step.
  const bool hasPlateaus = job.Tables.Occupied && !job.Nearest;
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
    // While no lane is done, the kernels below need no test of each lane.
    const bool* active = plateau.Left < BlockSize ? plateau.Active : nullptr;
    predictStep<Dimension>(job, weights, start, count, active, lanes);
    evaluations += plateau.Left < count ? plateau.Left : count;
    markUnresolved<Dimension>(job, plateau, lanes);
    correctForward<Dimension>(job, weights, before, count, writer, lanes);
    if (hasPlateaus && 3 * step >= steps) // before, boxes are wide
    {
      endOnPlateaus<Dimension>(job, count, lanes, plateau, writer);
    }
    lanes.Rotate();
  }
  for (int i = 0; i < count; ++i)
  {
    unresolved[i] = deferred[i] || lanes.Unresolved[i] > 0.0;
  }

  closeLastStep<Dimension>(job, run[steps - 1], plateau, lanes);
  finishPositions<Dimension>(job, count, lanes.Trial, unresolved);
  if (!writer.IsDense())
  {
    writer.WriteEnd(lanes.Trial);
    return evaluations;
  }
  for (int i = 0; i < count; ++i)
  {
    writer.WriteHermite(
      i, lanes.Time[i], 1.0, lanes.Position, *lanes.V[0], lanes.Trial, *lanes.V[3]);
  }
  return evaluations;
}
