// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/SameProperties.h"

#include "Bridge/Run/Failure.h"

#include "vtkIndent.h"
#include "vtkObject.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// A line each: "Name: value". Those before are VTK's, of objects in memory.
std::vector<std::string> linesOf(const std::string& text)
{
  std::vector<std::string> lines;
  std::istringstream is(text);
  bool isOurs = false;
  for (std::string line; std::getline(is, line);)
  {
    line.erase(0, line.find_first_not_of(' '));
    const std::string name = line.substr(0, line.find(':'));
    if (isOurs && name != "TableBuildTime")
    {
      lines.push_back(line);
    }
    isOurs = isOurs || name == "Threading";
  }
  return lines;
}

std::string valueOf(const std::string& line)
{
  const std::size_t colon = line.find(": ");
  return colon == std::string::npos ? "" : line.substr(colon + 2);
}

} // namespace

void requireSameProperties(vtkObject* filter, const Ranks& ranks)
{
  std::ostringstream printed;
  printed.precision(std::numeric_limits<double>::max_digits10);
  filter->PrintSelf(printed, vtkIndent());
  const std::string own = printed.str();
  const std::vector<Bytes> all = ranks.Gather(Bytes(own.begin(), own.end()));
  const std::vector<std::string> first =
    linesOf(std::string(all.front().begin(), all.front().end()));
  for (std::size_t rank = 1; rank < all.size(); ++rank)
  {
    const std::vector<std::string> other = linesOf(std::string(all[rank].begin(), all[rank].end()));
    const std::size_t count = std::min(first.size(), other.size());
    for (std::size_t i = 0; i < count; ++i)
    {
      if (first[i] != other[i])
      {
        throw Failure("The property " + first[i].substr(0, first[i].find(':')) + " is " +
          valueOf(first[i]) + " on rank 0, but " + valueOf(other[i]) + " on rank " +
          std::to_string(rank) + "; it must be the same on all");
      }
    }
  }
}

} // namespace RectifiedTransport
