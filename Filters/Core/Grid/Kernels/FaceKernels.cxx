// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Grid/Kernels/FaceKernels.h"

namespace RectifiedTransport
{

template <int Dimension>
FaceKernels<Dimension> faceKernels(InstructionSet set)
{
  return chooseKernels(set, [](auto chosen) { return faceKernelsOf<Dimension, chosen>(); });
}

template FaceKernels<2> faceKernels<2>(InstructionSet);
template FaceKernels<3> faceKernels<3>(InstructionSet);

} // namespace RectifiedTransport
