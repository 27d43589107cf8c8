// SPDX-License-Identifier: BSD-3-Clause
// Integrators with uniform steps. Included by FlowKernels.txx.

// The velocity at one time for all lanes, the ends of [0,1] included.
template <int Dimension>
RT_INLINE void velocityAt(const FlowJob<Dimension>& job, VelocityLanes<Dimension>& field, int count,
  const LaneVectors<Dimension>& x, double time, const LaneVectors<Dimension>& held,
  LaneVectors<Dimension>& v, bool* unresolved)
{
  if (time <= 0.0)
  {
    initialVelocity<Dimension>(job, x, v);
    return;
  }
  if (time >= 1.0)
  {
    finalVelocity<Dimension>(job, x, v);
    return;
  }
  alignas(64) Lanes t;
#pragma omp simd
  for (int i = 0; i < BlockSize; ++i)
  {
    t[i] = time;
  }
  evaluateVelocity<Dimension>(job, field, count, x, t, held, v);
  for (int i = 0; i < count; ++i)
  {
    unresolved[i] = unresolved[i] || field.Void[i] > 0.0;
  }
}

// The published scheme, with the correct limit at time 1: T uniform steps of RungeKutta4 (paper,
// Algorithm 2),
//   x += (V_1 + 2 (V_2 + V_3) + V_4) / 6T,
// or Euler (Section 3.3), x += V_1 / T, in either direction. Neither the straight start nor a
// closed finish: it is there to be compared with.
template <int Dimension>
std::int64_t advectUniformSteps(const FlowJob<Dimension>& job, const double* seeds,
  const std::int64_t* index, int count, int refinement, bool* unresolved)
{
  MultistepLanes<Dimension> lanes;
  PathWriter<Dimension> writer(job, seeds, index, count);
  loadPositions<Dimension>(job, seeds, count, lanes.Position);
  alignas(64) LaneVectors<Dimension> previous; // positions at the step's start
  alignas(64) LaneVectors<Dimension> slope;    // velocities there, V_1
  alignas(64) LaneVectors<Dimension> sum;      // V_1 + 2 V_2 + 2 V_3 + V_4 so far
  const bool fourStages = job.Integrator == Integrator::RungeKutta4;
  const std::int64_t steps = job.Steps << refinement;
  const double length = (job.Backward ? -1.0 : 1.0) / static_cast<double>(steps);
  // Times are counted in half steps: the inner stages of RungeKutta4 lie in the middle of a step.
  const auto timeAt = [&](std::int64_t halfSteps) {
    const double fraction = static_cast<double>(halfSteps) / static_cast<double>(2 * steps);
    return job.Backward ? 1.0 - fraction : fraction;
  };
#pragma omp simd
  for (int i = 0; i < BlockSize; ++i)
  {
    lanes.Span[i] = length;
  }
  // A lane whose box is empty keeps its velocity, at first that of the straight line to the
  // centroid.
  initialVelocity<Dimension>(job, lanes.Position, *lanes.V[0]);
  // Time 0 itself is the seed, not its place away from the faces.
  if (writer.IsDense())
  {
    const Lanes start = {};
    writer.WriteStraight(*lanes.V[0], start);
  }

  // Advance takes three weighted velocities: here one.
  const double one[3] = { 1.0, 0.0, 0.0 };
  for (std::int64_t step = 0; step <= steps; ++step)
  {
    if (shouldStop<Dimension>(job, step))
    {
      return step * count * (fourStages ? 4 : 1);
    }
    // The slope at a step's start closes the interpolant over the step before it.
    auto& first = *lanes.V[3];
    velocityAt<Dimension>(
      job, lanes.Field, count, lanes.Position, timeAt(2 * step), *lanes.V[0], first, unresolved);
    if (writer.IsDense() && step > 0)
    {
      for (int i = 0; i < count; ++i)
      {
        writer.WriteHermite(
          i, timeAt(2 * step - 2), timeAt(2 * step), previous, slope, lanes.Position, first);
      }
    }
    if (step == steps)
    {
      break;
    }
    std::memcpy(previous, lanes.Position, sizeof(previous));
    std::memcpy(slope, first, sizeof(slope));
    std::memcpy(sum, first, sizeof(sum));
    lanes.Rotate();
    if (fourStages)
    {
      // V_2 and V_3 in the middle of the step, from V_1 and V_2; V_4 at its end, from V_3. V[0] is
      // the velocity of the stage before, which is also what lanes with an empty box keep.
      for (int stage = 1; stage < 4; ++stage)
      {
        const double part = stage < 3 ? 0.5 : 1.0;
        const auto& last = *lanes.V[0];
        lanes.Advance(job, one, part, last, last, last, lanes.Trial);
        auto& next = *lanes.V[3];
        velocityAt<Dimension>(job, lanes.Field, count, lanes.Trial,
          timeAt(2 * step + (stage < 3 ? 1 : 2)), last, next, unresolved);
        const double weight = stage < 3 ? 2.0 : 1.0;
        for (int axis = 0; axis < Dimension; ++axis)
        {
#pragma omp simd
          for (int i = 0; i < BlockSize; ++i)
          {
            sum[axis][i] += weight * next[axis][i];
          }
        }
        lanes.Rotate();
      }
    }
    lanes.Advance(job, one, fourStages ? 1.0 / 6.0 : 1.0, sum, sum, sum, lanes.Position);
  }
  finishPositions<Dimension>(job, count, lanes.Position, unresolved);
  if (!writer.IsDense())
  {
    writer.WriteEnd(lanes.Position);
  }
  return steps * count * (fourStages ? 4 : 1);
}
