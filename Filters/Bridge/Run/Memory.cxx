// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/Memory.h"

#include "Bridge/Run/Failure.h"
#include "Core/Flow/NoMemoryForFlowMap.h"

#include <sstream>

namespace RectifiedTransport::Bridge
{

std::string describeLack(const std::string& purpose, double bytes)
{
  const char* const units[] = { "bytes", "kB", "MB", "GB", "TB", "PB" };
  int unit = 0;
  for (; bytes >= 1000.0 && unit < 5; ++unit)
  {
    bytes /= 1000.0;
  }
  std::ostringstream message;
  message.precision(3);
  message << "Not enough memory for " << purpose << ": " << bytes << " " << units[unit]
          << " were asked for";
  return message.str();
}

void failOutOfMemory(const std::string& purpose, double bytes)
{
  throw Failure(describeLack(purpose, bytes));
}

void failOutOfMemory(const std::bad_alloc& caught, const std::string& purpose, double bytes)
{
  if (dynamic_cast<const NoMemoryForFlowMap*>(&caught))
  {
    throw; // what the handler has caught
  }
  failOutOfMemory(purpose, bytes);
}

void requireMemory(const std::string& purpose, double bytes)
{
  void* memory = nullptr;
  if (bytes < static_cast<double>(std::numeric_limits<std::size_t>::max()))
  {
    // Volatile, or the compiler leaves out the pair of calls.
    void* (*volatile allocate)(std::size_t) = std::malloc;
    memory = allocate(static_cast<std::size_t>(bytes) + 1);
  }
  if (!memory)
  {
    failOutOfMemory(purpose, bytes);
  }
  std::free(memory);
}

} // namespace RectifiedTransport::Bridge
