// SPDX-License-Identifier: BSD-3-Clause
// The cells and weights of particles by a Gaussian: many, so that one particle is weighed at a
// time.
#ifndef RectifiedTransport_SplatGaussian_h
#define RectifiedTransport_SplatGaussian_h

#include "SplatBlock.h"

#include <vector>

namespace RectifiedTransport
{

template <int Dimension>
class GaussianStencil
{
public:
  GaussianStencil(const SplatGrid<Dimension>& grid, bool renormalize, double radius)
    : Grid(grid)
    , Renormalize(renormalize)
    , Kernel(radius)
  {
    for (int a = 0; a < Dimension; ++a)
    {
      this->Kept[a] = std::min(this->Kernel.Width(), grid.Size[a]);
      this->Weight[a].resize(static_cast<std::size_t>(this->Kernel.Width()));
    }
  }

  int Reach() const { return this->Kernel.Width() / 2 + 1; }
  int Width(int axis) const { return this->Kept[axis]; }

  void Weigh(const SplatBlock<Dimension>& block)
  {
    for (int a = 0; a < Dimension; ++a)
    {
      const std::int32_t size = this->Grid.Size[a];
      for (int i = 0; i < block.Count; ++i)
      {
        const std::int32_t cell = this->Kernel.FirstCell(block.X[a][i], size);
        this->First[a][i] = std::min(std::max(cell, 0), size - this->Kept[a]);
      }
    }
  }

  std::int32_t Cell(int axis, int i) const { return this->First[axis][i]; }

  void Add(const SplatBlock<Dimension>& block, int i, double* cells)
  {
    CellBox<Dimension> all;
    for (int a = 0; a < Dimension; ++a)
    {
      all.Low[a] = 0;
      all.High[a] = this->Grid.Size[a];
    }
    this->Add(block, i, all, cells);
  }

  void Add(const SplatBlock<Dimension>& block, int i, const CellBox<Dimension>& box, double* cells)
  {
    int begin[3] = { 0, 0, 0 };
    int end[3] = { 1, 1, 1 };
    std::int64_t start = 0;
    for (int a = 0; a < Dimension; ++a)
    {
      const std::int32_t size = this->Grid.Size[a];
      const int width = this->Kernel.Width();
      double* weight = this->Weight[a].data();
      const std::int32_t cell = this->Kernel.Weigh(block.X[a][i], size, weight);
      if (cell < 0 || cell + width > size)
      {
        keepInside(cell, width, size, this->Renormalize, weight, 1);
      }
      const std::int32_t first = this->First[a][i];
      start += first * this->Grid.Stride[a];
      begin[a] = std::max(box.Low[a] - first, 0);
      end[a] = std::min(box.High[a] - first, this->Kept[a]);
    }
    for (int k = begin[2]; k < end[2]; ++k)
    {
      double slice = block.Mass[i];
      std::int64_t sliceStart = start;
      if constexpr (Dimension > 2)
      {
        slice *= this->Weight[2][static_cast<std::size_t>(k)];
        sliceStart += k * this->Grid.Stride[2];
      }
      for (int j = begin[1]; j < end[1]; ++j)
      {
        double row = slice;
        double* __restrict to = cells + sliceStart;
        if constexpr (Dimension > 1)
        {
          row *= this->Weight[1][static_cast<std::size_t>(j)];
          to += j * this->Grid.Stride[1];
        }
        const double* __restrict weight = this->Weight[0].data();
#pragma omp simd
        for (int l = begin[0]; l < end[0]; ++l)
        {
          to[l] += row * weight[l];
        }
      }
    }
  }

private:
  const SplatGrid<Dimension>& Grid;
  bool Renormalize;
  GaussianKernel Kernel;
  std::int32_t Kept[Dimension];
  SplatCells First[Dimension];
  std::vector<double> Weight[Dimension];
};

} // namespace RectifiedTransport

#endif
