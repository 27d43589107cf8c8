// SPDX-License-Identifier: BSD-3-Clause
// The splat's kernels for AVX2; the flags are in CMakeLists.txt.
#define RECTIFIEDTRANSPORT_KERNELS splatKernelsAVX2
#include "Core/Splat/Kernels/SplatKernels.txx"
