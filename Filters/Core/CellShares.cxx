// SPDX-License-Identifier: BSD-3-Clause
#include "CellShares.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

using Numbers = std::vector<std::int64_t>;

template <int Dimension>
class CellCut
{
public:
  CellCut(const SitePixels<Dimension>& sites, const double* coordinates,
    const Point<Dimension>& spacing, std::int64_t* labels)
    : Size(sites.Size())
    , Coordinates(coordinates)
    , Spacing(spacing)
    , Labels(labels)
  {
  }

  void Cut(std::int64_t* sites, std::int64_t siteCount, std::int64_t* pixels,
    std::int64_t pixelCount) const
  {
    if (siteCount == 1)
    {
      for (std::int64_t i = 0; i < pixelCount; ++i)
      {
        this->Labels[pixels[i]] = *sites;
      }
      return;
    }
    const auto siteAt = [this](std::int64_t site, int axis) {
      return this->Coordinates[site * Dimension + axis];
    };
    const auto pixelAt = [this](std::int64_t pixel, int axis) {
      for (int below = 0; below < axis; ++below)
      {
        pixel /= this->Size[below];
      }
      return static_cast<double>(pixel % this->Size[axis]);
    };
    const auto [bySites, spread] = this->Widest(sites, siteCount, siteAt);
    const int axis = spread > 0.0 ? bySites : this->Widest(pixels, pixelCount, pixelAt).first;
    const std::int64_t half = siteCount / 2;
    // Each gets as many as any other, or one more.
    const std::int64_t each = pixelCount / siteCount;
    const std::int64_t more = (pixelCount % siteCount * half + siteCount / 2) / siteCount;
    const std::int64_t part = each * half + more;
    partition(sites, siteCount, half, axis, siteAt);
    partition(pixels, pixelCount, part, axis, pixelAt);
    this->Cut(sites, half, pixels, part);
    this->Cut(sites + half, siteCount - half, pixels + part, pixelCount - part);
  }

private:
  // The axis along which some numbers' coordinates differ most, and by how much.
  template <class Coordinate>
  std::pair<int, double> Widest(
    const std::int64_t* numbers, std::int64_t count, const Coordinate& at) const
  {
    std::pair<int, double> widest(0, 0.0);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const auto less = [&](std::int64_t a, std::int64_t b) { return at(a, axis) < at(b, axis); };
      const auto [low, high] = std::minmax_element(numbers, numbers + count, less);
      const double spread =
        count > 0 ? this->Spacing[axis] * (at(*high, axis) - at(*low, axis)) : 0.0;
      if (spread > widest.second)
      {
        widest = { axis, spread };
      }
    }
    return widest;
  }

  // Brings the `first` smallest along an axis to the front.
  template <class Coordinate>
  static void partition(
    std::int64_t* numbers, std::int64_t count, std::int64_t first, int axis, const Coordinate& at)
  {
    std::nth_element(
      numbers, numbers + first, numbers + count, [&](std::int64_t a, std::int64_t b) {
        const double x = at(a, axis);
        const double y = at(b, axis);
        return x != y ? x < y : a < b;
      });
  }

  const GridSize<Dimension> Size;
  const double* Coordinates;
  const Point<Dimension> Spacing;
  std::int64_t* Labels;
};

} // namespace

template <int Dimension>
void shareCells(const SitePixels<Dimension>& sites, const double* coordinates,
  const Point<Dimension>& spacing, std::int64_t* owners)
{
  std::int64_t pixels = 1;
  for (const std::int64_t cells : sites.Size())
  {
    pixels *= cells;
  }
  // The pixels of each cell of several sites.
  const std::int64_t cells = sites.NumberOfPixels();
  Numbers first(static_cast<std::size_t>(cells) + 1, 0);
  for (std::int64_t pixel = 0; pixel < pixels; ++pixel)
  {
    first[owners[pixel] + 1] += sites.SitesIn(owners[pixel]) > 1 ? 1 : 0;
  }
  for (std::int64_t cell = 0; cell < cells; ++cell)
  {
    first[cell + 1] += first[cell];
  }
  Numbers members(static_cast<std::size_t>(first.back()));
  Numbers next(first);
  for (std::int64_t pixel = 0; pixel < pixels; ++pixel)
  {
    const std::int64_t cell = owners[pixel];
    if (sites.SitesIn(cell) > 1)
    {
      members[next[cell]++] = pixel;
    }
    owners[pixel] = sites.Site(cell, 0);
  }
  const CellCut<Dimension> cut(sites, coordinates, spacing, owners);
  Numbers group;
  for (std::int64_t cell = 0; cell < cells; ++cell)
  {
    group.clear();
    for (std::int64_t i = 0; i < sites.SitesIn(cell); ++i)
    {
      group.push_back(sites.Site(cell, i));
    }
    if (group.size() > 1)
    {
      cut.Cut(group.data(), sites.SitesIn(cell), members.data() + first[cell],
        first[cell + 1] - first[cell]);
    }
  }
}

template void shareCells<1>(const SitePixels<1>&, const double*, const Point<1>&, std::int64_t*);
template void shareCells<2>(const SitePixels<2>&, const double*, const Point<2>&, std::int64_t*);
template void shareCells<3>(const SitePixels<3>&, const double*, const Point<3>&, std::int64_t*);

} // namespace RectifiedTransport
