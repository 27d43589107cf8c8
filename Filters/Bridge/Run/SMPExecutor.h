// SPDX-License-Identifier: BSD-3-Clause
// Runs the core's range kernels on vtkSMPTools, and chooses who runs them.
#ifndef RectifiedTransport_SMPExecutor_h
#define RectifiedTransport_SMPExecutor_h

#include "Core/Parallel/Executor.h"

#include <memory>

namespace RectifiedTransport
{

class SMPExecutor final : public Executor
{
public:
  void For(std::int64_t count, std::int64_t grain, RangeKernel kernel) const override;
  int Concurrency() const override;
};

enum class Threading
{
  Auto, // OpenMP where VTK's backend is Sequential, else VTK
  VTK,
  OpenMP,
  Serial
};

std::unique_ptr<Executor> makeExecutor(Threading threading);

} // namespace RectifiedTransport

#endif
