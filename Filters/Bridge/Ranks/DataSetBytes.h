// SPDX-License-Identifier: BSD-3-Clause
// Data sets as bytes.
#ifndef RectifiedTransport_DataSetBytes_h
#define RectifiedTransport_DataSetBytes_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Ranks.h"

#include "vtkSmartPointer.h"

#include <cstddef>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// With all arrays in their order, the active attributes and ghost arrays. Throws Failure for
// a type of data set that VTK cannot send.
Bytes bytesOfDataSet(vtkDataSet* data);
// Images come as vtkImageData.
vtkSmartPointer<vtkDataSet> dataSetOfBytes(const char* bytes, std::size_t count);

} // namespace RectifiedTransport::Bridge

#endif
