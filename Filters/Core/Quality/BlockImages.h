// SPDX-License-Identifier: BSD-3-Clause
// The blocks of a map's samples: the grid cells under them, and their images, where they lie and
// integrals over their faces.
#ifndef RectifiedTransport_BlockImages_h
#define RectifiedTransport_BlockImages_h

#include "Core/Quality/DensityRows.h"
#include "Core/Quality/LayerBins.h"
#include "Core/Quality/MapBlocks.h"
#include "Core/Tables/CoveredCells.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace RectifiedTransport
{

// The grid cells under the blocks.
template <int Dimension>
class BlockCells
{
public:
  // For blocks on a lattice over the domain of a grid.
  BlockCells(const GridSize<Dimension>& lattice, const GridSize<Dimension>& grid)
    : Size(grid)
    , Step(latticeStep<Dimension>(lattice, grid))
  {
  }

  // Returns the cells that blocks cover along an axis. A block reaches from the centre of its first
  // sample to that of the fourth after it, hence the 1/2.
  CoveredCells Covered(int axis, std::int64_t block, std::int64_t blocks = 1) const
  {
    constexpr std::int64_t size = MapBlocks<Dimension>::Size;
    const double step = this->Step[axis];
    return { (static_cast<double>(size * block) + 0.5) * step,
      (static_cast<double>(size * (block + blocks)) + 0.5) * step, this->Size[axis] };
  }

  LatticePart<Dimension> Of(const LatticePart<Dimension>& blocks) const
  {
    LatticePart<Dimension> cells{ {}, {} };
    for (int axis = 0; axis < Dimension && !blocks.IsEmpty(); ++axis)
    {
      const CoveredCells covered = this->Covered(axis, blocks.Low[axis], blocks.Cells[axis]);
      cells.Low[axis] = covered.First;
      cells.Cells[axis] = covered.End - covered.First;
    }
    return cells;
  }

  // Adds the mass of a block in the cells of the rows, and the least value of a cell.
  void AddMass(const GridSize<Dimension>& block, const DensityRows<Dimension>& rows, double& mass,
    double& least) const
  {
    GridSize<Dimension> one;
    one.fill(1);
    const LatticePart<Dimension>& held = rows.Cells();
    const LatticePart<Dimension> cells = this->Of({ block, one }).And(held);
    if (cells.IsEmpty())
    {
      return;
    }
    const CoveredCells x = this->Covered(0, block[0]);
    // The cells that are held may be a part of those of the block; other parts come with other
    // batches.
    const double low = std::max(x.Low, static_cast<double>(cells.Low[0]));
    const double high = std::min(x.High, static_cast<double>(cells.End(0)));
    const std::int64_t count = cells.Count() / cells.Cells[0];
    for (std::int64_t i = 0; i < count; ++i)
    {
      const GridSize<Dimension> cell = cells.CellOf(i * cells.Cells[0]);
      double part = 1.0;
      for (int axis = 1; axis < Dimension; ++axis)
      {
        part *= this->Covered(axis, block[axis]).PartOf(cell[axis]);
      }
      const double* row = rows.Row(cell);
      // The mass between two places of a row is a difference of prefix sums.
      mass += part * (rows.Before(row, high) - rows.Before(row, low));
      for (std::int64_t c = cells.Low[0]; c < cells.End(0); ++c)
      {
        least = std::min(least, row[c + 1] - row[c]);
      }
    }
  }

private:
  const GridSize<Dimension> Size;
  const Point<Dimension> Step;
};

// The images of the blocks.
template <int Dimension>
class BlockImages
{
public:
  explicit BlockImages(const MapSamples<Dimension>& map)
    : Map(map)
  {
  }

  const double* At(const GridSize<Dimension>& sample) const
  {
    return this->Map.Positions[this->Map.Within.NumberOf(sample)];
  }

  // The integral over a face of blocks across an axis, in the direction of the axis.
  template <class Integral>
  double Across(int axis, const GridSize<Dimension>& face, const Integral& integral) const
  {
    constexpr std::int64_t size = MapBlocks<Dimension>::Size;
    GridSize<Dimension> sample;
    for (int a = 0; a < Dimension; ++a)
    {
      sample[a] = size * face[a];
    }
    // The image of the face's first sample; others follow by strides in memory.
    const double* first = this->At(sample);
    // Doubles from a sample's image to that of the next one along an axis.
    const auto strideOf = [this](int a) {
      std::int64_t stride = Dimension;
      for (int b = 0; b < a; ++b)
      {
        stride *= this->Map.Within.Cells[b];
      }
      return stride;
    };
    if constexpr (Dimension == 1)
    {
      return integral.Point(first);
    }
    else if constexpr (Dimension == 2)
    {
      // Anticlockwise, the boundary of a block goes up on the right and to the left at the top.
      const std::int64_t stride = strideOf(1 - axis);
      double sum = 0.0;
      for (std::int64_t i = 0; i < size; ++i)
      {
        sum += integral.Edge(first + i * stride, first + (i + 1) * stride);
      }
      return axis == 0 ? sum : -sum;
    }
    else
    {
      // A face is divided into triangles in the same way for both blocks that share it, so that the
      // integrals over it cancel.
      const std::int64_t alongU = strideOf((axis + 1) % Dimension);
      const std::int64_t alongV = strideOf((axis + 2) % Dimension);
      double sum = 0.0;
      for (std::int64_t j = 0; j < size; ++j)
      {
        for (std::int64_t i = 0; i < size; ++i)
        {
          const double* low = first + i * alongU + j * alongV;
          const double* across = low + alongU + alongV;
          sum += integral.Triangle({ low, low + alongU, across }) +
            integral.Triangle({ low, across, low + alongV });
        }
      }
      return sum;
    }
  }

  // Returns the layers of a grid of `size` layers that contain the images of samples.
  LayerSpan LayersOf(const LatticePart<Dimension>& samples, std::int64_t size) const
  {
    double low = std::numeric_limits<double>::infinity();
    double high = 0.0;
    const std::int64_t count = samples.Count();
    for (std::int64_t i = 0; i < count; ++i)
    {
      const double place = this->At(samples.CellOf(i))[Dimension - 1];
      low = std::min(low, place);
      high = std::max(high, place);
    }
    const std::int64_t end = size - 1;
    return { std::min(static_cast<std::int64_t>(low), end),
      std::min(static_cast<std::int64_t>(high), end) + 1 };
  }

private:
  const MapSamples<Dimension>& Map;
};

} // namespace RectifiedTransport

#endif
