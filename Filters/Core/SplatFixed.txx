// SPDX-License-Identifier: BSD-3-Clause
// Kernels of a fixed number of cells an axis. Included by SplatKernels.txx.

// The cells and weights of a coordinate of [0, size]; cells may lie beyond the border. `Inside`:
// the coordinate is at least one cell away from it. Cells are doubles, which have their sums and
// products in all instruction sets.
struct CloudInCellWeights
{
  static constexpr int Width = 2;
  template <bool Inside>
  RT_INLINE void Weigh(double x, double)
  {
    const double upper = static_cast<std::int32_t>(x + 0.5);
    const double part = x - (upper - 0.5);
    this->First = upper - 1.0;
    this->Upper = Inside || part > 0.0 ? part : 0.0; // below 0 where x + 0.5 was rounded up to 1
    this->Lower = 1.0 - this->Upper;
  }
  template <int K>
  RT_INLINE double Get() const
  {
    return K == 0 ? this->Lower : this->Upper;
  }

  double First;
  double Lower;
  double Upper;
};

struct NearestCellWeights
{
  static constexpr int Width = 1;
  template <bool Inside>
  RT_INLINE void Weigh(double x, double size)
  {
    const double last = size - 1.0;
    this->First = static_cast<std::int32_t>(Inside || x < last ? x : last);
  }
  template <int K>
  RT_INLINE double Get() const
  {
    return 1.0;
  }

  double First;
};

struct TriangularShapedCloudWeights
{
  static constexpr int Width = 3;
  template <bool Inside>
  RT_INLINE void Weigh(double x, double)
  {
    const double own = static_cast<std::int32_t>(x);
    const double offset = x - (own + 0.5);
    this->First = own - 1.0;
    this->Lower = 0.5 * (0.5 - offset) * (0.5 - offset);
    this->Upper = 0.5 * (0.5 + offset) * (0.5 + offset);
    this->Middle = 1.0 - this->Lower - this->Upper;
  }
  template <int K>
  RT_INLINE double Get() const
  {
    return K == 0 ? this->Lower : K == 1 ? this->Middle : this->Upper;
  }

  double First;
  double Lower;
  double Middle;
  double Upper;
};

template <int Dimension, class Weights>
struct Stencil
{
  static constexpr int Width = Weights::Width;
  // Rows of cells along axis 0 that a particle reaches.
  static constexpr int Rows = Dimension == 1 ? 1 : Dimension == 2 ? Width : Width * Width;

  SplatCells First[Dimension];
  Lanes Weight[Width];   // along axis 0
  Lanes RowWeight[Rows]; // products of mass and weights across axis 0
  Lanes Start;           // the number of the first cell, plus startBias
};

// The number of a cell plus this is a double whose last bits are the number: vectors of doubles
// become 64-bit integers at no cost.
constexpr double startBias = 0x1p52;
constexpr std::uint64_t startBiasBits = 0x4330000000000000u;

template <class Weights, int K = 0>
RT_INLINE void writeAlong(const Weights& weights, Lanes* __restrict to, int i)
{
  if constexpr (K < Weights::Width)
  {
    to[K][i] = weights.template Get<K>();
    writeAlong<Weights, K + 1>(weights, to, i);
  }
}

// Axis 1 is `across`; axis 2 is in `mass` already.
template <class Weights, int First, int K = 0>
RT_INLINE void writeAcross(const Weights& across, double mass, Lanes* __restrict to, int i)
{
  if constexpr (K < Weights::Width)
  {
    to[First + K][i] = mass * across.template Get<K>();
    writeAcross<Weights, First, K + 1>(across, mass, to, i);
  }
}

template <class Weights, int K = 0>
RT_INLINE void writeSlices(const Weights* weights, double mass, Lanes* __restrict to, int i)
{
  if constexpr (K < Weights::Width)
  {
    writeAcross<Weights, K * Weights::Width>(
      weights[1], mass * weights[2].template Get<K>(), to, i);
    writeSlices<Weights, K + 1>(weights, mass, to, i);
  }
}

template <int Dimension, class Weights>
RT_INLINE void writeLane(const Weights* weights, double mass, const double* stride,
  Stencil<Dimension, Weights>& stencil, int i)
{
  writeAlong(weights[0], stencil.Weight, i);
  double start = weights[0].First + startBias;
  stencil.First[0][i] = static_cast<std::int32_t>(weights[0].First);
  if constexpr (Dimension > 1)
  {
    start += weights[1].First * stride[1];
    stencil.First[1][i] = static_cast<std::int32_t>(weights[1].First);
  }
  if constexpr (Dimension > 2)
  {
    start += weights[2].First * stride[2];
    stencil.First[2][i] = static_cast<std::int32_t>(weights[2].First);
  }
  stencil.Start[i] = start;
  if constexpr (Dimension == 1)
  {
    stencil.RowWeight[0][i] = mass;
  }
  else if constexpr (Dimension == 2)
  {
    writeAcross<Weights, 0>(weights[1], mass, stencil.RowWeight, i);
  }
  else
  {
    writeSlices(weights, mass, stencil.RowWeight, i);
  }
}

template <int Dimension, class Weights, bool Inside>
RT_INLINE void weighLane(double x, double y, double z, const double* size, double mass,
  const double* stride, Stencil<Dimension, Weights>& stencil, int i)
{
  Weights weights[Dimension];
  weights[0].template Weigh<Inside>(x, size[0]);
  if constexpr (Dimension > 1)
  {
    weights[1].template Weigh<Inside>(y, size[1]);
  }
  if constexpr (Dimension > 2)
  {
    weights[2].template Weigh<Inside>(z, size[2]);
  }
  writeLane<Dimension>(weights, mass, stride, stencil, i);
}

// Weighs a block whose particles may all be at least one cell away from the border, in one pass
// along the axes of physical space. Returns whether they are; what has been written is else of no
// use.
template <int Dimension, class Weights, class Real>
RT_INLINE bool weighInside(const SplatJob<Dimension, Real>& job, const Block<Dimension>& block,
  Stencil<Dimension, Weights>& stencil)
{
  const SplatMap<Dimension>& map = job.Particles.ToIndex;
  int axis[3];
  double factor[3];
  double origin[3];
  double size[3];
  double half[3];
  double allowed[3];
  double stride[3] = {};
  for (int a = 0; a < 3; ++a)
  {
    axis[a] = onlyAxis(map.Matrix[a]);
    if (axis[a] < 0)
    {
      return false;
    }
    factor[a] = map.Matrix[a][axis[a]];
    origin[a] = map.Origin[axis[a]];
    size[a] = a < Dimension ? job.Size[a < Dimension ? a : 0] : 0.0;
    half[a] = 0.5 * size[a];
    allowed[a] = a < Dimension ? half[a] - 1.0 : map.Tolerance[a];
    stride[a] = a < Dimension ? static_cast<double>(job.Stride[a < Dimension ? a : 0]) : 0.0;
  }
  const double* __restrict along0 = block.Point[axis[0]];
  const double* __restrict along1 = block.Point[axis[1]];
  const double* __restrict along2 = block.Point[axis[2]];
  const double* __restrict mass = block.Mass;
  double beyond = 0.0;
#pragma omp simd reduction(+ : beyond)
  for (int i = 0; i < splatBlock; ++i)
  {
    const double x = factor[0] * (along0[i] - origin[0]);
    const double y = factor[1] * (along1[i] - origin[1]);
    const double z = factor[2] * (along2[i] - origin[2]);
    beyond += __builtin_fabs(x - half[0]) <= allowed[0] ? 0.0 : 1.0;
    beyond += __builtin_fabs(y - half[1]) <= allowed[1] ? 0.0 : 1.0;
    beyond += __builtin_fabs(z - half[2]) <= allowed[2] ? 0.0 : 1.0;
    weighLane<Dimension, Weights, true>(x, y, z, size, mass[i], stride, stencil, i);
  }
  return beyond == 0.0;
}

// Weighs particle i of a block that has been placed, with an eye to the border.
template <int Dimension, class Weights, class Real>
void weighAtBorder(const SplatJob<Dimension, Real>& job, const Block<Dimension>& block, int i,
  Stencil<Dimension, Weights>& stencil)
{
  constexpr int width = Weights::Width;
  double weight[3][width];
  std::int64_t start = 0;
  for (int a = 0; a < Dimension; ++a)
  {
    const std::int32_t size = job.Size[a];
    Weights along;
    along.template Weigh<false>(block.X[a][i], size);
    Lanes lanes[width];
    writeAlong(along, lanes, 0);
    for (int k = 0; k < width; ++k)
    {
      weight[a][k] = lanes[k][0];
    }
    std::int32_t first = static_cast<std::int32_t>(along.First);
    if (first < 0 || first + width > size)
    {
      first = keepInside(first, width, job.Kept[a], size, job.Renormalize, weight[a]);
    }
    stencil.First[a][i] = first;
    start += first * job.Stride[a];
  }
  stencil.Start[i] = static_cast<double>(start) + startBias;
  for (int k = 0; k < width; ++k)
  {
    stencil.Weight[k][i] = weight[0][k];
  }
  for (int r = 0; r < Stencil<Dimension, Weights>::Rows; ++r)
  {
    const double slice = Dimension > 2 ? block.Mass[i] * weight[2][r / width] : block.Mass[i];
    stencil.RowWeight[r][i] = Dimension > 1 ? slice * weight[1][r % width] : slice;
  }
}

// Returns whether any particles are outside.
template <int Dimension, class Weights, class Real>
RT_INLINE bool weighStencil(const SplatJob<Dimension, Real>& job, Block<Dimension>& block,
  Stencil<Dimension, Weights>& stencil)
{
  if (weighInside(job, block, stencil))
  {
    return false;
  }
  const bool outside = placeBlock(job, block);
  double size[3] = {};
  double stride[3] = {};
  for (int a = 0; a < Dimension; ++a)
  {
    size[a] = job.Size[a];
    stride[a] = static_cast<double>(job.Stride[a]);
  }
  const double* __restrict x = block.X[0];
  const double* __restrict y = block.X[Dimension > 1 ? 1 : 0];
  const double* __restrict z = block.X[Dimension > 2 ? 2 : 0];
  const double* __restrict mass = block.Mass;
#pragma omp simd
  for (int i = 0; i < splatBlock; ++i)
  {
    weighLane<Dimension, Weights, false>(x[i], y[i], z[i], size, mass[i], stride, stencil, i);
  }
  for (int i = 0; i < block.Count; ++i)
  {
    bool inside = true;
    for (int a = 0; a < Dimension; ++a)
    {
      const std::int32_t first = stencil.First[a][i];
      inside = inside && first >= 0 && first <= job.Size[a] - Weights::Width;
    }
    if (!inside)
    {
      weighAtBorder(job, block, i, stencil);
    }
  }
  return outside;
}

template <int Dimension, int Width>
RT_INLINE std::int64_t rowOffset(const std::int64_t* stride, int row)
{
  return Dimension == 1 ? 0
    : Dimension == 2
    ? row * stride[Dimension - 1]
    : row % Width * stride[Dimension > 1 ? 1 : 0] + row / Width * stride[Dimension - 1];
}

template <int Dimension, class Weights>
RT_INLINE double* startOf(const Stencil<Dimension, Weights>& stencil, int i, double* cells)
{
  std::uint64_t bits;
  __builtin_memcpy(&bits, &stencil.Start[i], sizeof bits);
  return cells + (bits - startBiasBits);
}

template <int Dimension, class Weights>
RT_INLINE void addWhole(
  const Stencil<Dimension, Weights>& stencil, int i, const std::int64_t* stride, double* cells)
{
  double* start = startOf(stencil, i, cells);
#pragma GCC unroll 9
  for (int r = 0; r < Stencil<Dimension, Weights>::Rows; ++r)
  {
    double* to = start + rowOffset<Dimension, Weights::Width>(stride, r);
    const double row = stencil.RowWeight[r][i];
#pragma GCC unroll 3
    for (int l = 0; l < Weights::Width; ++l)
    {
      to[l] += row * stencil.Weight[l][i];
    }
  }
}

template <int Dimension, class Weights, class Real>
void addPart(const SplatJob<Dimension, Real>& job, const Stencil<Dimension, Weights>& stencil,
  int i, const CellBox<Dimension>* box)
{
  int begin[3] = { 0, 0, 0 };
  int end[3] = { 1, 1, 1 };
  for (int a = 0; a < Dimension; ++a)
  {
    const std::int32_t first = stencil.First[a][i];
    begin[a] = box ? larger(box->Low[a] - first, 0) : 0;
    end[a] = box ? smaller(box->High[a] - first, job.Kept[a]) : job.Kept[a];
  }
  double* start = startOf(stencil, i, job.Cells);
  for (int k = begin[2]; k < end[2]; ++k)
  {
    for (int j = begin[1]; j < end[1]; ++j)
    {
      const int r = k * Weights::Width + j;
      double* to = start + rowOffset<Dimension, Weights::Width>(job.Stride, r);
      for (int l = begin[0]; l < end[0]; ++l)
      {
        to[l] += stencil.RowWeight[r][i] * stencil.Weight[l][i];
      }
    }
  }
}

template <int Dimension, class Weights, class Real>
RT_INLINE void addStencil(const SplatJob<Dimension, Real>& job, int count,
  const Stencil<Dimension, Weights>& stencil, const CellBox<Dimension>* box)
{
  bool whole = true;
  std::int64_t stride[Dimension];
  for (int a = 0; a < Dimension; ++a)
  {
    whole = whole && job.Kept[a] == Weights::Width;
    stride[a] = job.Stride[a];
  }
  if (whole && !box)
  {
    for (int i = 0; i < count; ++i)
    {
      addWhole(stencil, i, stride, job.Cells);
    }
    return;
  }
  for (int i = 0; i < count; ++i)
  {
    bool inside = whole;
    for (int a = 0; a < Dimension && box; ++a)
    {
      const std::int32_t first = stencil.First[a][i];
      inside = inside && first >= box->Low[a] && first + Weights::Width <= box->High[a];
    }
    if (inside)
    {
      addWhole(stencil, i, stride, job.Cells);
    }
    else
    {
      addPart(job, stencil, i, box);
    }
  }
}

template <int Dimension, class Weights, class Real>
struct FixedSplat
{
  static std::int64_t Add(const SplatJob<Dimension, Real>& job, std::int64_t first,
    const std::uint32_t* index, std::int64_t count, const CellBox<Dimension>* box, double*)
  {
    Block<Dimension> block;
    Stencil<Dimension, Weights> stencil;
    std::int64_t outside = 0;
    for (std::int64_t begin = 0; begin < count; begin += splatBlock)
    {
      block.Count = count - begin < splatBlock ? static_cast<int>(count - begin) : splatBlock;
      readBlock(job, first, index, begin, block);
      if (box && !index && isFarFrom(job, block, *box))
      {
        continue;
      }
      outside += weighStencil(job, block, stencil) ? countOutside(block, stencil.First, box) : 0;
      addStencil(job, block.Count, stencil, box);
    }
    return outside;
  }

  static std::int64_t Find(
    const SplatJob<Dimension, Real>& job, std::int64_t first, int count, SplatCells* cells)
  {
    Block<Dimension> block;
    Stencil<Dimension, Weights> stencil;
    block.Count = count;
    readBlock(job, first, nullptr, 0, block);
    const int outside = weighStencil(job, block, stencil)
      ? countOutside<Dimension>(block, stencil.First, nullptr)
      : 0;
    for (int a = 0; a < Dimension; ++a)
    {
      for (int i = 0; i < splatBlock; ++i)
      {
        cells[a][i] = stencil.First[a][i];
      }
    }
    return outside;
  }
};
