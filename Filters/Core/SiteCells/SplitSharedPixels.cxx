// SPDX-License-Identifier: BSD-3-Clause
#include "Core/SiteCells/SplitSharedPixels.h"

#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

using Numbers = std::vector<std::int64_t>;

// Pixels between two polls for cancellation.
constexpr std::int64_t sliceOfPixels = std::int64_t{ 1 } << 16;

// Grid coordinates of pixels, without a division for one in the row of the pixel before.
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

template <int Dimension>
class CellBisection
{
public:
  CellBisection(const SiteDensity<Dimension>& sites, ConstPointSpan<Dimension> coordinates,
    const Point<Dimension>& spacing, std::int64_t* labels, Progress& progress,
    std::int64_t largestCell)
    : Coordinates(coordinates)
    , Spacing(spacing)
    , Labels(labels)
    , Work(progress)
    , Place(sites.Size())
    , Upper(largestCell)
  {
  }

  // Labels ascending pixels by recursive bisection; both parts ascend, too. Throws Cancelled.
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
    const Box box = this->FindBox(pixels, pixelCount);
    const int axis = this->ChooseAxis(sites, siteCount, box);
    const std::int64_t half = siteCount / 2;
    // Every site gets as many pixels as any other, or one more.
    const std::int64_t each = pixelCount / siteCount;
    const std::int64_t more = (pixelCount % siteCount * half + siteCount / 2) / siteCount;
    const std::int64_t part = each * half + more;
    std::nth_element(
      sites, sites + half, sites + siteCount, [this, axis](std::int64_t a, std::int64_t b) {
        const double x = this->Coordinates[a][axis];
        const double y = this->Coordinates[b][axis];
        return x != y ? x < y : a < b;
      });
    this->Divide(pixels, pixelCount, part, axis, box);
    this->Bisect(sites, half, pixels, part);
    this->Bisect(sites + half, siteCount - half, pixels + part, pixelCount - part);
  }

private:
  struct Box
  {
    GridSize<Dimension> Low{};
    GridSize<Dimension> High{};
  };

  template <class Visit>
  void ForPixels(const std::int64_t* pixels, std::int64_t count, const Visit& visit)
  {
    for (std::int64_t begin = 0; begin < count; begin += sliceOfPixels)
    {
      const std::int64_t end = std::min(begin + sliceOfPixels, count);
      for (std::int64_t i = begin; i < end; ++i)
      {
        visit(pixels[i], this->Place.At(pixels[i]));
      }
      this->Visited += end - begin;
      if (this->Visited >= sliceOfPixels)
      {
        this->Visited = 0;
        this->Work.Check();
      }
    }
  }

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

  // The axis along which the sites, or if they coincide the pixels, have the largest extent.
  int ChooseAxis(const std::int64_t* sites, std::int64_t count, const Box& box) const
  {
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
      const double spread = this->Spacing[axis] * (high - low);
      const double length =
        this->Spacing[axis] * static_cast<double>(box.High[axis] - box.Low[axis]);
      bySites = spread > bySites.first ? std::make_pair(spread, axis) : bySites;
      byPixels = length > byPixels.first ? std::make_pair(length, axis) : byPixels;
    }
    return bySites.second >= 0 ? bySites.second : byPixels.second;
  }

  // Moves the `first` lowest pixels along an axis to the front, those of a layer by their numbers.
  void Divide(
    std::int64_t* pixels, std::int64_t count, std::int64_t first, int axis, const Box& box)
  {
    const std::int64_t low = box.Low[axis];
    this->Layers.assign(static_cast<std::size_t>(box.High[axis] - low + 1), 0);
    this->ForPixels(pixels, count,
      [&](std::int64_t, const GridSize<Dimension>& place) { ++this->Layers[place[axis] - low]; });
    std::int64_t border = 0; // the layer that the parts share
    std::int64_t left = first;
    while (left > this->Layers[border])
    {
      left -= this->Layers[border++];
    }
    border += low;
    std::int64_t* upper = this->Upper.data();
    std::int64_t* lower = pixels;
    this->ForPixels(pixels, count, [&](std::int64_t pixel, const GridSize<Dimension>& place) {
      const std::int64_t layer = place[axis];
      if (layer < border || (layer == border && left-- > 0))
      {
        *lower++ = pixel;
      }
      else
      {
        *upper++ = pixel;
      }
    });
    this->ForPixels(this->Upper.data(), count - first,
      [&lower](std::int64_t pixel, const GridSize<Dimension>&) { *lower++ = pixel; });
  }

  ConstPointSpan<Dimension> Coordinates;
  const Point<Dimension> Spacing;
  std::int64_t* Labels;
  Progress& Work;
  PixelPlace<Dimension> Place;
  std::int64_t Visited = 0; // pixels since the last poll for cancellation
  Numbers Layers;
  LargeBuffer<std::int64_t> Upper; // of the size of the largest site cell
};

} // namespace

template <int Dimension>
void splitSharedPixels(const SiteDensity<Dimension>& sites, ConstPointSpan<Dimension> coordinates,
  const Point<Dimension>& spacing, std::int64_t* owners, const Context& context)
{
  Progress progress(context);
  std::int64_t pixels = 1;
  for (const std::int64_t cells : sites.Size())
  {
    pixels *= cells;
  }
  // The pixels of each site cell of several sites.
  const std::int64_t cells = sites.NumberOfPixels();
  Numbers first(static_cast<std::size_t>(cells) + 1, 0);
  progress.BeginStage(0.1);
  progress.ForInOrder(pixels, sliceOfPixels, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t pixel = begin; pixel < end; ++pixel)
    {
      first[owners[pixel] + 1] += sites.SitesIn(owners[pixel]) > 1 ? 1 : 0;
    }
  });
  const std::int64_t largest = *std::max_element(first.begin(), first.end());
  for (std::int64_t cell = 0; cell < cells; ++cell)
  {
    first[cell + 1] += first[cell];
  }
  LargeBuffer<std::int64_t> members(first.back());
  Numbers next(first);
  progress.BeginStage(0.2);
  progress.ForInOrder(pixels, sliceOfPixels, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t pixel = begin; pixel < end; ++pixel)
    {
      const std::int64_t cell = owners[pixel];
      if (sites.SitesIn(cell) > 1)
      {
        members.data()[next[cell]++] = pixel;
      }
      owners[pixel] = sites.Site(cell, 0);
    }
  });
  progress.BeginStage(1.0, first.back());
  CellBisection<Dimension> bisection(sites, coordinates, spacing, owners, progress, largest);
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
      bisection.Bisect(group.data(), sites.SitesIn(cell), members.data() + first[cell],
        first[cell + 1] - first[cell]);
    }
  }
}

template void splitSharedPixels<1>(
  const SiteDensity<1>&, ConstPointSpan<1>, const Point<1>&, std::int64_t*, const Context&);
template void splitSharedPixels<2>(
  const SiteDensity<2>&, ConstPointSpan<2>, const Point<2>&, std::int64_t*, const Context&);
template void splitSharedPixels<3>(
  const SiteDensity<3>&, ConstPointSpan<3>, const Point<3>&, std::int64_t*, const Context&);

} // namespace RectifiedTransport
