// SPDX-License-Identifier: BSD-3-Clause
#include "Core/SiteCells/PixelMasses.h"

#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Reduction.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// The cells of the density that a pixel overlaps along an axis, and how much of each. Both grids
// divide the same length, so that in units of 1 / (cells * pixels) all ends are integers, of at
// most 2^60, and the overlaps are exact.
class AxisOverlap
{
public:
  AxisOverlap(std::int64_t cells, std::int64_t pixels)
    : Cells(cells)
    , Pixels(pixels)
  {
  }

  std::int64_t First(std::int64_t pixel) const { return pixel * this->Cells / this->Pixels; }
  std::int64_t End(std::int64_t pixel) const
  {
    return ((pixel + 1) * this->Cells + this->Pixels - 1) / this->Pixels;
  }
  // The part of a cell that the pixel covers.
  double Part(std::int64_t pixel, std::int64_t cell) const
  {
    // The intervals of the cell and of the pixel have integer ends in this unit.
    const std::int64_t low = std::max(cell * this->Pixels, pixel * this->Cells);
    const std::int64_t high = std::min((cell + 1) * this->Pixels, (pixel + 1) * this->Cells);
    return static_cast<double>(high - low) / static_cast<double>(this->Pixels);
  }

private:
  std::int64_t Cells;
  std::int64_t Pixels;
};

// Computes the masses of one row of pixels after another.
template <int Dimension>
class RowMasses
{
public:
  RowMasses(const DensitySource<Dimension>& density, const GridSize<Dimension>& pixels)
    : Density(density)
    , Whole(density.Whole())
    , Pixels(pixels)
    , Values(static_cast<std::size_t>(density.Size[0]))
    , Sums(static_cast<std::size_t>(density.Size[0]))
  {
  }

  // Calls write(i, mass) for the pixels of a row, in units of the density's values.
  template <class Write>
  void Visit(std::int64_t row, const Write& write)
  {
    const std::int64_t cells = this->Density.Size[0];
    // The density integrated over the row's extent across axis 0: one value for each cell along it.
    std::fill(this->Sums.begin(), this->Sums.end(), 0.0);
    this->AddRows(row, Dimension - 1, 0, 1.0);
    // Both ends are in units in which a cell has as many as there are pixels, and a pixel as many
    // as there are cells.
    std::int64_t cell = 0;
    std::int64_t at = 0;
    for (std::int64_t i = 0; i < this->Pixels[0]; ++i)
    {
      double mass = 0.0;
      for (const std::int64_t end = (i + 1) * cells; at < end;)
      {
        const std::int64_t next = std::min((cell + 1) * this->Pixels[0], end);
        mass += static_cast<double>(next - at) * this->Sums[static_cast<std::size_t>(cell)];
        cell += next == (cell + 1) * this->Pixels[0] ? 1 : 0;
        at = next;
      }
      write(i, mass / static_cast<double>(this->Pixels[0]));
    }
  }

private:
  // Adds the density's rows that the row of pixels overlaps, each with the product of its parts:
  // first along `axis`, then recursively along the lower ones.
  void AddRows(std::int64_t row, int axis, std::int64_t cellRow, double part)
  {
    if (axis == 0)
    {
      const std::int64_t cells = this->Density.Size[0];
      this->Whole->Read(cellRow * cells, cells, this->Values.data());
      for (std::size_t c = 0; c < this->Sums.size(); ++c)
      {
        this->Sums[c] += part * this->Values[c];
      }
      return;
    }
    std::int64_t below = 1; // rows of pixels in a step along the axis
    for (int a = 1; a < axis; ++a)
    {
      below *= this->Pixels[a];
    }
    const std::int64_t pixel = row / below;
    // The rows of density cells under the row of pixels along this axis, with exact parts.
    const AxisOverlap across(this->Density.Size[axis], this->Pixels[axis]);
    for (std::int64_t c = across.First(pixel), end = across.End(pixel); c < end; ++c)
    {
      this->AddRows(row % below, axis - 1, cellRow * this->Density.Size[axis] + c,
        part * across.Part(pixel, c));
    }
  }

  const DensitySource<Dimension> Density;
  const std::shared_ptr<const DensityValues> Whole;
  const GridSize<Dimension> Pixels;
  std::vector<double> Values;
  std::vector<double> Sums;
};

} // namespace

template <int Dimension>
PixelMasses<Dimension>::PixelMasses(const DensitySource<Dimension>& density, double total,
  const GridSize<Dimension>& pixels, Progress& progress)
  : Pixels(pixels)
{
  // The sum of all pixels stays below 2^63 even if every one is rounded up.
  constexpr double whole = static_cast<double>(std::int64_t{ 1 } << 58);
  constexpr std::int64_t pixelsOfChunk = std::int64_t{ 1 } << 15;
  const auto count = static_cast<std::int64_t>(numberOfCells<Dimension>(pixels));
  // A mass for each pixel in units of 2^-58 of the total, axis 0 fastest.
  this->Units = LargeBuffer<std::int64_t>(count);
  const std::int64_t width = pixels[0];
  const auto read = [&](std::int64_t first, std::int64_t last) {
    // Chunks of rows have readers of their own, as a reader keeps buffers.
    RowMasses<Dimension> masses(density, pixels);
    Summary found;
    for (std::int64_t row = first; row < last; ++row)
    {
      std::int64_t* units = this->Units.data() + row * width;
      masses.Visit(row, [&](std::int64_t i, double mass) {
        // Rounding errors are at most half a unit a pixel, far below the rounding of a double sum.
        units[i] = std::llround(mass / total * whole);
        found.Total += units[i];
        found.Heaviest = std::max(found.Heaviest, units[i]);
        found.WithMass += units[i] > 0 ? 1 : 0;
      });
    }
    return found;
  };
  const auto add = [](const Summary& a, const Summary& b) {
    return Summary{ a.Total + b.Total, std::max(a.Heaviest, b.Heaviest), a.WithMass + b.WithMass };
  };
  this->Found = reduceChunks(progress, count / width,
    std::max<std::int64_t>(1, pixelsOfChunk / std::max(width, density.Size[0])), Summary{}, read,
    add);
}

template <int Dimension>
void PixelMasses<Dimension>::RemoveEmptyPixels(std::int64_t* labels, Progress& progress) const
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 16;
  progress.ForEach(this->NumberOfPixels(), grain,
    [&](std::int64_t pixel) { labels[pixel] = (*this)[pixel] > 0 ? labels[pixel] : -1; });
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(PixelMasses);

} // namespace RectifiedTransport
