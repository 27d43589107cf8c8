// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Overlap/RegionOutlines.h"

#include "Core/Geometry/Trees/Bins.h"
#include "Core/Overlap/EdgeCrossings.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t nobody = -1;

// The edges that reach each of equal rows of a plane, to find out what is around a point: only the
// edges of its row count.
class EdgeRows
{
public:
  explicit EdgeRows(const Rings& rings)
    : All(rings)
    , Low(rings.At(0)[1])
  {
    // The bounds along y and the sum of the edges' heights give the number of rows.
    double high = this->Low;
    double lengths = 0.0;
    for (std::int64_t i = 0; i < rings.Edges(); ++i)
    {
      this->Low = std::min(this->Low, rings.At(i)[1]);
      high = std::max(high, rings.At(i)[1]);
      lengths += std::abs(rings.At(rings.Next(i))[1] - rings.At(i)[1]);
    }
    const double height = high - this->Low;
    const auto count = static_cast<double>(rings.Edges());
    // With 2 rows for each mean height of an edge, an edge is in about 3 rows. The number is whole,
    // else the highest point may be rounded into one more.
    const double rows =
      lengths > 0.0 ? std::clamp(std::floor(2.0 * count * height / lengths), 1.0, count) : 1.0;
    const double perLength = rows / height;
    this->PerLength = std::isfinite(perLength) ? perLength : 0.0;
    this->Rows.Fill(
      static_cast<std::size_t>(rows) + 1, [this](const auto& add) { this->VisitEdges(add); });
  }

  // The rings that have the first point of an edge inside, except its own: those of which an odd
  // number of edges pass to the left of the point (even-odd rule). Exact predicates decide.
  std::vector<std::int64_t> RingsAround(std::int64_t point) const
  {
    // A ray to the left of p in its row.
    const NumberedPoint p = this->All.Numbered(point);
    std::vector<std::int64_t> around;
    for (const std::int64_t edge : this->Rows[this->RowOf(p.X)])
    {
      const std::int64_t ring = this->All.RingOf(edge);
      NumberedPoint low = this->All.Numbered(edge);
      NumberedPoint high = this->All.Numbered(this->All.Next(edge));
      // Edges that do not pass p's height do not count.
      if (ring == this->All.RingOf(point) || isAbove(low, p) == isAbove(high, p))
      {
        continue;
      }
      if (isAbove(low, high))
      {
        std::swap(low, high);
      }
      if (!turnsLeft(low, high, p))
      {
        toggle(around, ring);
      }
    }
    return around;
  }

  // Inside and outside change with each edge.
  static void toggle(std::vector<std::int64_t>& rings, std::int64_t ring)
  {
    const auto found = std::find(rings.begin(), rings.end(), ring);
    if (found == rings.end())
    {
      rings.push_back(ring);
    }
    else
    {
      rings.erase(found);
    }
  }

private:
  // Not clamped: points are within the rows.
  std::size_t RowOf(const Point<2>& x) const
  {
    return static_cast<std::size_t>((x[1] - this->Low) * this->PerLength);
  }

  template <class Visit>
  void VisitEdges(const Visit& visit) const
  {
    // An edge is listed in each row that it reaches, once.
    const auto edges = static_cast<std::int32_t>(this->All.Edges());
    for (std::int32_t edge = 0; edge < edges; ++edge)
    {
      const std::size_t a = this->RowOf(this->All.At(edge));
      const std::size_t b = this->RowOf(this->All.At(this->All.Next(edge)));
      for (std::size_t row = std::min(a, b); row <= std::max(a, b); ++row)
      {
        visit(row, edge);
      }
    }
  }

  const Rings& All;
  double Low;
  double PerLength;
  Bins<std::int32_t> Rows;
};

// Cuts the rings into pieces at their crossings, and finds the owners of the places to the left and
// to the right of each piece, which change only at crossings. A piece with two different owners is
// part of the outlines.
class OutlineWalk
{
public:
  OutlineWalk(
    const Rings& rings, const std::vector<double>& values, Progress& progress, bool& areSimple)
    : All(rings)
    , Values(values)
    , Stop(progress)
  {
    for (std::int64_t ring = 0; ring < rings.Count(); ++ring)
    {
      // The size of a ring decides which one owns a place.
      this->Areas.push_back(std::abs(windingArea(rings, ring)));
    }
    this->Crossings = edgeCrossings(rings, progress, areSimple);
  }

  std::vector<OutlineEdge> Run()
  {
    this->Found.reserve(static_cast<std::size_t>(this->All.Edges()));
    // A single ring has no others around it, and needs no rows.
    if (this->All.Count() == 1)
    {
      this->Walk(0, {});
      return std::move(this->Found);
    }
    const EdgeRows rows(this->All);
    for (std::int64_t ring = 0; ring < this->All.Count() && !this->Stop.ShouldStop(); ++ring)
    {
      if (this->All.Begin(ring + 1) > this->All.Begin(ring))
      {
        this->Walk(ring, rows.RingsAround(this->TopOf(ring)));
      }
    }
    // Pieces of a region follow each other, in the order of the walk.
    std::stable_sort(this->Found.begin(), this->Found.end(),
      [](const OutlineEdge& p, const OutlineEdge& q) { return p.Ring < q.Ring; });
    return std::move(this->Found);
  }

private:
  // The highest point of a ring: there, one side of its edges is inside of the ring, the other not.
  std::int64_t TopOf(std::int64_t ring) const
  {
    std::int64_t top = this->All.Begin(ring);
    for (std::int64_t i = top + 1; i < this->All.Begin(ring + 1); ++i)
    {
      top = isAbove(this->All.Numbered(i), this->All.Numbered(top)) ? i : top;
    }
    return top;
  }

  // The ring whose region has a place that is inside of `around`, by the rule of the header.
  std::int64_t OwnerOf(const std::vector<std::int64_t>& around) const
  {
    if (around.size() % 2 == 0)
    {
      return nobody;
    }
    std::int64_t owner = nobody;
    for (const std::int64_t ring : around)
    {
      const double value = this->Values[static_cast<std::size_t>(ring)];
      // Rings of one value around a place cancel in pairs.
      const auto same = std::count_if(around.begin(), around.end(),
        [&](std::int64_t other) { return this->Values[static_cast<std::size_t>(other)] == value; });
      const bool isSmaller = owner == nobody || this->AreaOf(ring) < this->AreaOf(owner) ||
        (this->AreaOf(ring) == this->AreaOf(owner) && ring > owner);
      owner = same % 2 == 1 && isSmaller ? ring : owner;
    }
    return owner;
  }

  double AreaOf(std::int64_t ring) const { return this->Areas[static_cast<std::size_t>(ring)]; }

  // Walks along a ring from its top. Both sides of an edge are inside of `others`, and one of
  // them of the ring itself. Each crossing with another ring changes `others`, each one with the
  // ring itself changes the side.
  void Walk(std::int64_t ring, std::vector<std::int64_t> others)
  {
    const std::int64_t top = this->TopOf(ring);
    const std::int64_t begin = this->All.Begin(ring);
    const std::int64_t end = this->All.Begin(ring + 1);
    const std::int64_t before = top == begin ? end - 1 : top - 1;
    // The inside of the top's angle is inside of the ring: on the left of the edge that leaves it
    // if that turns left of the one that comes.
    bool isInLeft = turnsLeft(
      this->All.Numbered(top), this->All.Numbered(this->All.Next(top)), this->All.Numbered(before));
    std::int64_t left = nobody;
    std::int64_t right = nobody;
    const auto findOwners = [&]() {
      // One side is inside of `others` alone, the other one of the ring as well.
      std::vector<std::int64_t> both = others;
      both.push_back(ring);
      // Owners change only where `others` or the side does.
      left = this->OwnerOf(isInLeft ? both : others);
      right = this->OwnerOf(isInLeft ? others : both);
    };
    findOwners();
    std::int64_t edge = top;
    do
    {
      const Point<2>* from = &this->All.At(edge);
      for (auto crossing = this->FirstOn(edge);
           crossing != this->Crossings.end() && crossing->Edge == edge; ++crossing)
      {
        this->AddPiece(edge, *from, crossing->X, left, right);
        from = &crossing->X;
        const std::int64_t other = this->All.RingOf(crossing->Other);
        if (other == ring)
        {
          isInLeft = !isInLeft;
        }
        else
        {
          EdgeRows::toggle(others, other);
        }
        findOwners();
      }
      this->AddPiece(edge, *from, this->All.At(this->All.Next(edge)), left, right);
      edge = this->All.Next(edge);
    } while (edge != top);
  }

  // Crossings are sorted by edges, and along each edge from its first point on.
  std::vector<EdgeCrossing>::const_iterator FirstOn(std::int64_t edge) const
  {
    return std::lower_bound(this->Crossings.begin(), this->Crossings.end(), edge,
      [](const EdgeCrossing& crossing, std::int64_t number) { return crossing.Edge < number; });
  }

  // Adds a piece to the outlines of both owners, for each with its region on the left.
  void AddPiece(std::int64_t edge, const Point<2>& from, const Point<2>& to, std::int64_t left,
    std::int64_t right)
  {
    if (left == right || from == to)
    {
      return;
    }
    const auto number = static_cast<std::int32_t>(edge);
    if (left != nobody)
    {
      this->Found.push_back({ from, to, number, static_cast<std::int32_t>(left) });
    }
    if (right != nobody)
    {
      this->Found.push_back({ to, from, number, static_cast<std::int32_t>(right) });
    }
  }

  const Rings& All;
  const std::vector<double>& Values;
  Progress& Stop;
  std::vector<double> Areas; // absolute areas that rings wind around
  std::vector<EdgeCrossing> Crossings;
  std::vector<OutlineEdge> Found;
};

} // namespace

std::vector<OutlineEdge> regionOutlines(
  const Rings& rings, const std::vector<double>& values, Progress& progress, bool* areSimple)
{
  // Two edges enclose no area.
  if (rings.Edges() < 3)
  {
    return {};
  }
  bool ignored = false;
  return OutlineWalk(rings, values, progress, areSimple ? *areSimple : ignored).Run();
}

// Area and centroid by the shoelace formula, about a point of the region: A = sum (a x b) / 2, c =
// sum (a x b) (a + b) / (6 A).
RegionSize sizeOfRegion(const OutlineEdge* first, const OutlineEdge* last)
{
  RegionSize size;
  if (first == last)
  {
    return size;
  }
  const Point<2> origin = first->From;
  for (const OutlineEdge* edge = first; edge != last; ++edge)
  {
    const Point<2> a{ edge->From[0] - origin[0], edge->From[1] - origin[1] };
    const Point<2> b{ edge->To[0] - origin[0], edge->To[1] - origin[1] };
    const double area = 0.5 * (a[0] * b[1] - a[1] * b[0]);
    size.Area += area;
    size.Centroid[0] += area * (a[0] + b[0]) / 3.0;
    size.Centroid[1] += area * (a[1] + b[1]) / 3.0;
  }
  for (int axis = 0; axis < 2; ++axis)
  {
    size.Centroid[axis] = origin[axis] + (size.Area > 0.0 ? size.Centroid[axis] / size.Area : 0.0);
  }
  // Rounding may leave a tiny negative area.
  size.Area = std::max(size.Area, 0.0);
  return size;
}

// The shoelace formula about the ring's first point.
double windingArea(const Rings& rings, std::int64_t ring)
{
  double area = 0.0;
  for (std::int64_t i = rings.Begin(ring); i < rings.Begin(ring + 1); ++i)
  {
    const Point<2>& origin = rings.At(rings.Begin(ring));
    const Point<2>& a = rings.At(i);
    const Point<2>& b = rings.At(rings.Next(i));
    area +=
      0.5 * ((a[0] - origin[0]) * (b[1] - origin[1]) - (a[1] - origin[1]) * (b[0] - origin[0]));
  }
  return area;
}

} // namespace RectifiedTransport
