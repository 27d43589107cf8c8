// SPDX-License-Identifier: BSD-3-Clause
// The instruction sets that kernels are compiled for.
#ifndef RectifiedTransport_InstructionSet_h
#define RectifiedTransport_InstructionSet_h

namespace RectifiedTransport
{

// Each has all that those before it have. SSE2 stands for what any processor of the family runs.
enum class InstructionSet
{
  SSE2,
  AVX2,
  AVX512
};

const char* nameOf(InstructionSet set);

// The widest that this processor runs.
InstructionSet widestInstructionSet();

// The one to take: that, unless the environment variable RECTIFIEDTRANSPORT_ISA (SSE2, AVX2 or
// AVX512) asks for a narrower one. It is read once. All kernels compute the same bits.
InstructionSet instructionSet();

} // namespace RectifiedTransport

#endif
