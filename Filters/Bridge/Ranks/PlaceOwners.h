// SPDX-License-Identifier: BSD-3-Clause
// Which rank has the part of a domain that holds a place.
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

namespace RectifiedTransport
{

// By the grid cell that holds it: that of the lowest rank that has it. Where a rank has the whole
// domain and others have parts of it, too, or there are no pieces, ranks have the pieces into which
// VTK divides an image's extent.
class PlaceOwners
{
public:
  // `pieces` may be nullptr.
  PlaceOwners(const ImageGrid& grid, const ImagePieces* pieces, const Ranks& ranks);

  // Of a physical place, or the nearest one of the domain.
  int OwnerOf(const double* place) const;
  // The points, or the corners of the cells, between which this rank has the places.
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

} // namespace RectifiedTransport

#endif
