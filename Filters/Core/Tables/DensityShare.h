// SPDX-License-Identifier: BSD-3-Clause
// Sums over boxes directly from a density without tables.
#ifndef RectifiedTransport_DensityShare_h
#define RectifiedTransport_DensityShare_h

#include "Core/Tables/CoveredCells.h"
#include "Core/Tables/Density.h"

#include <algorithm>
#include <cstdint>
#include <memory>

namespace RectifiedTransport
{

// The sum of the density over a box, clipped to the domain; reads all its cells.
template <int Dimension>
double densityIn(const DensitySource<Dimension>& density, const Point<Dimension>& low,
  const Point<Dimension>& high)
{
  constexpr std::int64_t most = 256; // cells read at once
  const auto covered = [&](int axis) {
    return axis < Dimension ? CoveredCells(low[axis], high[axis], density.Size[axis])
                            : CoveredCells(0.0, 1.0, 1);
  };
  const CoveredCells x = covered(0);
  const CoveredCells y = covered(1);
  const CoveredCells z = covered(2);
  const std::shared_ptr<const DensityValues> read = density.Whole();
  const std::int64_t rows = Dimension > 1 ? density.Size[Dimension > 1 ? 1 : 0] : 1;
  double sum = 0.0;
  for (std::int64_t k = z.First; k < z.End; ++k)
  {
    for (std::int64_t j = y.First; j < y.End; ++j)
    {
      // The weight of a cell is its overlap with the box: the product of the parts along the axes.
      const double part = y.PartOf(j) * z.PartOf(k);
      const std::int64_t row = (k * rows + j) * density.Size[0];
      for (std::int64_t i = x.First; i < x.End; i += most)
      {
        double values[most];
        const std::int64_t count = std::min(most, x.End - i);
        read->Read(row + i, count, values);
        for (std::int64_t cell = 0; cell < count; ++cell)
        {
          sum += values[cell] * (x.PartOf(i + cell) * part);
        }
      }
    }
  }
  return sum;
}

} // namespace RectifiedTransport

#endif
