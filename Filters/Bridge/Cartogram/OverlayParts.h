// SPDX-License-Identifier: BSD-3-Clause
// The point sets of an overlay, which is one or has them as blocks, and those of its output.
#ifndef RectifiedTransport_OverlayParts_h
#define RectifiedTransport_OverlayParts_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Cartogram/MapOverlays.h"
#include "Core/Parallel/Progress.h"

#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataObject;
class vtkPointSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

struct OverlayPart
{
  vtkPointSet* Input;
  vtkPointSet* Output; // has all of the input but its own points
};

// Gives an output of the overlay's type its blocks, cells and arrays. Throws Failure for blocks of
// other types and for cells that cannot be read.
std::vector<OverlayPart> overlayParts(vtkDataObject* overlay, vtkDataObject* output);

// Adds the points of all parts to what moves along with a map. Throws Failure and Cancelled.
void addOverlay(const std::vector<OverlayPart>& parts, MapOverlays& overlays, Progress& progress);
// Sets the points of the outputs after the move. Throws Failure and Cancelled.
void writeOverlay(
  const MapOverlays& overlays, const std::vector<OverlayPart>& parts, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
