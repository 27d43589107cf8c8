// SPDX-License-Identifier: BSD-3-Clause
#include "Core/SiteCells/EqualMasses/SplitSharedPixels.h"

#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

using Numbers = std::vector<std::int64_t>;

// Pixels between two polls for cancellation.
constexpr std::int64_t sliceOfShared = std::int64_t{ 1 } << 16;

// Grid coordinates of pixels; a pixel in the row of the previous one needs no division.
template <int Dimension>
class PixelPlace
{
public:
  explicit PixelPlace(const GridSize<Dimension>& size)
    : Size(size)
  {
  }

  const GridSize<Dimension>& At(std::int64_t pixel)
  {
    if (pixel < this->RowBegin || pixel >= this->RowEnd)
    {
      // Pixels ascend, so a new row is rare.
      std::int64_t row = pixel / this->Size[0];
      this->RowBegin = row * this->Size[0];
      this->RowEnd = this->RowBegin + this->Size[0];
      for (int axis = 1; axis < Dimension; ++axis)
      {
        this->Place[axis] = row % this->Size[axis];
        row /= this->Size[axis];
      }
    }
    this->Place[0] = pixel - this->RowBegin;
    return this->Place;
  }

private:
  const GridSize<Dimension> Size;
  GridSize<Dimension> Place{};
  std::int64_t RowBegin = 0;
  std::int64_t RowEnd = 0;
};

// Recursive bisection of the pixels of a site cell among its sites. `masses` are those of the
// pixels; with nullptr, all pixels count equally.
template <int Dimension>
class CellBisection
{
public:
  CellBisection(const GridSize<Dimension>& size, ConstPointSpan<Dimension> coordinates,
    const Point<Dimension>& spacing, const PixelMasses<Dimension>* masses, std::int64_t* labels,
    Progress& progress, std::int64_t largestCell)
    : Coordinates(coordinates)
    , Spacing(spacing)
    , Masses(masses)
    , Labels(labels)
    , Work(progress)
    , Place(size)
    , Upper(largestCell)
  {
  }

  // Labels pixels, in ascending order, by recursive bisection; both parts ascend, too. Throws
  // Cancelled.
  void Bisect(
    std::int64_t* sites, std::int64_t siteCount, std::int64_t* pixels, std::int64_t pixelCount)
  {
    if (siteCount == 1)
    {
      for (std::int64_t i = 0; i < pixelCount; ++i)
      {
        this->Labels[pixels[i]] = *sites;
      }
      return this->Work.Add(pixelCount);
    }
    // The bounds of the pixels, in pixels.
    const Box box = this->FindBox(pixels, pixelCount);
    const int axis = this->ChooseAxis(sites, siteCount, box);
    // The sites are divided at their median along the axis, and the pixels in proportion to the
    // numbers of sites.
    const std::int64_t half = siteCount / 2;
    std::nth_element(
      sites, sites + half, sites + siteCount, [this, axis](std::int64_t a, std::int64_t b) {
        const double x = this->Coordinates[a][axis];
        const double y = this->Coordinates[b][axis];
        return x != y ? x < y : a < b;
      });
    const std::int64_t part = this->Halve(pixels, pixelCount, siteCount, axis, box);
    this->Bisect(sites, half, pixels, part);
    this->Bisect(sites + half, siteCount - half, pixels + part, pixelCount - part);
  }

private:
  struct Box
  {
    GridSize<Dimension> Low{};
    GridSize<Dimension> High{};
  };

  // Calls visit(pixel, coordinates) for pixels in their order, with checks for cancellation.
  template <class Visit>
  void ForPixels(const std::int64_t* pixels, std::int64_t count, const Visit& visit)
  {
    for (std::int64_t begin = 0; begin < count; begin += sliceOfShared)
    {
      const std::int64_t end = std::min(begin + sliceOfShared, count);
      for (std::int64_t i = begin; i < end; ++i)
      {
        visit(pixels[i], this->Place.At(pixels[i]));
      }
      this->Visited += end - begin;
      if (this->Visited >= sliceOfShared)
      {
        this->Visited = 0;
        this->Work.Check();
      }
    }
  }

  // Low and High are the lowest and highest coordinates of the pixels, both included.
  Box FindBox(const std::int64_t* pixels, std::int64_t count)
  {
    Box box;
    if (count > 0)
    {
      box.Low = box.High = this->Place.At(*pixels);
    }
    this->ForPixels(pixels, count, [&box](std::int64_t, const GridSize<Dimension>& place) {
      for (int axis = 0; axis < Dimension; ++axis)
      {
        box.Low[axis] = std::min(box.Low[axis], place[axis]);
        box.High[axis] = std::max(box.High[axis], place[axis]);
      }
    });
    return box;
  }

  // Returns the axis along which the sites have the largest extent or, if they coincide, the
  // pixels.
  int ChooseAxis(const std::int64_t* sites, std::int64_t count, const Box& box) const
  {
    // The largest extent and its axis, for the sites and for the pixels.
    std::pair<double, int> bySites(0.0, -1);
    std::pair<double, int> byPixels(-1.0, 0);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      double low = this->Coordinates[*sites][axis];
      double high = low;
      for (std::int64_t i = 1; i < count; ++i)
      {
        const double x = this->Coordinates[sites[i]][axis];
        low = std::min(low, x);
        high = std::max(high, x);
      }
      // Extents are compared as lengths, since pixels need not be squares.
      const double spread = this->Spacing[axis] * (high - low);
      const double length =
        this->Spacing[axis] * static_cast<double>(box.High[axis] - box.Low[axis]);
      bySites = spread > bySites.first ? std::make_pair(spread, axis) : bySites;
      byPixels = length > byPixels.first ? std::make_pair(length, axis) : byPixels;
    }
    return bySites.second >= 0 ? bySites.second : byPixels.second;
  }

  // Moves the pixels of the lower half of the sites to the front. Returns how many there are.
  std::int64_t Halve(
    std::int64_t* pixels, std::int64_t count, std::int64_t siteCount, int axis, const Box& box)
  {
    const std::int64_t half = siteCount / 2;
    const std::int64_t part = this->Divide(pixels, count, siteCount, axis, box, false);
    if (this->Masses)
    {
      // If few heavy pixels leave a half fewer pixels with mass than it has sites, pixels are
      // counted instead of weighed.
      // The numbers of pixels with mass in the lower half and in all.
      std::int64_t lower = 0;
      std::int64_t all = 0;
      for (std::int64_t i = 0; i < count; ++i)
      {
        lower += i < part ? this->WeightOf(pixels[i], true) : 0;
        all += this->WeightOf(pixels[i], true);
      }
      if (all >= siteCount && (lower < half || all - lower < siteCount - half))
      {
        std::sort(pixels, pixels + count);
        return this->Divide(pixels, count, siteCount, axis, box, true);
      }
    }
    return part;
  }

  // Returns the mass of a pixel or, if pixels are counted, whether it has any.
  std::int64_t WeightOf(std::int64_t pixel, bool isCounted) const
  {
    const std::int64_t mass = this->Masses ? (*this->Masses)[pixel] : 1;
    return isCounted ? std::min<std::int64_t>(mass, 1) : mass;
  }
  // Returns the lower half's part of a weight: when pixels are counted, every site gets as many as
  // any other, or one more.
  static std::int64_t LowerPart(std::int64_t weight, std::int64_t siteCount)
  {
    const std::int64_t half = siteCount / 2;
    const std::int64_t each = weight / siteCount;
    const std::int64_t more = (weight % siteCount * half + siteCount / 2) / siteCount;
    return each * half + more;
  }

  // Moves the lowest pixels along an axis to the front: as many as have, to half a pixel, the
  // weight of the lower half of the sites. In the layer that both halves share, pixels with lower
  // numbers come first.
  std::int64_t Divide(std::int64_t* pixels, std::int64_t count, std::int64_t siteCount, int axis,
    const Box& box, bool areCounted)
  {
    const std::int64_t low = box.Low[axis];
    // The weight of each layer of pixels across the axis.
    this->Layers.assign(static_cast<std::size_t>(box.High[axis] - low + 1), 0);
    std::int64_t all = 0;
    this->ForPixels(pixels, count, [&](std::int64_t pixel, const GridSize<Dimension>& place) {
      const std::int64_t weight = this->WeightOf(pixel, areCounted);
      this->Layers[place[axis] - low] += weight;
      all += weight;
    });
    const std::int64_t last = box.High[axis] - low;
    std::int64_t border = 0; // the layer that the parts share
    // The weight that the lower half still needs when the border layer is reached.
    std::int64_t left = LowerPart(all, siteCount);
    while (border < last && left > this->Layers[border])
    {
      left -= this->Layers[border++];
    }
    border += low;
    std::int64_t* upper = this->Upper.data();
    std::int64_t* lower = pixels;
    this->ForPixels(pixels, count, [&](std::int64_t pixel, const GridSize<Dimension>& place) {
      const std::int64_t layer = place[axis];
      bool isLower = layer < border;
      if (layer == border)
      {
        const std::int64_t own = this->WeightOf(pixel, areCounted);
        // A pixel goes to the lower half if at least half of its weight is needed there.
        isLower = left > 0 && 2 * left >= own;
        left -= isLower ? own : 0;
      }
      // A stable partition: lower pixels move to the front in place, upper ones to the buffer and
      // back.
      *(isLower ? lower : upper)++ = pixel;
    });
    const std::int64_t part = lower - pixels;
    this->ForPixels(this->Upper.data(), count - part,
      [&lower](std::int64_t pixel, const GridSize<Dimension>&) { *lower++ = pixel; });
    return part;
  }

  ConstPointSpan<Dimension> Coordinates;
  const Point<Dimension> Spacing;
  const PixelMasses<Dimension>* Masses;
  std::int64_t* Labels;
  Progress& Work;
  PixelPlace<Dimension> Place;
  std::int64_t Visited = 0; // pixels since the last poll for cancellation
  Numbers Layers;
  LargeBuffer<std::int64_t> Upper; // pixels of the upper part; as many as the largest site cell has
};

// Divides the pixels of each group among its sites. Owners are groups before and sites afterwards;
// a group of one site only gets that site's number.
template <int Dimension>
void split(const SiteGroups& groups, const GridSize<Dimension>& size,
  ConstPointSpan<Dimension> coordinates, const Point<Dimension>& spacing,
  const PixelMasses<Dimension>* masses, std::int64_t* owners, const Context& context)
{
  Progress progress(context);
  Stages stages(progress, { { "counts", 1 }, { "pixels", 1 }, { "bisection", 8 } });
  const auto pixels = static_cast<std::int64_t>(numberOfCells<Dimension>(size));
  // The pixels of each site cell of several sites.
  const std::int64_t cells = groups.NumberOfGroups();
  Numbers first(static_cast<std::size_t>(cells) + 1, 0);
  stages["counts"].ForEachInOrder(pixels, sliceOfShared, [&](std::int64_t pixel) {
    first[owners[pixel] + 1] += groups.SitesIn(owners[pixel]) > 1 ? 1 : 0;
  });
  // The buffer is as large as the largest cell that is split.
  const std::int64_t largest = *std::max_element(first.begin(), first.end());
  for (std::int64_t cell = 0; cell < cells; ++cell)
  {
    first[cell + 1] += first[cell];
  }
  // A counting sort lists the pixels by groups: those of each group ascend, as bisection requires.
  LargeBuffer<std::int64_t> members(first.back());
  Numbers next(first);
  stages["pixels"].ForEachInOrder(pixels, sliceOfShared, [&](std::int64_t pixel) {
    const std::int64_t cell = owners[pixel];
    if (groups.SitesIn(cell) > 1)
    {
      members.data()[next[cell]++] = pixel;
    }
    owners[pixel] = groups.Site(cell, 0);
  });
  CellBisection<Dimension> bisection(
    size, coordinates, spacing, masses, owners, stages["bisection"].Expect(first.back()), largest);
  Numbers group;
  for (std::int64_t cell = 0; cell < cells; ++cell)
  {
    group.clear();
    for (std::int64_t i = 0; i < groups.SitesIn(cell); ++i)
    {
      group.push_back(groups.Site(cell, i));
    }
    if (group.size() > 1)
    {
      bisection.Bisect(group.data(), groups.SitesIn(cell), members.data() + first[cell],
        first[cell + 1] - first[cell]);
    }
  }
}

} // namespace

template <int Dimension>
void splitSharedPixels(const SiteDensity<Dimension>& sites, ConstPointSpan<Dimension> coordinates,
  const Point<Dimension>& spacing, std::int64_t* owners, const Context& context)
{
  split<Dimension>(sites.Groups(), sites.Size(), coordinates, spacing, nullptr, owners, context);
}

template <int Dimension>
void splitGroupsByMass(const SiteGroups& groups, const PixelMasses<Dimension>& masses,
  ConstPointSpan<Dimension> coordinates, const Point<Dimension>& spacing, std::int64_t* owners,
  const Context& context)
{
  split<Dimension>(groups, masses.Size(), coordinates, spacing, &masses, owners, context);
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(splitSharedPixels);
template decltype(splitGroupsByMass<2>) splitGroupsByMass<2>;
template decltype(splitGroupsByMass<3>) splitGroupsByMass<3>;

} // namespace RectifiedTransport
