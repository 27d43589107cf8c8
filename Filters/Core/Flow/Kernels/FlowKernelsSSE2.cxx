// SPDX-License-Identifier: BSD-3-Clause
// The kernels for SSE2; the flags are in CMakeLists.txt.
#define RECTIFIEDTRANSPORT_SET InstructionSet::SSE2
#include "Core/Flow/Kernels/FlowKernels.txx"
