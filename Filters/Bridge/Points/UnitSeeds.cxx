// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Points/UnitSeeds.h"

namespace RectifiedTransport
{

template <int D>
UnitSeeds<D>::UnitSeeds(
  SeedPattern pattern, const Point<D>& lengths, std::int64_t count, int randomSeed)
  : Pattern(pattern)
  , Lengths(lengths)
  , OnGrid(pattern == SeedPattern::Lattice)
  , RandomSeed(static_cast<std::uint64_t>(randomSeed))
  , Number(static_cast<double>(count))
{
  if (this->OnGrid)
  {
    this->Grid = latticeSize<D>(lengths, count);
    this->Number = numberOfCells<D>(this->Grid);
  }
}

template <int D>
UnitSeeds<D>::UnitSeeds(SeedPattern pattern, const GridSize<D>& grid, int randomSeed)
  : Pattern(pattern)
  , Grid(grid)
  , OnGrid(true)
  , RandomSeed(static_cast<std::uint64_t>(randomSeed))
  , Number(numberOfCells<D>(grid))
{
}

template <int D>
void UnitSeeds<D>::Generate(PointSpan<D> points, const Context& context) const
{
  if (!this->OnGrid)
  {
    generateSeeds<D>(this->Pattern, this->Lengths, this->RandomSeed, points, context);
  }
  else if (this->Pattern == SeedPattern::Lattice)
  {
    generateLattice<D>(this->Grid, points, context);
  }
  else
  {
    generateJitteredLattice<D>(this->Grid, this->RandomSeed, points, context);
  }
}

template class UnitSeeds<1>;
template class UnitSeeds<2>;
template class UnitSeeds<3>;

} // namespace RectifiedTransport
