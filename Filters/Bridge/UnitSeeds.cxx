// SPDX-License-Identifier: BSD-3-Clause
#include "UnitSeeds.h"

namespace RectifiedTransport
{

namespace
{

template <int D>
double product(const GridSize<D>& grid)
{
  double count = 1.0;
  for (const std::int64_t cells : grid)
  {
    count *= static_cast<double>(cells);
  }
  return count;
}

} // namespace

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
    this->Number = product<D>(this->Grid);
  }
}

template <int D>
UnitSeeds<D>::UnitSeeds(SeedPattern pattern, const GridSize<D>& grid, int randomSeed)
  : Pattern(pattern)
  , Grid(grid)
  , OnGrid(true)
  , RandomSeed(static_cast<std::uint64_t>(randomSeed))
  , Number(product<D>(grid))
{
}

template <int D>
void UnitSeeds<D>::Generate(double* points) const
{
  if (!this->OnGrid)
  {
    generateSeeds<D>(this->Pattern, this->Lengths, static_cast<std::int64_t>(this->Number),
      this->RandomSeed, points);
  }
  else if (this->Pattern == SeedPattern::Lattice)
  {
    generateLattice<D>(this->Grid, points);
  }
  else
  {
    generateJitteredLattice<D>(this->Grid, this->RandomSeed, points);
  }
}

template class UnitSeeds<1>;
template class UnitSeeds<2>;
template class UnitSeeds<3>;

} // namespace RectifiedTransport
