// SPDX-License-Identifier: BSD-3-Clause
// Adams-Bashforth-Moulton 3 with the step chosen for each particle, and the closed-form finish: the
// method of FlowMultistep.txx, but each lane has times, weights and errors of its own. Included by
// FlowKernels.txx.

// The mass of one grid cell, by differences of the finest table E over its 2^d corners: a corner
// with an odd number of low sides counts negative. 0 outside of the domain. The empty cells are
// known from their bits, without rounding.
template <int Dimension>
RT_INLINE double cellMass(const TableView<Dimension>& tables, const std::int64_t (&cell)[Dimension])
{
  double centre[Dimension];
  // Where the record of the low corner begins, in doubles.
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
      // Bit `axis` of a corner: its side.
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
// most one plane of the grid, else axis by axis with marginal densities. The box [a, b] is the one
// before clipping: outside of the domain the density is 0. Let f-, f+ be the densities on both
// sides of plane k, alpha = a - k, beta = b - k and
//   g = (f+ beta^2 - f- alpha^2) / (2 (beta - alpha)),
// x(1) = k + g / f+ if g > 0, else k + g / f-.
template <int Dimension>
RT_INLINE void finishInCells(const TableView<Dimension>& tables, const LaneVectors<Dimension>& x,
  int lane, double t, LaneVectors<Dimension>& end)
{
  std::int64_t first[Dimension];
  double from[Dimension];
  double to[Dimension];
  double length[Dimension][2]; // the box's in both cells that it overlaps
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double size = tables.Size[axis];
    // Eq. (10) without clipping.
    from[axis] = size - (size - x[axis][lane]) / t;
    to[axis] = x[axis][lane] / t;
    first[axis] = static_cast<std::int64_t>(from[axis] + 1.0) - 1; // from > -1
    const double plane = static_cast<double>(first[axis] + 1);
    length[axis][0] = smaller(to[axis], plane) - from[axis];
    length[axis][1] = larger(to[axis] - plane, 0.0);
  }
  // Along each axis the density of the two cells, integrated over the box's lengths in the others.
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
      // The cell's density times the overlap along all other axes.
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
    // c, where the box is in one cell, or no cell has mass.
    double place = 0.5 * (from[axis] + to[axis]);
    if (beta > 0.0 && below + above > 0.0)
    {
      const double g = (above * beta * beta - below * alpha * alpha) / (2.0 * (beta - alpha));
      place = plane + (g > 0.0 ? g / above : g / below);
    }
    end[axis][lane] = place;
  }
}

// The state of a block. Of `Steps` the Time is that of the end of the step which is tried.
template <int Dimension>
struct AdaptiveLanes
{
  MultistepLanes<Dimension> Steps;
  alignas(64) Lanes Step;    // the next step's length, positive in both directions
  alignas(64) Lanes Time;    // before the step
  alignas(64) Lanes Back[2]; // times of the second and third newest velocity
  alignas(64) Lanes History; // accepted steps, up to 2
  alignas(64) Lanes Error;   // estimated, of the step, in cells
  alignas(64) LaneVectors<Dimension> Predicted; // positions at the step's end
  alignas(64) LaneVectors<Dimension> Corrected; // the same by the corrector
  alignas(64) LaneVectors<Dimension> End;       // x(1), of finished lanes
  bool Active[BlockSize];                       // not finished
};

// Predictor positions at Time + Step, by the weights of AdamsWeights.h for each lane's own time
// ratios. With two velocities before the newest one the order is 3; with one it is 2
// (Adams-Bashforth 2), with none 1 (Euler). Ratios to times that are not there yet are those of
// even steps, so that divisions are safe.
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
      double third0;
      double third1;
      double third2;
      predictorWeights(alpha, beta, &third0, &third1, &third2);
      // Adams-Bashforth 2: the weight of v_k-1; that of v_k is 1 - second.
      const double second = 0.5 / alpha;
      const double third = third0 * v0[i] + third1 * v1[i] + third2 * v2[i];
      const double lower = lanes.History[i] > 0.0 ? (1.0 - second) * v0[i] + second * v1[i] : v0[i];
      const double slope = lanes.History[i] > 1.0 ? third : lower;
      lanes.Predicted[axis][i] = clampToDomain(lanes.Steps.Position[axis][i] + h * slope, size);
    }
  }
}

// Corrector positions, of order 3, or by the trapezoidal rule in a lane's first step, and the
// estimated error of the step, in cells: a tenth of the distance from the predictor along the axis
// where it is largest, by the ratio of the two error constants of even steps (Milne's device: 3/8
// and -1/24).
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
      double c0;
      double c1;
      double c2;
      correctorWeights(alpha, &c0, &c1, &c2);
      const double third = c0 * newest[i] + c1 * v0[i] + c2 * v1[i];
      const double slope = lanes.History[i] > 0.0 ? third : 0.5 * (newest[i] + v0[i]);
      const double place = clampToDomain(lanes.Steps.Position[axis][i] + h * slope, size);
      lanes.Corrected[axis][i] = place;
      const double distance = place - lanes.Predicted[axis][i];
      lanes.Error[i] = larger(lanes.Error[i], 0.1 * larger(distance, -distance));
    }
  }
}

// Going backward ends at this time, from where the seed is that of time 0.
constexpr double earliestTime = 1e-6;

// Positions, velocities, times and first steps of all lanes at the start: forward at the end of the
// straight start, where particles whose box is no wider than a cell end at once; backward at
// time 1. Returns how many lanes are left.
template <int Dimension>
RT_INLINE int startAdaptive(const FlowJob<Dimension>& job, int count, double cellTime,
  PathWriter<Dimension>& writer, AdaptiveLanes<Dimension>& lanes)
{
  constexpr double firstStep = 0.02; // relative to the remaining time
  MultistepLanes<Dimension>& steps = lanes.Steps;
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
    // t* may be late enough, as in a grid of one cell.
    if (lanes.Active[i] && !job.Backward && lanes.Time[i] >= cellTime)
    {
      finishInCells<Dimension>(job.Tables, steps.Position, i, lanes.Time[i], lanes.End);
      lanes.Active[i] = false;
    }
    left += lanes.Active[i] ? 1 : 0;
  }
  return left;
}

// Shortens steps that would pass the end of the run, and sets the times at which steps end.
template <int Dimension>
RT_INLINE void setTargetTimes(
  const FlowJob<Dimension>& job, double cellTime, double direction, AdaptiveLanes<Dimension>& lanes)
{
#pragma omp simd
  for (int i = 0; i < BlockSize; ++i)
  {
    const double end = job.Backward ? earliestTime : cellTime;
    const double reach = direction * (end - lanes.Time[i]);
    lanes.Step[i] = smaller(lanes.Step[i], reach);
    const double target = lanes.Time[i] + direction * lanes.Step[i];
    // A finished lane is computed at a valid time; its result is not used.
    lanes.Steps.Time[i] = target > 0.0 && target < 1.0 ? target : 0.5;
  }
}

// Controls the step of one lane by its estimated error e: sets the length of the next attempt,
//   h' = h * 0.9 (tolerance / e)^(1/4), but at least h / 4 and at most 2 h,
// as e is of order h^4. Returns whether the step is accepted: if e is within the tolerance, or the
// step is too short to be tried again.
template <int Dimension>
RT_INLINE bool controlStep(
  const FlowJob<Dimension>& job, double tolerance, int lane, AdaptiveLanes<Dimension>& lanes)
{
  constexpr double growth = 2.0;
  constexpr double shrinkage = 0.25;
  constexpr double safety = 0.9;
  // Relative to the remaining time: accepted whatever its error. No step is shorter than half of
  // it, so that no tolerance makes steps that do not advance.
  constexpr double shortest = 1e-6;

  const double ahead = job.Backward ? lanes.Time[lane] : 1.0 - lanes.Time[lane];
  // What is left before the run's end, and how far the error is below the tolerance: bounded both
  // ways, so that an error of 0 or a huge one give finite steps.
  const double ratio = tolerance / larger(lanes.Error[lane], 1e-300);
  const double factor = safety * __builtin_sqrt(__builtin_sqrt(smaller(ratio, 1e6)));
  const double length = lanes.Step[lane];
  const double next = length * smaller(larger(factor, shrinkage), growth);
  lanes.Step[lane] = larger(next, 0.5 * shortest * ahead);
  return !(ratio < 1.0 && length > shortest * ahead);
}

// Takes an accepted step of one lane: the corrected position becomes the current one, and the new
// velocity the newest of its history.
template <int Dimension>
RT_INLINE void acceptStep(double before, double after, int lane, AdaptiveLanes<Dimension>& lanes)
{
  MultistepLanes<Dimension>& steps = lanes.Steps;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    steps.Position[axis][lane] = lanes.Corrected[axis][lane];
    (*steps.V[2])[axis][lane] = (*steps.V[1])[axis][lane];
    (*steps.V[1])[axis][lane] = (*steps.V[0])[axis][lane];
    (*steps.V[0])[axis][lane] = (*steps.V[3])[axis][lane];
  }
  lanes.Back[1][lane] = lanes.Back[0][lane];
  lanes.Back[0][lane] = before;
  lanes.Time[lane] = after;
  lanes.History[lane] = smaller(lanes.History[lane] + 1.0, 2.0);
}

// Ends the path of a lane that has come to a time from which its end is known: backward its box is
// the whole domain (or no time is left) and the seed is written; forward the box is no wider than a
// cell, and x(1) is left in End.
template <int Dimension>
RT_INLINE void finishAdaptive(const FlowJob<Dimension>& job, const std::int64_t* index,
  double cellTime, double time, int lane, AdaptiveLanes<Dimension>& lanes)
{
  const MultistepLanes<Dimension>& steps = lanes.Steps;
  if (job.Backward)
  {
    if (isBoxWhole<Dimension>(job, steps.Position, lane, time))
    {
      writeSeed<Dimension>(job, steps.Position, lane, time, index[lane]);
      lanes.Active[lane] = false;
    }
    else if (time <= earliestTime)
    {
      writeSeed<Dimension>(job, steps.Position, lane, 0.0, index[lane]);
      lanes.Active[lane] = false;
    }
  }
  else if (time >= cellTime)
  {
    finishInCells<Dimension>(job.Tables, steps.Position, lane, time, lanes.End);
    lanes.Active[lane] = false;
  }
}

// Writes the end points of a forward run.
template <int Dimension>
RT_INLINE void writeAdaptiveEnds(const FlowJob<Dimension>& job, int count,
  PathWriter<Dimension>& writer, AdaptiveLanes<Dimension>& lanes, bool* unresolved)
{
  MultistepLanes<Dimension>& steps = lanes.Steps;
  for (int i = count; i < BlockSize; ++i)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      // Lanes without a particle: any valid place.
      lanes.End[axis][i] = 0.0;
    }
  }
  finishPositions<Dimension>(job, count, lanes.End, unresolved);
  if (!writer.IsDense())
  {
    writer.WriteEnd(lanes.End);
    return;
  }
  finalVelocity<Dimension>(job, lanes.End, *steps.V[3]);
  for (int i = 0; i < count; ++i)
  {
    writer.WriteHermite(i, lanes.Time[i], 1.0, steps.Position, *steps.V[0], lanes.End, *steps.V[3]);
  }
}

// Either direction. Forward from the end of the straight start until the box is no wider than a
// cell; backward from time 1 until the box is the whole domain. Lanes have times and steps of their
// own: a round of the loop tries one step of each lane that is not finished.
template <int Dimension>
std::int64_t advectAdaptive(const FlowJob<Dimension>& job, const double* seeds,
  const std::int64_t* index, int count, int refinement, bool* unresolved)
{
  AdaptiveLanes<Dimension> lanes;
  MultistepLanes<Dimension>& steps = lanes.Steps;
  PathWriter<Dimension> writer(job, seeds, index, count);
  loadPositions<Dimension>(job, seeds, count, steps.Position);
  double widest = 0.0;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    widest = larger(widest, job.Tables.Size[axis]);
  }
  // The widest side of the unclipped box, S (1 - t) / t, is one cell.
  const double cellTime = widest / (1.0 + widest);
  const double direction = job.Backward ? -1.0 : 1.0;
  // A particle that is redone gets a tolerance 4^-refinement times as large.
  double tolerance = job.Tolerance;
  for (int k = 0; k < refinement; ++k)
  {
    tolerance *= 0.25;
  }

  int left = startAdaptive<Dimension>(job, count, cellTime, writer, lanes);
  std::int64_t evaluations = 0;
  for (std::int64_t step = 0; left > 0; ++step)
  {
    if (shouldStop<Dimension>(job, step))
    {
      return evaluations;
    }
    setTargetTimes<Dimension>(job, cellTime, direction, lanes);
    predictAdaptive<Dimension>(job, lanes, direction);
    evaluateVelocity<Dimension>(
      job, steps.Field, count, lanes.Predicted, steps.Time, *steps.V[0], *steps.V[3], lanes.Active);
    correctAdaptive<Dimension>(job, lanes, direction);
    evaluations += left;
    for (int i = 0; i < count; ++i)
    {
      if (!lanes.Active[i] || !controlStep<Dimension>(job, tolerance, i, lanes))
      {
        continue;
      }
      // The boxes of rejected steps do not count.
      unresolved[i] = unresolved[i] || steps.Field.Void[i] > 0.0;
      const double before = lanes.Time[i];
      const double after = steps.Time[i];
      if (writer.IsDense())
      {
        writer.WriteHermite(
          i, before, after, steps.Position, *steps.V[0], lanes.Corrected, *steps.V[3]);
      }
      acceptStep<Dimension>(before, after, i, lanes);
      finishAdaptive<Dimension>(job, index, cellTime, after, i, lanes);
      left -= lanes.Active[i] ? 0 : 1;
    }
  }
  if (!job.Backward)
  {
    writeAdaptiveEnds<Dimension>(job, count, writer, lanes, unresolved);
  }
  return evaluations;
}
