// SPDX-License-Identifier: BSD-3-Clause
// The core's executor on vtkSMPTools, and the choice of executor by the property Threading.
#ifndef RectifiedTransport_SMPExecutor_h
#define RectifiedTransport_SMPExecutor_h

#include "Core/Parallel/Executor.h"

#include <functional>
#include <memory>

namespace RectifiedTransport::Bridge
{

// Serial in a child that fork() made.
class SMPExecutor final : public Executor
{
public:
  void For(std::int64_t count, std::int64_t grain, RangeKernel kernel) const override;
  int Concurrency() const override;
};

// The values are those of vtkCollectiveAlgorithm::ThreadingType.
enum class Threading
{
  Auto, // OpenMP if VTK's backend is Sequential, else VTK
  VTK,
  OpenMP,
  Serial
};

const char* threadingText(int threading);

std::unique_ptr<Executor> makeExecutor(Threading threading);
// Throws Failure for a value out of range.
std::unique_ptr<Executor> makeExecutor(int threading);

// Calls a function. In a child that fork() made, what it calls of VTK's own classes runs serially
// meanwhile: backends keep threads, too.
void withThreadsOfThisProcess(const std::function<void()>& function);

} // namespace RectifiedTransport::Bridge

#endif
