// SPDX-License-Identifier: BSD-3-Clause
// One point in each cell of a lattice that fills a box, in an order in which neighbours in memory
// are neighbours in space. ParticleOrder sorts points for that. Here the order depends only on the
// lattice: nothing is stored, and any range is computed independently.
#ifndef RectifiedTransport_LatticeOrder_h
#define RectifiedTransport_LatticeOrder_h

#include "Core/Geometry/GridSize.h"
#include "Core/Geometry/LatticePart.h"

#include <cstdint>
#include <utility>

namespace RectifiedTransport
{

template <int Dimension>
class LatticeOrder
{
public:
  // `lattice` cells an axis on the box [0, size]; `place` is the point in its cell, in [0, 1].
  LatticeOrder(const GridSize<Dimension>& lattice, const GridSize<Dimension>& size,
    const Point<Dimension>& place = cellCentre<Dimension>())
    : LatticeOrder(lattice, LatticeParts<Dimension>::WholeOf(lattice), size, place)
  {
  }
  // The points of parts of the lattice, one part after another.
  LatticeOrder(const GridSize<Dimension>& lattice, LatticeParts<Dimension> parts,
    const GridSize<Dimension>& size, const Point<Dimension>& place = cellCentre<Dimension>())
    : Lattice(lattice)
    , Chosen(std::move(parts))
    , Size(size)
    , Place(place)
  {
    for (const LatticePart<Dimension>& part : this->Chosen.Parts)
    {
      this->Samples += part.Count();
    }
  }

  std::int64_t Count() const { return this->Samples; }
  const GridSize<Dimension>& Cells() const { return this->Lattice; }
  const GridSize<Dimension>& Box() const { return this->Size; }
  const Point<Dimension>& PlaceInCell() const { return this->Place; }

  // Samples [first, first + count) in this order: the indices of their results, and their
  // coordinates.
  void Fill(std::int64_t first, int count, std::int64_t* index, double* points) const;

private:
  GridSize<Dimension> Lattice;
  LatticeParts<Dimension> Chosen;
  GridSize<Dimension> Size;
  Point<Dimension> Place;
  std::int64_t Samples = 0;
};

// A coordinate of the point at `place` in cell `cell` of `cells` on [0, size]; exact at the centre
// if cells == size.
inline double latticePoint(std::int64_t cell, double place, std::int64_t cells, std::int64_t size)
{
  return (static_cast<double>(cell) + place) * static_cast<double>(size) /
    static_cast<double>(cells);
}

} // namespace RectifiedTransport

#endif
