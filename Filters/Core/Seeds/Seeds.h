// SPDX-License-Identifier: BSD-3-Clause
// Uniform points, the particles at time 0 (paper, Sections 3.3 and 5.1). All patterns depend only
// on their arguments, to the last bit on every machine. Negative counts and grid sizes, and sides
// that are not positive and finite, throw std::invalid_argument. The generators run on the calling
// thread, whatever the executor, and may throw Cancelled.
#ifndef RectifiedTransport_Seeds_h
#define RectifiedTransport_Seeds_h

#include "../Geometry/GridSize.h"
#include "../Parallel/Context.h"

#include <cstdint>

namespace RectifiedTransport
{

enum class SeedPattern
{
  BlueNoise,      // an even, irregular pattern without preferred directions
  Lattice,        // the centres of a regular grid
  Jittered,       // one random point in each of as many boxes of equal measure as there are points
  LowDiscrepancy, // an additive recurrence (Roberts 2018), shifted by the seed
  Random          // independent uniform points
};

// A grid of about `count` cells, as near to cubes as possible, on a box with sides `lengths`: at
// least 1 an axis (no cells for a count of 0).
template <int Dimension>
GridSize<Dimension> latticeSize(const Point<Dimension>& lengths, std::int64_t count);

// Writes unitPoints.size() points of the unit box [0,1]^Dimension, spread evenly in a box of sides
// `lengths`, each > 0 and of any unit. Not for Lattice, whose count is latticeSize's.
template <int Dimension>
void generateSeeds(SeedPattern pattern, const Point<Dimension>& lengths, std::uint64_t randomSeed,
  PointSpan<Dimension> unitPoints, const Context& context = Context());

// Those of the `count` points of generateSeeds from number `first` on, with the same bits. Only
// blue noise also takes time for the others; memory is only for the part.
template <int Dimension>
void generateSeedsFrom(SeedPattern pattern, const Point<Dimension>& lengths, std::int64_t count,
  std::uint64_t randomSeed, std::int64_t first, PointSpan<Dimension> unitPoints,
  const Context& context = Context());

// The centres of a grid of cells on the unit box, axis 0 fastest, one for each.
template <int Dimension>
void generateLattice(const GridSize<Dimension>& size, PointSpan<Dimension> unitPoints,
  const Context& context = Context());
// The same for the cells from number `first` on.
template <int Dimension>
void generateLatticeFrom(const GridSize<Dimension>& size, std::int64_t first,
  PointSpan<Dimension> unitPoints, const Context& context = Context());

// One random point in each cell of a grid on the unit box, axis 0 fastest.
template <int Dimension>
void generateJitteredLattice(const GridSize<Dimension>& size, std::uint64_t randomSeed,
  PointSpan<Dimension> unitPoints, const Context& context = Context());
// The same for the cells from number `first` on.
template <int Dimension>
void generateJitteredLatticeFrom(const GridSize<Dimension>& size, std::uint64_t randomSeed,
  std::int64_t first, PointSpan<Dimension> unitPoints, const Context& context = Context());

} // namespace RectifiedTransport

#endif
