// SPDX-License-Identifier: BSD-3-Clause
// The kernel of the dots' repulsion for AVX2; the flags are in CMakeLists.txt.
#define RECTIFIEDTRANSPORT_SET InstructionSet::AVX2
#include "Surfaces/SurfaceRelaxation/Kernels/DotKernels.txx"
