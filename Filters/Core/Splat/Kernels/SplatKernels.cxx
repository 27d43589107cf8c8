// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Splat/Kernels/SplatKernels.h"

namespace RectifiedTransport
{

template <int Dimension, class Real>
SplatKernels<Dimension, Real> splatKernels(SplatKernel kernel, [[maybe_unused]] InstructionSet set)
{
#ifdef RECTIFIEDTRANSPORT_X86
  if (set >= InstructionSet::AVX2)
  {
    return splatKernelsAVX2<Dimension, Real>(kernel);
  }
#endif
  return splatKernelsSSE2<Dimension, Real>(kernel);
}

template SplatKernels<1, float> splatKernels<1, float>(SplatKernel, InstructionSet);
template SplatKernels<2, float> splatKernels<2, float>(SplatKernel, InstructionSet);
template SplatKernels<3, float> splatKernels<3, float>(SplatKernel, InstructionSet);
template SplatKernels<1, double> splatKernels<1, double>(SplatKernel, InstructionSet);
template SplatKernels<2, double> splatKernels<2, double>(SplatKernel, InstructionSet);
template SplatKernels<3, double> splatKernels<3, double>(SplatKernel, InstructionSet);

} // namespace RectifiedTransport
