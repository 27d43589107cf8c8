// SPDX-License-Identifier: BSD-3-Clause
// Where the particles of an advection start.
#ifndef RectifiedTransport_FlowSeeds_h
#define RectifiedTransport_FlowSeeds_h

#include "../Geometry/GridSize.h"
#include "../Geometry/LatticePart.h"
#include "../Geometry/Points.h"

#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>

namespace RectifiedTransport
{

// Points of an array, which are not copied, or one point in each cell of a lattice that fills the
// box, axis 0 fastest. A lattice needs neither an array nor a sort.
template <int Dimension>
class FlowSeeds
{
public:
  FlowSeeds() = default; // no points
  FlowSeeds(ConstPointSpan<Dimension> points)
    : Given(points)
  {
  }
  FlowSeeds(const double* coordinates, std::int64_t count)
    : Given(coordinates, count)
  {
  }
  // Anything that converts to a span of points, such as a std::vector of them.
  template <class Container,
    class = std::enable_if_t<std::is_convertible_v<const Container&, ConstPointSpan<Dimension>>>>
  FlowSeeds(const Container& points)
    : Given(points)
  {
  }

  // `cells` along the axes, 1 to 2^30; `place` is the point in its cell, in [0, 1], by default the
  // centre.
  static FlowSeeds Lattice(
    const GridSize<Dimension>& cells, const Point<Dimension>& place = cellCentre<Dimension>())
  {
    FlowSeeds seeds(LatticeParts<Dimension>::WholeOf(cells));
    seeds.CellsOfLattice = cells;
    seeds.PlaceInCell = place;
    seeds.IsWhole = true;
    return seeds;
  }
  // Parts of such a lattice, which give the places of the results; results are as for the whole
  // lattice.
  static FlowSeeds Lattice(const GridSize<Dimension>& cells, LatticeParts<Dimension> parts,
    const Point<Dimension>& place = cellCentre<Dimension>())
  {
    FlowSeeds seeds(std::move(parts));
    seeds.CellsOfLattice = cells;
    seeds.PlaceInCell = place;
    return seeds;
  }

  // The same seeds as samples of equal mass, which together have the mass of the density that they
  // are taken from: a transport may move them together, to keep masses.
  FlowSeeds AsSamples() const
  {
    FlowSeeds seeds = *this;
    seeds.HaveMass = true;
    return seeds;
  }
  bool AreSamples() const { return this->HaveMass; }

  // The number of points of the whole lattice.
  double Count() const
  {
    return this->IsLattice() ? numberOfCells<Dimension>(this->CellsOfLattice)
                             : static_cast<double>(this->Given.size());
  }
  bool IsLattice() const { return this->Chosen.has_value(); }
  bool IsWholeLattice() const { return this->IsWhole; }
  ConstPointSpan<Dimension> Points() const { return this->Given; }
  const GridSize<Dimension>& Cells() const { return this->CellsOfLattice; }
  const LatticeParts<Dimension>& Parts() const { return *this->Chosen; }
  const Point<Dimension>& Place() const { return this->PlaceInCell; }

private:
  explicit FlowSeeds(LatticeParts<Dimension> parts)
    : Chosen(std::move(parts))
  {
  }

  ConstPointSpan<Dimension> Given;
  GridSize<Dimension> CellsOfLattice{};
  std::optional<LatticeParts<Dimension>> Chosen;
  Point<Dimension> PlaceInCell{};
  bool IsWhole = false;
  bool HaveMass = false;
};

} // namespace RectifiedTransport

#endif
