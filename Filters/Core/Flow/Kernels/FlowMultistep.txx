// SPDX-License-Identifier: BSD-3-Clause
// Graded Adams-Bashforth-Moulton 3 (PEC). Included by FlowKernels.txx.

// The state of a multistep method: positions and the velocities of the last steps.
template <int Dimension>
struct MultistepLanes
{
  alignas(64) LaneVectors<Dimension> Position;
  alignas(64) LaneVectors<Dimension> Trial;
  alignas(64) LaneVectors<Dimension> Velocities[4];
  LaneVectors<Dimension>* V[4]; // newest, second, third, output
  alignas(64) Lanes Time;
  alignas(64) Lanes Span;       // length of the graded interval
  alignas(64) Lanes Unresolved; // 1 once a box was empty
  VelocityLanes<Dimension> Field;

  MultistepLanes()
  {
    for (int k = 0; k < 4; ++k)
    {
      this->V[k] = &this->Velocities[k];
    }
    std::memset(this->Velocities, 0, sizeof(this->Velocities));
    std::memset(this->Unresolved, 0, sizeof(this->Unresolved));
    std::memset(this->Field.Boxes.Mass, 0, sizeof(this->Field.Boxes.Mass));
    std::memset(this->Field.Boxes.Moment, 0, sizeof(this->Field.Boxes.Moment));
  }

  void Rotate()
  {
    LaneVectors<Dimension>* oldest = this->V[2];
    this->V[2] = this->V[1];
    this->V[1] = this->V[0];
    this->V[0] = this->V[3];
    this->V[3] = oldest;
  }

  // result = Position + Span * (a[0] first + a[1] second + a[2] third), kept in the domain.
  RT_INLINE void Advance(const FlowJob<Dimension>& job, const double a[3], double length,
    const LaneVectors<Dimension>& first, const LaneVectors<Dimension>& second,
    const LaneVectors<Dimension>& third, LaneVectors<Dimension>& result)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double size = job.Tables.Size[axis];
#pragma omp simd
      for (int i = 0; i < BlockSize; ++i)
      {
        const double sum = a[0] * first[axis][i] + a[1] * second[axis][i] + a[2] * third[axis][i];
        result[axis][i] =
          clampToDomain(this->Position[axis][i] + this->Span[i] * length * sum, size);
      }
    }
  }
};

// Where the density has its maximum in all of a particle's box, and the box is not clipped, its
// mean is the box's centre c. The box then shrinks about c, so that x(1) = c: exact. Densities with
// empty cells are most often shapes of one value, where nearly all boxes become such.
template <int Dimension>
struct PlateauLanes
{
  alignas(64) LaneVectors<Dimension> End; // x(1)
  alignas(64) Lanes Done;                 // 1 where End is known, else 0
  bool Active[BlockSize];                 // lanes that are not done
  int Left = BlockSize;                   // how many

  PlateauLanes()
  {
    std::memset(this->End, 0, sizeof(this->End));
    std::memset(this->Done, 0, sizeof(this->Done));
    std::memset(this->Active, 1, sizeof(this->Active));
  }

  // After an evaluation of the velocity in `field`, with particles at x. Marks in `found` the lanes
  // that are done since the last call, and returns whether there are any.
  RT_INLINE bool Find(const FlowJob<Dimension>& job, const VelocityLanes<Dimension>& field,
    const LaneVectors<Dimension>& x, Lanes& found)
  {
    constexpr double rounding = 1e-9;
    alignas(64) Lanes mass; // the largest that the box could hold
#pragma omp simd
    for (int i = 0; i < BlockSize; ++i)
    {
      mass[i] = job.Tables.Largest;
    }
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double size = job.Tables.Size[axis];
#pragma omp simd
      for (int i = 0; i < BlockSize; ++i)
      {
        const double from = field.From[axis][i];
        const double to = field.To[axis][i];
        mass[i] = from > 0.0 && to < size ? mass[i] * (to - from) : 1e300;
      }
    }
    double sum = 0.0;
#pragma omp simd reduction(+ : sum)
    for (int i = 0; i < BlockSize; ++i)
    {
      const double missing = mass[i] * field.Boxes.Mass[i] - 1.0; // Mass is 1 / mass here
      found[i] = missing <= rounding && field.Void[i] == 0.0 && this->Done[i] == 0.0 ? 1.0 : 0.0;
      this->Done[i] += found[i];
      sum += found[i];
    }
    if (sum == 0.0)
    {
      return false;
    }
    for (int i = 0; i < BlockSize; ++i)
    {
      this->Active[i] = this->Done[i] == 0.0;
    }
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double half = 0.5 * job.Tables.Size[axis];
#pragma omp simd
      for (int i = 0; i < BlockSize; ++i)
      {
        const double centre = half + (x[axis][i] - half) * field.InverseTime[i];
        this->End[axis][i] = found[i] > 0.0 ? centre : this->End[axis][i];
      }
    }
    this->Left -= static_cast<int>(sum);
    return true;
  }
};

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

template <int Dimension>
StepWeights stepWeights(const FlowJob<Dimension>& job, std::int64_t step, std::int64_t steps)
{
  return job.Weights && steps == job.Steps ? job.Weights[step] : multistepWeights(step, steps);
}

// Time 0 to 1 by graded Adams-Bashforth-Moulton 3 (PEC), from the end of the straight start. The
// last step is implicit and closed, as the velocity at time 1 is x - S/2.
template <int Dimension>
std::int64_t multistepForward(const FlowJob<Dimension>& job, const double* seeds,
  const std::int64_t* index, int count, int refinement, bool* unresolved)
{
  MultistepLanes<Dimension> lanes;
  PathWriter<Dimension> writer(job, seeds, index, count);
  alignas(64) Lanes start;
  loadPositions<Dimension>(job, seeds, count, lanes.Position);
  startStraight<Dimension>(job, lanes.Position, *lanes.V[0], start);
  if (writer.IsDense())
  {
    writer.WriteStraight(*lanes.V[0], start);
  }
#pragma omp simd
  for (int i = 0; i < BlockSize; ++i)
  {
    lanes.Span[i] = 1.0 - start[i];
    lanes.Time[i] = start[i];
  }

  const std::int64_t steps = job.Steps << refinement;
  const bool hasPlateaus = job.Tables.Occupied && !job.Nearest;
  PlateauLanes<Dimension> plateau;
  std::int64_t step = 0;
  for (; step + 1 < steps && plateau.Left > 0; ++step)
  {
    if (shouldStop<Dimension>(job, step))
    {
      return step * count;
    }
    const StepWeights weights = stepWeights<Dimension>(job, step, steps);
    const auto& v0 = *lanes.V[0];
    const auto& v1 = *lanes.V[1];
    auto& newest = *lanes.V[3];
    lanes.Advance(job, weights.Predictor, weights.Length, v0, v1, *lanes.V[2], lanes.Trial);
    alignas(64) Lanes before;
#pragma omp simd
    for (int i = 0; i < BlockSize; ++i)
    {
      before[i] = lanes.Time[i];
      lanes.Time[i] = start[i] + lanes.Span[i] * weights.Time;
    }
    const bool* active = plateau.Left < BlockSize ? plateau.Active : nullptr;
    evaluateVelocity<Dimension>(
      job, lanes.Field, count, lanes.Trial, lanes.Time, v0, newest, active);
#pragma omp simd
    for (int i = 0; i < BlockSize; ++i)
    {
      const double isVoid = plateau.Done[i] > 0.0 ? 0.0 : lanes.Field.Void[i];
      lanes.Unresolved[i] = larger(lanes.Unresolved[i], isVoid);
    }
    if (writer.IsDense())
    {
      std::memcpy(lanes.Trial, lanes.Position, sizeof(lanes.Trial));
    }
    lanes.Advance(job, weights.Corrector, weights.Length, newest, v0, v1, lanes.Position);
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
    unresolved[i] = lanes.Unresolved[i] > 0.0;
  }

  const StepWeights last = stepWeights<Dimension>(job, steps - 1, steps);
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
  return step * count;
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

template <int Dimension>
RT_INLINE void writeSeed(const FlowJob<Dimension>& job, const LaneVectors<Dimension>& x, int lane,
  double t, std::int64_t index)
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double size = job.Tables.Size[axis];
    const double seed = (x[axis][lane] - t * job.Tables.Centroid[axis]) / (1.0 - t);
    job.Output[index * Dimension + axis] = smaller(larger(seed, 0.0), size);
  }
}

// Time 1 to 0 over the reversed graded steps of [0,1]; a particle is done once its box is the whole
// domain, as its seed is then known in closed form.
template <int Dimension>
std::int64_t multistepBackward(
  const FlowJob<Dimension>& job, const double* seeds, const std::int64_t* index, int count)
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

  std::int64_t evaluations = 0;
  for (std::int64_t step = 0; step < job.Steps && left > 0; ++step)
  {
    if (shouldStop<Dimension>(job, step))
    {
      return evaluations;
    }
    const StepWeights weights = stepWeights<Dimension>(job, step, job.Steps);
    const double time = 1.0 - weights.Time;
    const bool atStart = step + 1 == job.Steps;
    const auto& v0 = *lanes.V[0];
    const auto& v1 = *lanes.V[1];
    auto& newest = *lanes.V[3];
    lanes.Advance(job, weights.Predictor, weights.Length, v0, v1, *lanes.V[2], lanes.Trial);
    if (atStart)
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
      evaluations += left;
    }
    lanes.Advance(job, weights.Corrector, weights.Length, newest, v0, v1, lanes.Position);
    lanes.Rotate();
    for (int i = 0; i < count; ++i)
    {
      if (active[i] && (atStart || isBoxWhole<Dimension>(job, lanes.Position, i, time)))
      {
        writeSeed<Dimension>(job, lanes.Position, i, atStart ? 0.0 : time, index[i]);
        active[i] = false;
        --left;
      }
    }
  }
  return evaluations;
}
