// SPDX-License-Identifier: BSD-3-Clause
#include "Core/SiteCells/SiteColors.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <limits>

namespace RectifiedTransport
{

namespace
{

// The neighbours of lower ids of each site.
class Neighbours
{
public:
  explicit Neighbours(std::int64_t sites)
    : Lower(static_cast<std::size_t>(sites))
  {
  }

  void Join(std::int64_t one, std::int64_t other)
  {
    const auto [low, high] = std::minmax(one, other);
    if (low < 0)
    {
      return;
    }
    auto& known = this->Lower[static_cast<std::size_t>(high)];
    // The pair before is often the same.
    if (std::find(known.rbegin(), known.rend(), low) == known.rend())
    {
      known.push_back(low);
    }
  }

  const std::vector<std::int64_t>& Of(std::size_t site) const { return this->Lower[site]; }
  std::size_t Count() const { return this->Lower.size(); }

private:
  std::vector<std::vector<std::int64_t>> Lower;
};

template <int Dimension>
void joinRow(const GridSize<Dimension>& size, const std::int64_t* labels, std::int64_t row,
  Neighbours& neighbours)
{
  const std::int64_t* first = labels + row * size[0];
  for (std::int64_t i = 0; i + 1 < size[0]; ++i)
  {
    if (first[i] != first[i + 1])
    {
      neighbours.Join(first[i], first[i + 1]);
    }
  }
  std::int64_t index = row;
  std::int64_t stride = size[0];
  for (std::size_t axis = 1; axis < Dimension; ++axis)
  {
    if (index % size[axis] + 1 < size[axis])
    {
      const std::int64_t* next = first + stride;
      for (std::int64_t i = 0; i < size[0]; ++i)
      {
        if (first[i] != next[i])
        {
          neighbours.Join(first[i], next[i]);
        }
      }
    }
    index /= size[axis];
    stride *= size[axis];
  }
}

std::vector<std::uint8_t> colourInOrder(const Neighbours& neighbours)
{
  constexpr std::size_t most = std::numeric_limits<std::uint8_t>::max();
  std::vector<std::uint8_t> colours(neighbours.Count());
  std::vector<std::size_t> usedBy(most, neighbours.Count()); // the last site with such a neighbour
  for (std::size_t site = 0; site < colours.size(); ++site)
  {
    for (std::int64_t neighbour : neighbours.Of(site))
    {
      const std::size_t colour = colours[static_cast<std::size_t>(neighbour)];
      if (colour < most)
      {
        usedBy[colour] = site;
      }
    }
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
  std::int64_t rows = 1;
  for (std::size_t axis = 1; axis < Dimension; ++axis)
  {
    rows *= size[axis];
  }
  Neighbours neighbours(sites);
  constexpr std::int64_t pixels = std::int64_t{ 1 } << 20;
  progress.ForEachInOrder(
    rows, 1, [&](std::int64_t row) { joinRow<Dimension>(size, labels, row, neighbours); },
    std::max<std::int64_t>(1, pixels / size[0]));
  return colourInOrder(neighbours);
}

template decltype(colourSiteCells<1>) colourSiteCells<1>;
template decltype(colourSiteCells<2>) colourSiteCells<2>;
template decltype(colourSiteCells<3>) colourSiteCells<3>;

} // namespace RectifiedTransport
