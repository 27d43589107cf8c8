// SPDX-License-Identifier: BSD-3-Clause
// A hash that tells ranks whether they have the same data.
#ifndef RectifiedTransport_SampledFingerprint_h
#define RectifiedTransport_SampledFingerprint_h

#include "Bridge/VTKCompatibility.h"

#include <cstdint>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataObject;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// Hashes the numbers of points and cells, the bounds, and samples of the coordinates and array
// values of data sets and of the leaves of composites; 0 if none has points.
std::uint64_t sampledFingerprint(const std::vector<vtkDataObject*>& data);

} // namespace RectifiedTransport::Bridge

#endif
