// SPDX-License-Identifier: BSD-3-Clause
// Blended particles as masses on a grid.
#ifndef RectifiedTransport_BlendSplat_h
#define RectifiedTransport_BlendSplat_h

#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Ranks.h"
#include "Core/Splat/RankSplat.h"

#include <cstdint>

namespace RectifiedTransport
{

// Writes `scale` times the masses in the cells of a part, with the CloudInCell kernel. `masses` may
// be nullptr if all are 1; for `keys`, which may be nullptr, see splatOnRanks. A single rank gets
// the whole grid. Collective.
template <int D>
void splatInCells(ConstPointSpan<3> points, const double* masses, const std::int64_t* keys,
  const ImageGrid& grid, const LatticePart<D>& wanted, double scale, double* cells,
  Progress& progress)
{
  const GridSize<D> size = grid.Size<D>();
  const SplatParticles<D, double> particles{ points, masses, 1.0, grid.ToIndexMap<D>() };
  if (progress.Group().AreSeveral())
  {
    splatOnRanks<D, double>(particles, keys, size, wanted, {}, scale, cells, progress);
    return;
  }
  splatMass<D, double>(particles, size, {}, scale, cells, progress);
}

} // namespace RectifiedTransport

#endif
