// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Parallel/InstructionSet.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace RectifiedTransport
{

namespace
{

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

InstructionSet instructionSet()
{
  static const InstructionSet chosen = chooseInstructionSet();
  return chosen;
}

} // namespace RectifiedTransport
