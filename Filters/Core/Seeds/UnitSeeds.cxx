// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Seeds/UnitSeeds.h"

#include "Core/Geometry/CountText.h"
#include "Core/Parallel/LargeBuffer.h"

#include <algorithm>
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
    this->Grid = latticeSize<Dimension>(lengths, count);
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
  if (pattern != SeedPattern::Lattice && pattern != SeedPattern::Jittered)
  {
    throw std::invalid_argument(
      "seeds in each cell of a grid are of the pattern Lattice or Jittered");
  }
}

template <int Dimension>
void UnitSeeds<Dimension>::Generate(PointSpan<Dimension> unitPoints, const Context& context) const
{
  if (static_cast<double>(unitPoints.size()) != this->Number)
  {
    throw std::invalid_argument("there is memory for " + std::to_string(unitPoints.size()) +
      " seeds, there must be " + describeCount(this->Number));
  }
  if (!this->OnGrid)
  {
    generateSeeds<Dimension>(this->Pattern, this->Lengths, this->RandomSeed, unitPoints, context);
  }
  else if (this->Pattern == SeedPattern::Lattice)
  {
    generateLattice<Dimension>(this->Grid, unitPoints, context);
  }
  else
  {
    generateJitteredLattice<Dimension>(this->Grid, this->RandomSeed, unitPoints, context);
  }
}

template <int Dimension>
void UnitSeeds<Dimension>::GenerateFrom(
  std::int64_t first, PointSpan<Dimension> unitPoints, const Context& context) const
{
  if (static_cast<double>(unitPoints.size()) == this->Number)
  {
    this->Generate(unitPoints, context);
    return;
  }
  const auto all = static_cast<std::int64_t>(this->Number);
  if (first < 0 || unitPoints.size() > all - first)
  {
    throw std::invalid_argument("there are " + describeCount(this->Number) + " seeds, not " +
      std::to_string(unitPoints.size()) + " from number " + std::to_string(first) + " on");
  }
  LargeBuffer<double> points(all * Dimension);
  this->Generate({ points.data(), all }, context);
  std::copy_n(points.data() + first * Dimension, unitPoints.size() * Dimension, unitPoints.data());
}

template class UnitSeeds<1>;
template class UnitSeeds<2>;
template class UnitSeeds<3>;

} // namespace RectifiedTransport
