// SPDX-License-Identifier: BSD-3-Clause
// An image that one rank has made, distributed to all.
#ifndef RectifiedTransport_DistributedImage_h
#define RectifiedTransport_DistributedImage_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Ranks.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
class vtkInformation;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// Where the first rank has an image and the others none: gives each the extent that is requested of
// its output, with all arrays, and the field data to all; announces the whole extent. Collective.
//
void distributeImage(vtkImageData* image, vtkInformation* output, const Ranks& ranks);

} // namespace RectifiedTransport

#endif
