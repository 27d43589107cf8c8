// SPDX-License-Identifier: BSD-3-Clause
// Arrays that have the name of the ghost flags, but not their type.
#ifndef RectifiedTransport_GhostArrayType_h
#define RectifiedTransport_GhostArrayType_h

#include "Bridge/VTKCompatibility.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithm;
class vtkInformationVector;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// A warning of the filter for the first such array of its inputs. VTK does not take them for flags,
// so that they hide no points and cells.
void warnOfGhostArrayType(vtkAlgorithm* filter, vtkInformationVector** inputVector);

} // namespace RectifiedTransport::Bridge

#endif
