// SPDX-License-Identifier: BSD-3-Clause
// The kernel of the dots' repulsion for AVX512; the flags are in CMakeLists.txt.
#define RECTIFIEDTRANSPORT_SET InstructionSet::AVX512
#include "Surfaces/SurfaceRelaxation/Kernels/DotKernels.txx"
