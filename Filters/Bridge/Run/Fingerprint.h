// SPDX-License-Identifier: BSD-3-Clause
// A hash of arrays.
#ifndef RectifiedTransport_Fingerprint_h
#define RectifiedTransport_Fingerprint_h

#include "Bridge/VTKCompatibility.h"

#include <cstdint>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// A hash of the bits of the arrays' values; 0 if one is not contiguous in memory. Arrays may be
// null. Throws Cancelled.
std::uint64_t fingerprint(const std::vector<vtkDataArray*>& arrays, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
