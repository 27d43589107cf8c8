// SPDX-License-Identifier: BSD-3-Clause
// The point sets of an overlay, which is one or has them as blocks, and those of its output.
#ifndef RectifiedTransport_OverlayParts_h
#define RectifiedTransport_OverlayParts_h

#include "Bridge/VTKCompatibility.h"

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

} // namespace RectifiedTransport::Bridge

#endif
