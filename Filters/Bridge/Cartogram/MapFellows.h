// SPDX-License-Identifier: BSD-3-Clause
// What moves along with a map: the points of an overlay, and the lines of a graticule.
#ifndef RectifiedTransport_MapFellows_h
#define RectifiedTransport_MapFellows_h

#include "Bridge/Cartogram/MapPlace.h"
#include "Bridge/Cartogram/OverlayParts.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Progress.h"

#include <cstddef>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

class MapFellows
{
public:
  // `map` is in index space. Throws Failure and Cancelled.
  MapFellows(const MapPlace& place, const RegionMap& map, const std::vector<OverlayPart>& overlay,
    Progress& progress);

  // To be moved: in index space.
  FellowPoints& Points() { return this->Moved; }
  // They throw Failure and Cancelled.
  void WriteGraticule(vtkPolyData* output) const;
  // Sets the points of the overlay's outputs.
  void WriteOverlay(Progress& progress) const;

private:
  const MapPlace& Place;
  FellowPoints Moved; // of the graticule, then of the overlay
  FellowPoints Before;
  std::vector<std::size_t> LineEnds; // of the graticule, one beyond
  const std::vector<OverlayPart>& Overlay;
  std::vector<Point<3>> OverlayBefore; // of all parts
};

} // namespace RectifiedTransport::Bridge

#endif
