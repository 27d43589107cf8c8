// SPDX-License-Identifier: BSD-3-Clause
// All version guards: the differences among the supported versions of VTK.
#ifndef RectifiedTransport_VTKCompatibility_h
#define RectifiedTransport_VTKCompatibility_h

#include "vtkVersionMacros.h"

// VTK's ABI namespace and vtkAlgorithm::CheckAbort appeared on one date between 9.2.0 and 9.3.0.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220823)
#include "vtkABINamespace.h"
#define RECTIFIEDTRANSPORT_VTK_HAS_CHECK_ABORT
// For tests: vtkGradientFilter of 9.1 uses other differences for cell data of 1D and 2D images.
#define RECTIFIEDTRANSPORT_VTK_HAS_FLAT_GRADIENTS
#else
#define VTK_ABI_NAMESPACE_BEGIN
#define VTK_ABI_NAMESPACE_END
#endif

// From this version on (of ParaView 5.13), the faces of polyhedra are cell arrays.
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 3, 20240617)
#define RECTIFIEDTRANSPORT_VTK_HAS_FACE_STREAMS
#endif

// From this version on, the blocks of an AMR may be any Cartesian grids, cell types may be any
// array, and the earlier names are deprecated.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
#define RECTIFIEDTRANSPORT_VTK_HAS_AMR_OF_CARTESIAN_GRIDS
#define RECTIFIEDTRANSPORT_VTK_HAS_CELL_TYPES_OF_ANY_ARRAY
#endif

// For tests: from this version on, an assertion of VTK ends the process if an image gets an
// impossible extent.
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 3, 20240617)
#define RECTIFIEDTRANSPORT_VTK_HAS_IMAGES_OF_ANY_EXTENT
#endif

#endif
