// SPDX-License-Identifier: BSD-3-Clause
// The repulsion's kernels for AVX512; the flags are in CMakeLists.txt.
#define RECTIFIEDTRANSPORT_SET InstructionSet::AVX512
#include "Core/Relaxation/Kernels/RepulsionKernels.txx"
