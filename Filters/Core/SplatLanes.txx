// SPDX-License-Identifier: BSD-3-Clause
// A block of particles in structure-of-arrays lanes: its coordinates in index space. Included by
// SplatKernels.txx.

using Lanes = double[splatBlock];

RT_INLINE double absolute(double x)
{
  return __builtin_fabs(x);
}

RT_INLINE std::int32_t smaller(std::int32_t a, std::int32_t b)
{
  return a < b ? a : b;
}

RT_INLINE std::int32_t larger(std::int32_t a, std::int32_t b)
{
  return a > b ? a : b;
}

// Where the particles of a block are in memory: lane i is at(i). Lanes from the count on repeat the
// last particle; their results are not used.
struct WholeBlock
{
  RT_INLINE std::int64_t operator()(int i) const { return i; }
};

struct PartOfBlock
{
  RT_INLINE std::int64_t operator()(int i) const { return i < this->Count ? i : this->Count - 1; }
  int Count;
};

struct IndexedBlock
{
  RT_INLINE std::int64_t operator()(int i) const
  {
    return this->Index[i < this->Count ? i : this->Count - 1];
  }
  const std::uint32_t* Index;
  int Count;
};

// The one axis of physical space that a row of the map reads, -1 if it reads several. Most images
// have no direction; what is left out would add 0.
RT_INLINE int onlyAxis(const double* row)
{
  const int zeros = (row[0] == 0.0) + (row[1] == 0.0) + (row[2] == 0.0);
  return zeros < 2 ? -1 : row[0] != 0.0 ? 0 : row[1] != 0.0 ? 1 : 2;
}

// The particles of a block: where they are in physical space and then, moved to the border where
// they are not inside, in index space; and their masses.
template <int Dimension>
struct Block
{
  int Count;
  Lanes Point[3];
  Lanes X[Dimension];
  Lanes Mass;
  Lanes Beyond; // by how much particles are outside, or no number, if any are
};

// Reads a block of particles from `first` on.
template <int Dimension, class Real, class At>
RT_INLINE void readBlock(
  const SplatJob<Dimension, Real>& job, std::int64_t first, const At& at, Block<Dimension>& block)
{
  const Real* __restrict points = job.Particles.Points + 3 * first;
  double* __restrict x = block.Point[0];
  double* __restrict y = block.Point[1];
  double* __restrict z = block.Point[2];
  double* __restrict mass = block.Mass;
#pragma omp simd
  for (int i = 0; i < splatBlock; ++i)
  {
    const Real* point = points + 3 * at(i);
    x[i] = point[0];
    y[i] = point[1];
    z[i] = point[2];
  }
  const double scale = job.Scale;
  if (!job.Particles.Masses)
  {
    const double each = scale * job.Particles.Mass;
#pragma omp simd
    for (int i = 0; i < splatBlock; ++i)
    {
      mass[i] = each;
    }
    return;
  }
  const double* __restrict masses = job.Particles.Masses + first;
#pragma omp simd
  for (int i = 0; i < splatBlock; ++i)
  {
    mass[i] = scale * masses[at(i)];
  }
}

// Particles first + begin, ... of a range, or with an index first + index[begin], ....
template <int Dimension, class Real>
RT_INLINE void readBlock(const SplatJob<Dimension, Real>& job, std::int64_t first,
  const std::uint32_t* index, std::int64_t begin, Block<Dimension>& block)
{
  if (index)
  {
    readBlock(job, first, IndexedBlock{ index + begin, block.Count }, block);
  }
  else if (block.Count < splatBlock)
  {
    readBlock(job, first + begin, PartOfBlock{ block.Count }, block);
  }
  else
  {
    readBlock(job, first + begin, WholeBlock{}, block);
  }
}

// Row `a` of the map.
template <int Dimension>
RT_INLINE void mapLanes(
  const SplatMap<Dimension>& map, int a, const Lanes* __restrict point, double* __restrict x)
{
  const double* row = map.Matrix[a];
  const int axis = onlyAxis(row);
  if (axis >= 0)
  {
    const double factor = row[axis];
    const double origin = map.Origin[axis];
    const double* __restrict along = point[axis];
#pragma omp simd
    for (int i = 0; i < splatBlock; ++i)
    {
      x[i] = factor * (along[i] - origin);
    }
    return;
  }
  const double row0 = row[0];
  const double row1 = row[1];
  const double row2 = row[2];
  const double origin0 = map.Origin[0];
  const double origin1 = map.Origin[1];
  const double origin2 = map.Origin[2];
#pragma omp simd
  for (int i = 0; i < splatBlock; ++i)
  {
    x[i] = row0 * (point[0][i] - origin0) + row1 * (point[1][i] - origin1) +
      row2 * (point[2][i] - origin2);
  }
}

// Adds to `beyond` by how much lanes are further than `tolerance` from [0, size]; that is no number
// where the map has overflowed.
RT_INLINE void addBeyond(
  const double* __restrict x, double size, double tolerance, double* __restrict beyond)
{
  const double half = 0.5 * size;
  const double allowed = half + tolerance;
#pragma omp simd
  for (int i = 0; i < splatBlock; ++i)
  {
    const double excess = absolute(x[i] - half) - allowed;
    beyond[i] += excess <= 0.0 ? 0.0 : excess;
  }
}

RT_INLINE void clampLanes(double* __restrict x, double size)
{
#pragma omp simd
  for (int i = 0; i < splatBlock; ++i)
  {
    const double above = x[i] > 0.0 ? x[i] : 0.0;
    x[i] = above < size ? above : size;
  }
}

RT_INLINE double sumOfLanes(const double* __restrict lanes)
{
  double sum = 0.0;
#pragma omp simd reduction(+ : sum)
  for (int i = 0; i < splatBlock; ++i)
  {
    sum += lanes[i];
  }
  return sum;
}

// Whether no particle of a block, which has been read, comes near a box along the last axis.
template <int Dimension, class Real>
RT_INLINE bool isFarFrom(const SplatJob<Dimension, Real>& job, const Block<Dimension>& block,
  const CellBox<Dimension>& box)
{
  constexpr int a = Dimension - 1;
  const double size = job.Size[a];
  Lanes x;
  mapLanes(job.Particles.ToIndex, a, block.Point, x);
  clampLanes(x, size);
  // Further than the kernel reaches by more than rounding; where the border moves its cells, they
  // are within its width.
  const double reach = 0.5 * job.Width + 1.0;
  const double low = box.Low[a] <= job.Width ? 0.0 : box.Low[a] - reach;
  const double high = box.High[a] >= job.Size[a] - job.Width ? size : box.High[a] + reach;
  Lanes near;
#pragma omp simd
  for (int i = 0; i < splatBlock; ++i)
  {
    near[i] = (x[i] >= low ? 1.0 : 0.0) * (x[i] <= high ? 1.0 : 0.0);
  }
  return sumOfLanes(near) == 0.0;
}

// How many particles of a block are outside, of those whose first cell is within a box (null: of
// all): every particle is counted once, however many boxes it reaches.
template <int Dimension>
int countOutside(
  const Block<Dimension>& block, const SplatCells* first, const CellBox<Dimension>* box)
{
  int outside = 0;
  for (int i = 0; i < block.Count; ++i)
  {
    const bool isOutside = !(block.Beyond[i] == 0.0);
    const std::int32_t cell = first[Dimension - 1][i];
    const bool counts =
      !box || (cell >= box->Low[Dimension - 1] && cell < box->High[Dimension - 1]);
    outside += isOutside && counts ? 1 : 0;
  }
  return outside;
}

// Places a block that has been read. Returns whether any particles are outside.
template <int Dimension, class Real>
RT_INLINE bool placeBlock(const SplatJob<Dimension, Real>& job, Block<Dimension>& block)
{
  const SplatMap<Dimension>& map = job.Particles.ToIndex;
  double* __restrict beyond = block.Beyond;
#pragma omp simd
  for (int i = 0; i < splatBlock; ++i)
  {
    beyond[i] = 0.0;
  }
  for (int a = 0; a < Dimension; ++a)
  {
    mapLanes(map, a, block.Point, block.X[a]);
    addBeyond(block.X[a], job.Size[a], map.Tolerance[a], beyond);
    clampLanes(block.X[a], job.Size[a]);
  }
  for (int a = Dimension; a < 3; ++a)
  {
    Lanes across;
    mapLanes(map, a, block.Point, across);
    addBeyond(across, 0.0, map.Tolerance[a], beyond);
  }
  if (sumOfLanes(beyond) == 0.0)
  {
    return false;
  }
  for (int i = 0; i < block.Count && !job.Renormalize; ++i)
  {
    block.Mass[i] = beyond[i] == 0.0 ? block.Mass[i] : 0.0;
  }
  return true;
}

// Moves weights of the cells from `cell` on to the `kept` ones from the returned one on, which are
// inside; what was outside is shared among them or lost.
RT_INLINE std::int32_t keepInside(
  std::int32_t cell, int width, int kept, std::int32_t size, bool renormalize, double* weight)
{
  const std::int32_t first = smaller(larger(cell, 0), size - kept);
  const std::int32_t shift = first - cell;
  double sum = 0.0;
  // Weights move towards the first if the first cells are outside, else away from it: none is
  // overwritten before it is read.
  for (int step = 0; step < kept; ++step)
  {
    const int k = shift >= 0 ? step : kept - 1 - step;
    const int from = k + shift;
    weight[k] = from >= 0 && from < width ? weight[from] : 0.0;
    sum += weight[k];
  }
  for (int k = 0; k < kept && renormalize; ++k)
  {
    weight[k] /= sum;
  }
  return first;
}
