// SPDX-License-Identifier: BSD-3-Clause
// Measures of how well the distribution of particles matches a density.
#ifndef RectifiedTransport_ParticleQuality_h
#define RectifiedTransport_ParticleQuality_h

#include "../Flow/RectifiedFlow.h"
#include "../Geometry/ImageGrid.h"
#include "../Parallel/Context.h"
#include "BlockErrors.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace RectifiedTransport
{

// Particles in physical space: at least one (of all ranks), and all numbers finite.
struct ParticleSample
{
  ConstPointSpan<3> Points;
  const double* Masses = nullptr;       // not negative; null: all equal
  ConstPointSpan<3> Displacements = {}; // one a particle, or none at all
  // On several ranks, keys of the order in which particles are summed; null: those of rank 0 first,
  // on each rank in their order.
  const std::int64_t* Order = nullptr;
};

// Sums over blocks: the mass found and the mass expected in each, in any units, and its measure.
struct BlockCorrelation
{
  void Add(double found, double expected, double measure)
  {
    this->Blocks += 1.0;
    this->Measure += measure;
    this->Found += found;
    this->Expected += expected;
    this->FoundSquares += found * found / measure;
    this->ExpectedSquares += expected * expected / measure;
    this->Products += found * expected / measure;
  }
  // That of the densities; 0 where it may be chance: within three standard deviations of random
  // ones.
  double Value() const
  {
    const double found = this->FoundSquares - this->Found * this->Found / this->Measure;
    const double expected = this->ExpectedSquares - this->Expected * this->Expected / this->Measure;
    const double both = this->Products - this->Found * this->Expected / this->Measure;
    const double value = found > 0.0 && expected > 0.0 ? both / std::sqrt(found * expected) : 0.0;
    return value * value * this->Blocks > 9.0 ? value : 0.0;
  }

  double Blocks = 0.0;
  double Measure = 0.0;
  double Found = 0.0;
  double Expected = 0.0;
  double FoundSquares = 0.0;
  double ExpectedSquares = 0.0;
  double Products = 0.0;
};

struct ParticleQuality
{
  std::int64_t Particles = 0;
  double TotalMass = 0.0;        // of the density: sum over grid cells of value times measure
  std::int64_t Outside = 0;      // of the domain
  std::int64_t InEmptyCells = 0; // particles inside the domain in grid cells without mass
  // The relative L2 distance between the particles' density and the given one, both averaged over
  // blocks of grid cells.
  double DensityError = 0.0;
  // How the density of the particles goes with the given one over the blocks, from -1 to 1; 0 where
  // it may be chance.
  double Correlation = 0.0;
  // The relative errors of the masses of blocks whose density is more than leastOfMean.
  BlockErrors Blocks;
  double TransportCost = 0.0; // mean squared displacement, by mass
  // Over the particles inside that have mass: the distance to the nearest other particle, relative
  // to the densest lattice packing at the local density. 0 if there are no such particles.
  double SmallestSpacing = 0.0;
  double MeanSpacing = 0.0;
};

// Returns the smallest size of blocks, in grid cells along each axis, with which a block holds
// `particles` of `all` on average over the grid.
template <int Dimension>
std::int64_t blockSizeFor(const GridSize<Dimension>& cells, std::int64_t all, double particles)
{
  const double wanted =
    std::min(1.0, particles / static_cast<double>(all)) * numberOfCells<Dimension>(cells);
  const auto cellsOfBlock = [&cells](std::int64_t size) {
    double product = 1.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      product *= static_cast<double>(std::min(size, cells[axis]));
    }
    return product;
  };
  std::int64_t tooSmall = 0;
  std::int64_t large = *std::max_element(cells.begin(), cells.end());
  while (large - tooSmall > 1)
  {
    const std::int64_t size = tooSmall + (large - tooSmall) / 2;
    (cellsOfBlock(size) < wanted ? tooSmall : large) = size;
  }
  return large;
}

// Returns the sides, in grid cells, of boxes about a particle that have equal sides in physical
// space, up to a common factor.
template <int Dimension>
Point<Dimension> boxAspect(const ImageGrid& grid);

// Compares particles with the density of a flow, which lies on `grid` in physical space.
// Collective: each rank of the context gives its own particles, with the same attributes as the
// others if it has any; all ranks get the figures of all particles. Temporarily takes about 88
// bytes a particle and 16 a block; O(particles log particles). Throws std::invalid_argument for a
// block without cells and for masses whose sum is not a positive number, std::overflow_error for a
// figure beyond the largest double, std::bad_alloc and Cancelled.
template <int Dimension>
ParticleQuality measureQuality(const ParticleSample& particles,
  const RectifiedFlow<Dimension>& flow, const ImageGrid& grid, std::int64_t blockSize,
  const Context& context = Context());

} // namespace RectifiedTransport

#endif
