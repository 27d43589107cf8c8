// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Relaxation/Kernels/RepulsionKernels.h"

namespace RectifiedTransport
{

template <int Dimension>
RepulsionKernels<Dimension> repulsionKernels(InstructionSet set)
{
  return chooseKernels(set, [](auto chosen) { return repulsionKernelsOf<Dimension, chosen>(); });
}

template RepulsionKernels<2> repulsionKernels<2>(InstructionSet);
template RepulsionKernels<3> repulsionKernels<3>(InstructionSet);

} // namespace RectifiedTransport
