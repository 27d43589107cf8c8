// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Equalize/Kernels/EqualizeKernels.h"

namespace RectifiedTransport
{

template <int Dimension>
EqualizeKernels<Dimension> equalizeKernels(InstructionSet set)
{
  return chooseKernels(set, [](auto chosen) { return equalizeKernelsOf<Dimension, chosen>(); });
}

template EqualizeKernels<2> equalizeKernels<2>(InstructionSet);
template EqualizeKernels<3> equalizeKernels<3>(InstructionSet);

} // namespace RectifiedTransport
