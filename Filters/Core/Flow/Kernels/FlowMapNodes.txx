// SPDX-License-Identifier: BSD-3-Clause
// The nodes of a flow map's lattices. Forward, their seeds are taken to a hand-over by the steps in
// FlowMultistep.txx; backward, the particles that are at the nodes at the hand-over are taken to
// their seeds. Included by FlowKernels.txx.

// Marks the lanes whose box was empty at the last velocity.
template <int Dimension>
RT_INLINE void markEmpty(MultistepLanes<Dimension>& lanes)
{
#pragma omp simd
  for (int i = 0; i < BlockSize; ++i)
  {
    lanes.Unresolved[i] = larger(lanes.Unresolved[i], lanes.Field.Void[i]);
  }
}

// The corrector of a step after predictStep.
template <int Dimension>
RT_INLINE void correctStep(
  const FlowJob<Dimension>& job, const StepWeights& weights, MultistepLanes<Dimension>& lanes)
{
  markEmpty<Dimension>(lanes);
  lanes.Advance(
    job, weights.Corrector, weights.Length, *lanes.V[3], *lanes.V[0], *lanes.V[1], lanes.Position);
  lanes.Rotate();
}

// result = Position + length * (a[0] first + a[1] second + a[2] third), kept in the domain, with
// each lane's own weights.
template <int Dimension>
RT_INLINE void advanceByLane(const FlowJob<Dimension>& job, const double (&a)[3][BlockSize],
  double length, const LaneVectors<Dimension>& first, const LaneVectors<Dimension>& second,
  const LaneVectors<Dimension>& third, const LaneVectors<Dimension>& position,
  LaneVectors<Dimension>& result)
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double size = job.Tables.Size[axis];
#pragma omp simd
    for (int i = 0; i < BlockSize; ++i)
    {
      result[axis][i] = advance(position[axis][i], 1.0, length, a[0][i], a[1][i], a[2][i],
        first[axis][i], second[axis][i], third[axis][i], size);
    }
  }
}

// From the seeds in lanes.Position to the time of a hand-over: the straight start, graded steps to
// two of the common steps before, and those two, at first with velocities of each lane's own times.
template <int Dimension>
std::int64_t startNodes(const FlowJob<Dimension>& job, int handOver, const StepWeights* graded,
  int count, MultistepLanes<Dimension>& lanes)
{
  // The common times of particles that hand over, by the number of steps that are left.
  const auto timeAt = [&](std::int64_t stepsLeft) {
    return commonStart + (1.0 - commonStart) * grading(job.Map->Steps - stepsLeft, job.Map->Steps);
  };
  alignas(64) Lanes start;
  startStraight<Dimension>(job, lanes.Position, *lanes.V[0], start);
  const double end = timeAt(handOver + 2);
#pragma omp simd
  for (int i = 0; i < BlockSize; ++i)
  {
    lanes.Span[i] = end - start[i];
    lanes.Time[i] = start[i];
  }
  // Graded steps on [t*, end], each lane from its own t*: `graded` ends at 1 in units of Span.
  const std::int64_t steps = startSteps(job.Map->Steps, handOver);
  for (std::int64_t step = 0; step < steps; ++step)
  {
    if (shouldStop<Dimension>(job, step))
    {
      return step * count;
    }
    predictStep<Dimension>(job, graded[step], start, count, nullptr, lanes);
    correctStep<Dimension>(job, graded[step], lanes);
  }

  // Two steps of the common times. The velocities behind lie at times of each lane's own, and so
  // weights are its own, too.
  const double last = graded[steps - 1].Length; // in units of Span
  const double before = graded[steps - 2].Length;
  alignas(64) Lanes first; // times since the last but one velocity and the one before it
  alignas(64) Lanes second;
#pragma omp simd
  for (int i = 0; i < BlockSize; ++i)
  {
    // The lengths of steps in units of time.
    first[i] = last * lanes.Span[i];
    second[i] = first[i] + before * lanes.Span[i];
  }
  for (int left = handOver + 2; left > handOver; --left)
  {
    const double time = timeAt(left - 1);
    const double length = time - timeAt(left);
    alignas(64) double predictor[3][BlockSize]; // weights of each lane
    alignas(64) double corrector[3][BlockSize];
    for (int i = 0; i < BlockSize; ++i)
    {
      double p[3];
      double c[3];
      // The step's length is the unit of the weights; after the step both velocities are further
      // back.
      adamsWeights(-first[i] / length, -second[i] / length, p, c);
      for (int k = 0; k < 3; ++k)
      {
        predictor[k][i] = p[k];
        corrector[k][i] = c[k];
      }
      second[i] = first[i] + length;
      first[i] = length;
      lanes.Time[i] = time;
    }
    const auto& v0 = *lanes.V[0];
    const auto& v1 = *lanes.V[1];
    auto& newest = *lanes.V[3];
    advanceByLane<Dimension>(
      job, predictor, length, v0, v1, *lanes.V[2], lanes.Position, lanes.Trial);
    evaluateVelocity<Dimension>(job, lanes.Field, count, lanes.Trial, lanes.Time, v0, newest);
    markEmpty<Dimension>(lanes);
    advanceByLane<Dimension>(
      job, corrector, length, newest, v0, v1, lanes.Position, lanes.Position);
    lanes.Rotate();
  }
  return (steps + 2) * count;
}

// Steps of particles from one hand-over to that of a finer level, of lanes that are not deferred.
template <int Dimension>
std::int64_t continueNodes(const FlowJob<Dimension>& job, int from, int handOver, int count,
  const bool (&deferred)[BlockSize], MultistepLanes<Dimension>& lanes)
{
  bool active[BlockSize];
  int left = 0;
  for (int i = 0; i < BlockSize; ++i)
  {
    active[i] = !deferred[i];
    left += active[i] ? 1 : 0;
  }
  alignas(64) Lanes start;
#pragma omp simd
  for (int i = 0; i < BlockSize; ++i)
  {
    // The graded interval of particles that hand over, [commonStart, 1].
    start[i] = commonStart;
    lanes.Span[i] = 1.0 - commonStart;
  }
  const RunWeights<Dimension> run(*job.Map);
  for (std::int64_t stepsLeft = from; stepsLeft > handOver && left > 0; --stepsLeft)
  {
    if (shouldStop<Dimension>(job, from - stepsLeft))
    {
      break;
    }
    const StepWeights weights = run[run.Steps - stepsLeft];
    predictStep<Dimension>(job, weights, start, count, left < BlockSize ? active : nullptr, lanes);
    correctStep<Dimension>(job, weights, lanes);
  }
  return static_cast<std::int64_t>(from - handOver) * left;
}

// Forward records: position and the last three velocities at the level's hand-over, of the
// particles whose seeds are the nodes. From the seeds on, or from a coarser level on.
template <int Dimension>
std::int64_t advanceForwardNodes(const FlowJob<Dimension>& job,
  const FlowMapLevel<Dimension>& level, int parent, const NodeBlock& block)
{
  constexpr int record = FlowMapLevel<Dimension>::ForwardRecord;
  MultistepLanes<Dimension> lanes;
  loadPositions<Dimension>(job, block.Places, block.Count, lanes.Position);
  bool deferred[BlockSize] = {};
  // The coarsest level, and nodes that no lattice serves, take all steps.
  std::int64_t evaluations = 0;
  if (parent < 0)
  {
    evaluations = startNodes<Dimension>(job, level.HandOver, block.Weights, block.Count, lanes);
  }
  else
  {
    const FlowMapLevel<Dimension>& coarser = job.Map->Levels[parent];
    loadFromMap<Dimension>(job, coarser, block.Count, lanes, deferred);
    evaluations =
      continueNodes<Dimension>(job, coarser.HandOver, level.HandOver, block.Count, deferred, lanes);
  }
  for (int i = 0; i < block.Count; ++i)
  {
    block.Deferred[i] = deferred[i] ? 1 : 0;
    if (deferred[i])
    {
      continue;
    }
    // A node that met an empty box has a record, but the cells around it will be bad.
    block.Unresolved[block.Index[i]] = lanes.Unresolved[i] > 0.0 ? 1 : 0;
    float* state = level.Records + block.Index[i] * record;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      state[axis] = static_cast<float>(lanes.Position[axis][i]);
      for (int k = 0; k < 3; ++k)
      {
        state[(k + 1) * Dimension + axis] = static_cast<float>((*lanes.V[k])[axis][i]);
      }
    }
    // Whole registers are read.
    for (int k = 4 * Dimension; k < record; ++k)
    {
      state[k] = 0.0f;
    }
  }
  return evaluations;
}

// From a level's time back to that of the parent, which gives the seeds where its cells are good,
// or to time 0.
template <int Dimension>
std::int64_t advanceBackwardNodes(const FlowJob<Dimension>& job,
  const FlowMapLevel<Dimension>& level, int parent, const NodeBlock& block)
{
  constexpr int record = FlowMapLevel<Dimension>::BackwardRecord;
  const auto timeAt = [&](std::int64_t step) {
    return step < job.Map->Steps ? 1.0 - grading(step, job.Map->Steps) : 0.0;
  };
  // A record is the seed, and zeros up to a whole register.
  const auto write = [&](int lane, const auto& coordinate) {
    float* seed = level.Records + block.Index[lane] * record;
    for (int axis = 0; axis < record; ++axis)
    {
      seed[axis] = axis < Dimension ? static_cast<float>(coordinate(axis)) : 0.0f;
    }
  };
  MultistepLanes<Dimension> lanes;
  loadPositions<Dimension>(job, block.Places, block.Count, lanes.Position);
  bool active[BlockSize];
  for (int i = 0; i < BlockSize; ++i)
  {
    active[i] = i < block.Count;
  }
  // Marks lanes that met an empty box before they are done. Finished ones are not computed: their
  // Void is that of an earlier step.
  const auto markActive = [&]() {
    for (int i = 0; i < block.Count; ++i)
    {
      if (active[i])
      {
        lanes.Unresolved[i] = larger(lanes.Unresolved[i], lanes.Field.Void[i]);
      }
    }
  };
  // The steps lead from the level's time down to that of the parent, or to 0, in graded steps of
  // [begin, end].
  const std::int64_t to = parent < 0 ? job.Map->Steps : job.Map->Levels[parent].HandOver;
  const std::int64_t steps = nodeSteps(level.HandOver, to);
  // Steps lead from begin down to end: Span is negative.
  const double begin = timeAt(level.HandOver);
  const double end = timeAt(to);
  int left = block.Count;
  // Boxes may be whole at the level's time already.
  finishStraight<Dimension>(job, block.Count, lanes.Position, begin, active, left, write);
#pragma omp simd
  for (int i = 0; i < BlockSize; ++i)
  {
    lanes.Time[i] = begin;
    lanes.Span[i] = end - begin;
  }
  evaluateVelocity<Dimension>(
    job, lanes.Field, block.Count, lanes.Position, lanes.Time, *lanes.V[0], *lanes.V[0], active);
  std::int64_t evaluations = left;
  markActive();
  for (std::int64_t step = 0; step < steps && left > 0; ++step)
  {
    if (shouldStop<Dimension>(job, step))
    {
      return evaluations;
    }
    const StepWeights& weights = block.Weights[step];
    const double time = step + 1 == steps ? end : begin + lanes.Span[0] * weights.Time;
    stepBackward<Dimension>(job, weights, time, block.Count, active, lanes);
    if (time > 0.0)
    {
      evaluations += left;
      markActive();
    }
    finishStraight<Dimension>(job, block.Count, lanes.Position, time, active, left, write);
  }
  // Nodes to which the parent gives no seed are deferred, to the next coarser level.
  if (parent >= 0)
  {
    finishFromMap<Dimension>(
      job.Map->Levels[parent], block.Count, lanes.Position, active, left, write);
  }
  for (int i = 0; i < block.Count; ++i)
  {
    block.Deferred[i] = active[i] ? 1 : 0;
    block.Unresolved[block.Index[i]] = lanes.Unresolved[i] > 0.0 ? 1 : 0;
  }
  return evaluations;
}

// The kernel AdvanceNodes of FlowKernels.h.
template <int Dimension>
std::int64_t advanceNodes(const FlowJob<Dimension>& job, const FlowMapLevel<Dimension>& level,
  int parent, const NodeBlock& block)
{
  return job.Backward ? advanceBackwardNodes<Dimension>(job, level, parent, block)
                      : advanceForwardNodes<Dimension>(job, level, parent, block);
}
