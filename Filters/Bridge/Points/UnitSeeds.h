// SPDX-License-Identifier: BSD-3-Clause
// The seeds of a pattern property, in the unit box.
#ifndef RectifiedTransport_UnitSeeds_h
#define RectifiedTransport_UnitSeeds_h

#include "Core/Seeds/Seeds.h"

#include <cstdint>

namespace RectifiedTransport
{

constexpr const char* SeedPatternTexts[] = { "BlueNoise", "Lattice", "Jittered", "LowDiscrepancy",
  "Random" };

template <int D>
class UnitSeeds
{
public:
  // `count` seeds for a box with sides `lengths`; Lattice: the nearest number of a grid.
  UnitSeeds(SeedPattern pattern, const Point<D>& lengths, std::int64_t count, int randomSeed);
  // A grid of seeds for Lattice and Jittered.
  UnitSeeds(SeedPattern pattern, const GridSize<D>& grid, int randomSeed);

  // How many there are. Not an integer, because it may exceed every integer.
  double Count() const { return this->Number; }
  // Makes Count() points. Throws std::bad_alloc and Cancelled.
  void Generate(PointSpan<D> points, const Context& context) const;

private:
  SeedPattern Pattern;
  Point<D> Lengths{};
  GridSize<D> Grid{};
  bool OnGrid;
  std::uint64_t RandomSeed;
  double Number;
};

} // namespace RectifiedTransport

#endif
