// SPDX-License-Identifier: BSD-3-Clause
// The seeds of any pattern: how many there will be, so that memory can be provided, then the seeds.
#ifndef RectifiedTransport_UnitSeeds_h
#define RectifiedTransport_UnitSeeds_h

#include "Seeds.h"

#include <cstdint>

namespace RectifiedTransport
{

// Points of the unit box. Throws std::invalid_argument as the functions of Seeds.h do.
template <int Dimension>
class UnitSeeds
{
public:
  // `count` seeds for a box with sides `lengths`; Lattice: the nearest number of a grid.
  UnitSeeds(SeedPattern pattern, const Point<Dimension>& lengths, std::int64_t count,
    std::uint64_t randomSeed);
  // A seed in each cell of a grid, for Lattice and Jittered.
  UnitSeeds(SeedPattern pattern, const GridSize<Dimension>& grid, std::uint64_t randomSeed);

  // The number of seeds. A double, because it may exceed every integer.
  double Count() const { return this->Number; }
  // Makes Count() points. Throws std::bad_alloc and Cancelled.
  void Generate(PointSpan<Dimension> unitPoints, const Context& context = Context()) const;
  // Makes those from number `first` on, with the same bits. Throws std::invalid_argument if there
  // are not as many.
  void GenerateFrom(
    std::int64_t first, PointSpan<Dimension> unitPoints, const Context& context = Context()) const;

private:
  SeedPattern Pattern;
  Point<Dimension> Lengths{};
  GridSize<Dimension> Grid{};
  bool OnGrid;
  std::uint64_t RandomSeed;
  double Number;
};

} // namespace RectifiedTransport

#endif
