// SPDX-License-Identifier: BSD-3-Clause
// Which rank owns a position of a domain.
#ifndef RectifiedTransport_PlaceOwners_h
#define RectifiedTransport_PlaceOwners_h

#include "Bridge/Ranks/ImagePieces.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Geometry/LatticePart.h"
#include "Core/Geometry/Points.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport::Bridge
{

// The owner is the lowest rank that has the grid cell of the position. If a rank has the whole
// domain and others also have parts of it, or if there are no pieces, ranks own the pieces into
// which VTK divides an image's extent.
class PlaceOwners
{
public:
  // `pieces` may be nullptr.
  PlaceOwners(const ImageGrid& grid, const ImagePieces* pieces, const Ranks& ranks);

  // The owner of a physical position, or of the nearest position of the domain.
  int OwnerOf(const double* place) const;
  // The points, or the corners of the cells, between which this rank owns the positions.
  const Extent& OwnExtent() const { return this->Own; }

private:
  template <int D>
  int Find(const double* place) const;

  const ImageGrid& Grid;
  Extent Own;
  std::vector<LatticePart<3>> Boxes;            // of grid cells, of each rank
  std::array<std::vector<std::int64_t>, 3> Cut; // where boxes begin and end along an axis
  std::vector<int> Owners;                      // of the parts between cuts
};

} // namespace RectifiedTransport::Bridge

#endif
