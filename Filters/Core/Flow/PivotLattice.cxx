// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/PivotLattice.h"

#include "Core/Geometry/LowDiscrepancy.h"
#include "Core/Geometry/ReproducibleMath.h"

namespace RectifiedTransport
{

namespace
{

template <int Dimension>
std::int64_t power(std::int64_t base)
{
  std::int64_t product = 1;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    product *= base;
  }
  return product;
}

// The largest number whose power is at most `value`.
template <int Dimension>
std::int64_t integerRoot(std::int64_t value)
{
  auto guess = static_cast<std::int64_t>(root<Dimension>(static_cast<double>(value)));
  while (power<Dimension>(guess + 1) <= value)
  {
    ++guess;
  }
  while (power<Dimension>(guess) > value)
  {
    --guess;
  }
  return guess;
}

// Point i of `count` consecutive ones of the recurrence, shifted so that points i and count - 1 - i
// are mirror images about the centre.
template <int Dimension>
Point<Dimension> placeInCell(std::int64_t i, std::int64_t count)
{
  constexpr std::uint64_t half = std::uint64_t{ 1 } << 63;
  Point<Dimension> place;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const auto halfSteps = static_cast<std::uint64_t>(2 * i - (count - 1));
    place[axis] = unitReal(half + halfSteps * (lowDiscrepancyStep<Dimension>(axis) / 2));
  }
  return place;
}

} // namespace

template <int Dimension>
PivotLattice<Dimension> pivotLattice(const GridSize<Dimension>& grid, std::int64_t perCell)
{
  PivotLattice<Dimension> samples{ grid, {} };
  const std::int64_t side = integerRoot<Dimension>(perCell);
  if (power<Dimension>(side) == perCell)
  {
    for (std::int64_t& cells : samples.Lattice)
    {
      cells *= side;
    }
    samples.Places.push_back(cellCentre<Dimension>());
    return samples;
  }
  for (std::int64_t i = 0; i < perCell; ++i)
  {
    samples.Places.push_back(placeInCell<Dimension>(i, perCell));
  }
  return samples;
}

template PivotLattice<1> pivotLattice<1>(const GridSize<1>&, std::int64_t);
template PivotLattice<2> pivotLattice<2>(const GridSize<2>&, std::int64_t);
template PivotLattice<3> pivotLattice<3>(const GridSize<3>&, std::int64_t);

} // namespace RectifiedTransport
