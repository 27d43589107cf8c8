// SPDX-License-Identifier: BSD-3-Clause
// Nodes in memory that may be new. The system clears new memory page by page at the first write. If
// several threads write to the same new huge page at once, each clears a page, and all except one
// are thrown away. Hence one thread touches every page before several write to it.
#ifndef RectifiedTransport_NewNodes_h
#define RectifiedTransport_NewNodes_h

#include "Core/Parallel/Executor.h"

#include <cstdint>

namespace RectifiedTransport
{

class NewNodes
{
public:
  // Begins at a node; nodes are in the order of their addresses.
  explicit NewNodes(double* nodes)
    : Next(nodes)
  {
  }

  // The number of pages to touch that begin in the nodes up to an end; 0 for one thread.
  std::int64_t PagesUpTo(const double* end, const Executor& threads) const
  {
    return threads.Concurrency() > 1 ? pageFrom(end) - pageFrom(this->Next) : 0;
  }
  // Writes to one of these pages. Call it before anything else is written to these nodes.
  void Touch(std::int64_t page) const
  {
    const std::int64_t address = (pageFrom(this->Next) + page) * pageBytes;
    this->Next[(address - addressOf(this->Next)) / doubleBytes] = 0.0;
  }
  // Continues with the nodes from there on.
  void Pass(double* end) { this->Next = end; }

private:
  static constexpr std::int64_t pageBytes = std::int64_t{ 1 } << 21;
  static constexpr auto doubleBytes = static_cast<std::int64_t>(sizeof(double));

  static std::int64_t addressOf(const double* node)
  {
    return static_cast<std::int64_t>(reinterpret_cast<std::uintptr_t>(node));
  }
  // The number of the first page that begins at a node or after it.
  static std::int64_t pageFrom(const double* node)
  {
    return (addressOf(node) + pageBytes - 1) / pageBytes;
  }

  double* Next;
};

} // namespace RectifiedTransport

#endif
