// SPDX-License-Identifier: BSD-3-Clause
// Whether particles are dense where a density is high: the correlation of the two over blocks.
#ifndef RectifiedTransport_BlockCorrelation_h
#define RectifiedTransport_BlockCorrelation_h

#include "Core/Geometry/Points.h"
#include "Core/Quality/GridBlocks.h"
#include "Core/Quality/ParticleQuality.h"
#include "Core/Tables/DensityShare.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Counts each block once; blocks weigh as much as they measure.
template <int Dimension>
BlockCorrelation correlateBlocks(
  const DensitySource<Dimension>& density, ConstPointSpan<Dimension> points)
{
  constexpr double usual = 64.0; // points of a block: their noise is an eighth of their number
  const std::int64_t size = blockSizeFor<Dimension>(density.Size, points.size(), usual);
  const GridBlocks<Dimension> blocks(density.Size, size);
  std::vector<double> found(static_cast<std::size_t>(blocks.Count()), 0.0);
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    Point<Dimension> place;
    std::copy_n(points[i], Dimension, place.begin());
    found[static_cast<std::size_t>(blocks.At(place))] += 1.0;
  }
  BlockCorrelation correlation;
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    const GridBox<Dimension> box = blocks.Box(static_cast<std::int64_t>(i));
    Point<Dimension> low;
    Point<Dimension> high;
    std::copy(box.Low.begin(), box.Low.end(), low.begin());
    std::copy(box.High.begin(), box.High.end(), high.begin());
    correlation.Add(found[i], densityIn<Dimension>(density, low, high), box.Cells());
  }
  return correlation;
}

} // namespace RectifiedTransport

#endif
