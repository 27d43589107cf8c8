// SPDX-License-Identifier: BSD-3-Clause
// The splat's kernels for SSE2; the flags are in CMakeLists.txt.
#define RECTIFIEDTRANSPORT_KERNELS splatKernelsSSE2
#include "Core/Splat/Kernels/SplatKernels.txx"
