// SPDX-License-Identifier: BSD-3-Clause
#include "Core/PowerCells/SiteTree.h"

#include "Core/Geometry/Trees/BoxTree.h"
#include "Core/Parallel/Progress.h"

#include <limits>

namespace RectifiedTransport
{

namespace
{

// Leaves with so few sites cost less to visit than to divide.
constexpr std::int64_t leafSites = 6;

} // namespace

void SiteTree::Build(ConstPointSpan<2> sites, Progress& progress)
{
  // The sites are sorted with the tree, so that each box has the sites [First, Last) of this array;
  // `Id` is the number of a site in the caller's order.
  this->Sites.resize(static_cast<std::size_t>(sites.size()));
  for (std::int64_t i = 0; i < sites.size(); ++i)
  {
    this->Sites[static_cast<std::size_t>(i)] = { { sites[i][0], sites[i][1] }, 0.0, i };
  }
  this->Boxes = makeBoxTree<Box>(
    sites.size(),
    [&](std::int64_t first, std::int64_t last) {
      // The bounds of the places now; those of the weights follow in SetWeights().
      Box box{ {}, {}, 0.0, {}, 0.0, first, last, -1 };
      this->Bound(box);
      progress.Add(last - first);
      return box;
    },
    [&](const Box& box) {
      if (box.Last - box.First <= leafSites)
      {
        return box.First;
      }
      // Halved at the median along the longer side; numbers decide between equal coordinates.
      const std::size_t axis = box.High[1] - box.Low[1] > box.High[0] - box.Low[0] ? 1 : 0;
      const std::int64_t middle = box.First + (box.Last - box.First) / 2;
      const auto at = [this](std::int64_t i) { return this->Sites.begin() + i; };
      std::nth_element(at(box.First), at(middle), at(box.Last),
        [axis](const WeightedSite& a, const WeightedSite& b) {
          return std::make_pair(a.X[axis], a.Id) < std::make_pair(b.X[axis], b.Id);
        });
      return middle;
    });
}

void SiteTree::Bound(Box& box) const
{
  // Infinite bounds the wrong way round are those of no sites.
  constexpr double infinity = std::numeric_limits<double>::infinity();
  box.Low.fill(infinity);
  box.High.fill(-infinity);
  for (std::int64_t i = box.First; i < box.Last; ++i)
  {
    for (std::size_t a = 0; a < 2; ++a)
    {
      box.Low[a] = std::min(box.Low[a], this->At(i).X[a]);
      box.High[a] = std::max(box.High[a], this->At(i).X[a]);
    }
  }
}

void SiteTree::SetWeights(const double* weights, Progress& progress)
{
  constexpr std::int64_t sitesOfRange = 1 << 12;
  progress.ForEach(this->Size(), sitesOfRange, [&](std::int64_t i) {
    WeightedSite& site = this->Sites[static_cast<std::size_t>(i)];
    site.Weight = weights[site.Id];
  });
  constexpr std::int64_t boxesOfRange = 64; // boxes; some have all sites
  const std::int64_t firstSlice = this->Size() > sitesOfRange ? boxesOfRange : 1 << 14;
  progress.ForEach(
    static_cast<std::int64_t>(this->Boxes.size()), boxesOfRange,
    [&](std::int64_t i) { this->BoundWeights(this->Boxes[static_cast<std::size_t>(i)]); },
    firstSlice);
}

// Bounds the weights in a box by a plane: Offset + Slope . x >= weight. The slope is that of the
// least-squares plane through the weights, the offset the least that bounds all; any other slope
// would be valid, too.
void SiteTree::BoundWeights(Box& box) const
{
  const Point<2> middle = { (box.Low[0] + box.High[0]) / 2.0, (box.Low[1] + box.High[1]) / 2.0 };
  // Sums for the least-squares fit of the weights, about the middle of the box.
  double x = 0.0;
  double y = 0.0;
  double w = 0.0;
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  double xw = 0.0;
  double yw = 0.0;
  box.LargestWeight = -std::numeric_limits<double>::infinity();
  for (std::int64_t i = box.First; i < box.Last; ++i)
  {
    const WeightedSite& site = this->At(i);
    const double a = site.X[0] - middle[0];
    const double b = site.X[1] - middle[1];
    x += a;
    y += b;
    w += site.Weight;
    xx += a * a;
    xy += a * b;
    yy += b * b;
    xw += a * site.Weight;
    yw += b * site.Weight;
    box.LargestWeight = std::max(box.LargestWeight, site.Weight);
  }
  // Moments about the mean: subtract the products of sums.
  const auto count = static_cast<double>(box.Last - box.First);
  xx -= x * x / count;
  xy -= x * y / count;
  yy -= y * y / count;
  xw -= x * w / count;
  yw -= y * w / count;
  // The normal equations of the slope: (xx xy; xy yy) slope = (xw; yw).
  const double determinant = xx * yy - xy * xy;
  // Sites on a line determine no slope across it; then the plane is level.
  constexpr double flat = 1e-6;
  box.Slope = { 0.0, 0.0 };
  if (determinant > flat * xx * yy)
  {
    box.Slope = { (yy * xw - xy * yw) / determinant, (xx * yw - xy * xw) / determinant };
  }
  // The offset is the maximum of weight - Slope . x over the sites of the box.
  box.Offset = -std::numeric_limits<double>::infinity();
  for (std::int64_t i = box.First; i < box.Last; ++i)
  {
    const WeightedSite& site = this->At(i);
    box.Offset =
      std::max(box.Offset, site.Weight - box.Slope[0] * site.X[0] - box.Slope[1] * site.X[1]);
  }
}

} // namespace RectifiedTransport
