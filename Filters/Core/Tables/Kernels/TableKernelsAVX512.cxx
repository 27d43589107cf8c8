// SPDX-License-Identifier: BSD-3-Clause
// The kernels for AVX512; the flags are in CMakeLists.txt.
#define RECTIFIEDTRANSPORT_SET InstructionSet::AVX512
#include "Core/Tables/Kernels/TableKernels.txx"
