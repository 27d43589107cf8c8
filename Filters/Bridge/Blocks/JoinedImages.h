// SPDX-License-Identifier: BSD-3-Clause
// Images that are parts of one lattice, as one image.
#ifndef RectifiedTransport_JoinedImages_h
#define RectifiedTransport_JoinedImages_h

#include "Bridge/Blocks/DensityBlocks.h"

#include "vtkSmartPointer.h"

#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// One image with the arrays that all images with mass have; the density is its active scalars. What
// no image covers is hidden. nullptr if a block is no image, if the images do not lie on one
// lattice, if most of its box is empty, if cells overlap, or if shared points have two values. Such
// blocks are resampled.
vtkSmartPointer<vtkImageData> joinImages(const std::vector<DensityBlock>& blocks, bool onPoints);

} // namespace RectifiedTransport::Bridge

#endif
