// SPDX-License-Identifier: BSD-3-Clause
// The centres of a grid of cells that fill a box, in an order in which neighbours in memory are
// neighbours in space. What ParticleOrder finds by a sort follows here from the grid alone: nothing
// is stored, and every range can be made by itself.
#ifndef RectifiedTransport_LatticeOrder_h
#define RectifiedTransport_LatticeOrder_h

#include "Density.h"

#include <cstdint>

namespace RectifiedTransport
{

template <int Dimension>
class LatticeOrder
{
public:
  // `lattice` cells an axis on the box [0, size].
  LatticeOrder(const GridSize<Dimension>& lattice, const GridSize<Dimension>& size)
    : Lattice(lattice)
    , Size(size)
  {
  }

  std::int64_t Count() const;

  // Samples [first, first + count) of this order: their numbers in the grid, axis 0 fastest, and
  // their coordinates.
  void Fill(std::int64_t first, int count, std::int64_t* index, double* points) const;

private:
  GridSize<Dimension> Lattice;
  GridSize<Dimension> Size;
};

// A coordinate of the centre of cell `cell` of `cells` on [0, size]; exact where they are as many.
inline double latticeCentre(std::int64_t cell, std::int64_t cells, std::int64_t size)
{
  return (static_cast<double>(cell) + 0.5) * static_cast<double>(size) / static_cast<double>(cells);
}

} // namespace RectifiedTransport

#endif
