// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Parallel/Context.h"

#include "Core/Parallel/Ranks.h"

#include <utility>

namespace RectifiedTransport
{

namespace
{

// All threads of OpenMP, as the host program has set them.
const Executor& defaultExecutor()
{
  static const OpenMPExecutor executor;
  return executor;
}

} // namespace

Context::Context()
  : Context(defaultExecutor())
{
}

// Without further settings there is one rank.
Context::Context(
  const Executor& threads, std::function<void(double)> report, std::function<bool()> isCancelled)
  : Threads(&threads)
  , Group(&SoloRanks::Get())
  , Report(std::move(report))
  , IsCancelled(std::move(isCancelled))
{
}

} // namespace RectifiedTransport
