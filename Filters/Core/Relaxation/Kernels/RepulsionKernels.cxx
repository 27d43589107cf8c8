// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Relaxation/Kernels/RepulsionKernels.h"

namespace RectifiedTransport
{

template <int Dimension>
RepulsionKernels<Dimension> repulsionKernels([[maybe_unused]] InstructionSet set)
{
#ifdef RECTIFIEDTRANSPORT_X86
  if (set == InstructionSet::AVX512)
  {
    return repulsionKernelsAVX512<Dimension>();
  }
  if (set == InstructionSet::AVX2)
  {
    return repulsionKernelsAVX2<Dimension>();
  }
#endif
  return repulsionKernelsSSE2<Dimension>();
}

template RepulsionKernels<2> repulsionKernels<2>(InstructionSet);
template RepulsionKernels<3> repulsionKernels<3>(InstructionSet);

} // namespace RectifiedTransport
