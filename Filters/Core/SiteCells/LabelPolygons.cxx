// SPDX-License-Identifier: BSD-3-Clause
#include "Core/SiteCells/LabelPolygons.h"

#include "Core/Geometry/Trees/Bins.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t noLabel = -1;
constexpr std::int64_t rowsOfBand = 16;
constexpr double clipRounding = 1e-9; // pixels; errors of the clipping of polygons

// A closed interval, empty at first.
struct Interval
{
  double Low = std::numeric_limits<double>::infinity();
  double High = -std::numeric_limits<double>::infinity();

  void Add(double x)
  {
    this->Low = std::min(this->Low, x);
    this->High = std::max(this->High, x);
  }
};

// Scan conversion of convex polygons: each fills the interval of a row that it contains. Bands do
// not share pixels, so that nothing depends on their order.
class PolygonLabels
{
public:
  PolygonLabels(const std::vector<Point<2>>& corners, const std::vector<std::int64_t>& first,
    const GridSize<2>& size, std::int64_t* labels)
    : Corners(corners)
    , First(first)
    , Size(size)
    , Labels(labels)
  {
  }

  void Run(Progress& progress)
  {
    // The number of bands, the last of which may be narrower.
    const std::int64_t bands = (this->Size[1] + rowsOfBand - 1) / rowsOfBand;
    this->FindBands(bands, progress);
    progress.ForEach(
      bands, 1, [this](std::int64_t band) { this->FillBand(band); },
      std::max<std::int64_t>(1, (1 << 16) / (rowsOfBand * this->Size[0])));
  }

private:
  struct Range
  {
    std::int64_t Begin;
    std::int64_t End;
  };

  // Returns the extent of a polygon along an axis.
  Interval ExtentOf(std::int64_t polygon, std::size_t axis) const
  {
    Interval extent;
    for (std::int64_t k = this->First[static_cast<std::size_t>(polygon)];
         k < this->First[static_cast<std::size_t>(polygon) + 1]; ++k)
    {
      extent.Add(this->Corners[static_cast<std::size_t>(k)][axis]);
    }
    return extent;
  }

  // Returns the pixels whose centres are in an interval, or so near it that rounding may have put
  // them outside: centre i + 1/2 >= low, so i >= ceil(low - 1/2).
  static Range PixelsOf(const Interval& interval, std::int64_t count)
  {
    const auto bounded = [count](double x) {
      return static_cast<std::int64_t>(std::clamp(x, 0.0, static_cast<double>(count)));
    };
    return { bounded(std::ceil(interval.Low - 0.5 - clipRounding)),
      bounded(std::ceil(interval.High - 0.5 + clipRounding)) };
  }

  // Lists the polygons that reach into each band, ascending.
  void FindBands(std::int64_t bands, Progress& progress)
  {
    const auto polygons = static_cast<std::int64_t>(this->First.size()) - 1;
    this->Bands.Fill(static_cast<std::size_t>(bands), [&](const auto& add) {
      progress.ForEachInOrder(polygons, 1 << 10, [&](std::int64_t polygon) {
        const Range columns = PixelsOf(this->ExtentOf(polygon, 0), this->Size[0]);
        const Range rows = PixelsOf(this->ExtentOf(polygon, 1), this->Size[1]);
        // Many polygons may lie between the centres of two columns; they fill no pixel.
        const std::int64_t end = columns.Begin < columns.End ? rows.End : rows.Begin;
        for (std::int64_t band = rows.Begin / rowsOfBand;
             rows.Begin < end && band <= (end - 1) / rowsOfBand; ++band)
        {
          add(static_cast<std::size_t>(band), polygon);
        }
      });
    });
  }

  // Where two polygons claim a pixel by rounding, the one with the higher number gets it: polygons
  // are listed in their order.
  void FillBand(std::int64_t band)
  {
    const std::int64_t begin = band * rowsOfBand;
    const std::int64_t end = std::min(begin + rowsOfBand, this->Size[1]);
    std::fill(this->Labels + begin * this->Size[0], this->Labels + end * this->Size[0], noLabel);
    for (const std::int64_t polygon : this->Bands[static_cast<std::size_t>(band)])
    {
      const Interval extent = this->ExtentOf(polygon, 1);
      const Range rows = PixelsOf(extent, this->Size[1]);
      for (std::int64_t row = std::max(rows.Begin, begin); row < std::min(rows.End, end); ++row)
      {
        // The centre may be outside the extent by rounding.
        const double y = std::clamp(static_cast<double>(row) + 0.5, extent.Low, extent.High);
        const Range pixels = PixelsOf(this->Section(polygon, y), this->Size[0]);
        std::int64_t* labels = this->Labels + row * this->Size[0];
        std::fill(labels + pixels.Begin, labels + std::max(pixels.Begin, pixels.End), polygon);
      }
    }
    for (std::int64_t row = begin; row < end; ++row)
    {
      this->CloseGaps(this->Labels + row * this->Size[0]);
    }
  }

  // Returns the interval of the polygon along a row. Sides along the row may be inclined by
  // rounding, so corners near it count, too.
  Interval Section(std::int64_t polygon, double y) const
  {
    Interval section;
    const std::int64_t first = this->First[static_cast<std::size_t>(polygon)];
    const std::int64_t last = this->First[static_cast<std::size_t>(polygon) + 1];
    for (std::int64_t k = first; k < last; ++k)
    {
      const Point<2>& a = this->Corners[static_cast<std::size_t>(k)];
      const Point<2>& b = this->Corners[static_cast<std::size_t>(k + 1 < last ? k + 1 : first)];
      if (std::abs(a[1] - y) <= clipRounding)
      {
        section.Add(a[0]);
      }
      if ((a[1] < y && y < b[1]) || (b[1] < y && y < a[1]))
      {
        // The side crosses the row's centre line strictly between its ends.
        section.Add(a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
      }
    }
    return section;
  }

  // Corners are very uncertain where bisectors are nearly parallel, and gaps may be wider than
  // rounding: they get the polygon on their left.
  void CloseGaps(std::int64_t* labels) const
  {
    const std::int64_t* end = labels + this->Size[0];
    // The first labelled pixel also fills a gap at the row's beginning.
    const std::int64_t* first = std::find_if(
      static_cast<const std::int64_t*>(labels), end, [](std::int64_t label) { return label >= 0; });
    std::int64_t last = first == end ? 0 : *first;
    for (std::int64_t* label = labels; label != end; ++label)
    {
      last = *label == noLabel ? last : *label;
      *label = last;
    }
  }

  const std::vector<Point<2>>& Corners;
  const std::vector<std::int64_t>& First;
  const GridSize<2> Size;
  std::int64_t* const Labels;
  Bins<std::int64_t> Bands; // the polygons that reach into each band
};

} // namespace

void labelPolygons(const std::vector<Point<2>>& corners, const std::vector<std::int64_t>& first,
  const GridSize<2>& size, std::int64_t* labels, Progress& progress)
{
  PolygonLabels(corners, first, size, labels).Run(progress);
}

} // namespace RectifiedTransport
