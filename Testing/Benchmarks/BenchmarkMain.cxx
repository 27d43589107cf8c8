// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Parallel/InstructionSet.h"
#include "FreshMemory.h"

#include <benchmark/benchmark.h>

int main(int argc, char** argv)
{
  RectifiedTransport::useFreshMemory();
  benchmark::AddCustomContext(
    "instruction_set", RectifiedTransport::nameOf(RectifiedTransport::instructionSet()));
#ifdef __VERSION__
  benchmark::AddCustomContext("compiler", __VERSION__);
#endif
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
  {
    return 1;
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
