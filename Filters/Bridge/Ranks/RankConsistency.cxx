// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/RankConsistency.h"

#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Run/Fingerprint.h"
#include "Core/Geometry/Distributed/PropertyDifference.h"
#include "Core/Messages/Failure.h"
#include "Core/Parallel/RankExchange.h"

#include "vtkExtentTranslator.h"
#include "vtkIndent.h"
#include "vtkNew.h"
#include "vtkObject.h"

#include <algorithm>
#include <limits>
#include <sstream>

namespace RectifiedTransport::Bridge
{

std::string requireSameOnRanks(
  const Ranks& ranks, const std::string& own, const std::string& what, const std::string& rule)
{
  std::string common;
  const std::string difference = differenceOfTexts(gatherTexts(ranks, own), common);
  if (!difference.empty())
  {
    throw Failure(what + difference + "; " + rule);
  }
  return common;
}

void requireSameProperties(vtkObject* filter, const Ranks& ranks)
{
  std::ostringstream printed;
  printed.precision(std::numeric_limits<double>::max_digits10);
  filter->PrintSelf(printed, vtkIndent());
  const std::string difference = differenceOfProperties(gatherTexts(ranks, printed.str()));
  if (!difference.empty())
  {
    throw Failure(difference);
  }
}

bool areSameOnRanks(vtkDataObject* data, const Ranks& ranks)
{
  const std::vector<std::uint64_t> all = gatherValues(ranks, sampledFingerprint({ data }));
  return std::all_of(
    all.begin(), all.end(), [&all](std::uint64_t there) { return there == all.front(); });
}

std::vector<Extent> dividedExtent(const Extent& whole, int ranks)
{
  std::vector<Extent> extents(static_cast<std::size_t>(ranks));
  vtkNew<vtkExtentTranslator> translator;
  for (int rank = 0; rank < ranks; ++rank)
  {
    Extent given = whole;
    translator->PieceToExtentThreadSafe(rank, ranks, 0, given.data(),
      extents[static_cast<std::size_t>(rank)].data(), vtkExtentTranslator::BLOCK_MODE, 0);
  }
  return extents;
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
