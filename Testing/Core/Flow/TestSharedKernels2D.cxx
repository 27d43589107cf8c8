// SPDX-License-Identifier: BSD-3-Clause
#define RT_D 2
#define RT_SUITE SharedKernels2D
#include "SharedKernels.txx"
