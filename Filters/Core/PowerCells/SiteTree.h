// SPDX-License-Identifier: BSD-3-Clause
// A tree of bounding boxes of weighted sites. It finds the sites that may cut a power cell.
#ifndef RectifiedTransport_SiteTree_h
#define RectifiedTransport_SiteTree_h

#include "Core/Geometry/Points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

class Progress;

class SiteTree
{
public:
  // The sites are divided at the median along the widest axis of their box: O(count log count).
  // Throws Cancelled.
  void Build(ConstPointSpan<2> sites, Progress& progress);
  // Call it before a visit: a weight for each site.
  void SetWeights(const double* weights, Progress& progress);

  std::int64_t Size() const { return static_cast<std::int64_t>(this->Sites.size()); }
  // The sites in the order of the tree: places near each other hold neighbours.
  std::int64_t Site(std::int64_t place) const { return this->At(place).Id; }

  // Calls visit(id, offset of the site from the centre, weight), nearest boxes first, at least for
  // the sites with a smaller power at some corner of a cell than the site at `centre` with weight
  // `weight`. The cell has Corners(), with places X relative to the centre, and Radius(), their
  // largest distance. It may shrink during the visit, which ends when it is empty.
  template <class Cell, class Visit>
  void VisitRivals(
    const Point<2>& centre, double weight, const Cell& cell, const Visit& visit) const;

private:
  struct WeightedSite
  {
    Point<2> X;
    double Weight;
    std::int64_t Id;
  };
  // The box of the sites [First, Last). The first child is the next box in memory, Second is the
  // other one: -1 in a leaf.
  struct Box
  {
    Point<2> Low;
    Point<2> High;
    double LargestWeight;
    // Weights are at most Offset + Slope . x: they may vary much in a box, but then smoothly.
    Point<2> Slope;
    double Offset;
    std::int64_t First;
    std::int64_t Last;
    std::int64_t Second;
  };
  // The smallest and the largest squared distance from a centre.
  struct Range
  {
    double Nearest;
    double Farthest;
  };

  const WeightedSite& At(std::int64_t place) const
  {
    return this->Sites[static_cast<std::size_t>(place)];
  }
  const Box& BoxAt(std::int64_t box) const { return this->Boxes[static_cast<std::size_t>(box)]; }
  static Range RangeOf(const Box& box, const Point<2>& centre);
  template <class Cell>
  static bool MayCut(const Box& box, const Point<2>& centre, double weight, const Cell& cell);
  void Bound(Box& box) const;
  void BoundWeights(Box& box) const;

  std::vector<WeightedSite> Sites;
  std::vector<Box> Boxes;
};

inline SiteTree::Range SiteTree::RangeOf(const Box& box, const Point<2>& centre)
{
  Range range{ 0.0, 0.0 };
  for (std::size_t a = 0; a < 2; ++a)
  {
    const double fromLow = centre[a] - box.Low[a];
    const double toHigh = box.High[a] - centre[a];
    const double gap = std::max(0.0, -std::min(fromLow, toHigh));
    const double reach = std::max(fromLow, toHigh);
    range.Nearest += gap * gap;
    range.Farthest += reach * reach;
  }
  return range;
}

// At a corner v of the cell, the power of a site x in the box, both relative to the centre, is at
// least |v - x|^2 - Offset' - Slope . x = |x - u|^2 - Slope . v - Slope^2 / 4 - Offset', where u =
// v + Slope / 2. The box may cut only if this is less than the power of the cell's own site, |v|^2
// - weight, at some corner.
template <class Cell>
bool SiteTree::MayCut(const Box& box, const Point<2>& centre, double weight, const Cell& cell)
{
  const Point<2>& g = box.Slope;
  const double atCentre = g[0] * centre[0] + g[1] * centre[1];
  const double square = (g[0] * g[0] + g[1] * g[1]) / 4.0;
  // Sites near each other may have very different weights; steep slopes then cause rounding.
  const double rounding =
    1e-15 * (std::abs(weight) + std::abs(box.Offset) + std::abs(atCentre) + 4.0 * square);
  const double constant = weight - (box.Offset + atCentre) - square - rounding;
  const Point<2> low = { box.Low[0] - centre[0] - g[0] / 2.0, box.Low[1] - centre[1] - g[1] / 2.0 };
  const Point<2> high = { box.High[0] - centre[0] - g[0] / 2.0,
    box.High[1] - centre[1] - g[1] / 2.0 };
  for (const auto& corner : cell.Corners())
  {
    const Point<2>& v = corner.X;
    const double x = std::max({ low[0] - v[0], v[0] - high[0], 0.0 });
    const double y = std::max({ low[1] - v[1], v[1] - high[1], 0.0 });
    const double own = v[0] * v[0] + v[1] * v[1];
    if (x * x + y * y - g[0] * v[0] - g[1] * v[1] + constant < own)
    {
      return true;
    }
  }
  return false;
}

// Depth first, the nearer child first. The bisector with a site at the distance d passes at the
// distance (d^2 - w' + w) / (2 d). This is within the radius r if d^2 - 2 d r < w' - w; the left
// side falls up to d = r and then rises, so the box's best d is r clamped to its range.
template <class Cell, class Visit>
void SiteTree::VisitRivals(
  const Point<2>& centre, double weight, const Cell& cell, const Visit& visit) const
{
  struct Entry
  {
    std::int64_t Box;
    Range Distance;
  };
  constexpr int deepest = 64; // levels: medians halve the sites
  Entry stack[deepest];
  int depth = 0;
  stack[depth++] = { 0, RangeOf(this->BoxAt(0), centre) };
  while (depth > 0 && !cell.Corners().empty())
  {
    const Entry entry = stack[--depth];
    const Box& box = this->BoxAt(entry.Box);
    const double r = cell.Radius();
    const double d =
      std::clamp(r, std::sqrt(entry.Distance.Nearest), std::sqrt(entry.Distance.Farthest));
    if (d * d - 2.0 * d * r >= box.LargestWeight - weight || !MayCut(box, centre, weight, cell))
    {
      continue;
    }
    if (box.Second >= 0)
    {
      Entry first = { entry.Box + 1, RangeOf(this->BoxAt(entry.Box + 1), centre) };
      Entry second = { box.Second, RangeOf(this->BoxAt(box.Second), centre) };
      if (first.Distance.Nearest < second.Distance.Nearest)
      {
        std::swap(first, second);
      }
      stack[depth++] = first;
      stack[depth++] = second;
      continue;
    }
    for (std::int64_t i = box.First; i < box.Last; ++i)
    {
      const WeightedSite& site = this->At(i);
      visit(site.Id, { site.X[0] - centre[0], site.X[1] - centre[1] }, site.Weight);
    }
  }
}

} // namespace RectifiedTransport

#endif
