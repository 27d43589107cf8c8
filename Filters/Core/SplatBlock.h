// SPDX-License-Identifier: BSD-3-Clause
// A block of particles in structure-of-arrays lanes: placed in the grid, weighed, and added to the
// cells of a box.
#ifndef RectifiedTransport_SplatBlock_h
#define RectifiedTransport_SplatBlock_h

#include "SplatWeights.h"

#include <algorithm>
#include <cstddef>

namespace RectifiedTransport
{

// Cells [Low, High) along each axis.
template <int Dimension>
struct CellBox
{
  std::int32_t Low[Dimension];
  std::int32_t High[Dimension];
};

template <int Dimension>
struct SplatGrid
{
  explicit SplatGrid(const GridSize<Dimension>& size)
  {
    std::int64_t stride = 1;
    for (int a = 0; a < Dimension; ++a)
    {
      this->Size[a] = static_cast<std::int32_t>(size[a]);
      this->Stride[a] = stride;
      stride *= size[a];
    }
  }

  std::int32_t Size[Dimension];
  std::int64_t Stride[Dimension];
};

// The particles of a block in index space, moved to the border where they are not inside.
template <int Dimension>
class SplatBlock
{
public:
  // Particle i of the block is particle at(i) of all. Returns how many are outside.
  template <class Real, class At>
  int Load(const SplatParticles<Dimension, Real>& particles, const SplatGrid<Dimension>& grid,
    bool keepOutside, double scale, int count, const At& at)
  {
    this->Count = count;
    SplatLanes offset[3];
    const SplatMap<Dimension>& map = particles.ToIndex;
    for (int i = 0; i < splatBlock; ++i)
    {
      const Real* x = particles.Points + 3 * at(std::min(i, count - 1));
      offset[0][i] = x[0] - map.Origin[0];
      offset[1][i] = x[1] - map.Origin[1];
      offset[2][i] = x[2] - map.Origin[2];
    }
    std::int32_t outside[splatBlock] = {};
    for (int a = 0; a < 3; ++a)
    {
      this->Place(map, offset, a, a < Dimension ? grid.Size[a] : 0, outside);
    }
    const double mass = scale * particles.Mass;
    for (int i = 0; i < splatBlock; ++i)
    {
      this->Mass[i] =
        particles.Masses ? scale * particles.Masses[at(std::min(i, count - 1))] : mass;
    }
    int sum = 0;
    for (int i = 0; i < count; ++i)
    {
      sum += outside[i];
    }
    for (int i = 0; i < count && sum > 0 && !keepOutside; ++i)
    {
      this->Mass[i] = outside[i] ? 0.0 : this->Mass[i];
    }
    return sum;
  }

  int Count = 0;
  SplatLanes X[Dimension];
  SplatLanes Mass;

private:
  void Place(const SplatMap<Dimension>& map, const SplatLanes* __restrict offset, int a,
    double size, std::int32_t* __restrict outside)
  {
    const double m0 = map.Matrix[a][0];
    const double m1 = map.Matrix[a][1];
    const double m2 = map.Matrix[a][2];
    const double low = -map.Tolerance[a];
    const double high = size + map.Tolerance[a];
    SplatLanes unused;
    double* __restrict place = a < Dimension ? this->X[a < Dimension ? a : 0] : unused;
#pragma omp simd
    for (int i = 0; i < splatBlock; ++i)
    {
      const double x = m0 * offset[0][i] + m1 * offset[1][i] + m2 * offset[2][i];
      outside[i] |= x >= low && x <= high ? 0 : 1;
      const double above = x > 0.0 ? x : 0.0; // what overflowed too
      place[i] = above < size ? above : size;
    }
  }
};

// The cells and weights of a block's particles, by a kernel of a fixed number of cells.
template <int Dimension, class Kernel>
class FixedStencil
{
public:
  FixedStencil(const SplatGrid<Dimension>& grid, bool renormalize)
    : Grid(grid)
    , Renormalize(renormalize)
  {
    for (int a = 0; a < Dimension; ++a)
    {
      this->Kept[a] = std::min(Kernel::Width, grid.Size[a]);
    }
  }

  // How far from a particle's own cell its cells may be.
  int Reach() const { return Kernel::Width / 2; }
  int Width(int axis) const { return this->Kept[axis]; }

  void Weigh(const SplatBlock<Dimension>& block)
  {
    for (int a = 0; a < Dimension; ++a)
    {
      const std::int32_t size = this->Grid.Size[a];
      Kernel::Weigh(block.X[a], size, this->First[a], this->Weight[a]);
      std::int32_t lowest = 0;
      std::int32_t highest = 0;
#pragma omp simd reduction(min : lowest) reduction(max : highest)
      for (int i = 0; i < splatBlock; ++i)
      {
        lowest = std::min(lowest, this->First[a][i]);
        highest = std::max(highest, this->First[a][i]);
      }
      if (lowest < 0 || highest + Kernel::Width > size)
      {
        this->KeepInside(a);
      }
    }
  }

  // The first cell of particle i along an axis, once it is weighed.
  std::int32_t Cell(int axis, int i) const
  {
    return this->First[axis][i];
  }

  // Adds all of particle i.
  void Add(const SplatBlock<Dimension>& block, int i, double* cells) const
  {
    if (this->IsWhole())
    {
      this->template AddRows<true>(block, i, nullptr, cells);
    }
    else
    {
      this->template AddRows<false>(block, i, nullptr, cells);
    }
  }

  // Adds what falls into a box.
  void Add(
    const SplatBlock<Dimension>& block, int i, const CellBox<Dimension>& box, double* cells) const
  {
    this->template AddRows<false>(block, i, &box, cells);
  }

private:
  bool IsWhole() const
  {
    bool whole = true;
    for (int a = 0; a < Dimension; ++a)
    {
      whole = whole && this->Kept[a] == Kernel::Width;
    }
    return whole;
  }

  void KeepInside(int a)
  {
    const std::int32_t size = this->Grid.Size[a];
    for (int i = 0; i < splatBlock; ++i)
    {
      std::int32_t& first = this->First[a][i];
      if (first < 0 || first + Kernel::Width > size)
      {
        first = keepInside(
          first, Kernel::Width, size, this->Renormalize, &this->Weight[a][0][i], splatBlock);
      }
    }
  }

  template <bool Whole>
  void AddRows(
    const SplatBlock<Dimension>& block, int i, const CellBox<Dimension>* box, double* cells) const
  {
    int begin[3] = { 0, 0, 0 };
    int end[3] = { 1, 1, 1 };
    std::int64_t start = 0;
    for (int a = 0; a < Dimension; ++a)
    {
      const std::int32_t first = this->First[a][i];
      start += first * this->Grid.Stride[a];
      end[a] = Whole ? Kernel::Width : this->Kept[a];
      if (!Whole && box)
      {
        begin[a] = std::max(box->Low[a] - first, 0);
        end[a] = std::min(box->High[a] - first, end[a]);
      }
    }
    for (int k = begin[2]; k < end[2]; ++k)
    {
      double slice = block.Mass[i];
      std::int64_t sliceStart = start;
      if constexpr (Dimension > 2)
      {
        slice *= this->Weight[2][k][i];
        sliceStart += k * this->Grid.Stride[2];
      }
      for (int j = begin[1]; j < end[1]; ++j)
      {
        double row = slice;
        double* to = cells + sliceStart;
        if constexpr (Dimension > 1)
        {
          row *= this->Weight[1][j][i];
          to += j * this->Grid.Stride[1];
        }
        for (int l = begin[0]; l < end[0]; ++l)
        {
          to[l] += row * this->Weight[0][l][i];
        }
      }
    }
  }

  const SplatGrid<Dimension>& Grid;
  bool Renormalize;
  std::int32_t Kept[Dimension];
  SplatCells First[Dimension];
  SplatLanes Weight[Dimension][Kernel::Width];
};

} // namespace RectifiedTransport

#endif
