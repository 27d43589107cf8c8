// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Cartogram/RegionSets.h"

#include <algorithm>
#include <limits>
#include <new>

namespace RectifiedTransport
{

// A set is stored as a linked list: a smaller set and its largest region. Toggling a region unwinds
// the list down to it and adds the larger regions again.
std::int32_t RegionSets::FindToggled(std::int32_t set, std::int32_t region)
{
  // Both numbers in one key.
  const std::int64_t key = static_cast<std::int64_t>(set) << 32 | region;
  const auto found = this->Found.find(key);
  if (found != this->Found.end())
  {
    return found->second;
  }
  std::int32_t toggled = set;
  // A region larger than all of the set is simply appended.
  if (this->PairOf(set).Region < region)
  {
    toggled = this->End();
    if (toggled == std::numeric_limits<std::int32_t>::max())
    {
      throw std::bad_alloc();
    }
    this->Pairs.push_back({ set, region });
  }
  else
  {
    std::vector<std::int32_t> above;
    while (toggled != Empty && this->PairOf(toggled).Region >= region)
    {
      above.push_back(this->PairOf(toggled).Region);
      toggled = this->PairOf(toggled).Set;
    }
    // The region is removed if the set has it, and added otherwise.
    if (above.back() == region)
    {
      above.pop_back();
    }
    else
    {
      above.push_back(region);
    }
    for (; !above.empty(); above.pop_back())
    {
      toggled = this->Toggled(toggled, above.back());
    }
  }
  this->Found.insert({ key, toggled });
  return toggled;
}

// Sets become ranges of members; the linked lists and the cache are released.
std::vector<std::int32_t> RegionSets::Keep(const std::vector<unsigned char>& isUsed)
{
  const std::int32_t end = this->End();
  std::vector<std::int32_t> numbers(static_cast<std::size_t>(end), -1);
  for (std::int32_t region = 0; region < this->Regions; ++region)
  {
    numbers[static_cast<std::size_t>(region)] = region;
  }
  std::int32_t kept = this->Regions;
  for (std::int32_t set = this->Regions; set < end; ++set)
  {
    if (isUsed[static_cast<std::size_t>(set)] == 0)
    {
      continue;
    }
    numbers[static_cast<std::size_t>(set)] = kept++;
    // The links of a set lead from its largest region down to its smallest one.
    std::int32_t part = set;
    while (part >= this->Regions)
    {
      const Pair pair = this->PairOf(part);
      this->Members.push_back(pair.Region);
      part = pair.Set;
    }
    this->Members.push_back(part);
    std::reverse(this->Members.begin() + static_cast<std::ptrdiff_t>(this->Begins.back()),
      this->Members.end());
    this->Begins.push_back(this->Members.size());
  }
  this->Pairs = {};
  this->Found = {};
  return numbers;
}

} // namespace RectifiedTransport
