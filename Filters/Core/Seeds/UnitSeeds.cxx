// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Seeds/UnitSeeds.h"

#include "Core/Messages/PartText.h"

#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

template <int Dimension>
UnitSeeds<Dimension>::UnitSeeds(SeedPattern pattern, const Point<Dimension>& lengths,
  std::int64_t count, std::uint64_t randomSeed)
  : Pattern(pattern)
  , Lengths(lengths)
  , OnGrid(pattern == SeedPattern::Lattice)
  , RandomSeed(randomSeed)
  , Number(static_cast<double>(count))
{
  if (this->OnGrid)
  {
    // A lattice has the number of cells that comes nearest to `count` with cells near to cubes.
    this->Grid = latticeSize<Dimension>(lengths, count);
    // The number is a double, since the product of the sizes may exceed 64 bits.
    this->Number = numberOfCells<Dimension>(this->Grid);
  }
}

template <int Dimension>
UnitSeeds<Dimension>::UnitSeeds(
  SeedPattern pattern, const GridSize<Dimension>& grid, std::uint64_t randomSeed)
  : Pattern(pattern)
  , Grid(grid)
  , OnGrid(true)
  , RandomSeed(randomSeed)
  , Number(numberOfCells<Dimension>(grid))
{
  // Other patterns have no point for each cell of a grid.
  if (pattern != SeedPattern::Lattice && pattern != SeedPattern::Jittered)
  {
    throw std::invalid_argument(
      "seeds in each cell of a grid are of the pattern Lattice or Jittered");
  }
}

template <int Dimension>
void UnitSeeds<Dimension>::Generate(PointSpan<Dimension> unitPoints, const Context& context) const
{
  // A count beyond the largest integer differs from every size, so it fails here.
  if (static_cast<double>(unitPoints.size()) != this->Number)
  {
    throw std::invalid_argument("there is memory for " + std::to_string(unitPoints.size()) +
      " seeds, there must be " + describeCount(this->Number));
  }
  this->GenerateFrom(0, unitPoints, context);
}

template <int Dimension>
void UnitSeeds<Dimension>::GenerateFrom(
  std::int64_t first, PointSpan<Dimension> unitPoints, const Context& context) const
{
  // Every pattern can make any part of its seeds, with the same bits as the whole.
  if (!this->OnGrid)
  {
    generateSeedsFrom<Dimension>(this->Pattern, this->Lengths,
      static_cast<std::int64_t>(this->Number), this->RandomSeed, first, unitPoints, context);
  }
  else if (this->Pattern == SeedPattern::Lattice)
  {
    generateLatticeFrom<Dimension>(this->Grid, first, unitPoints, context);
  }
  else
  {
    generateJitteredLatticeFrom<Dimension>(
      this->Grid, this->RandomSeed, first, unitPoints, context);
  }
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(UnitSeeds);

} // namespace RectifiedTransport
