// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/Masses/SampleCorrection.h"

#include "Core/OptimalMap/Masses/ExactCounts.h"
#include "Core/OptimalMap/Masses/MassCorrection.h"
#include "Core/OptimalMap/Masses/SlabEqualization.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// The correction's nodes are two cells apart: samples are too few to resolve cells.
constexpr int samplesCellsANode = 2;

// Fewer samples say too little about the image's masses to correct them.
bool areEnough(double samples, double cells)
{
  constexpr double least = 0.25; // samples a cell
  return samples >= least * cells;
}

// First long moves by Poisson's equation, then short ones that make counts exact box by box, then
// moves within cells that make places uniform.
template <int Dimension>
void correctAll(const CellDensity<Dimension>& density, const Point<Dimension>& sides,
  PointSpan<Dimension> samples, Progress& progress)
{
  Stages stages(progress, { { "masses", 10 }, { "counts", 7 }, { "spread", 3 } });
  if (areEnough(static_cast<double>(samples.size()), static_cast<double>(density.NumberOfCells())))
  {
    const MassCorrection<Dimension> correction(
      density, sides, samplesCellsANode, samples, nullptr, stages["masses"]);
  }
  makeCountsExact<Dimension>(density, sides, samples, stages["counts"]);
  equalizeInSlabs<Dimension>(
    density.Size(), samples, stages["spread"].Expect(2 * Dimension * samples.size()));
}

} // namespace

// Exact counts need all samples, so each rank gathers them, computes the same, and keeps its own
// part.
template <int Dimension>
void correctSamples(const CellDensity<Dimension>& density, const Point<Dimension>& sides,
  PointSpan<Dimension> samples, Progress& progress)
{
  const Ranks& ranks = progress.Group();
  if (!ranks.AreSeveral())
  {
    correctAll<Dimension>(density, sides, samples, progress);
    return;
  }
  // The place of each rank's coordinates in the gathered array.
  std::vector<std::int64_t> starts{ 0 };
  for (const std::int64_t count : gatherValues<std::int64_t>(ranks, samples.size() * Dimension))
  {
    starts.push_back(starts.back() + count);
  }
  LargeBuffer<double> all(starts.back());
  const std::int64_t own = starts[static_cast<std::size_t>(ranks.Own())];
  std::copy_n(samples.data(), samples.size() * Dimension, all.data() + own);
  gatherParts(ranks, starts, all.data());
  correctAll<Dimension>(density, sides, { all.data(), starts.back() / Dimension }, progress);
  std::copy_n(all.data() + own, samples.size() * Dimension, samples.data());
}

template <int Dimension>
double memoryForCorrection(const GridSize<Dimension>& size, double samples, bool onSeveralRanks)
{
  const auto count = static_cast<std::int64_t>(samples);
  const double ofMasses = areEnough(samples, numberOfCells<Dimension>(size))
    ? MassCorrection<Dimension>::MemoryFor(size, samplesCellsANode)
    : 0.0;
  const double ofSteps = std::max({ ofMasses, memoryForExactCounts<Dimension>(size, count),
    memoryForSlabEqualization<Dimension>(size, count) });
  return ofSteps + (onSeveralRanks ? samples * Dimension * sizeof(double) : 0.0);
}

template void correctSamples<1>(const CellDensity<1>&, const Point<1>&, PointSpan<1>, Progress&);
template void correctSamples<2>(const CellDensity<2>&, const Point<2>&, PointSpan<2>, Progress&);
template void correctSamples<3>(const CellDensity<3>&, const Point<3>&, PointSpan<3>, Progress&);
template double memoryForCorrection<1>(const GridSize<1>&, double, bool);
template double memoryForCorrection<2>(const GridSize<2>&, double, bool);
template double memoryForCorrection<3>(const GridSize<3>&, double, bool);

} // namespace RectifiedTransport
