// SPDX-License-Identifier: BSD-3-Clause
// The Gaussian, which reaches many cells: weights are computed for one particle at a time, and are
// products of those along the axes. It is cut at a distance, and corrected so that mass and
// centroid are kept. Included by SplatKernels.txx.

// exp(x) from basic operations alone: the last bit of the library's may depend on the processor.
// The argument is halved until it is at most 1/2, where the Taylor polynomial of degree 13 is exact
// to rounding, and the result squared as often.
inline double exponential(double x)
{
  int halvings = 0;
  for (; __builtin_fabs(x) > 0.5; ++halvings)
  {
    x *= 0.5;
  }
  double sum = 1.0;
  for (int term = 13; term > 0; --term)
  {
    sum = 1.0 + sum * x / term;
  }
  for (; halvings > 0; --halvings)
  {
    sum *= sum;
  }
  return sum;
}

RT_INLINE std::int32_t ceiling(double x)
{
  const std::int32_t truncated = static_cast<std::int32_t>(x);
  return truncated + (truncated < x ? 1 : 0);
}

// The grid cell of a coordinate, and the first cell that the Gaussian reaches.
struct GaussianPlace
{
  RT_INLINE GaussianPlace(double x, std::int32_t size, double cut)
  {
    const std::int32_t own = smaller(static_cast<std::int32_t>(x), size - 1);
    this->Offset = x - own - 0.5;
    this->FirstOffset = ceiling(this->Offset - cut);
    this->First = own + this->FirstOffset;
  }

  double Offset; // from the centre of its grid cell
  std::int32_t FirstOffset;
  std::int32_t First;
};

// Computes the weights along one axis.
template <int Dimension, class Real>
RT_INLINE void weighGaussian(const SplatJob<Dimension, Real>& job, int a, double x, double* weight)
{
  const GaussianPlace place(x, job.Size[a], job.Cut);
  const int width = job.Width;
  // exp(-(k - offset)^2 / 2 sigma^2) of cell k from the own one is
  //   exp(-k^2 / 2 sigma^2) exp(offset / sigma^2)^k
  // times a factor that all cells have in common, which the normalization below removes. The first
  // exponential is known (AtOffset), the second is a power of one exponential, upwards and
  // downwards.
  const double up = exponential(place.Offset * job.PerVariance);
  const double down = 1.0 / up;
  double power = 1.0;
  for (int k = 0; k - place.FirstOffset < width; ++k)
  {
    weight[k - place.FirstOffset] = power * job.AtOffset[k];
    power *= up;
  }
  power = down;
  for (int k = 1; k <= -place.FirstOffset; ++k)
  {
    weight[-k - place.FirstOffset] = power * job.AtOffset[k];
    power *= down;
  }
  // The moments of order 0, 1 and 2 of the weights about the particle: S_0, S_1, S_2.
  double sum = 0.0;
  double moment = 0.0;
  double second = 0.0;
  for (int k = 0; k < width; ++k)
  {
    const double distance = place.FirstOffset + k - place.Offset;
    weight[k] = distance <= job.Cut ? weight[k] : 0.0;
    sum += weight[k];
    moment += weight[k] * distance;
    second += weight[k] * distance * distance;
  }
  // The linear function p + q d of the distance d for which the sum is 1 and the moment 0:
  //   p S_0 + q S_1 = 1,   p S_1 + q S_2 = 0.
  const double determinant = sum * second - moment * moment;
  const double constant = second / determinant;
  const double slope = -moment / determinant;
  for (int k = 0; k < width; ++k)
  {
    weight[k] *= constant + slope * (place.FirstOffset + k - place.Offset);
  }
  if (place.First < 0 || place.First + width > job.Size[a])
  {
    keepInside(place.First, width, job.Span[a], job.Size[a], job.Renormalize, weight);
  }
}

// The first of the Span cells of each particle along each axis, [particle][3].
template <int Dimension, class Real>
RT_INLINE void findGaussian(
  const SplatJob<Dimension, Real>& job, const Block& block, std::int32_t* cells)
{
  for (int i = 0; i < block.Count; ++i)
  {
    for (int a = 0; a < Dimension; ++a)
    {
      const GaussianPlace place(block.X[3 * i + a], job.Size[a], job.Cut);
      cells[3 * i + a] = firstCell(job, a, place.First);
    }
  }
}

// Adds particle i to the cells of a box. No weights are computed for a particle that reaches
// none of them.
template <int Dimension, class Real>
RT_INLINE void addGaussian(const SplatJob<Dimension, Real>& job, const Block& block,
  const std::int32_t* first, int i, const CellBox<Dimension>& box, double* scratch)
{
  int begin[3] = { 0, 0, 0 };
  int end[3] = { 1, 1, 1 };
  std::int64_t start = -job.Memory.Start;
  const double* weight[3] = { scratch, scratch, scratch };
  for (int a = 0; a < Dimension; ++a)
  {
    const std::int32_t cell = first[3 * i + a];
    start += cell * job.Memory.Stride[a];
    begin[a] = larger(box.Low[a] - cell, 0);
    end[a] = smaller(box.High[a] - cell, job.Span[a]);
    if (begin[a] >= end[a])
    {
      return;
    }
    weight[a] = scratch + a * job.Width;
  }
  for (int a = 0; a < Dimension; ++a)
  {
    weighGaussian(job, a, block.X[3 * i + a], scratch + a * job.Width);
  }
  for (int k = begin[2]; k < end[2]; ++k)
  {
    const double slice = Dimension > 2 ? block.Mass[i] * weight[2][k] : block.Mass[i];
    for (int j = begin[1]; j < end[1]; ++j)
    {
      const double row = Dimension > 1 ? slice * weight[1][j] : slice;
      const std::int64_t to = rowOffset(job.Memory, start, j, k);
      double* __restrict cells = job.Memory.Cells;
      const double* __restrict along = weight[0];
#pragma omp simd
      for (int l = begin[0]; l < end[0]; ++l)
      {
        cells[to + l] += row * along[l];
      }
    }
  }
}

// Reads block.Count particles and finds their cells. Returns the countOutside of `box`.
template <int Dimension, class Real>
RT_INLINE int findBlock(const SplatJob<Dimension, Real>& job, const Axes<Dimension, Real>& axes,
  std::int64_t first, const std::uint32_t* index, std::int64_t begin, const CellBox<Dimension>& box,
  Block& block, std::int32_t* cells)
{
  readBlock(job, axes, first, index, begin, block);
  const bool anyOutside = placeBlock(job, axes, block);
  findGaussian(job, block, cells);
  return anyOutside ? countOutside(job, block, cells, box) : 0;
}

// The kernels of the Gaussian, see SplatKernels.h.
template <int Dimension, class Real>
struct GaussianSplat
{
  static constexpr int Width = 0; // set by the radius

  static std::int64_t Add(const SplatJob<Dimension, Real>& job, std::int64_t first,
    const std::uint32_t* index, std::int64_t count, const CellBox<Dimension>* part, double* scratch)
  {
    const Axes<Dimension, Real> axes(job);
    const CellBox<Dimension> box = boxOrGrid(job, part);
    Block block;
    std::int32_t cells[blockCoordinates];
    std::int64_t outside = 0;
    for (std::int64_t begin = 0; begin < count; begin += splatBlock)
    {
      block.Count = count - begin < splatBlock ? static_cast<int>(count - begin) : splatBlock;
      outside += findBlock(job, axes, first, index, begin, box, block, cells);
      for (int i = 0; i < block.Count; ++i)
      {
        addGaussian(job, block, cells, i, box, scratch);
      }
    }
    return outside;
  }

  static std::int64_t Find(
    const SplatJob<Dimension, Real>& job, std::int64_t first, int count, std::int32_t* cells)
  {
    const Axes<Dimension, Real> axes(job);
    const CellBox<Dimension> grid = boxOrGrid<Dimension>(job, nullptr);
    Block block;
    std::int64_t outside = 0;
    for (int begin = 0; begin < count; begin += splatBlock)
    {
      block.Count = smaller(count - begin, splatBlock);
      outside += findBlock(job, axes, first, nullptr, begin, grid, block, cells + 3 * begin);
    }
    return outside;
  }

  // Bounds the cells of the particles, see BoxOfParticles. The first cell that the Gaussian
  // reaches lies at most `below` and at least `below` - 3 cells before the particle's own cell,
  // since both are rounded.
  static CellBox<Dimension> Reach(
    const SplatJob<Dimension, Real>& job, std::int64_t first, std::int64_t count)
  {
    constexpr double rounding = 0x1p-10; // above that of the map
    double least[Dimension];
    double most[Dimension];
    findBounds(job, job.Particles.Points.data() + 3 * first, count, least, most);
    CellBox<Dimension> box;
    for (int a = 0; a < Dimension; ++a)
    {
      const std::int32_t below = ceiling(job.Cut + 0.5 + rounding);
      box.Low[a] = firstCell(job, a, static_cast<std::int32_t>(least[a]) - below);
      box.High[a] = firstCell(job, a, static_cast<std::int32_t>(most[a]) - below + 3) + job.Span[a];
    }
    return box;
  }
};
