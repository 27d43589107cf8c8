// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Overlap/RingTriangles.h"

#include "Core/Geometry/Trees/Bins.h"
#include "Core/Overlap/EdgeCrossings.h"
#include "Core/Overlap/EdgeOrder.h"
#include "Core/Overlap/MonotoneStrips.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace RectifiedTransport
{

namespace
{

// The points of rings and their crossings in the order of a line that sweeps upwards, those with
// equal coordinates as one, and the pieces of edges between them.
class SweptEdges
{
public:
  SweptEdges(const Rings& rings, Progress& progress)
    : Given(rings)
  {
    bool areSimple = false;
    // Rings with common points need no crossings there: equal places are one point.
    constexpr bool atEnds = false;
    this->Crossings = edgeCrossings(rings, progress, areSimple, atEnds);
    this->SortPoints();
    this->Above.Fill(this->Places.size(), [this](const auto& add) { this->VisitPieces(add); });
  }

  // The points from the lowest to the highest; those on one height from left to right.
  const std::vector<Point<2>>& All() const { return this->Places; }
  double Rounding() const { return this->Unit; } // unit of the rounded coordinates
  const Point<2>& At(std::int32_t point) const { return this->Places[Index(point)]; }
  NumberedPoint Numbered(std::int32_t point) const { return { this->At(point), point }; }
  // The upper ends of the pieces that begin at a point.
  Bins<std::int32_t>::Range EndsAbove(std::int32_t point) const
  {
    return this->Above[Index(point)];
  }

  // Turns the corners of triangles from sweep numbers to those of the rings' points. Crossings that
  // triangles have become added points.
  void Renumber(RingTriangles& triangles) const
  {
    const auto count = static_cast<std::int32_t>(this->Given.Edges());
    std::vector<std::int32_t> numbers = this->Numbers;
    for (std::int32_t& number : numbers)
    {
      if (number >= count)
      {
        const EdgeCrossing& crossing = this->Crossings[Index(number - count)];
        const Point<2>& a = this->Given.At(crossing.Edge);
        const Point<2>& b = this->Given.At(this->Given.Next(crossing.Edge));
        const double square = (b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]);
        number = count + static_cast<std::int32_t>(triangles.Added.size());
        triangles.Added.push_back(
          { crossing.X, crossing.Edge, std::clamp(crossing.Along / square, 0.0, 1.0) });
      }
    }
    for (std::array<std::int32_t, 3>& corners : triangles.Corners)
    {
      for (std::int32_t& corner : corners)
      {
        corner = numbers[Index(corner)];
      }
    }
  }

private:
  static std::size_t Index(std::int32_t i) { return static_cast<std::size_t>(i); }

  // The places of the points of rings, then of crossings, rounded: places that differ by rounding
  // errors are mostly equal then.
  // Places are rounded to 48 of the 53 bits of the largest coordinate: crossings have errors of a
  // few units in the last place, and should become equal to points that they lie on.
  std::vector<Point<2>> RoundedPlaces()
  {
    constexpr int bits = 48; // bits of 53 that stay
    std::vector<Point<2>> places;
    double largest = 0.0;
    for (std::int64_t i = 0; i < this->Given.Edges(); ++i)
    {
      places.push_back(this->Given.At(i));
      largest = std::max({ largest, std::abs(places.back()[0]), std::abs(places.back()[1]) });
    }
    for (const EdgeCrossing& crossing : this->Crossings)
    {
      places.push_back(crossing.X);
    }
    int exponent = 0;
    // largest < 2^exponent
    std::frexp(largest, &exponent);
    this->Unit =
      std::ldexp(1.0, std::max(exponent - bits, std::numeric_limits<double>::min_exponent));
    for (Point<2>& place : places)
    {
      place = { std::round(place[0] / this->Unit) * this->Unit,
        std::round(place[1] / this->Unit) * this->Unit };
    }
    return places;
  }

  // Sorts by height, then from left to right, and numbers each place once.
  void SortPoints()
  {
    const std::vector<Point<2>> places = this->RoundedPlaces();
    std::vector<std::int32_t> order(places.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&places](std::int32_t i, std::int32_t j) {
      const Point<2>& p = places[Index(i)];
      const Point<2>& q = places[Index(j)];
      return p[1] != q[1] ? p[1] < q[1] : p[0] != q[0] ? p[0] < q[0] : i < j;
    });
    this->Swept.resize(order.size());
    for (const std::int32_t number : order)
    {
      if (this->Places.empty() || this->Places.back() != places[Index(number)])
      {
        this->Places.push_back(places[Index(number)]);
        this->Numbers.push_back(number);
      }
      this->Swept[Index(number)] = static_cast<std::int32_t>(this->Places.size()) - 1;
    }
  }

  // Calls add(lower end, upper end) for all pieces of edges that are longer than 0. The crossings
  // are in the order of the edges and along them.
  template <class Add>
  void VisitPieces(const Add& add) const
  {
    const auto count = static_cast<std::int32_t>(this->Given.Edges());
    auto crossing = this->Crossings.begin();
    for (std::int32_t edge = 0; edge < count; ++edge)
    {
      std::int32_t from = this->Swept[Index(edge)];
      // From the lower to the higher end, as numbers of the sweep ascend.
      const auto addTo = [&](std::int32_t to) {
        if (from != to)
        {
          add(Index(std::min(from, to)), std::max(from, to));
        }
        from = to;
      };
      for (; crossing != this->Crossings.end() && crossing->Edge == edge; ++crossing)
      {
        addTo(
          this
            ->Swept[Index(count + static_cast<std::int32_t>(crossing - this->Crossings.begin()))]);
      }
      addTo(this->Swept[Index(static_cast<std::int32_t>(this->Given.Next(edge)))]);
    }
  }

  const Rings& Given;
  std::vector<EdgeCrossing> Crossings;
  double Unit = 0.0;                 // unit of coordinates
  std::vector<Point<2>> Places;      // in the order of the sweep
  std::vector<std::int32_t> Numbers; // by places: a ring's point or, numbered on, a crossing
  std::vector<std::int32_t> Swept;   // places, by the rings' points and crossings
  Bins<std::int32_t> Above;          // upper ends of pieces, by lower ends
};

// Moves a line upwards over the edges. Between each two of the edges that it meets, from left to
// right, the plane is inside and outside in turn; each part inside is a strip that grows with the
// points on its sides. Where an outer part ends, two strips are one part until the next point, to
// which an edge divides it again.
//
// An edge that passes a point to rounding is divided there: touching edges need nothing else, and
// the rounded places of crossings do no harm.
class StripSweep
{
public:
  StripSweep(const SweptEdges& edges, std::vector<std::array<std::int32_t, 3>>& triangles)
    : Swept(edges)
    , Strips(edges.All(), triangles)
    , Ending(edges.All().size(), 0)
  {
  }

  void Run(Progress& progress)
  {
    constexpr std::int32_t betweenPolls = 1 << 14;
    const auto count = static_cast<std::int32_t>(this->Ending.size());
    for (std::int32_t point = 0; point < count; ++point)
    {
      if (point % betweenPolls == 0 && progress.ShouldStop())
      {
        return;
      }
      this->Pass(point);
    }
  }

private:
  static constexpr std::int32_t none = -1;

  // What is between two neighbouring edges of the line: no strip outside, one inside, two after a
  // point where two parts have joined.
  struct Part
  {
    std::int32_t Strip = none;
    std::int32_t Second = none; // to the right of the first

    bool IsInside() const { return this->Strip != none; }
  };

  struct Edge
  {
    std::int32_t Low;
    std::int32_t High;
    Part Right; // what is between this edge and the next one
  };

  // Some edges that follow each other in the order.
  struct Range
  {
    EdgeOrder::Place First;
    int Count;
  };

  Edge& At(std::int32_t edge) { return this->Met[static_cast<std::size_t>(edge)]; }

  // -1 if an edge lies to the left of the point, 1 to the right, 0 if it passes it up to rounding.
  int SideOf(std::int32_t edge, std::int32_t point)
  {
    const Point<2>& low = this->Swept.At(this->At(edge).Low);
    const Point<2>& high = this->Swept.At(this->At(edge).High);
    double error = 0.0;
    const double area = doubleArea(low, high, this->Swept.At(point), error);
    // A place is rounded by half a unit along each axis: as much area as the unit times the edge's
    // extents.
    error += this->Swept.Rounding() * (std::abs(high[0] - low[0]) + std::abs(high[1] - low[1]));
    return area > error ? 1 : area < -error ? -1 : 0;
  }

  // The edges that end at a point or pass it: they follow each other in the order, unless rounding
  // has changed that.
  Range EdgesAt(std::int32_t point)
  {
    Range range{ this->Order.Find([&](std::int32_t edge) { return this->SideOf(edge, point) < 0; }),
      0 };
    // The edges that end here must all be in the range, else the order has changed.
    int ending = 0;
    for (EdgeOrder::Place place = range.First; this->Order.At(place) != EdgeOrder::nothing &&
         this->SideOf(this->Order.At(place), point) == 0;
         place = this->Order.Next(place))
    {
      ++range.Count;
      ending += this->At(this->Order.At(place)).High == point ? 1 : 0;
    }
    return ending == this->Ending[static_cast<std::size_t>(point)] ? range : this->EdgesUpTo(point);
  }

  // The edges from the first to the last one that end at the point. This is for cases where
  // rounding has brought edges into another order, and includes all edges between them.
  Range EdgesUpTo(std::int32_t point)
  {
    Range range{ { 0, 0 }, 0 };
    int left = this->Ending[static_cast<std::size_t>(point)];
    for (EdgeOrder::Place place = range.First; left > 0; place = this->Order.Next(place))
    {
      const bool isEnding = this->At(this->Order.At(place)).High == point;
      range.First = range.Count == 0 ? place : range.First;
      range.Count += isEnding || range.Count > 0 ? 1 : 0;
      left -= isEnding ? 1 : 0;
    }
    return range;
  }

  // Finds the upper ends of the edges from a point, from left to right. Edges that pass the point
  // begin again there. Two edges on each other cancel, by the even-odd rule.
  void FindEnds(std::int32_t point)
  {
    this->Ends.assign(this->Swept.EndsAbove(point).begin(), this->Swept.EndsAbove(point).end());
    for (const std::int32_t edge : this->Below)
    {
      if (this->At(edge).High != point)
      {
        this->Ends.push_back(this->At(edge).High);
      }
    }
    const NumberedPoint at = this->Swept.Numbered(point);
    std::sort(this->Ends.begin(), this->Ends.end(), [&](std::int32_t i, std::int32_t j) {
      return i != j && turnsLeft(at, this->Swept.Numbered(j), this->Swept.Numbered(i));
    });
    // An even number of edges on each other cancels, an odd number leaves one.
    std::size_t kept = 0;
    for (const std::int32_t end : this->Ends)
    {
      const bool isTwice = kept > 0 && this->Ends[kept - 1] == end;
      kept = isTwice ? kept - 1 : kept + 1;
      if (!isTwice)
      {
        this->Ends[kept - 1] = end;
      }
    }
    this->Ends.resize(kept);
  }

  // Moves the line past a point: takes out the edges that end or pass there, lets strips grow or
  // end, and puts in the edges from there upwards.
  void Pass(std::int32_t point)
  {
    Range range = this->EdgesAt(point);
    const std::int32_t leftEdge = this->Order.Before(range.First);
    this->Below.clear();
    for (; range.Count > 0; --range.Count)
    {
      this->Below.push_back(this->Order.At(range.First));
      --this->Ending[static_cast<std::size_t>(this->At(this->Below.back()).High)];
      range.First = this->Order.Erase(range.First);
    }
    this->FindEnds(point);
    // What is to the left of the point, and to the right of its lower edges.
    Part left = leftEdge == EdgeOrder::nothing ? Part() : this->At(leftEdge).Right;
    Part right = this->Below.empty() ? left : this->At(this->Below.back()).Right;
    this->Grow(point, left, right);
    if (leftEdge != EdgeOrder::nothing)
    {
      this->At(leftEdge).Right = left;
    }
    this->BeginEdges(point, range.First, left.IsInside(), right);
  }

  // Lets strips grow: the one to the left gets the point on its right side, the one to the right on
  // its left side; those between the edges below end. Without edges below, an edge that begins
  // within a strip divides it.
  void Grow(std::int32_t point, Part& left, Part& right)
  {
    if (this->Below.empty())
    {
      if (left.IsInside() && !this->Ends.empty())
      {
        this->Divide(point, left, right);
      }
      return;
    }
    for (std::size_t i = 0; i + 1 < this->Below.size(); ++i)
    {
      const Part& part = this->At(this->Below[i]).Right;
      // A part between two edges that end here ends, too.
      this->End(part.Strip, point);
      this->End(part.Second, point);
    }
    if (left.IsInside())
    {
      this->End(left.Second, point);
      this->Strips.Add(left.Strip, point, StripSide::Right);
      left.Second = none;
    }
    if (right.IsInside())
    {
      if (right.Second != none)
      {
        this->End(right.Strip, point);
        right = { right.Second, none };
      }
      this->Strips.Add(right.Strip, point, StripSide::Left);
    }
    // Two parts join where no edge goes on upwards. They stay two strips until the next point.
    if (left.IsInside() && this->Ends.empty())
    {
      left.Second = right.Strip;
    }
  }

  // A part of two strips is divided already: the point is above both.
  void Divide(std::int32_t point, Part& left, Part& right)
  {
    std::array<std::int32_t, 2> both{ left.Strip, left.Second };
    if (left.Second == none)
    {
      both = this->Strips.Divide(left.Strip, point);
    }
    else
    {
      this->Strips.Add(left.Strip, point, StripSide::Right);
      this->Strips.Add(left.Second, point, StripSide::Left);
    }
    left = { both[0], none };
    right = { both[1], none };
  }

  void End(std::int32_t strip, std::int32_t point)
  {
    if (strip != none)
    {
      this->Strips.End(strip, point);
    }
  }

  // Puts in the edges from a point upwards, between the edges beside it. Each changes inside and
  // outside; a new strip begins in each new part inside.
  void BeginEdges(
    std::int32_t point, const EdgeOrder::Place& place, bool isInside, const Part& right)
  {
    if (this->Ends.empty())
    {
      return;
    }
    this->Below.clear();
    for (const std::int32_t end : this->Ends)
    {
      isInside = !isInside;
      // The last edge has the point's right part to its right.
      const bool isLast = this->Below.size() + 1 == this->Ends.size();
      const std::int32_t strip = isInside && !isLast ? this->Strips.Begin(point) : none;
      this->Below.push_back(static_cast<std::int32_t>(this->Met.size()));
      this->Met.push_back({ point, end, isLast ? right : Part{ strip, none } });
      ++this->Ending[static_cast<std::size_t>(end)];
    }
    this->Order.Insert(place, this->Below.data(), this->Below.data() + this->Below.size());
  }

  const SweptEdges& Swept;
  MonotoneStrips Strips;
  std::vector<int> Ending; // numbers of edges of the order that end, by points
  std::vector<Edge> Met;   // all edges so far
  EdgeOrder Order;
  std::vector<std::int32_t> Below; // edges at the point that is passed
  std::vector<std::int32_t> Ends;  // upper ends of the edges that begin
};

} // namespace

RingTriangles triangulateRings(const Rings& rings, Progress& progress)
{
  RingTriangles triangles;
  if (rings.Edges() >= 3)
  {
    const SweptEdges edges(rings, progress);
    StripSweep(edges, triangles.Corners).Run(progress);
    edges.Renumber(triangles);
  }
  return triangles;
}

} // namespace RectifiedTransport
