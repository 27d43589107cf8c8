// SPDX-License-Identifier: BSD-3-Clause
// How well a sampled transport map preserves the measure: errors of the areas or masses in
// blocks of samples.
#ifndef RectifiedTransport_MapBlocks_h
#define RectifiedTransport_MapBlocks_h

#include "../Flow/FlowOptions.h"
#include "../Geometry/LatticePart.h"
#include "../Tables/Density.h"
#include "BlockErrors.h"

#include <algorithm>
#include <cstdint>

namespace RectifiedTransport
{

class Progress;

// Images of the centres of the cells of a lattice over the domain, in index space.
template <int Dimension>
struct MapSamples
{
  GridSize<Dimension> Lattice;
  LatticePart<Dimension> Own;    // samples that this rank owns
  LatticePart<Dimension> Within; // a larger part, whose images Positions are, axis 0 fastest
  ConstPointSpan<Dimension> Positions;
};

// Blocks are of 4 sample spacings along each axis: from a sample to the fourth after it. They begin
// with the first sample of the lattice; what is left at its end is in no block. The image of a
// block is what the images of the cells between its samples cover, with sign: lines,
// quadrilaterals, trilinear hexahedra. A block belongs to the rank that owns its first sample.
template <int Dimension>
struct MapBlocks
{
  static constexpr std::int64_t Size = 4;

  // Returns the blocks of a rank, as a part of all blocks of the lattice.
  static LatticePart<Dimension> Of(
    const GridSize<Dimension>& lattice, const LatticePart<Dimension>& own)
  {
    LatticePart<Dimension> blocks{ {}, {} };
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const auto firstFrom = [](std::int64_t sample) { return (sample + Size - 1) / Size; };
      const std::int64_t all = (lattice[axis] - 1) / Size;
      blocks.Low[axis] = std::min(all, firstFrom(own.Low[axis]));
      blocks.Cells[axis] = std::min(all, firstFrom(own.End(axis))) - blocks.Low[axis];
    }
    return blocks;
  }

  // Returns the samples at the blocks' corners and between them.
  static LatticePart<Dimension> SamplesOf(const LatticePart<Dimension>& blocks)
  {
    LatticePart<Dimension> samples{ {}, {} };
    for (int axis = 0; axis < Dimension && !blocks.IsEmpty(); ++axis)
    {
      samples.Low[axis] = Size * blocks.Low[axis];
      samples.Cells[axis] = Size * blocks.Cells[axis] + 1;
    }
    return samples;
  }
};

// The relative errors of all ranks' blocks; `total` is the sum of the density.
// - Forward, of the mass: |share of the mass in the image of the block - the block's share of the
//   domain| / the latter. In 3D, faces of the cells between samples are two triangles each; first a
//   point of each of them tells which blocks seem worst, then the worst twentieth is integrated
//   exactly. The others count as better.
// - Backward, of the measure: |the image's share of the domain - the block's share of the mass| /
//   the latter, of the blocks all of whose grid cells have more than leastOfMean of the mean
//   density.
// The same bits for any number of ranks and threads. Collective. Memory: 8 bytes a block and axis,
// and 34 MB or a layer of the density. Throws std::bad_alloc and Cancelled.
template <int Dimension>
BlockErrors measureBlocks(const MapSamples<Dimension>& map, const DensitySource<Dimension>& density,
  double total, FlowDirection direction, Progress& progress);

template <int Dimension>
struct SummedDensity
{
  DensitySource<Dimension> Density;
  double Total; // the sum of the density
};

// The same for a map from one density to another, with its images in the index space of the target:
// |the target's share of the mass in the image of the block - the source's share in the block| /
// the latter, of the blocks that count backward. In 3D as forward.
template <int Dimension>
BlockErrors measureBlocksBetween(const MapSamples<Dimension>& map,
  const SummedDensity<Dimension>& source, const SummedDensity<Dimension>& target,
  Progress& progress);

} // namespace RectifiedTransport

#endif
