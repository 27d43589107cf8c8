// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/SurfaceRelaxation/Kernels/DotKernels.h"

namespace RectifiedTransport
{

SumDots dotKernel(InstructionSet set)
{
  return chooseKernels(set, [](auto chosen) -> SumDots { return &sumDots<chosen>; });
}

} // namespace RectifiedTransport
