// SPDX-License-Identifier: BSD-3-Clause
#include "Core/SurfaceRelaxation/Kernels/DotKernels.h"

namespace RectifiedTransport
{

SumDots dotKernel([[maybe_unused]] InstructionSet set)
{
#ifdef RECTIFIEDTRANSPORT_X86
  if (set == InstructionSet::AVX512)
  {
    return &sumDotsAVX512;
  }
  if (set == InstructionSet::AVX2)
  {
    return &sumDotsAVX2;
  }
#endif
  return &sumDotsSSE2;
}

} // namespace RectifiedTransport
