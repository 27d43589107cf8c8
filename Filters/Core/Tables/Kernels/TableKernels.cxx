// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Tables/Kernels/TableKernels.h"

namespace RectifiedTransport
{

const TableKernels& tableKernels(InstructionSet set)
{
  return chooseKernels(
    set, [](auto chosen) -> const TableKernels& { return tableKernelsOf<chosen>(); });
}

} // namespace RectifiedTransport
