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
bool UnitSeeds<D>::Generate(double* points, const Monitor& monitor) const
{
  if (!this->OnGrid)
  {
    return generateSeeds<D>(this->Pattern, this->Lengths, static_cast<std::int64_t>(this->Number),
      this->RandomSeed, points, monitor);
  }
  if (this->Pattern == SeedPattern::Lattice)
  {
    return generateLattice<D>(this->Grid, points, monitor);
  }
  return generateJitteredLattice<D>(this->Grid, this->RandomSeed, points, monitor);
}

template class UnitSeeds<1>;
template class UnitSeeds<2>;
template class UnitSeeds<3>;

} // namespace RectifiedTransport
