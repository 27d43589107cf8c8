// SPDX-License-Identifier: BSD-3-Clause
// The kernels of FaceSystem for SSE2; the flags are in CMakeLists.txt.
#define RECTIFIEDTRANSPORT_SET InstructionSet::SSE2
#include "Core/Grid/Kernels/FaceKernels.txx"
