// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Quality/MapFigures.h"

#include "Core/Flow/MapDerivatives.h"
#include "Core/Flow/MapDisplacement.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{

namespace
{

// Prepares the sums that give the masses in the cells of a part of a lattice. Collective.
template <int D>
void prepareShares(
  const RectifiedFlow<D>& flow, const GridSize<D>& lattice, const LatticePart<D>& part)
{
  const Point<D> step = latticeStep<D>(lattice, flow.Size());
  GridSize<D> low{};
  GridSize<D> high{};
  // The box of grid cells that the part's cells cover, with one more for rounding.
  for (int a = 0; a < D && part.Count() > 0; ++a)
  {
    low[a] = static_cast<std::int64_t>(static_cast<double>(part.Low[a]) * step[a]);
    const double end = std::ceil(static_cast<double>(part.End(a)) * step[a]);
    high[a] = std::min(flow.Size()[a], static_cast<std::int64_t>(end) + 1);
  }
  flow.PrepareShares(low, high);
}

// Converts images from the index space of the target to that of the samples, where they may be
// outside the domain.
template <int D>
void takeFrom(const ImageGrid& target, const MapOnLattice<D>& map, Progress& progress)
{
  if (target == map.Geometry)
  {
    return;
  }
  constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
  progress.ForEach(map.Positions.size(), grain, [&](std::int64_t i) {
    double x[3];
    target.ToPhysical<D>(map.Positions[i], x);
    map.Geometry.template ToIndex<D>(x, map.Positions[i]);
  });
}

// Writes everything except costs. Derivatives need the positions of the layers before and after.
template <int D>
void writeSamples(const MapOnLattice<D>& map, const Point<D>& step, const MapDisplacement<D>& moves,
  const MapValues& values, DisplacementSums& sums, Progress& progress)
{
  const MapDerivatives<D> derivatives(map.Lattice, map.Wanted, map.Stored, step, map.Positions);
  const std::int64_t count = map.Wanted.Count();
  // On several ranks in 3D, displacements overwrite positions layer by layer, so that
  // derivatives of a layer are taken first.
  const bool isInPlace = D == 3 && progress.Group().AreSeveral();
  // One layer at a time where results overwrite positions, otherwise all at once.
  const std::int64_t layers = isInPlace ? map.Wanted.Cells[D - 1] : 1;
  const std::int64_t each = count / std::max<std::int64_t>(1, layers);
  const LatticePart<D> counted = map.Wanted.Contains(map.Own) ? map.Own : LatticePart<D>{ {}, {} };
  constexpr std::int64_t grain = 4096;
  Parts parts(progress, layers);
  for (std::int64_t layer = 0; layer < layers; ++layer)
  {
    Stages stages(parts[layer], { { "derivatives", 4 }, { "displacements", 6 } });
    stages["derivatives"].For(each, grain, [&](std::int64_t first, std::int64_t last) {
      derivatives.Write(
        layer * each + first, layer * each + last, values.Divergences, values.Determinants);
    });
    moves.Write(layer * each, (layer + 1) * each, counted, { values.Displacements, count }, sums,
      stages["displacements"]);
  }
}

} // namespace

template <int D>
MapFigures writeMap(const MapOnLattice<D>& map, const RectifiedFlow<D>& flow,
  FlowDirection direction, const DensitySource<D>& density, const MapTarget<D>* target,
  const MapValues& values, Progress& progress)
{
  const Ranks& ranks = progress.Group();
  const Point<D> step = latticeStep<D>(map.Lattice, map.Geometry.template Size<D>());
  // The density at which the map begins, with the weights of samples; nullptr for the uniform
  // measure.
  const RectifiedFlow<D>* begins = direction == FlowDirection::Backward ? &flow : nullptr;
  const bool hasOwn = map.Wanted.Contains(map.Own);
  if (begins)
  {
    // Costs belong to the wanted samples.
    prepareShares<D>(flow, map.Lattice, target ? map.Own.With(map.Wanted) : map.Own);
  }
  Stages stages(progress,
    { { "blocks", 20 }, { "target", target ? 8.0 : 0.0 }, { "own part", hasOwn ? 0.0 : 35.0 },
      { "samples", hasOwn ? 70.0 : 35.0 }, { "figures", target ? 8.0 : 0.0 } });
  // Figures of all samples on all ranks.
  MapFigures figures;
  const MapSamples<D> samples{ map.Lattice, map.Own, map.Stored, map.Positions };
  figures.Blocks = target
    ? measureBlocksBetween<D>(samples, { density, flow.Total() }, target->Density, stages["blocks"])
    : measureBlocks<D>(samples, density, flow.Total(), direction, stages["blocks"]);
  if (target)
  {
    takeFrom<D>(target->Grid, map, stages["target"]);
  }
  const auto movesOf = [&](const LatticePart<D>& part) {
    return MapDisplacement<D>(map.Geometry, map.Lattice, part, map.Stored, map.Positions, begins);
  };
  const MapDisplacement<D> moves = movesOf(map.Wanted);
  const MapFolds<D> folds(map.Lattice, begins);
  DisplacementSums sums;
  // Figures count each sample once, on the rank that owns it, even if that rank writes another
  // part.
  if (!hasOwn)
  {
    Progress& counting = stages["own part"];
    movesOf(map.Own).Count(sums, counting);
    figures.Folds = folds.Count(map.Own, map.Stored, step, map.Positions, counting);
  }
  writeSamples<D>(map, step, moves, values, sums, stages["samples"]);
  if (hasOwn)
  {
    figures.Folds = folds.Count(map.Own, map.Wanted, values.Determinants, stages["samples"]);
  }
  const DisplacementSums all = sumOverRanks(ranks, sums);
  // Sums are exact, so the cost does not depend on the ranks.
  figures.Cost = moves.MeanSquare(all);
  if (target)
  {
    moves.WriteCosts(values.Displacements, all, values.Costs, stages["figures"]);
  }
  figures.Folds = sumOverRanks(ranks, figures.Folds);
  if (figures.Folds.Samples > 0)
  {
    figures.WithMass = sumOverRanks(ranks, folds.CountWithMass(map.Own, stages["figures"]));
  }
  return figures;
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(writeMap);

} // namespace RectifiedTransport
