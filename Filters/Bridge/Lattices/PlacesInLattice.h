// SPDX-License-Identifier: BSD-3-Clause
// Where particles lie among the points and cells of data sets that form a lattice.
#ifndef RectifiedTransport_PlacesInLattice_h
#define RectifiedTransport_PlacesInLattice_h

#include "Bridge/Blocks/BlockValues.h"
#include "Bridge/Lattices/CellLattice.h"
#include "Bridge/Points/SampledArrays.h"
#include "Core/Geometry/Points.h"

#include <vector>

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// Linear between the corners of a cell along each axis. Places in holes are in no cell, except
// those that rounding put there.
class PlacesInLattice : public SampledPlaces
{
public:
  // `places` are physical, in the lattice's grid. Throws Failure and Cancelled.
  PlacesInLattice(const CellLattice& lattice, const std::vector<BlockValues>& blocks,
    ConstPointSpan<3> places, Progress& progress);

  std::int64_t Count() const override { return this->Places.size(); }
  SampledPlace Find(std::int64_t place) const override;

private:
  // The number of a cell among the cells of all blocks; -1 for none.
  std::int64_t CellNear(const std::array<double, 3>& along) const;

  const CellLattice& Lattice;
  const std::vector<BlockValues>& Blocks;
  const ConstPointSpan<3> Places;
  std::vector<std::int64_t> First;  // number of a cell of each block, and the end
  std::vector<std::int64_t> CellAt; // each place of the lattice
};

} // namespace RectifiedTransport::Bridge

#endif
