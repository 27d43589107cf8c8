// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/Distributed/PropertyDifference.h"

#include <algorithm>
#include <cstddef>
#include <sstream>

namespace RectifiedTransport
{

namespace
{

// The lines "Name: value" of the project's own properties. VTK prints those before Threading, and
// they have addresses; times and counts may differ between ranks.
std::vector<std::string> linesOf(const std::string& text)
{
  std::vector<std::string> lines;
  std::istringstream is(text);
  bool isOurs = false;
  for (std::string line; std::getline(is, line);)
  {
    line.erase(0, line.find_first_not_of(' '));
    const std::string name = line.substr(0, line.find(':'));
    if (isOurs && name != "TableBuildTime" && name != "NumberOfSolutions")
    {
      lines.push_back(line);
    }
    isOurs = isOurs || name == "Threading";
  }
  return lines;
}

// What follows "Name: " in a line.
std::string valueOf(const std::string& line)
{
  const std::size_t colon = line.find(": ");
  return colon == std::string::npos ? "" : line.substr(colon + 2);
}

} // namespace

// Empty texts are those of ranks without data; they agree with any other.
std::string differenceOfTexts(const std::vector<std::string>& all, std::string& common)
{
  std::size_t first = 0;
  for (std::size_t rank = 0; rank < all.size(); ++rank)
  {
    first = common.empty() ? rank : first;
    common = common.empty() ? all[rank] : common;
    if (!all[rank].empty() && all[rank] != common)
    {
      return common + " on rank " + std::to_string(first) + ", but " + all[rank] + " on rank " +
        std::to_string(rank);
    }
  }
  return {};
}

// Each rank is compared with rank 0, line by line; the first difference is enough.
std::string differenceOfProperties(const std::vector<std::string>& all)
{
  const std::vector<std::string> first = linesOf(all.front());
  for (std::size_t rank = 1; rank < all.size(); ++rank)
  {
    const std::vector<std::string> other = linesOf(all[rank]);
    for (std::size_t i = 0; i < std::min(first.size(), other.size()); ++i)
    {
      if (first[i] != other[i])
      {
        return "The property " + first[i].substr(0, first[i].find(':')) + " is " +
          valueOf(first[i]) + " on rank 0, but " + valueOf(other[i]) + " on rank " +
          std::to_string(rank) + "; it must be the same on all";
      }
    }
  }
  return {};
}

} // namespace RectifiedTransport
