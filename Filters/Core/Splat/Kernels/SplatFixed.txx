// SPDX-License-Identifier: BSD-3-Clause
// The B-spline kernels of order 0, 1 and 2, of a fixed number of cells an axis. The weights of a
// particle are products of those along the axes. Along each they sum to 1, and from order 1 on,
// inside of the grid, the mean of the cells' centres is the particle's place: mass and centroid are
// kept. Included by SplatKernels.txx.

// Rounds towards 0, four coordinates at a time: for coordinates from 0 on this is the cell.
RT_INLINE FourCells truncated(const Four& x)
{
  return __builtin_convertvector(x, FourCells);
}

// Subtracts one with wrap-around: the cell of a particle far outside may be any number.
RT_INLINE FourCells before(const FourCells& cells)
{
  return (FourCells)((FourOf<std::uint32_t>::Type)cells - 1);
}

// Weigh computes for coordinates in [0, size] the first cell, which may lie beyond the border, and
// the Parts numbers from which Spread computes the Width weights. `Inside`: the coordinates are
// more than one cell away from the border.
//
// Order 1: linear between the centres of two cells. With u the place from the lower one's centre,
// the weights are 1 - u and u.
struct CloudInCellWeights
{
  static constexpr int Width = 2;
  static constexpr int Parts = 1;
  template <bool Inside>
  static RT_INLINE FourCells Weigh(const Four& x, const Four&, Four* part)
  {
    const FourCells upper = truncated(x + 0.5);
    part[0] = x - (__builtin_convertvector(upper, Four) - 0.5);
    if (!Inside)
    {
      part[0] = part[0] > 0.0 ? part[0] : Four{}; // below 0 where x + 0.5 was rounded up to 1
    }
    return before(upper);
  }
  static RT_INLINE void Spread(const double* part, double* weight)
  {
    weight[0] = 1.0 - part[0];
    weight[1] = part[0];
  }
};

// Order 0: the whole mass goes to the particle's own cell.
struct NearestCellWeights
{
  static constexpr int Width = 1;
  static constexpr int Parts = 0;
  template <bool Inside>
  static RT_INLINE FourCells Weigh(const Four& x, const Four& size, Four*)
  {
    const Four last = size - 1.0;
    return truncated(Inside ? x : x < last ? x : last);
  }
  static RT_INLINE void Spread(const double*, double* weight) { weight[0] = 1.0; }
};

// Order 2: the particle's own cell and both neighbours. With u in [-1/2, 1/2] the place from the
// own cell's centre, the weights are (1/2 - u)^2 / 2, 3/4 - u^2, which is 1 less the others, and
// (1/2 + u)^2 / 2.
struct TriangularShapedCloudWeights
{
  static constexpr int Width = 3;
  static constexpr int Parts = 2;
  template <bool Inside>
  static RT_INLINE FourCells Weigh(const Four& x, const Four&, Four* part)
  {
    const FourCells own = truncated(x);
    const Four offset = x - (__builtin_convertvector(own, Four) + 0.5);
    part[0] = 0.5 * (0.5 - offset) * (0.5 - offset);
    part[1] = 0.5 * (0.5 + offset) * (0.5 + offset);
    return before(own);
  }
  static RT_INLINE void Spread(const double* part, double* weight)
  {
    weight[0] = part[0];
    weight[1] = 1.0 - part[0] - part[1];
    weight[2] = part[1];
  }
};

constexpr int atLeastOne(int count)
{
  return count > 0 ? count : 1;
}

// The first cells and weights of a block, coordinate by coordinate.
template <class Weights>
struct WeighedBlock
{
  std::int32_t First[blockCoordinates]; // the cells, which may lie beyond the border
  double Part[atLeastOne(Weights::Parts)][blockCoordinates];

  RT_INLINE void Spread(int coordinate, double* weight) const
  {
    double part[atLeastOne(Weights::Parts)] = {};
    for (int p = 0; p < Weights::Parts; ++p)
    {
      part[p] = this->Part[p][coordinate];
    }
    Weights::Spread(part, weight);
  }
};

// Computes the weights of a block, given in index space or, if `IsMapped`, in physical space.
// Returns whether all particles are inside, or if `Inside` more than one cell away from the border;
// if not, `weighed` is undefined.
template <bool Inside, bool IsMapped, int Dimension, class Weights, class Real, class From>
RT_INLINE bool weighBlock(
  const Axes<Dimension, Real>& axes, const From* __restrict from, WeighedBlock<Weights>& weighed)
{
  // Each coordinate has its own bound; NaN is within none.
  const Period& allowed = Inside ? axes.Inside : axes.Within;
  auto inside = Four{} == Four{};
#pragma GCC unroll 1
  for (int begin = 0; begin < blockCoordinates; begin += coordinatePeriod)
  {
    for (int v = 0; v < vectorsOfPeriod; ++v)
    {
      const int lane = begin + 4 * v;
      const Four place = __builtin_convertvector(load(from + lane), Four);
      const Four x = IsMapped ? axes.Factor[v] * (place - axes.Origin[v]) : place;
      const Four offset = x - axes.Half[v];
      inside &= (offset <= allowed[v]) & (-offset <= allowed[v]);
      Four part[atLeastOne(Weights::Parts)];
      store(Weights::template Weigh<Inside>(x, axes.Size[v], part), weighed.First + lane);
      for (int p = 0; p < Weights::Parts; ++p)
      {
        store(part[p], weighed.Part[p] + lane);
      }
    }
  }
  return (inside[0] & inside[1] & inside[2] & inside[3]) != 0;
}

// Returns the box of the cells that the particles of a block reach, if none is near the border.
template <int Dimension, class Weights>
RT_INLINE CellBox<Dimension> boxOf(const WeighedBlock<Weights>& weighed)
{
  FourCells low[vectorsOfPeriod];
  FourCells high[vectorsOfPeriod];
  for (int v = 0; v < vectorsOfPeriod; ++v)
  {
    // The extremes of each lane of a period first, then those of the lanes of one axis.
    low[v] = load(weighed.First + 4 * v);
    high[v] = low[v];
  }
#pragma GCC unroll 1
  for (int begin = coordinatePeriod; begin < blockCoordinates; begin += coordinatePeriod)
  {
    for (int v = 0; v < vectorsOfPeriod; ++v)
    {
      const FourCells cells = load(weighed.First + begin + 4 * v);
      low[v] = cells < low[v] ? cells : low[v];
      high[v] = cells > high[v] ? cells : high[v];
    }
  }
  CellBox<Dimension> box;
  for (int a = 0; a < Dimension; ++a)
  {
    box.Low[a] = low[0][a];
    box.High[a] = high[0][a];
    for (int j = a + 3; j < coordinatePeriod; j += 3)
    {
      box.Low[a] = smaller(box.Low[a], low[j / 4][j % 4]);
      box.High[a] = larger(box.High[a], high[j / 4][j % 4]);
    }
    box.High[a] += Weights::Width;
  }
  return box;
}

// Adds particle i to the cells that it reaches, of numbers [begin, end) along the last axis.
template <int Dimension, class Weights>
RT_INLINE void addLayers(const WeighedBlock<Weights>& weighed, int i, double mass,
  const CellMemory<Dimension>& memory, int begin, int end)
{
  constexpr int width = Weights::Width;
  constexpr int last = Dimension - 1;
  double weight[Dimension][width];
  double* cells = memory.Cells;
  std::int64_t start = -memory.Start;
  for (int a = 0; a < Dimension; ++a)
  {
    weighed.Spread(3 * i + a, weight[a]);
    start += weighed.First[3 * i + a] * memory.Stride[a];
  }
  int first[3] = { 0, 0, 0 };
  int after[3] = { width, Dimension > 1 ? width : 1, Dimension > 2 ? width : 1 };
  first[last] = begin;
  after[last] = end;
#pragma GCC unroll 3
  for (int k = first[2]; k < after[2]; ++k)
  {
    const double slice = Dimension > 2 ? mass * weight[last][k] : mass;
#pragma GCC unroll 3
    for (int j = first[1]; j < after[1]; ++j)
    {
      const double row = Dimension > 1 ? slice * weight[Dimension > 1 ? 1 : 0][j] : slice;
      const std::int64_t to = rowOffset(memory, start, j, k);
#pragma GCC unroll 3
      for (int l = first[0]; l < after[0]; ++l)
      {
        cells[to + l] += row * weight[0][l];
      }
    }
  }
}

// Adds particle i to all cells that it reaches.
template <int Dimension, class Weights>
RT_INLINE void addWhole(
  const WeighedBlock<Weights>& weighed, int i, double mass, const CellMemory<Dimension>& memory)
{
  addLayers(weighed, i, mass, memory, 0, Weights::Width);
}

// Adds particle i, which may be at the border, to the cells of a box.
template <int Dimension, class Weights, class Real>
void addPart(const SplatJob<Dimension, Real>& job, const WeighedBlock<Weights>& weighed, int i,
  double mass, const CellBox<Dimension>& box)
{
  constexpr int width = Weights::Width;
  double weight[3][width];
  int begin[3] = { 0, 0, 0 };
  int end[3] = { 1, 1, 1 };
  double* cells = job.Memory.Cells;
  std::int64_t start = -job.Memory.Start;
  for (int a = 0; a < Dimension; ++a)
  {
    weighed.Spread(3 * i + a, weight[a]);
    const std::int32_t size = job.Size[a];
    std::int32_t first = weighed.First[3 * i + a];
    if (first < 0 || first + width > size)
    {
      // At the border of the grid, weights outside are redistributed or dropped.
      first = keepInside(first, width, job.Span[a], size, job.Renormalize, weight[a]);
    }
    start += first * job.Memory.Stride[a];
    // The range of the particle's cells that is in the box.
    begin[a] = larger(box.Low[a] - first, 0);
    end[a] = smaller(box.High[a] - first, job.Span[a]);
  }
  for (int k = begin[2]; k < end[2]; ++k)
  {
    const double slice = Dimension > 2 ? mass * weight[2][k] : mass;
    for (int j = begin[1]; j < end[1]; ++j)
    {
      const double row = Dimension > 1 ? slice * weight[1][j] : slice;
      const std::int64_t to = rowOffset(job.Memory, start, j, k);
      for (int l = begin[0]; l < end[0]; ++l)
      {
        cells[to + l] += row * weight[0][l];
      }
    }
  }
}

// How many of the cells that particles reach are in a box.
enum class Covered
{
  None,
  Some,
  All
};

// Both boxes are half-open ranges of cells along each axis.
template <int Dimension>
RT_INLINE Covered coveredBy(const CellBox<Dimension>& reached, const CellBox<Dimension>& box)
{
  Covered covered = Covered::All;
  for (int a = 0; a < Dimension; ++a)
  {
    if (reached.Low[a] >= box.High[a] || reached.High[a] <= box.Low[a])
    {
      return Covered::None;
    }
    if (reached.Low[a] < box.Low[a] || reached.High[a] > box.High[a])
    {
      covered = Covered::Some;
    }
  }
  return covered;
}

// Splats a range of particles, block by block. Most blocks lie inside the grid and the box, and
// need no test of single particles.
template <int Dimension, class Weights, class Real>
class FixedSplat
{
public:
  static constexpr int Width = Weights::Width;

  // See AddParticles.
  static std::int64_t Add(const SplatJob<Dimension, Real>& job, std::int64_t first,
    const std::uint32_t* index, std::int64_t count, const CellBox<Dimension>* box, double*)
  {
    FixedSplat splat(job, box);
    std::int64_t outside = 0;
    for (std::int64_t begin = 0; begin < count; begin += splatBlock)
    {
      const std::int64_t left = count - begin;
      const int number = left < splatBlock ? static_cast<int>(left) : splatBlock;
      outside += splat.Weigh(first, index, begin, number);
      const Covered covered = box && splat.IsInside
        ? coveredBy(boxOf<Dimension>(splat.Weighed), splat.Box)
        : Covered::All;
      if (covered == Covered::All && splat.IsInside)
      {
        splat.AddWhole();
      }
      else if (covered != Covered::None)
      {
        splat.AddParts();
      }
    }
    return outside;
  }

  // See FindCells.
  static std::int64_t Find(
    const SplatJob<Dimension, Real>& job, std::int64_t first, int count, std::int32_t* cells)
  {
    FixedSplat splat(job, nullptr);
    std::int64_t outside = 0;
    for (int begin = 0; begin < count; begin += splatBlock)
    {
      const int number = smaller(count - begin, splatBlock);
      outside += splat.Weigh(first, nullptr, begin, number);
      for (int i = 0; i < number; ++i)
      {
        for (int a = 0; a < Dimension; ++a)
        {
          cells[3 * (begin + i) + a] = firstCell(job, a, splat.Weighed.First[3 * i + a]);
        }
      }
    }
    return outside;
  }

  // See BoxOfParticles. The cell is monotonic in the coordinate, so the cells of the bounds,
  // widened by the rounding of the map, bound those of all particles.
  static CellBox<Dimension> Reach(
    const SplatJob<Dimension, Real>& job, std::int64_t first, std::int64_t count)
  {
    constexpr double below = 0.5 * (Weights::Width - 1);
    constexpr double rounding = 0x1p-10; // above that of the map
    double least[Dimension];
    double most[Dimension];
    findBounds(job, job.Particles.Points.data() + 3 * first, count, least, most);
    CellBox<Dimension> box;
    for (int a = 0; a < Dimension; ++a)
    {
      // Negative numbers are truncated upwards, but firstCell raises them to 0 anyway.
      box.Low[a] = firstCell(job, a, static_cast<std::int32_t>(least[a] - below - rounding));
      box.High[a] =
        firstCell(job, a, static_cast<std::int32_t>(most[a] - below + rounding)) + job.Span[a];
    }
    return box;
  }

private:
  // Without a box, the whole grid is one.
  RT_INLINE FixedSplat(const SplatJob<Dimension, Real>& job, const CellBox<Dimension>* box)
    : Job(job)
    , JobAxes(job)
    , Box(boxOrGrid(job, box))
  {
  }

  // Computes the weights of the `count` particles first + begin, ... of a range, or with an index
  // first + index[begin], .... Returns how many are outside.
  RT_INLINE int Weigh(std::int64_t first, const std::uint32_t* index, std::int64_t begin, int count)
  {
    // Gathered, short or oblique blocks are read into memory of their own first.
    this->Particles.Count = count;
    if (index || count < splatBlock || !this->JobAxes.AreParallel)
    {
      readBlock(this->Job, this->JobAxes, first, index, begin, this->Particles);
      return this->WeighPlaced();
    }
    const Real* points = this->Job.Particles.Points.data() + 3 * (first + begin);
    // Straight from memory, once more where particles are at the border, and by the slow way where
    // any are outside.
    this->IsInside = weighBlock<true, true>(this->JobAxes, points, this->Weighed);
    if (!this->IsInside && !weighBlock<false, true>(this->JobAxes, points, this->Weighed))
    {
      readBlock(this->Job, this->JobAxes, first, index, begin, this->Particles);
      return this->WeighPlaced();
    }
    readMasses(this->Job, first, index, begin, count, this->Particles.Mass);
    return 0;
  }

  // Weighs particles that are already in index space; returns how many are outside.
  int WeighPlaced()
  {
    this->IsInside = weighBlock<true, false>(this->JobAxes, this->Particles.X, this->Weighed);
    if (this->IsInside)
    {
      return 0;
    }
    const bool anyOutside = placeBlock(this->Job, this->JobAxes, this->Particles);
    weighBlock<false, false>(this->JobAxes, this->Particles.X, this->Weighed);
    return anyOutside ? countOutside(this->Job, this->Particles, this->Weighed.First, this->Box)
                      : 0;
  }

  // No particle is near the border or the face of the box: each adds all of its weights.
  RT_INLINE void AddWhole()
  {
    const CellMemory<Dimension> memory = this->Job.Memory; // as the cells might alias the job
    for (int i = 0; i < this->Particles.Count; ++i)
    {
      addWhole(this->Weighed, i, this->Particles.Mass[i], memory);
    }
  }

  // A slab: the box is as wide as the grid along all axes but the last.
  bool IsSlab() const
  {
    for (int a = 0; a + 1 < Dimension; ++a)
    {
      if (this->Box.Low[a] > 0 || this->Box.High[a] < this->Job.Size[a])
      {
        return false;
      }
    }
    return true;
  }

  // Particle by particle: those within the box are added as a whole, those at its border in part.
  void AddParts()
  {
    if (this->IsInside && this->IsSlab())
    {
      this->AddPartsOfSlab();
      return;
    }
    for (int i = 0; i < this->Particles.Count; ++i)
    {
      CellBox<Dimension> reached;
      for (int a = 0; a < Dimension; ++a)
      {
        reached.Low[a] = this->Weighed.First[3 * i + a];
        reached.High[a] = reached.Low[a] + Weights::Width;
      }
      // Inside the grid no weight needs correction, so a covered particle takes the fast way.
      const Covered covered = coveredBy(reached, this->Box);
      if (covered == Covered::All)
      {
        addWhole(this->Weighed, i, this->Particles.Mass[i], this->Job.Memory);
      }
      else if (covered == Covered::Some)
      {
        addPart(this->Job, this->Weighed, i, this->Particles.Mass[i], this->Box);
      }
    }
  }

  // A slab cuts along the last axis only: each particle adds a range of layers, which may be empty.
  void AddPartsOfSlab()
  {
    constexpr int last = Dimension - 1;
    const std::int32_t low = this->Box.Low[last];
    const std::int32_t high = this->Box.High[last];
    for (int i = 0; i < this->Particles.Count; ++i)
    {
      const std::int32_t first = this->Weighed.First[3 * i + last];
      addLayers(this->Weighed, i, this->Particles.Mass[i], this->Job.Memory, larger(low - first, 0),
        smaller(high - first, Weights::Width));
    }
  }

  const SplatJob<Dimension, Real>& Job;
  const Axes<Dimension, Real> JobAxes;
  const CellBox<Dimension> Box;
  Block Particles;
  WeighedBlock<Weights> Weighed;
  bool IsInside = false; // all particles of the block
};
