// SPDX-License-Identifier: BSD-3-Clause
// EqualizeAreas for the samples of a lattice, and what a corrected map costs.
#ifndef RectifiedTransport_CorrectedImages_h
#define RectifiedTransport_CorrectedImages_h

#include "Core/Equalize/AreaCorrection.h"
#include "Core/Flow/MapDisplacement.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/RankShare.h"
#include "Core/Parallel/Stages.h"

#include <cstdint>

namespace RectifiedTransport
{

// Corrects the images of the centres of a part of a lattice, whose cells have the sides `step` in
// index space; `parts` says where the images are. Throws Cancelled.
template <int D>
void correctImages(const AreaCorrection<D>& correction, const Point<D>& step,
  const LatticePart<D>& part, const LatticeParts<D>& parts, PointSpan<D> images, Progress& progress)
{
  constexpr std::int64_t grain = 1 << 12;
  progress.ForEach(part.Count(), grain, [&](std::int64_t i) {
    const GridSize<D> cell = part.CellOf(i);
    Point<D> sample;
    for (int a = 0; a < D; ++a)
    {
      sample[a] = (static_cast<double>(cell[a]) + 0.5) * step[a];
    }
    correction.Correct(sample.data(), images[parts.IndexOf(cell)]);
  });
}

// The layers of a density's cells that a rank moves, to find the cost of a map.
template <int D>
LatticePart<D> layersOf(const GridSize<D>& size, const Ranks& ranks)
{
  auto part = LatticePart<D>::WholeOf(size);
  const RankShare layers(size[D - 1], ranks);
  part.Low[D - 1] = layers.First;
  part.Cells[D - 1] = layers.Count;
  return part;
}

// The mean squared displacement of the mass of the density of a flow on a grid, which a map takes
// to the uniform measure, by the centres of its cells. `correction` may be nullptr. Takes memory
// for the images of layersOf(...). Collective. Throws std::bad_alloc and Cancelled.
template <int D>
double costBackward(const ImageGrid& grid, const RectifiedFlow<D>& flow,
  const PointTransport<D>& map, const AreaCorrection<D>* correction, Progress& progress)
{
  const GridSize<D>& size = flow.Size();
  const LatticePart<D> part = layersOf<D>(size, progress.Group());
  Stages stages(progress, { { "map", 9 }, { "cost", 1 } });
  LargeBuffer<double> buffer(part.Count() * D);
  const PointSpan<D> images(buffer.data(), part.Count());
  const LatticeParts<D> parts(part, part);
  map.Backward(FlowSeeds<D>::Lattice(size, parts), images, stages["map"]);
  Progress& counting = stages["cost"].Expect((correction ? 2 : 1) * part.Count());
  if (correction)
  {
    correctImages<D>(*correction, latticeStep<D>(size, size), part, parts, images, counting);
  }
  const MapDisplacement<D> moves(grid, size, part, part, images, &flow);
  DisplacementSums sums;
  moves.Count(sums, counting);
  return moves.MeanSquare(sumOverRanks(progress.Group(), sums));
}

} // namespace RectifiedTransport

#endif
