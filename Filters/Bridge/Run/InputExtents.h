// SPDX-License-Identifier: BSD-3-Clause
#ifndef RectifiedTransport_InputExtents_h
#define RectifiedTransport_InputExtents_h

#include "Bridge/VTKCompatibility.h"

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithm;
class vtkDataObject;
class vtkInformationVector;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// Throws Failure for an image or a structured grid, also as a block, whose extent ends before it
// begins, or is longer than VTK's numbers of points: VTK counts points and cells from it that are
// not there.
void requireExtents(vtkAlgorithm* filter, vtkInformationVector** inputVector);
// Of one input, which messages call by its name.
void requireExtents(vtkDataObject* data, const std::string& name);

std::string textOfExtent(const int* extent);
// Whether an extent is none of these; that of nothing is none.
bool isReadable(const int* extent);

} // namespace RectifiedTransport

#endif
