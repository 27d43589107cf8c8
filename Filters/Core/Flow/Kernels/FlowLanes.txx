// SPDX-License-Identifier: BSD-3-Clause
// Steps common to all integrators: load a block, advance it along its exact straight start, write
// positions at the requested times, check the end points. Included by FlowKernels.txx.

// Polls for cancellation before `step`, every 64 steps.
template <int Dimension>
RT_INLINE bool shouldStop(const FlowJob<Dimension>& job, std::int64_t step)
{
  constexpr std::int64_t interval = 64;
  return step % interval == interval - 1 && job.ShouldStop && job.ShouldStop(job.ClientData);
}

// Lanes from `count` on repeat the last particle: their results are not used.
template <int Dimension>
RT_INLINE void loadPositions(
  const FlowJob<Dimension>& job, const double* seeds, int count, LaneVectors<Dimension>& x)
{
  for (int i = 0; i < BlockSize; ++i)
  {
    const double* point = seeds + (i < count ? i : count - 1) * Dimension;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      x[axis][i] = clampToDomain(point[axis], job.Tables.Size[axis]);
    }
  }
}

// While a particle's box is the whole domain, its path is the straight line x0 + t (M - x0), M the
// centroid, until t* (endOfStraightStart). `time` is t*; the particle is moved there, and
// `velocity` is M - x0. Exact.
template <int Dimension>
RT_INLINE void startStraight(const FlowJob<Dimension>& job, LaneVectors<Dimension>& x,
  LaneVectors<Dimension>& velocity, Lanes& time)
{
#pragma omp simd
  for (int i = 0; i < BlockSize; ++i)
  {
    time[i] = 1.0;
  }
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double size = job.Tables.Size[axis];
    const double centroid = job.Tables.Centroid[axis];
#pragma omp simd
    for (int i = 0; i < BlockSize; ++i)
    {
      time[i] = smaller(time[i], endOfStraightStart(x[axis][i], size, centroid));
      velocity[axis][i] = centroid - x[axis][i];
    }
  }
  for (int axis = 0; axis < Dimension; ++axis)
  {
#pragma omp simd
    for (int i = 0; i < BlockSize; ++i)
    {
      x[axis][i] += time[i] * velocity[axis][i];
    }
  }
}

// Writes positions at the requested times, or at time 1 alone. Particles are advected to time 1 in
// any case: whether one must be redone with smaller steps depends on its end point.
template <int Dimension>
struct PathWriter
{
  PathWriter(
    const FlowJob<Dimension>& job, const double* seeds, const std::int64_t* index, int count)
    : Job(job)
    , Seeds(seeds)
    , Index(index)
    , Count(count)
  {
    for (int i = 0; i < count; ++i)
    {
      this->Next[i] = 0;
    }
  }

  bool IsDense() const { return this->Job.Times != nullptr; }

  double* Place(int lane, std::int64_t time) const
  {
    return this->Job.Output + (this->Index[lane] * this->Job.TimeCount + time) * Dimension;
  }

  // Writes the times up to `end` of a lane's path, where place(s, axis) is the position at time s.
  template <class PositionAt>
  RT_INLINE void WriteUntil(int lane, double end, const PositionAt& place)
  {
    std::int64_t& next = this->Next[lane];
    // Times ascend, as the calls of a lane do: each is written once.
    while (next < this->Job.TimeCount && this->Job.Times[next] <= end)
    {
      double* position = this->Place(lane, next);
      for (int axis = 0; axis < Dimension; ++axis)
      {
        const double value = place(this->Job.Times[next], axis);
        position[axis] = smaller(larger(value, 0.0), this->Job.Tables.Size[axis]);
      }
      ++next;
    }
  }

  // The straight start from the seed, until `end`. At time 0 the seed itself.
  void WriteStraight(const LaneVectors<Dimension>& velocity, const Lanes& end)
  {
    for (int i = 0; i < this->Count; ++i)
    {
      const double* seed = this->Seeds + i * Dimension;
      this->WriteUntil(
        i, end[i], [&](double s, int axis) { return seed[axis] + s * velocity[axis][i]; });
    }
  }

  // The cubic Hermite interpolant over one step of one lane: positions x0, x1 and velocities v0, v1
  // at its ends. With r the place in the step and h its length, by the Bernstein form
  //   (1-r)^2 (x0 + r h v0 + 2 r x0) + r^2 (x1 - (1-r) h v1 + 2 (1-r) x1).
  // Its error is O(h^4), like that of a step: positions within a step are no worse than at its
  // ends.
  RT_INLINE void WriteHermite(int lane, double begin, double end, const LaneVectors<Dimension>& x0,
    const LaneVectors<Dimension>& v0, const LaneVectors<Dimension>& x1,
    const LaneVectors<Dimension>& v1)
  {
    const double length = end - begin;
    this->WriteUntil(lane, end, [&](double s, int axis) {
      const double r = (s - begin) / length;
      const double rest = 1.0 - r;
      const double start = x0[axis][lane] + r * length * v0[axis][lane];
      const double stop = x1[axis][lane] - rest * length * v1[axis][lane];
      return rest * rest * (start + 2.0 * r * x0[axis][lane]) +
        r * r * (stop + 2.0 * rest * x1[axis][lane]);
    });
  }

  // The end point, at time 1.
  void WriteEnd(const LaneVectors<Dimension>& x)
  {
    for (int i = 0; i < this->Count; ++i)
    {
      if (!this->IsDense() || this->Next[i] < this->Job.TimeCount)
      {
        double* position = this->Place(i, this->Job.TimeCount - 1);
        for (int axis = 0; axis < Dimension; ++axis)
        {
          position[axis] = x[axis][i];
        }
      }
    }
  }

  const FlowJob<Dimension>& Job;
  const double* Seeds;          // interleaved, of the block
  const std::int64_t* Index;    // of the block's particles in the output
  int Count;                    // of particles
  std::int64_t Next[BlockSize]; // the first time that is not written yet
};

// Whether the grid cell of a point has mass. Points on the high faces belong to the last cell.
template <int Dimension>
RT_INLINE bool isOccupied(const TableView<Dimension>& tables, const double (&point)[Dimension])
{
  if (!tables.Occupied)
  {
    return true;
  }
  std::int64_t cell[Dimension];
  for (int axis = 0; axis < Dimension; ++axis)
  {
    // Truncated: coordinates are not negative.
    const std::int64_t last = tables.Cells[axis] - 1;
    cell[axis] = static_cast<std::int64_t>(point[axis]);
    cell[axis] = cell[axis] < last ? cell[axis] : last;
  }
  std::int64_t row = 0;
  for (int axis = Dimension - 1; axis > 0; --axis)
  {
    row = row * tables.Cells[axis] + cell[axis];
  }
  // One bit a cell; a row of cells along axis 0 starts with a new word.
  const std::uint64_t word = tables.Occupied[row * tables.WordsPerRow + (cell[0] >> 6)];
  return (word >> (cell[0] & 63)) & 1;
}

// Clamps end points to the domain and marks those in empty grid cells as unresolved.
template <int Dimension>
RT_INLINE void finishPositions(
  const FlowJob<Dimension>& job, int count, LaneVectors<Dimension>& x, bool* unresolved)
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double size = job.Tables.Size[axis];
#pragma omp simd
    for (int i = 0; i < BlockSize; ++i)
    {
      x[axis][i] = smaller(larger(x[axis][i], 0.0), size);
    }
  }
  // Backward the ends are uniform in the domain, whatever the density; and without bits every cell
  // has mass.
  if (job.Backward || !job.Tables.Occupied)
  {
    return;
  }
  for (int i = 0; i < count; ++i)
  {
    double point[Dimension];
    for (int axis = 0; axis < Dimension; ++axis)
    {
      point[axis] = x[axis][i];
    }
    unresolved[i] = unresolved[i] || !isOccupied<Dimension>(job.Tables, point);
  }
}
