// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/Masses/SampleCorrection.h"

#include "Core/OptimalMap/Masses/ExactCounts.h"
#include "Core/OptimalMap/Masses/MassCorrection.h"
#include "Core/OptimalMap/Nodes/IntegerSums.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// Places within cells are made uniform along each axis by equalizing their histogram. A cell alone
// has too few particles for one, so neighbours share it: a slab is one cell thick along the axis
// and 8 cells wide across it.
constexpr std::int64_t across = 8;        // cells
constexpr int mostBins = 32;              // bins a slab
constexpr std::int64_t fewestSpread = 16; // particles a bin; bins of fewer are merged
constexpr double inside = 0x1p-20; // in cells: places stay at least so far from a cell's sides

// The slabs along an axis: numbers of slabs, and the place of a particle along the axis.
template <int Dimension>
class Slabs
{
public:
  Slabs(const GridSize<Dimension>& size, int axis)
    : Size(size)
    , Axis(axis)
  {
    for (int a = 0; a < Dimension; ++a)
    {
      this->Count[a] = a == axis ? size[a] : (size[a] + across - 1) / across;
      this->Number *= this->Count[a];
    }
  }

  std::int64_t NumberOfSlabs() const { return this->Number; }

  // The slab that holds a particle, axis 0 fastest.
  std::int64_t SlabOf(const double* particle) const
  {
    std::int64_t slab = 0;
    for (int a = Dimension; a-- > 0;)
    {
      const std::int64_t cell = this->CellOf(particle[a], a);
      slab = slab * this->Count[a] + (a == this->Axis ? cell : cell / across);
    }
    return slab;
  }
  // The particle's coordinate along the axis within its cell, from 0 to 1.
  double PlaceOf(const double* particle) const
  {
    const double at = particle[this->Axis];
    return at - static_cast<double>(this->CellOf(at, this->Axis));
  }
  void SetPlace(double* particle, double place) const
  {
    double& at = particle[this->Axis];
    at = static_cast<double>(this->CellOf(at, this->Axis)) + place;
  }

private:
  std::int64_t CellOf(double at, int axis) const
  {
    return std::clamp<std::int64_t>(static_cast<std::int64_t>(at), 0, this->Size[axis] - 1);
  }

  GridSize<Dimension> Size;
  int Axis;
  GridSize<Dimension> Count;
  std::int64_t Number = 1;
};

// The number of bins a slab, a power of two, or 0 if there are too many slabs for so few particles:
// counts take at most 4 a particle, or a million if that is more.
int binsFor(std::int64_t slabs, std::int64_t particles)
{
  const std::int64_t most = std::max(4 * particles, std::int64_t{ 1 } << 20);
  int bins = mostBins;
  while (bins > 1 && slabs * bins > most)
  {
    bins /= 2;
  }
  return bins > 1 ? bins : 0;
}

// The bin of a place in [0, 1].
int binOf(double place, int bins)
{
  return std::min(static_cast<int>(place * bins), bins - 1);
}

// Writes bins + 1 ends: where those of a slab's bins go, which is the cumulative distribution of
// the places. It is found from halves of halves, like a Haar transform. The differences between
// halves are shrunk by the factor 1 - parts / chi^2 (as by James and Stein), for chi^2 is about
// `parts` if the differences are chance alone.
void writeEnds(const std::int64_t* counts, int bins, double* ends)
{
  double* shares = ends + 1; // each part's share of the particles, of those of the present level
  shares[0] = 1.0;
  std::int64_t sums[2 * mostBins]; // each part's particles on all levels, the whole at 1, the
                                   // halves of p at 2 p and 2 p + 1
  std::copy_n(counts, bins, sums + bins);
  for (int part = bins; part-- > 1;)
  {
    sums[part] = sums[2 * part] + sums[2 * part + 1];
  }
  for (int parts = 1; parts < bins; parts *= 2)
  {
    double chiSquare = 0.0;
    double differences[mostBins]; // (low - high) / (low + high) for the two halves of each part
    for (int i = 0; i < parts; ++i)
    {
      const auto low = static_cast<double>(sums[2 * (parts + i)]);
      const auto high = static_cast<double>(sums[2 * (parts + i) + 1]);
      differences[i] = low + high > 0.0 ? (low - high) / (low + high) : 0.0;
      chiSquare += differences[i] * (low - high);
    }
    const bool areEnough = sums[1] >= 2 * fewestSpread * parts;
    const double kept = areEnough && chiSquare > parts ? 1.0 - parts / chiSquare : 0.0;
    // Backwards, as part i's halves take the places 2 i and 2 i + 1 in the same array.
    for (int i = parts; i-- > 0;)
    {
      const double half = 0.5 * shares[i];
      shares[2 * i] = half * (1.0 + kept * differences[i]);
      shares[2 * i + 1] = half * (1.0 - kept * differences[i]);
    }
  }
  // Ends are cumulative sums of shares, from 0 to exactly 1.
  ends[0] = 0.0;
  std::partial_sum(shares, shares + bins, shares);
  ends[bins] = 1.0;
}

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

// Each axis in turn: counts the particles of each bin, then moves each particle by the piecewise
// linear map that takes bins to shares of the cell of the same size as theirs. This is histogram
// equalization; it keeps particles in their cells.
template <int Dimension>
void equalizeInSlabs(
  const GridSize<Dimension>& size, PointSpan<Dimension> particles, Progress& progress)
{
  const std::int64_t number = particles.size();
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const Slabs<Dimension> slabs(size, axis);
    const int bins = binsFor(slabs.NumberOfSlabs(), number);
    if (bins == 0)
    {
      continue;
    }
    // Integer counts are the same for any number of threads.
    IntegerSums sums(slabs.NumberOfSlabs() * bins, number, progress);
    progress.For(number, std::int64_t{ 1 } << 13, [&](std::int64_t first, std::int64_t last) {
      const IntegerSums::Part part(sums);
      for (std::int64_t i = first; i < last; ++i)
      {
        const int bin = binOf(slabs.PlaceOf(particles[i]), bins);
        ++part.Values()[slabs.SlabOf(particles[i]) * bins + bin];
      }
    });
    const LargeBuffer<std::int64_t> counts = sums.Release(progress);
    LargeBuffer<double> ends(slabs.NumberOfSlabs() * (bins + 1));
    progress.Threads().For(
      slabs.NumberOfSlabs(), std::int64_t{ 1 } << 10, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t slab = first; slab < last && !progress.IsCancelled(); ++slab)
        {
          writeEnds(counts.data() + slab * bins, bins, ends.data() + slab * (bins + 1));
        }
        progress.ShouldStop();
      });
    progress.Check();
    progress.ForEach(number, std::int64_t{ 1 } << 13, [&](std::int64_t i) {
      const double place = slabs.PlaceOf(particles[i]);
      const int bin = binOf(place, bins);
      const double* end = ends.data() + slabs.SlabOf(particles[i]) * (bins + 1) + bin;
      const double to = end[0] + (place * bins - bin) * (end[1] - end[0]);
      slabs.SetPlace(particles[i], std::clamp(to, inside, 1.0 - inside));
    });
  }
}

// The most that an axis takes: first counts on several threads, then counts and ends.
template <int Dimension>
double memoryForSlabEqualization(const GridSize<Dimension>& size, std::int64_t particles)
{
  double most = 0.0;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const std::int64_t slabs = Slabs<Dimension>(size, axis).NumberOfSlabs();
    const std::int64_t sums = slabs * binsFor(slabs, particles);
    if (sums > 0)
    {
      const double arrays = IntegerSums::ArraysFor(sums, particles, mostArraysOfSums);
      const auto ends = static_cast<double>(sums + slabs);
      most = std::max(most, static_cast<double>(sums) * arrays);
      most = std::max(most, static_cast<double>(sums) + ends);
    }
  }
  return most * sizeof(double);
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(equalizeInSlabs);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(memoryForSlabEqualization);

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

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(correctSamples);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(memoryForCorrection);

} // namespace RectifiedTransport
