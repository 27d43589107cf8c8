// SPDX-License-Identifier: BSD-3-Clause
#define RT_D 3
#define RT_SUITE SharedKernels3D
#include "SharedKernels.txx"
