// SPDX-License-Identifier: BSD-3-Clause
// Which rank owns a position of a domain.
#ifndef RectifiedTransport_PlaceOwners_h
#define RectifiedTransport_PlaceOwners_h

#include "Core/Geometry/Distributed/TupleBoxes.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Geometry/LatticePart.h"
#include "Core/Parallel/Ranks.h"

#include <array>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// The owner is the lowest rank that holds the grid cell of the position. If a rank holds the whole
// domain and others also hold parts of it, or if none holds any, ranks own the pieces into which
// the domain is divided.
class PlaceOwners
{
public:
  // Extents of the points, or of the corners of the cells, of each rank: those that they hold, or
  // none, and the pieces of the domain.
  PlaceOwners(const ImageGrid& grid, std::vector<Extent> held, const std::vector<Extent>& divided,
    const Ranks& ranks);

  // The owner of a physical position, or of the nearest position of the domain.
  int OwnerOf(const double* place) const;
  // The points, or the corners of the cells, between which this rank owns the positions.
  const Extent& OwnExtent() const { return this->Own; }

private:
  template <int D>
  int Find(const double* place) const;

  const ImageGrid& Grid;
  Extent Own;
  std::vector<LatticePart<3>> Boxes;            // boxes of grid cells, by ranks
  std::array<std::vector<std::int64_t>, 3> Cut; // where boxes begin and end along an axis
  std::vector<int> Owners;                      // by parts between cuts, axis 0 fastest
};

} // namespace RectifiedTransport

#endif
