// SPDX-License-Identifier: BSD-3-Clause
// The instruction sets that kernels are compiled for, and the choice among them at run time.
#ifndef RectifiedTransport_InstructionSet_h
#define RectifiedTransport_InstructionSet_h

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

} // namespace RectifiedTransport

#endif
