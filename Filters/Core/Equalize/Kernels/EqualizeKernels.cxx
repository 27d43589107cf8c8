// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Equalize/Kernels/EqualizeKernels.h"

namespace RectifiedTransport
{

template <int Dimension>
EqualizeKernels<Dimension> equalizeKernels([[maybe_unused]] InstructionSet set)
{
#ifdef RECTIFIEDTRANSPORT_X86
  if (set == InstructionSet::AVX512)
  {
    return equalizeKernelsAVX512<Dimension>();
  }
  if (set == InstructionSet::AVX2)
  {
    return equalizeKernelsAVX2<Dimension>();
  }
#endif
  return equalizeKernelsSSE2<Dimension>();
}

template EqualizeKernels<2> equalizeKernels<2>(InstructionSet);
template EqualizeKernels<3> equalizeKernels<3>(InstructionSet);

} // namespace RectifiedTransport
