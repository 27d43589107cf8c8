// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Parallel/MemoryPlan.h"

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <sstream>

namespace RectifiedTransport
{

std::string MemoryPlan::DescribeLack() const
{
  return "Not enough memory for " + this->Purpose + ": " + this->Amount() + " were asked for";
}

std::string MemoryPlan::Amount() const
{
  const char* const units[] = { "bytes", "kB", "MB", "GB", "TB", "PB" };
  double bytes = this->Bytes;
  int unit = 0;
  for (; bytes >= 1000.0 && unit < 5; ++unit)
  {
    bytes /= 1000.0;
  }
  std::ostringstream message;
  message.precision(3);
  message << bytes << " " << units[unit];
  return message.str();
}

bool MemoryPlan::Fits() const
{
  void* memory = nullptr;
  if (this->Bytes < static_cast<double>(std::numeric_limits<std::size_t>::max()))
  {
    // Volatile, or the compiler leaves out the pair of calls.
    void* (*volatile allocate)(std::size_t) = std::malloc;
    memory = allocate(static_cast<std::size_t>(this->Bytes) + 1);
  }
  std::free(memory);
  return memory != nullptr;
}

} // namespace RectifiedTransport
