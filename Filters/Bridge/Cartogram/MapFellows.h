// SPDX-License-Identifier: BSD-3-Clause
// What moves along with a map: the points of an overlay, and the lines of a graticule.
#ifndef RectifiedTransport_MapFellows_h
#define RectifiedTransport_MapFellows_h

#include "Bridge/Cartogram/MapPlace.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Progress.h"

#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkPointSet;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class MapFellows
{
public:
  // `overlay` may be nullptr. Throws Failure and Cancelled.
  MapFellows(const MapPlace& place, vtkPointSet* overlay, Progress& progress);

  // To be moved: in index space.
  FellowPoints& Points() { return this->Moved; }
  void WriteGraticule(vtkPolyData* output) const;
  // Sets the points of an output that has the rest of the overlay.
  void WriteOverlay(vtkPointSet* output) const;

private:
  const MapPlace& Place;
  FellowPoints Moved; // of the graticule, then of the overlay
  FellowPoints Before;
  std::vector<Point<3>> Overlay; // the places before
};

} // namespace RectifiedTransport

#endif
