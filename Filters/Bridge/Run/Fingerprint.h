// SPDX-License-Identifier: BSD-3-Clause
// Hashes of arrays and data objects.
#ifndef RectifiedTransport_Fingerprint_h
#define RectifiedTransport_Fingerprint_h

#include "Bridge/VTKCompatibility.h"

#include <cstdint>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
class vtkDataObject;
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

// Hashes the numbers of points and cells, the bounds, and samples of the coordinates and array
// values of data sets and of the leaves of composites; 0 if none has points.
std::uint64_t sampledFingerprint(const std::vector<vtkDataObject*>& data);

} // namespace RectifiedTransport::Bridge

#endif
