// SPDX-License-Identifier: BSD-3-Clause
// Adams-Bashforth-Moulton 3 with the step chosen for each particle, and the closed-form finish.
// Included by FlowKernels.txx.

// The mass of one grid cell, by differences of the finest table.
template <int Dimension>
RT_INLINE double cellMass(const TableView<Dimension>& tables, const std::int64_t (&cell)[Dimension])
{
  double centre[Dimension];
  std::int64_t offset = cell[0] * TableView<Dimension>::Record;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    if (cell[axis] < 0 || cell[axis] >= tables.Cells[axis])
    {
      return 0.0;
    }
    centre[axis] = static_cast<double>(cell[axis]) + 0.5;
    offset += axis > 0 ? cell[axis] * tables.Levels[0].Stride[axis] : 0;
  }
  if (!isOccupied<Dimension>(tables, centre))
  {
    return 0.0;
  }
  double mass = 0.0;
  for (int corner = 0; corner < (1 << Dimension); ++corner)
  {
    std::int64_t node = offset;
    int lowSides = 0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const bool high = (corner >> axis) & 1;
      const std::int64_t stride =
        axis == 0 ? TableView<Dimension>::Record : tables.Levels[0].Stride[axis];
      node += high ? stride : 0;
      lowSides += high ? 0 : 1;
    }
    const double sum = tables.Levels[0].Nodes[node];
    mass += lowSides % 2 == 0 ? sum : -sum;
  }
  return larger(mass, 0.0);
}

// The end point of a particle whose box is at most one cell wide: exact where the box crosses at
// most one plane of the grid, else axis by axis with marginal densities. With f-, f+ the densities
// on both sides of plane k, alpha = a - k, beta = b - k and
//   g = (f+ beta^2 - f- alpha^2) / (2 (beta - alpha)),
// x(1) = k + g / f+ if g > 0, else k + g / f-.
template <int Dimension>
RT_INLINE void finishInCells(const TableView<Dimension>& tables, const LaneVectors<Dimension>& x,
  int lane, double t, LaneVectors<Dimension>& end)
{
  std::int64_t first[Dimension];
  double from[Dimension];
  double to[Dimension];
  double length[Dimension][2]; // of the box in the two cells that it overlaps
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double size = tables.Size[axis];
    from[axis] = size - (size - x[axis][lane]) / t;
    to[axis] = x[axis][lane] / t;
    first[axis] = static_cast<std::int64_t>(from[axis] + 1.0) - 1; // from > -1
    const double plane = static_cast<double>(first[axis] + 1);
    length[axis][0] = smaller(to[axis], plane) - from[axis];
    length[axis][1] = larger(to[axis] - plane, 0.0);
  }
  double marginal[Dimension][2] = {};
  for (int corner = 0; corner < (1 << Dimension); ++corner)
  {
    std::int64_t cell[Dimension];
    for (int axis = 0; axis < Dimension; ++axis)
    {
      cell[axis] = first[axis] + ((corner >> axis) & 1);
    }
    const double density = cellMass<Dimension>(tables, cell);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      double others = density;
      for (int other = 0; other < Dimension; ++other)
      {
        others *= other == axis ? 1.0 : length[other][(corner >> other) & 1];
      }
      marginal[axis][(corner >> axis) & 1] += others;
    }
  }
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double plane = static_cast<double>(first[axis] + 1);
    const double alpha = from[axis] - plane;
    const double beta = to[axis] - plane;
    const double below = marginal[axis][0];
    const double above = marginal[axis][1];
    double place = 0.5 * (from[axis] + to[axis]);
    if (beta > 0.0 && below + above > 0.0)
    {
      const double g = (above * beta * beta - below * alpha * alpha) / (2.0 * (beta - alpha));
      place = plane + (g > 0.0 ? g / above : g / below);
    }
    end[axis][lane] = place;
  }
}

template <int Dimension>
struct AdaptiveLanes
{
  MultistepLanes<Dimension> Steps;
  alignas(64) Lanes Step;    // the next step's length
  alignas(64) Lanes Time;    // before the step
  alignas(64) Lanes Back[2]; // times of the second and third newest velocity
  alignas(64) Lanes History; // accepted steps, up to 2
  alignas(64) Lanes Error;
  alignas(64) LaneVectors<Dimension> Predicted;
  alignas(64) LaneVectors<Dimension> Corrected;
  alignas(64) LaneVectors<Dimension> End;
  bool Active[BlockSize];
};

// Predictor positions at Time + Step.
template <int Dimension>
RT_INLINE void predictAdaptive(
  const FlowJob<Dimension>& job, AdaptiveLanes<Dimension>& lanes, double direction)
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double size = job.Tables.Size[axis];
    const auto& v0 = (*lanes.Steps.V[0])[axis];
    const auto& v1 = (*lanes.Steps.V[1])[axis];
    const auto& v2 = (*lanes.Steps.V[2])[axis];
#pragma omp simd
    for (int i = 0; i < BlockSize; ++i)
    {
      const double h = direction * lanes.Step[i];
      const double alpha = lanes.History[i] > 0.0 ? (lanes.Back[0][i] - lanes.Time[i]) / h : -1.0;
      const double beta = lanes.History[i] > 1.0 ? (lanes.Back[1][i] - lanes.Time[i]) / h : -2.0;
      const double third0 = (1.0 / 3.0 - (alpha + beta) / 2.0 + alpha * beta) / (alpha * beta);
      const double third1 = (1.0 / 3.0 - beta / 2.0) / (alpha * (alpha - beta));
      const double third2 = (1.0 / 3.0 - alpha / 2.0) / (beta * (beta - alpha));
      const double second = 0.5 / alpha;
      const double third = third0 * v0[i] + third1 * v1[i] + third2 * v2[i];
      const double lower = lanes.History[i] > 0.0 ? (1.0 - second) * v0[i] + second * v1[i] : v0[i];
      const double slope = lanes.History[i] > 1.0 ? third : lower;
      lanes.Predicted[axis][i] = clampToDomain(lanes.Steps.Position[axis][i] + h * slope, size);
    }
  }
}

// Corrector positions and the estimated error of the step, in cells: a tenth of the distance from
// the predictor, by the ratio of the two error constants.
template <int Dimension>
RT_INLINE void correctAdaptive(
  const FlowJob<Dimension>& job, AdaptiveLanes<Dimension>& lanes, double direction)
{
#pragma omp simd
  for (int i = 0; i < BlockSize; ++i)
  {
    lanes.Error[i] = 0.0;
  }
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double size = job.Tables.Size[axis];
    const auto& v0 = (*lanes.Steps.V[0])[axis];
    const auto& v1 = (*lanes.Steps.V[1])[axis];
    const auto& newest = (*lanes.Steps.V[3])[axis];
#pragma omp simd
    for (int i = 0; i < BlockSize; ++i)
    {
      const double h = direction * lanes.Step[i];
      const double alpha = lanes.History[i] > 0.0 ? (lanes.Back[0][i] - lanes.Time[i]) / h : -1.0;
      const double c0 = (1.0 / 3.0 - alpha / 2.0) / (1.0 - alpha);
      const double c1 = (1.0 / 3.0 - (1.0 + alpha) / 2.0 + alpha) / alpha;
      const double c2 = -1.0 / (6.0 * alpha * (alpha - 1.0));
      const double third = c0 * newest[i] + c1 * v0[i] + c2 * v1[i];
      const double slope = lanes.History[i] > 0.0 ? third : 0.5 * (newest[i] + v0[i]);
      const double place = clampToDomain(lanes.Steps.Position[axis][i] + h * slope, size);
      lanes.Corrected[axis][i] = place;
      const double distance = place - lanes.Predicted[axis][i];
      lanes.Error[i] = larger(lanes.Error[i], 0.1 * larger(distance, -distance));
    }
  }
}

// Either direction. Forward from the end of the straight start until the box is no wider than a
// cell; backward from time 1 until the box is the whole domain.
template <int Dimension>
std::int64_t advectAdaptive(const FlowJob<Dimension>& job, const double* seeds,
  const std::int64_t* index, int count, int refinement, bool* unresolved)
{
  constexpr double growth = 2.0;
  constexpr double shrinkage = 0.25;
  constexpr double safety = 0.9;
  constexpr double firstStep = 0.02; // relative to the remaining time
  // Relative to the remaining time: accepted whatever its error. No step is shorter than half of
  // it, so that no tolerance makes steps that do not advance.
  constexpr double shortest = 1e-6;
  constexpr double earliest = 1e-6; // time at which going backward ends

  AdaptiveLanes<Dimension> lanes;
  MultistepLanes<Dimension>& steps = lanes.Steps;
  PathWriter<Dimension> writer(job, seeds, index, count);
  loadPositions<Dimension>(job, seeds, count, steps.Position);
  double widest = 0.0;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    widest = larger(widest, job.Tables.Size[axis]);
  }
  const double cellTime = widest / (1.0 + widest); // the widest side of the box is one cell
  const double direction = job.Backward ? -1.0 : 1.0;
  double tolerance = job.Tolerance;
  for (int k = 0; k < refinement; ++k)
  {
    tolerance *= 0.25;
  }

  if (job.Backward)
  {
    finalVelocity<Dimension>(job, steps.Position, *steps.V[0]);
#pragma omp simd
    for (int i = 0; i < BlockSize; ++i)
    {
      lanes.Time[i] = 1.0;
      lanes.Step[i] = 0.5 * (1.0 - cellTime);
    }
  }
  else
  {
    startStraight<Dimension>(job, steps.Position, *steps.V[0], lanes.Time);
    if (writer.IsDense())
    {
      writer.WriteStraight(*steps.V[0], lanes.Time);
    }
#pragma omp simd
    for (int i = 0; i < BlockSize; ++i)
    {
      lanes.Step[i] = firstStep * (1.0 - lanes.Time[i]);
    }
  }
  int left = 0;
  for (int i = 0; i < BlockSize; ++i)
  {
    lanes.History[i] = 0.0;
    lanes.Back[0][i] = lanes.Back[1][i] = 0.0;
    lanes.Active[i] = i < count;
    if (lanes.Active[i] && !job.Backward && lanes.Time[i] >= cellTime)
    {
      finishInCells<Dimension>(job.Tables, steps.Position, i, lanes.Time[i], lanes.End);
      lanes.Active[i] = false;
    }
    left += lanes.Active[i] ? 1 : 0;
  }

  std::int64_t evaluations = 0;
  for (std::int64_t step = 0; left > 0; ++step)
  {
    if (shouldStop<Dimension>(job, step))
    {
      return evaluations;
    }
#pragma omp simd
    for (int i = 0; i < BlockSize; ++i)
    {
      const double end = job.Backward ? earliest : cellTime;
      const double reach = direction * (end - lanes.Time[i]);
      lanes.Step[i] = smaller(lanes.Step[i], reach);
      const double target = lanes.Time[i] + direction * lanes.Step[i];
      // A finished lane is computed at a valid time; its result is not used.
      steps.Time[i] = target > 0.0 && target < 1.0 ? target : 0.5;
    }
    predictAdaptive<Dimension>(job, lanes, direction);
    evaluateVelocity<Dimension>(
      job, steps.Field, count, lanes.Predicted, steps.Time, *steps.V[0], *steps.V[3], lanes.Active);
    correctAdaptive<Dimension>(job, lanes, direction);
    evaluations += left;
    for (int i = 0; i < count; ++i)
    {
      if (!lanes.Active[i])
      {
        continue;
      }
      const double ahead = job.Backward ? lanes.Time[i] : 1.0 - lanes.Time[i];
      const double ratio = tolerance / larger(lanes.Error[i], 1e-300);
      const double factor = safety * __builtin_sqrt(__builtin_sqrt(smaller(ratio, 1e6)));
      const double length = lanes.Step[i];
      const double next = length * smaller(larger(factor, shrinkage), growth);
      lanes.Step[i] = larger(next, 0.5 * shortest * ahead);
      if (ratio < 1.0 && length > shortest * ahead)
      {
        continue;
      }
      unresolved[i] = unresolved[i] || steps.Field.Void[i] > 0.0;
      const double before = lanes.Time[i];
      const double after = steps.Time[i];
      if (writer.IsDense())
      {
        writer.WriteHermite(
          i, before, after, steps.Position, *steps.V[0], lanes.Corrected, *steps.V[3]);
      }
      for (int axis = 0; axis < Dimension; ++axis)
      {
        steps.Position[axis][i] = lanes.Corrected[axis][i];
        (*steps.V[2])[axis][i] = (*steps.V[1])[axis][i];
        (*steps.V[1])[axis][i] = (*steps.V[0])[axis][i];
        (*steps.V[0])[axis][i] = (*steps.V[3])[axis][i];
      }
      lanes.Back[1][i] = lanes.Back[0][i];
      lanes.Back[0][i] = before;
      lanes.Time[i] = after;
      lanes.History[i] = smaller(lanes.History[i] + 1.0, 2.0);
      if (job.Backward)
      {
        if (isBoxWhole<Dimension>(job, steps.Position, i, after))
        {
          writeSeed<Dimension>(job, steps.Position, i, after, index[i]);
          lanes.Active[i] = false;
        }
        else if (after <= earliest)
        {
          writeSeed<Dimension>(job, steps.Position, i, 0.0, index[i]);
          lanes.Active[i] = false;
        }
      }
      else if (after >= cellTime)
      {
        finishInCells<Dimension>(job.Tables, steps.Position, i, after, lanes.End);
        lanes.Active[i] = false;
      }
      left -= lanes.Active[i] ? 0 : 1;
    }
  }
  if (job.Backward)
  {
    return evaluations;
  }
  for (int i = count; i < BlockSize; ++i)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      lanes.End[axis][i] = 0.0;
    }
  }
  finishPositions<Dimension>(job, count, lanes.End, unresolved);
  if (writer.IsDense())
  {
    finalVelocity<Dimension>(job, lanes.End, *steps.V[3]);
    for (int i = 0; i < count; ++i)
    {
      writer.WriteHermite(
        i, lanes.Time[i], 1.0, steps.Position, *steps.V[0], lanes.End, *steps.V[3]);
    }
  }
  else
  {
    writer.WriteEnd(lanes.End);
  }
  return evaluations;
}
