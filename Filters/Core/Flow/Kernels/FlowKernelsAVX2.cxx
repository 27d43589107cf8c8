// SPDX-License-Identifier: BSD-3-Clause
// The kernels for AVX2; the flags are in CMakeLists.txt.
#define RECTIFIEDTRANSPORT_SET InstructionSet::AVX2
#include "Core/Flow/Kernels/FlowKernels.txx"
