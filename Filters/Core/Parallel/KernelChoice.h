// SPDX-License-Identifier: BSD-3-Clause
// The kernels of an instruction set, among those that were compiled for each.
#ifndef RectifiedTransport_KernelChoice_h
#define RectifiedTransport_KernelChoice_h

#include "Core/Parallel/InstructionSet.h"

#include <type_traits>

namespace RectifiedTransport
{

// kernelsOf(set), the set being a constant of the compiler. AVX2 and AVX-512 exist on x86 alone;
// elsewhere the kernels of the base instruction set carry the name SSE2.
template <class KernelsOf>
decltype(auto) chooseKernels([[maybe_unused]] InstructionSet set, const KernelsOf& kernelsOf)
{
  using Set = InstructionSet;
#ifdef RECTIFIEDTRANSPORT_X86
  if (set == Set::AVX512)
  {
    return kernelsOf(std::integral_constant<Set, Set::AVX512>());
  }
  if (set == Set::AVX2)
  {
    return kernelsOf(std::integral_constant<Set, Set::AVX2>());
  }
#endif
  return kernelsOf(std::integral_constant<Set, Set::SSE2>());
}

} // namespace RectifiedTransport

#endif
