// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/Memory.h"

#include "Bridge/Run/Failure.h"
#include "Core/Flow/NoMemoryForFlowMap.h"

#include <sstream>

namespace RectifiedTransport::Bridge
{

std::string describeLack(const MemoryPlan& plan)
{
  const char* const units[] = { "bytes", "kB", "MB", "GB", "TB", "PB" };
  double bytes = plan.Bytes;
  int unit = 0;
  for (; bytes >= 1000.0 && unit < 5; ++unit)
  {
    bytes /= 1000.0;
  }
  std::ostringstream message;
  message.precision(3);
  message << "Not enough memory for " << plan.Purpose << ": " << bytes << " " << units[unit]
          << " were asked for";
  return message.str();
}

void failOutOfMemory(const MemoryPlan& plan)
{
  throw Failure(describeLack(plan));
}

void failOutOfMemory(const std::bad_alloc& caught, const MemoryPlan& plan)
{
  if (dynamic_cast<const NoMemoryForFlowMap*>(&caught))
  {
    throw; // what the handler has caught
  }
  failOutOfMemory(plan);
}

void requireMemory(const MemoryPlan& plan)
{
  void* memory = nullptr;
  if (plan.Bytes < static_cast<double>(std::numeric_limits<std::size_t>::max()))
  {
    // Volatile, or the compiler leaves out the pair of calls.
    void* (*volatile allocate)(std::size_t) = std::malloc;
    memory = allocate(static_cast<std::size_t>(plan.Bytes) + 1);
  }
  if (!memory)
  {
    failOutOfMemory(plan);
  }
  std::free(memory);
}

} // namespace RectifiedTransport::Bridge
