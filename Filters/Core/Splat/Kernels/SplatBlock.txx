// SPDX-License-Identifier: BSD-3-Clause
// A block of particles and their coordinates in index space, in which cell i is [i, i + 1] along an
// axis. Included by SplatKernels.txx.

RT_INLINE std::int32_t smaller(std::int32_t a, std::int32_t b)
{
  return a < b ? a : b;
}

RT_INLINE std::int32_t larger(std::int32_t a, std::int32_t b)
{
  return a > b ? a : b;
}

// Vectors of GCC, as it does not vectorize loops over a period of coordinates.
template <class Number>
struct FourOf
{
  // GCC ignores the attribute where `using` names a type that depends on arguments.
  typedef Number Type __attribute__((vector_size(4 * sizeof(Number))));
};
using Four = FourOf<double>::Type;
using FourCells = FourOf<std::int32_t>::Type;

template <class Number>
RT_INLINE typename FourOf<Number>::Type load(const Number* from)
{
  typename FourOf<Number>::Type four;
  __builtin_memcpy(&four, from, sizeof four);
  return four;
}

template <class Vector, class Number>
RT_INLINE void store(const Vector& four, Number* to)
{
  static_assert(sizeof four == 4 * sizeof *to, "four numbers");
  __builtin_memcpy(to, &four, sizeof four);
}

// The least number of interleaved coordinates, x y z x y z ..., that are whole particles and whole
// vectors. Loops over the periods of a block stay rolled: -O3 would copy each body sixteen times.
constexpr int coordinatePeriod = 12;
constexpr int vectorsOfPeriod = 3;
constexpr int blockCoordinates = 3 * splatBlock;
static_assert(blockCoordinates % coordinatePeriod == 0, "blocks are whole periods");

// A number of each coordinate of a period.
struct Period
{
  double Of[coordinatePeriod];
  RT_INLINE Four operator[](int vector) const { return load(this->Of + 4 * vector); }
};

// The parameters of a job's axes, repeated for the coordinates of a period. Axes beyond the
// Dimension have size 0.
template <int Dimension, class Real>
struct Axes
{
  RT_INLINE explicit Axes(const SplatJob<Dimension, Real>& job)
  {
    constexpr double roundings = 0x1p-50;
    const IndexMap<Dimension>& map = job.Particles.ToIndex;
    this->AreParallel = true;
    for (int j = 0; j < coordinatePeriod; ++j)
    {
      const int a = j % 3;
      const double* row = map.Matrix[a];
      this->AreParallel = this->AreParallel && row[(a + 1) % 3] == 0.0 && row[(a + 2) % 3] == 0.0;
      this->Factor.Of[j] = row[a];
      this->Origin.Of[j] = map.Origin[a];
      const double size = a < Dimension ? job.Size[a < Dimension ? a : 0] : 0.0;
      this->Size.Of[j] = size;
      this->Half.Of[j] = 0.5 * size;
      this->Allowed.Of[j] = 0.5 * size + map.Tolerance[a];
      this->Within.Of[j] = a < Dimension ? 0.5 * size : this->Allowed.Of[j];
      this->Inside.Of[j] =
        a < Dimension ? 0.5 * size - 1.0 - roundings * size : this->Allowed.Of[j];
    }
  }

  bool AreParallel; // to those of physical space, as in most images: axis a is axis a there
  Period Factor;
  Period Origin;
  Period Size;
  Period Half;
  // Largest distances from the middle of the domain of a particle that is
  Period Allowed; // not outside
  Period Within;  // not moved to the border either
  Period Inside;  // more than one cell away from the border
};

// A block of particles. Coordinate a of particle i is number 3 i + a, as in memory: a transposition
// would cost more than the weights do.
struct Block
{
  int Count;
  double X[blockCoordinates]; // in index space
  double Mass[splatBlock];
  double Beyond[splatBlock]; // distances outside, or NaN; set if any are outside
};

// Points to index space by the whole matrix; __restrict, as `from` and `x` do not overlap.
template <int Dimension>
RT_INLINE void mapOblique(
  const IndexMap<Dimension>& map, const double* __restrict from, double* __restrict x)
{
  for (int i = 0; i < splatBlock; ++i)
  {
    for (int a = 0; a < 3; ++a)
    {
      const double* row = map.Matrix[a];
      x[3 * i + a] = row[0] * (from[3 * i] - map.Origin[0]) +
        row[1] * (from[3 * i + 1] - map.Origin[1]) + row[2] * (from[3 * i + 2] - map.Origin[2]);
    }
  }
}

// The bounding box of particles, in index space [least, most] along the Dimension axes, clipped to
// the grid.
template <int Dimension, class Real>
RT_INLINE void findBounds(const SplatJob<Dimension, Real>& job, const Real* points,
  std::int64_t count, double* least, double* most)
{
  // First in physical space, in the lanes of a period, which are joined after the loop.
  Real low[coordinatePeriod];
  Real high[coordinatePeriod];
  for (int j = 0; j < coordinatePeriod; ++j)
  {
    low[j] = points[j % 3];
    high[j] = points[j % 3];
  }
  using Vector = typename FourOf<Real>::Type;
  Vector lows[vectorsOfPeriod];
  Vector highs[vectorsOfPeriod];
  __builtin_memcpy(lows, low, sizeof low);
  __builtin_memcpy(highs, high, sizeof high);
  const std::int64_t whole = 3 * count / coordinatePeriod * coordinatePeriod;
  for (std::int64_t begin = 0; begin < whole; begin += coordinatePeriod)
  {
    for (int v = 0; v < vectorsOfPeriod; ++v)
    {
      const Vector x = load(points + begin + 4 * v);
      lows[v] = x < lows[v] ? x : lows[v];
      highs[v] = x > highs[v] ? x : highs[v];
    }
  }
  __builtin_memcpy(low, lows, sizeof low);
  __builtin_memcpy(high, highs, sizeof high);
  for (std::int64_t j = whole; j < 3 * count; ++j)
  {
    low[j - whole] = points[j] < low[j - whole] ? points[j] : low[j - whole];
    high[j - whole] = points[j] > high[j - whole] ? points[j] : high[j - whole];
  }
  const IndexMap<Dimension>& map = job.Particles.ToIndex;
  for (int a = 0; a < Dimension; ++a)
  {
    least[a] = 0.0;
    most[a] = 0.0;
  }
  for (int r = 0; r < 3; ++r)
  {
    for (int j = r + 3; j < coordinatePeriod; j += 3)
    {
      low[r] = low[j] < low[r] ? low[j] : low[r];
      high[r] = high[j] > high[r] ? high[j] : high[r];
    }
    for (int a = 0; a < Dimension; ++a)
    {
      // The box of a linear map of a box: the extremes of each term add up. It holds all particles,
      // but need not be the smallest.
      const double one = map.Matrix[a][r] * (low[r] - map.Origin[r]);
      const double other = map.Matrix[a][r] * (high[r] - map.Origin[r]);
      least[a] += one < other ? one : other;
      most[a] += one < other ? other : one;
    }
  }
  for (int a = 0; a < Dimension; ++a)
  {
    // False if the map has overflowed.
    const double size = job.Size[a];
    const bool known = least[a] <= most[a];
    least[a] = known && least[a] > 0.0 ? (least[a] < size ? least[a] : size) : 0.0;
    most[a] = known && most[a] < size ? (most[a] > 0.0 ? most[a] : 0.0) : size;
  }
}

// Returns the box or, without one, the whole grid.
template <int Dimension, class Real>
RT_INLINE CellBox<Dimension> boxOrGrid(
  const SplatJob<Dimension, Real>& job, const CellBox<Dimension>* box)
{
  CellBox<Dimension> cells;
  for (int a = 0; a < Dimension; ++a)
  {
    cells.Low[a] = box ? box->Low[a] : 0;
    cells.High[a] = box ? box->High[a] : job.Size[a];
  }
  return cells;
}

// The offset in memory of a cell, which need not be in the box.
template <int Dimension>
RT_INLINE std::int64_t rowOffset(
  const CellMemory<Dimension>& memory, std::int64_t start, int j, int k)
{
  return start + (Dimension > 1 ? j * memory.Stride[Dimension > 1 ? 1 : 0] : 0) +
    (Dimension > 2 ? k * memory.Stride[Dimension - 1] : 0);
}

// The masses of `count` particles first + begin, ... of a range, or with an index first +
// index[begin], .... Lanes from the count on repeat the last one; their results are not used.
template <int Dimension, class Real>
RT_INLINE void readMasses(const SplatJob<Dimension, Real>& job, std::int64_t first,
  const std::uint32_t* index, std::int64_t begin, int count, double* __restrict mass)
{
  const double* masses = job.Particles.Masses;
  if (!masses)
  {
    const double each = job.Scale * job.Particles.Mass;
    for (int i = 0; i < splatBlock; ++i)
    {
      mass[i] = each;
    }
  }
  else if (!index && count == splatBlock)
  {
    for (int i = 0; i < splatBlock; ++i)
    {
      mass[i] = job.Scale * masses[first + begin + i];
    }
  }
  else
  {
    for (int i = 0; i < splatBlock; ++i)
    {
      const std::int64_t at = begin + smaller(i, count - 1);
      mass[i] = job.Scale * masses[first + (index ? index[at] : at)];
    }
  }
}

// Reads masses and points of block.Count particles, as readMasses.
template <int Dimension, class Real>
RT_INLINE void readBlock(const SplatJob<Dimension, Real>& job, const Axes<Dimension, Real>& axes,
  std::int64_t first, const std::uint32_t* index, std::int64_t begin, Block& block)
{
  readMasses(job, first, index, begin, block.Count, block.Mass);
  // Gathered first: coordinates of an index, of floats, or of fewer than a block.
  double from[blockCoordinates];
  for (int i = 0; i < splatBlock; ++i)
  {
    const std::int64_t at = begin + smaller(i, block.Count - 1);
    const Real* point = job.Particles.Points.data() + 3 * (first + (index ? index[at] : at));
    for (int r = 0; r < 3; ++r)
    {
      from[3 * i + r] = point[r];
    }
  }
  if (!axes.AreParallel)
  {
    mapOblique(job.Particles.ToIndex, from, block.X);
    return;
  }
#pragma GCC unroll 1
  for (int begins = 0; begins < blockCoordinates; begins += coordinatePeriod)
  {
    for (int v = 0; v < vectorsOfPeriod; ++v)
    {
      const int lane = begins + 4 * v;
      store(axes.Factor[v] * (load(from + lane) - axes.Origin[v]), block.X + lane);
    }
  }
}

// The first of the Span cells inside the grid for a particle that reaches cells from `first` on
// along axis `a`.
template <int Dimension, class Real>
RT_INLINE std::int32_t firstCell(const SplatJob<Dimension, Real>& job, int a, std::int32_t first)
{
  return smaller(larger(first, 0), job.Size[a] - job.Span[a]);
}

// The number of particles of a block that are outside, of those whose first cell along the last
// axis is in a box: so that each is counted once, however many boxes it reaches.
template <int Dimension, class Real>
int countOutside(const SplatJob<Dimension, Real>& job, const Block& block,
  const std::int32_t* first, const CellBox<Dimension>& box)
{
  constexpr int axis = Dimension - 1;
  int outside = 0;
  for (int i = 0; i < block.Count; ++i)
  {
    const std::int32_t cell = firstCell(job, axis, first[3 * i + axis]);
    const bool counts = cell >= box.Low[axis] && cell < box.High[axis];
    outside += !(block.Beyond[i] == 0.0) && counts ? 1 : 0;
  }
  return outside;
}

// Moves the particles of a block that are not inside to the border. Returns whether any are
// outside.
template <int Dimension, class Real>
RT_INLINE bool placeBlock(
  const SplatJob<Dimension, Real>& job, const Axes<Dimension, Real>& axes, Block& block)
{
  double beyond[blockCoordinates];
  Four sum = {};
#pragma GCC unroll 1
  for (int begin = 0; begin < blockCoordinates; begin += coordinatePeriod)
  {
    for (int v = 0; v < vectorsOfPeriod; ++v)
    {
      double* at = block.X + begin + 4 * v;
      const Four x = load(at);
      const Four offset = x - axes.Half[v];
      // NaN where the map has overflowed.
      const Four excess = (offset < 0.0 ? -offset : offset) - axes.Allowed[v];
      const Four outside = excess <= 0.0 ? Four{} : excess;
      store(outside, beyond + begin + 4 * v);
      sum += outside;
      // Clamped to [0, size]; NaN to 0.
      const Four above = x > 0.0 ? x : Four{};
      store(above < axes.Size[v] ? above : axes.Size[v], at);
    }
  }
  if (sum[0] + sum[1] + sum[2] + sum[3] == 0.0)
  {
    return false;
  }
  for (int i = 0; i < splatBlock; ++i)
  {
    // The mass of what is outside counts at the border with Renormalize, else not at all.
    block.Beyond[i] = beyond[3 * i] + beyond[3 * i + 1] + beyond[3 * i + 2];
    block.Mass[i] = job.Renormalize || block.Beyond[i] == 0.0 ? block.Mass[i] : 0.0;
  }
  return true;
}

// Shifts the weights of the cells from `cell` on to the `kept` cells from the returned one on,
// which are inside; the weights outside are distributed to them or dropped.
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
