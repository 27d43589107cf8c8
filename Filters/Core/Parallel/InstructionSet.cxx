// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Parallel/InstructionSet.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace RectifiedTransport
{

namespace
{

// The widest set, or a narrower one that the environment asks for, for tests and measurements. All
// sets compute the same bits.
InstructionSet chooseInstructionSet()
{
  const InstructionSet widest = widestInstructionSet();
  const char* wanted = std::getenv("RECTIFIEDTRANSPORT_ISA");
  for (const InstructionSet set : { InstructionSet::SSE2, InstructionSet::AVX2 })
  {
    if (wanted && std::strcmp(wanted, nameOf(set)) == 0)
    {
      return std::min(set, widest);
    }
  }
  return widest;
}

} // namespace

const char* nameOf(InstructionSet set)
{
  const char* const names[] = { "SSE2", "AVX2", "AVX512" };
  return names[static_cast<int>(set)];
}

// AVX512 needs F for the vectors, DQ for conversions of 64-bit integers, and VL for shorter
// vectors. Machines that are not x86 compile the SSE2 set's source for their own vectors.
InstructionSet widestInstructionSet()
{
#ifdef RECTIFIEDTRANSPORT_X86
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2"))
  {
    const bool wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl");
    return wide ? InstructionSet::AVX512 : InstructionSet::AVX2;
  }
#endif
  return InstructionSet::SSE2;
}

// Chosen once, at the first use.
InstructionSet instructionSet()
{
  static const InstructionSet chosen = chooseInstructionSet();
  return chosen;
}

} // namespace RectifiedTransport
