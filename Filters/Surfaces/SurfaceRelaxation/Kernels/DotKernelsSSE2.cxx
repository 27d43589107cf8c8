// SPDX-License-Identifier: BSD-3-Clause
// The kernel of the dots' repulsion for SSE2; the flags are in CMakeLists.txt.
#define RECTIFIEDTRANSPORT_SET InstructionSet::SSE2
#include "Surfaces/SurfaceRelaxation/Kernels/DotKernels.txx"
