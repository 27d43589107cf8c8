// SPDX-License-Identifier: BSD-3-Clause
// One point in each of a grid of cells that fill a box, in an order in which neighbours in memory
// are neighbours in space. What ParticleOrder finds by a sort follows here from the grid alone:
// nothing is stored, and every range can be made by itself.
#ifndef RectifiedTransport_LatticeOrder_h
#define RectifiedTransport_LatticeOrder_h

#include "Core/Tables/Density.h"

#include <cstdint>

namespace RectifiedTransport
{

template <int Dimension>
class LatticeOrder
{
public:
  // `lattice` cells an axis on the box [0, size]; `place` is that of the point in its cell.
  LatticeOrder(const GridSize<Dimension>& lattice, const GridSize<Dimension>& size,
    const Point<Dimension>& place = cellCentre<Dimension>())
    : Lattice(lattice)
    , Size(size)
    , Place(place)
  {
  }

  std::int64_t Count() const;

  // All of the order from `first` on is there without preparation. Returns how many these are.
  std::int64_t Prepare(std::int64_t first) const { return this->Count() - first; }

  // Samples [first, first + count) of this order: their numbers in the grid, axis 0 fastest, and
  // their coordinates.
  void Fill(std::int64_t first, int count, std::int64_t* index, double* points) const;

private:
  GridSize<Dimension> Lattice;
  GridSize<Dimension> Size;
  Point<Dimension> Place;
};

// A coordinate of the point at `place` in cell `cell` of `cells` on [0, size]; exact at the centre
// where they are as many.
inline double latticePoint(std::int64_t cell, double place, std::int64_t cells, std::int64_t size)
{
  return (static_cast<double>(cell) + place) * static_cast<double>(size) /
    static_cast<double>(cells);
}

inline double latticeCentre(std::int64_t cell, std::int64_t cells, std::int64_t size)
{
  return latticePoint(cell, 0.5, cells, size);
}

} // namespace RectifiedTransport

#endif
