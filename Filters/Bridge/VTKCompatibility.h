// SPDX-License-Identifier: BSD-3-Clause
// The one place of version guards: what differs among the VTK versions that are supported.
#ifndef RectifiedTransport_VTKCompatibility_h
#define RectifiedTransport_VTKCompatibility_h

#include "vtkVersionMacros.h"

// VTK's ABI namespace and vtkAlgorithm::CheckAbort appeared on one date between 9.2.0 and 9.3.0.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220823)
#include "vtkABINamespace.h"
#define RECTIFIEDTRANSPORT_VTK_HAS_CHECK_ABORT
// Of cell values on images of one or two dimensions, for tests: 9.1 takes other differences.
#define RECTIFIEDTRANSPORT_VTK_HAS_FLAT_GRADIENTS
#else
#define VTK_ABI_NAMESPACE_BEGIN
#define VTK_ABI_NAMESPACE_END
#endif

#endif
