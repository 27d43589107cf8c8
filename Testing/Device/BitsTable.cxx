// SPDX-License-Identifier: BSD-3-Clause
#include "BitsTable.h"

namespace RectifiedTransport
{

std::string grouped(std::int64_t number)
{
  std::string text = std::to_string(number);
  for (int place = static_cast<int>(text.size()) - 3; place > 0; place -= 3)
  {
    text.insert(static_cast<std::size_t>(place), ",");
  }
  return text;
}

void BitsTable::PrintHead(const char* title)
{
  std::printf("\n%s\n  %-16s %-68s %11s %11s\n", title, "kernel", "case", "compared", "differ");
}

void BitsTable::Print(const std::string& kernel, const std::string& what, const BitsCount& count)
{
  std::printf("  %-16s %-68s %11s %11s\n", kernel.c_str(), what.c_str(), grouped(count.Of).c_str(),
    grouped(count.Differ).c_str());
  if (count.Differ > 0)
  {
    std::printf("    first: %s\n", count.First.c_str());
  }
  std::fflush(stdout);
}

void BitsTable::Add(const std::string& kernel, const std::string& what, const BitsCount& count)
{
  Print(kernel, what, count);
  this->All += count.Of;
  this->Wrong += count.Differ > 0 ? 1 : 0;
}

void BitsTable::AddFault(
  const std::string& kernel, const std::string& what, const std::string& fault)
{
  std::printf("  %-16s %-68s %23s\n    %s\n", kernel.c_str(), what.c_str(), "NOT DONE",
    fault.empty() ? "No kernel was started, and no reason was given" : fault.c_str());
  std::fflush(stdout);
  ++this->Wrong;
}

} // namespace RectifiedTransport
