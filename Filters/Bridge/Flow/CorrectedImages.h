// SPDX-License-Identifier: BSD-3-Clause
// EqualizeAreas for the samples of a lattice.
#ifndef RectifiedTransport_CorrectedImages_h
#define RectifiedTransport_CorrectedImages_h

#include "Core/Equalize/AreaCorrection.h"
#include "Core/Geometry/LatticePart.h"
#include "Core/Parallel/Progress.h"

#include <cstdint>

namespace RectifiedTransport::Bridge
{

// Corrects the images of the centres of a part of a lattice, whose cells have the sides `step` in
// index space; `parts` says where the images are. Throws Cancelled.
template <int D>
void correctImages(const AreaCorrection<D>& correction, const Point<D>& step,
  const LatticePart<D>& part, const LatticeParts<D>& parts, PointSpan<D> images, Progress& progress)
{
  constexpr std::int64_t grain = 1 << 12;
  progress.For(part.Count(), grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      const GridSize<D> cell = part.CellOf(i);
      Point<D> sample;
      for (int a = 0; a < D; ++a)
      {
        sample[a] = (static_cast<double>(cell[a]) + 0.5) * step[a];
      }
      correction.Correct(sample.data(), images[parts.IndexOf(cell)]);
    }
  });
}

} // namespace RectifiedTransport::Bridge

#endif
