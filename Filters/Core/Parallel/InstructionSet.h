// SPDX-License-Identifier: BSD-3-Clause
// The instruction sets that kernels are compiled for, and the choice among them at run time.
#ifndef RectifiedTransport_InstructionSet_h
#define RectifiedTransport_InstructionSet_h

#include <type_traits>

namespace RectifiedTransport
{

// Each includes those before it. SSE2 stands for the baseline of the processor family.
enum class InstructionSet
{
  SSE2,
  AVX2,
  AVX512
};

const char* nameOf(InstructionSet set);

// The widest that this processor supports.
InstructionSet widestInstructionSet();

// The widest, or the narrower one that the environment variable RECTIFIEDTRANSPORT_ISA (SSE2, AVX2
// or AVX512) names. It is read once. All kernels compute the same bits.
InstructionSet instructionSet();

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
