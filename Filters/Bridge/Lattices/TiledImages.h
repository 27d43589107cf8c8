// SPDX-License-Identifier: BSD-3-Clause
// Images that tile one lattice, as one image.
#ifndef RectifiedTransport_TiledImages_h
#define RectifiedTransport_TiledImages_h

#include "Bridge/Blocks/DensityBlocks.h"

#include "vtkSmartPointer.h"

#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// The arrays that all images with mass have, at least one; what none of these covers is hidden.
// nullptr where a block is no image, where they are not of one lattice, or most of its box is
// empty, and where cells overlap or points that images share have two values: these are resampled.
vtkSmartPointer<vtkImageData> joinTiles(const std::vector<DensityBlock>& blocks, bool onPoints);

} // namespace RectifiedTransport

#endif
