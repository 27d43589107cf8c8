// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Tables/Kernels/TableKernels.h"

namespace RectifiedTransport
{

const TableKernels& tableKernels([[maybe_unused]] InstructionSet set)
{
#ifdef RECTIFIEDTRANSPORT_X86
  if (set == InstructionSet::AVX512)
  {
    return tableKernelsAVX512();
  }
  if (set == InstructionSet::AVX2)
  {
    return tableKernelsAVX2();
  }
#endif
  return tableKernelsSSE2();
}

} // namespace RectifiedTransport
