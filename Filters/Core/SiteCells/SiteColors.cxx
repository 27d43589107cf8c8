// SPDX-License-Identifier: BSD-3-Clause
#include "Core/SiteCells/SiteColors.h"

#include "Core/Parallel/Progress.h"
#include "Core/SiteCells/PixelRows.h"

#include <algorithm>
#include <limits>

namespace RectifiedTransport
{

namespace
{

// The neighbours of lower ids of each site.
using Neighbours = std::vector<std::vector<std::int64_t>>;

void join(std::int64_t one, std::int64_t other, Neighbours& neighbours)
{
  // Each pair is stored once, at the site with the higher id; -1 is no site.
  const auto [low, high] = std::minmax(one, other);
  if (low < 0)
  {
    return;
  }
  auto& known = neighbours[static_cast<std::size_t>(high)];
  // The last pair was often the same, so the search begins at the end.
  if (std::find(known.rbegin(), known.rend(), low) == known.rend())
  {
    known.push_back(low);
  }
}

// Greedy colouring in the order of the ids: the smallest number that no neighbour of a lower id
// has.
std::vector<std::uint8_t> colourInOrder(const Neighbours& neighbours)
{
  constexpr std::size_t most = std::numeric_limits<std::uint8_t>::max();
  std::vector<std::uint8_t> colours(neighbours.size());
  std::vector<std::size_t> usedBy(most, neighbours.size()); // the last site with such a neighbour
  for (std::size_t site = 0; site < colours.size(); ++site)
  {
    for (std::int64_t neighbour : neighbours[site])
    {
      const std::size_t colour = colours[static_cast<std::size_t>(neighbour)];
      if (colour < most)
      {
        usedBy[colour] = site;
      }
    }
    // The first colour that no neighbour of a lower id uses.
    const auto free =
      std::find_if(usedBy.begin(), usedBy.end(), [site](std::size_t last) { return last != site; });
    colours[site] = static_cast<std::uint8_t>(free - usedBy.begin());
  }
  return colours;
}

} // namespace

template <int Dimension>
std::vector<std::uint8_t> colourSiteCells(const GridSize<Dimension>& size,
  const std::int64_t* labels, std::int64_t sites, const Context& context)
{
  Progress progress(context);
  const PixelRows<Dimension> rows(size);
  Neighbours neighbours(static_cast<std::size_t>(sites));
  constexpr std::int64_t pixels = std::int64_t{ 1 } << 20;
  progress.ForEachInOrder(
    rows.Count, 1,
    [&](std::int64_t row) {
      rows.VisitFaces(row, labels, [&](std::int64_t pixel, std::int64_t other) {
        join(labels[pixel], labels[other], neighbours);
      });
    },
    std::max<std::int64_t>(1, pixels / size[0]));
  return colourInOrder(neighbours);
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(colourSiteCells);

} // namespace RectifiedTransport
