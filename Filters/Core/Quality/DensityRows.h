// SPDX-License-Identifier: BSD-3-Clause
// Some layers of a density, summed along their rows: for the mass in boxes, and in regions between
// lines or surfaces.
#ifndef RectifiedTransport_DensityRows_h
#define RectifiedTransport_DensityRows_h

#include "Core/Geometry/LatticePart.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/Density.h"
#include "Core/Tables/ScaledDensity.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace RectifiedTransport
{

// Layers are along the last axis. Rows are always whole, so that sums have the same bits on any
// number of ranks; in 1D they are the layers.
template <int Dimension>
class DensityRows
{
public:
  static constexpr int Last = Dimension - 1;

  // `total` is the sum of the density.
  DensityRows(const DensitySource<Dimension>& density, double total)
    : Density(density)
    , Scaling(std::ldexp(1.0, scalingOf(total)))
    , Total(total * this->Scaling)
  {
  }

  // Returns the mass of the whole density, scaled by a power of two if its values would leave the
  // range of doubles.
  double TotalMass() const { return this->Total; }

  // Returns how many layers are read at a time: about 4 million cells, and at least one layer.
  std::int64_t LayersAtOnce() const
  {
    constexpr double most = 1 << 22;
    const auto layers = static_cast<double>(this->Density.Size[Last]);
    return std::max<std::int64_t>(
      1, static_cast<std::int64_t>(most / numberOfCells<Dimension>(this->Density.Size) * layers));
  }

  // Reads a box of cells, which may be empty; in 2D and 3D its rows are completed. Collective, if
  // the density is distributed. Throws std::bad_alloc and Cancelled.
  void Read(LatticePart<Dimension> box, Progress& progress)
  {
    if (Dimension > 1 && !box.IsEmpty())
    {
      box.Low[0] = 0;
      box.Cells[0] = this->Density.Size[0];
    }
    // Data that are already here are not read again.
    if (!this->Density.IsDistributed() && box.Low == this->Box.Low && box.Cells == this->Box.Cells)
    {
      return;
    }
    GridSize<Dimension> high;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      high[axis] = box.End(axis);
    }
    const auto values = this->Density.Part(box.Low, high);
    this->Box = box;
    if (box.IsEmpty())
    {
      return;
    }
    const std::int64_t cells = box.Cells[0];
    const std::int64_t rows = box.Count() / cells;
    if (this->Sums.size() < rows * (cells + 1))
    {
      this->Sums = LargeBuffer<double>(); // not both at a time
      this->Sums = LargeBuffer<double>(rows * (cells + 1));
    }
    const auto whole = LatticePart<Dimension>::WholeOf(this->Density.Size);
    const std::int64_t grain = std::max<std::int64_t>(1, (std::int64_t{ 1 } << 13) / cells);
    const std::int64_t units = std::max<std::int64_t>(1, (std::int64_t{ 1 } << 18) / cells);
    progress.ForEach(
      rows, grain,
      [&](std::int64_t row) {
        double* sums = this->Sums.data() + row * (cells + 1);
        values->Read(whole.NumberOf(box.CellOf(row * cells)), cells, sums + 1);
        sums[0] = 0.0;
        for (std::int64_t i = 1; i <= cells; ++i)
        {
          sums[i] = sums[i - 1] + sums[i] * this->Scaling;
        }
      },
      units);
  }

  const LatticePart<Dimension>& Cells() const { return this->Box; }
  const GridSize<Dimension>& Size() const { return this->Density.Size; }

  // Returns the prefix sums of the row of a cell of the box: entry i is the mass before cell i. The
  // cell's number along axis 0 is ignored.
  const double* Row(GridSize<Dimension> cell) const
  {
    cell[0] = this->Box.Low[0];
    const std::int64_t row = this->Box.NumberOf(cell) / this->Box.Cells[0];
    return this->Sums.data() + row * (this->Box.Cells[0] + 1) - this->Box.Low[0];
  }
  // The mass in a row before x, which is in the box.
  double Before(const double* row, double x) const
  {
    const std::int64_t cell =
      std::min(static_cast<std::int64_t>(x), this->Box.Low[0] + this->Box.Cells[0] - 1);
    return this->Before(row, cell, x);
  }
  // The same, for a known cell that contains x.
  double Before(const double* row, std::int64_t cell, double x) const
  {
    return row[cell] + (x - static_cast<double>(cell)) * (row[cell + 1] - row[cell]);
  }

private:
  const DensitySource<Dimension> Density;
  const double Scaling;
  const double Total;
  LatticePart<Dimension> Box{ {}, {} };
  LargeBuffer<double> Sums; // a row has one more than cells
};

} // namespace RectifiedTransport

#endif
