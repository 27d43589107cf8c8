// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/SameOnRanks.h"

#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Run/SampledFingerprint.h"
#include "Core/Messages/Failure.h"
#include "Core/Parallel/RankExchange.h"

#include "vtkIndent.h"
#include "vtkObject.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <sstream>
#include <vector>

namespace RectifiedTransport::Bridge
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
    if (isOurs && name != "TableBuildTime" && name != "NumberOfSolutions")
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

// A layer of points has no cells in an image that has some along its axis: with those next to it.
Extent withCells(const Extent& extent, const Extent& whole)
{
  Extent grown = extent;
  for (std::size_t low = 0; low < grown.size() && !isEmpty(extent); low += 2)
  {
    if (extent[low] == extent[low + 1] && whole[low] < whole[low + 1])
    {
      grown[low] -= extent[low + 1] == whole[low + 1] ? 1 : 0;
      grown[low + 1] = grown[low] + 1;
    }
  }
  return grown;
}

} // namespace

std::string requireSameOnRanks(
  const Ranks& ranks, const std::string& own, const std::string& what, const std::string& rule)
{
  const std::vector<Bytes> all = ranks.Gather(Bytes(own.begin(), own.end()));
  std::string common;
  std::size_t first = 0;
  for (std::size_t rank = 0; rank < all.size(); ++rank)
  {
    const std::string there(all[rank].begin(), all[rank].end());
    first = common.empty() ? rank : first;
    common = common.empty() ? there : common;
    if (!there.empty() && there != common)
    {
      throw Failure(what + common + " on rank " + std::to_string(first) + ", but " + there +
        " on rank " + std::to_string(rank) + "; " + rule);
    }
  }
  return common;
}

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

bool areSameOnRanks(vtkDataObject* data, const Ranks& ranks)
{
  const std::vector<std::uint64_t> all = gatherValues(ranks, sampledFingerprint({ data }));
  return std::all_of(
    all.begin(), all.end(), [&all](std::uint64_t there) { return there == all.front(); });
}

Extent extentToGive(const Extent& whole, vtkInformation* output, const Ranks& ranks)
{
  if (!ranks.AreSeveral())
  {
    return whole;
  }
  const bool isKnown = announcedGrid(output, true).Extent() == whole;
  if (onAllRanks(ranks, isKnown))
  {
    return withCells(requestedExtent(output), whole);
  }
  return dividedExtent(whole, ranks.Count())[static_cast<std::size_t>(ranks.Own())];
}

} // namespace RectifiedTransport::Bridge
