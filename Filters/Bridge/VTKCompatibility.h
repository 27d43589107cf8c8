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

// Later the faces of polyhedra are cell arrays.
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 4, 0)
#define RECTIFIEDTRANSPORT_VTK_HAS_FACE_STREAMS
#endif

// Later the blocks of an AMR may be any Cartesian grids, types of cells any array, and what names
// them before is deprecated.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
#define RECTIFIEDTRANSPORT_VTK_HAS_AMR_OF_CARTESIAN_GRIDS
#define RECTIFIEDTRANSPORT_VTK_HAS_CELL_TYPES_OF_ANY_ARRAY
#endif

// For tests: later an assertion of VTK's own ends the process where an image's extent is set to
// what no image can have.
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 3, 20240617)
#define RECTIFIEDTRANSPORT_VTK_HAS_IMAGES_OF_ANY_EXTENT
#endif

#endif
