// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Overlap/RingCrossings.h"

#include "Core/Geometry/PointBounds.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace RectifiedTransport
{

namespace
{

// Eight doubles fill a vector of AVX-512, or two of AVX2.
constexpr std::size_t lanes = 8;
// For these few edges the comparison of all pairs is faster than sorting into bins.
constexpr std::size_t comparedAll = 64;   // edges; fewer are not put into bins
constexpr std::size_t dividedAgain = 384; // edges; bins of more are divided again
// Bins whose edges all lie on each other cannot be divided further: the depth has a limit.
constexpr int mostDivisions = 4;
constexpr double recordsPerEdge = 4.0; // about

using Box = Bounds<2>;

// Finds the pairs of edges that may cross by a uniform grid of bins, refined where many edges share
// a bin; compares all pairs in a bin, and decides by exact predicates.
class CrossingSearch
{
public:
  CrossingSearch(const Rings& rings, Progress& progress, bool atEnds)
    : All(rings)
    , AtEnds(atEnds)
    , Stop(progress)
  {
  }

  // Finds the crossings among edges within a box. `divisions` counts the levels of bins above these
  // edges.
  void Search(const std::vector<std::int32_t>& edges, const Box& box, int divisions)
  {
    if (edges.size() <= comparedAll || divisions >= mostDivisions)
    {
      this->Compare(edges.data(), edges.size());
      return;
    }
    this->SearchBins(edges, box, divisions);
  }

  // A pair may have been found in several bins.
  std::vector<EdgePair> Take()
  {
    const auto isLess = [](const EdgePair& a, const EdgePair& b) {
      return a.First != b.First ? a.First < b.First : a.Second < b.Second;
    };
    // The order of the pairs does not depend on the bins.
    std::sort(this->Found.begin(), this->Found.end(), isLess);
    this->Found.erase(std::unique(this->Found.begin(), this->Found.end(),
                        [](const EdgePair& a, const EdgePair& b) {
                          return a.First == b.First && a.Second == b.Second;
                        }),
      this->Found.end());
    return std::move(this->Found);
  }

private:
  // Equal bins over a box, axis 0 fastest.
  struct Bins
  {
    Point<2> Low;
    Point<2> Width;
    std::array<std::int64_t, 2> Size;

    // Rounded onto the border bins where x is beyond the box.
    std::int64_t At(int axis, double x) const
    {
      const double bin = (x - this->Low[axis]) / this->Width[axis];
      return static_cast<std::int64_t>(
        std::clamp(bin, 0.0, static_cast<double>(this->Size[axis] - 1)));
    }
    Box Of(std::size_t bin) const
    {
      // bin = place_0 + size_0 place_1
      const auto number = static_cast<std::int64_t>(bin);
      Box box;
      for (int a = 0; a < 2; ++a)
      {
        const std::int64_t place = a == 0 ? number % this->Size[0] : number / this->Size[0];
        box.Low[a] = this->Low[a] + static_cast<double>(place) * this->Width[a];
        box.High[a] = box.Low[a] + this->Width[a];
      }
      return box;
    }
  };

  // Bins about as wide and high as the edges are, and at most as many as there are edges.
  Bins BinsFor(const std::vector<std::int32_t>& edges, const Box& box) const
  {
    const auto count = static_cast<double>(edges.size());
    Point<2> lengths{ 0.0, 0.0 };
    for (const std::int32_t edge : edges)
    {
      const Point<2>& a = this->All.At(edge);
      const Point<2>& b = this->All.At(this->All.Next(edge));
      for (int axis = 0; axis < 2; ++axis)
      {
        // The sum of the edges' extents along the axis; those beyond the box count no more than it.
        lengths[axis] += std::min(std::abs(b[axis] - a[axis]), box.Length(axis));
      }
    }
    Point<2> most;
    // An edge of the mean length reaches 2 bins along each axis: 4 records in all.
    for (int a = 0; a < 2; ++a)
    {
      most[a] = std::clamp(0.5 * recordsPerEdge * count * box.Length(a) / lengths[a], 1.0, count);
      most[a] = box.Length(a) > 0.0 ? most[a] : 1.0;
    }
    // The number of bins is at most that of edges: both sizes shrink by the same factor.
    const double tooMany = std::max(1.0, std::sqrt(most[0] * most[1] / count));
    Bins bins{ box.Low, {}, {} };
    for (int a = 0; a < 2; ++a)
    {
      const double size = std::clamp(std::floor(most[a] / tooMany), 1.0, count);
      bins.Size[static_cast<std::size_t>(a)] = static_cast<std::int64_t>(size);
      bins.Width[a] = box.Length(a) > 0.0 ? box.Length(a) / size : 1.0;
    }
    return bins;
  }

  // Calls visit(bin) for the bins that an edge reaches, and for some beside them. A long edge is
  // cut by rows, so that it reaches a band of bins, not all bins of its bounds.
  template <class Visit>
  void VisitBins(const Bins& bins, std::int32_t edge, const Visit& visit) const
  {
    constexpr double slack = 1e-6; // part of a bin; far above rounding, so that no bin is missed
    const Point<2>* a = &this->All.At(edge);
    const Point<2>* b = &this->All.At(this->All.Next(edge));
    if ((*a)[1] > (*b)[1])
    {
      std::swap(a, b);
    }
    const Point<2> margin{ slack * bins.Width[0], slack * bins.Width[1] };
    // dx / dy from the lower end; infinite or NaN for horizontal edges, which are in one row.
    const double slope = ((*b)[0] - (*a)[0]) / ((*b)[1] - (*a)[1]);
    const double low = std::min((*a)[0], (*b)[0]);
    const double high = std::max((*a)[0], (*b)[0]);
    const std::int64_t first = bins.At(1, (*a)[1] - margin[1]);
    const std::int64_t last = bins.At(1, (*b)[1] + margin[1]);
    for (std::int64_t row = first; row <= last; ++row)
    {
      // The range along axis 0 that the edge has in the row, from its points at the row's lower and
      // upper end.
      double from = low;
      double to = high;
      if (first != last && high - low > bins.Width[0])
      {
        const double y = bins.Low[1] + static_cast<double>(row) * bins.Width[1];
        const double under =
          row == first ? (*a)[0] : (*a)[0] + (std::max(y - margin[1], (*a)[1]) - (*a)[1]) * slope;
        const double over = row == last
          ? (*b)[0]
          : (*a)[0] + (std::min(y + bins.Width[1] + margin[1], (*b)[1]) - (*a)[1]) * slope;
        from = std::max(low, std::min(under, over));
        to = std::min(high, std::max(under, over));
      }
      const std::int64_t end = bins.At(0, to + margin[0]);
      for (std::int64_t i = bins.At(0, from - margin[0]); i <= end; ++i)
      {
        visit(static_cast<std::size_t>(row * bins.Size[0] + i));
      }
    }
  }

  // Sorts the edges by bins (counting sort over records), then compares or divides the edges of
  // each.
  void SearchBins(const std::vector<std::int32_t>& edges, const Box& box, int divisions)
  {
    // The sort keeps the order of the edges in each bin: begin[bin + 1] is where its next edge
    // goes, and after the sort where it ends.
    const Bins bins = this->BinsFor(edges, box);
    struct Record
    {
      std::uint32_t Bin;
      std::int32_t Edge;
    };
    // One record for each pair of a bin and an edge that reaches it.
    std::vector<Record> records;
    records.reserve(edges.size() * static_cast<std::size_t>(recordsPerEdge));
    std::vector<std::size_t> begin(static_cast<std::size_t>(bins.Size[0] * bins.Size[1]) + 2, 0);
    for (const std::int32_t edge : edges)
    {
      this->VisitBins(bins, edge, [&](std::size_t bin) {
        records.push_back({ static_cast<std::uint32_t>(bin), edge });
        ++begin[bin + 2];
      });
    }
    for (std::size_t bin = 2; bin < begin.size(); ++bin)
    {
      begin[bin] += begin[bin - 1];
    }
    std::vector<std::int32_t> sorted(records.size());
    for (const Record& record : records)
    {
      sorted[begin[record.Bin + 1]++] = record.Edge;
    }
    for (std::size_t bin = 0; bin + 2 < begin.size() && !this->ShouldStop(); ++bin)
    {
      // Edges of the bin are sorted[begin[bin]] on.
      const std::size_t count = begin[bin + 1] - begin[bin];
      const std::int32_t* first = sorted.data() + begin[bin];
      // Bins are divided again only if the edges in them leave most of the box empty: else bins
      // would hold the same edges once more.
      const Box part = count > dividedAgain ? this->BoxWithin(bins.Of(bin), first, count) : box;
      const bool isMuchSmaller = 4.0 * part.Length(0) < box.Length(0) + box.Length(1) &&
        4.0 * part.Length(1) < box.Length(0) + box.Length(1);
      if (isMuchSmaller)
      {
        this->Search({ first, first + count }, part, divisions + 1);
      }
      else
      {
        this->Compare(first, count);
      }
    }
  }

  // The bounds of the parts of edges within a box: of their ends, clamped to it.
  Box BoxWithin(const Box& box, const std::int32_t* edges, std::size_t count) const
  {
    Box within;
    for (std::size_t i = 0; i < count; ++i)
    {
      for (const std::int64_t end : { std::int64_t{ edges[i] }, this->All.Next(edges[i]) })
      {
        Point<2> x = this->All.At(end);
        for (std::size_t a = 0; a < 2; ++a)
        {
          x[a] = std::clamp(x[a], box.Low[a], box.High[a]);
        }
        within.Add(x.data());
      }
    }
    return within;
  }

  // Orders edges so that those that have an end in one place come one after the other. Where such
  // ends do not count as crossings, the edges of a fan need no comparison with each other: of n
  // edges, n^2 pairs are left out.
  void GatherFans(const std::int32_t* edges, std::size_t count)
  {
    struct End
    {
      Point<2> Place;
      std::size_t Edge;
    };
    std::vector<End> ends;
    for (std::size_t i = 0; i < count; ++i)
    {
      // Both ends of each edge, sorted by place: equal places are fans.
      ends.push_back({ this->All.At(edges[i]), i });
      ends.push_back({ this->All.At(this->All.Next(edges[i])), i });
    }
    std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) {
      return a.Place != b.Place ? a.Place < b.Place : a.Edge < b.Edge;
    });
    // An edge belongs to the larger fan of its two ends, since each edge has one place in the
    // order.
    std::vector<std::size_t> size(count, 0); // number of edges in the larger fan of each edge
    std::vector<std::size_t> fan(count);
    for (std::size_t first = 0, last = 0; first < ends.size(); first = last)
    {
      while (last < ends.size() && ends[last].Place == ends[first].Place)
      {
        ++last;
      }
      for (std::size_t i = first; i < last; ++i)
      {
        const std::size_t edge = ends[i].Edge;
        if (last - first > size[edge])
        {
          size[edge] = last - first;
          fan[edge] = first;
        }
      }
    }
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{ 0 });
    std::sort(order.begin(), order.end(),
      [&fan](std::size_t i, std::size_t j) { return fan[i] != fan[j] ? fan[i] < fan[j] : i < j; });
    this->Gathered.resize(count);
    this->Others.resize(count);
    for (std::size_t i = count; i-- > 0;)
    {
      this->Gathered[i] = edges[order[i]];
      const bool isLast = i + 1 == count || fan[order[i]] != fan[order[i + 1]];
      // Filled from the back: the end of a fan is passed on to its edges.
      this->Others[i] = isLast ? i + 1 : this->Others[i + 1];
    }
  }

  // Compares all pairs. Coordinates lie in separate arrays, padded to whole lanes with the last
  // edge.
  void Compare(const std::int32_t* edges, std::size_t count)
  {
    // Gathering costs a sort, which pays for large bins only.
    const bool hasFans = !this->AtEnds && count > dividedAgain;
    if (hasFans)
    {
      this->GatherFans(edges, count);
      edges = this->Gathered.data();
    }
    for (std::vector<double>& values : this->Ends)
    {
      values.resize((count + lanes - 1) / lanes * lanes);
    }
    Box box;
    for (std::size_t i = 0; i < this->Ends[0].size(); ++i)
    {
      const std::int32_t edge = edges[std::min(i, count - 1)];
      const Point<2>& a = this->All.At(edge);
      const Point<2>& b = this->All.At(this->All.Next(edge));
      for (int axis = 0; axis < 2; ++axis)
      {
        this->Ends[static_cast<std::size_t>(axis)][i] = a[axis];
        this->Ends[static_cast<std::size_t>(2 + axis)][i] = b[axis];
      }
      box.Add(a.data());
      box.Add(b.data());
    }
    // The differences of coordinates below are at most this large, which bounds their rounding.
    const double extent = std::max(box.Length(0), box.Length(1));
    for (std::size_t i = 0; i + 1 < count && !this->ShouldStop(); ++i)
    {
      this->CompareWith(edges, i, hasFans ? this->Others[i] : i + 1, count, extent);
    }
  }

  // Compares an edge with those of a range. Eight lanes at a time are rejected if both ends are on
  // one side of the edge's line by more than rounding; most pairs end there.
  void CompareWith(
    const std::int32_t* edges, std::size_t i, std::size_t begin, std::size_t end, double extent)
  {
    const double* ax = this->Ends[0].data();
    const double* ay = this->Ends[1].data();
    const double* bx = this->Ends[2].data();
    const double* by = this->Ends[3].data();
    const double x = ax[i];
    const double y = ay[i];
    const double dx = bx[i] - x;
    const double dy = by[i] - y;
    // Bounds the rounding of the two cross products: coordinates differ by at most the extent.
    const double error =
      8.0 * std::numeric_limits<double>::epsilon() * extent * (std::abs(dx) + std::abs(dy));
    for (std::size_t first = begin / lanes * lanes; first < end; first += lanes)
    {
      std::array<double, lanes> beside; // how far both ends are on one side
      for (std::size_t l = 0; l < lanes; ++l)
      {
        const std::size_t j = first + l;
        // Twice the area of the triangles with both ends of edge j: the sides on which they are.
        const double from = dx * (ay[j] - y) - dy * (ax[j] - x);
        const double to = dx * (by[j] - y) - dy * (bx[j] - x);
        beside[l] = std::max(std::min(from, to), std::min(-from, -to));
      }
      for (std::size_t l = 0; l < lanes; ++l)
      {
        const std::size_t j = first + l;
        if (!(beside[l] > error) && j >= begin && j < end)
        {
          this->CompareTwo(edges[i], edges[j]);
        }
      }
      this->Compared += static_cast<std::int64_t>(lanes);
    }
  }

  // Exact: neighbours in a ring share a point and do not cross; then bounds; then the perturbed
  // predicate.
  void CompareTwo(std::int32_t i, std::int32_t j)
  {
    const std::int64_t endOfI = this->All.Next(i);
    const std::int64_t endOfJ = this->All.Next(j);
    if (endOfI == j || endOfJ == i)
    {
      return;
    }
    const NumberedPoint a = this->All.Numbered(i);
    const NumberedPoint b = this->All.Numbered(endOfI);
    const NumberedPoint c = this->All.Numbered(j);
    const NumberedPoint d = this->All.Numbered(endOfJ);
    for (int axis = 0; axis < 2; ++axis)
    {
      if (std::max(a.X[axis], b.X[axis]) < std::min(c.X[axis], d.X[axis]) ||
        std::max(c.X[axis], d.X[axis]) < std::min(a.X[axis], b.X[axis]))
      {
        return;
      }
    }
    // Edges of one place touch there; the perturbation may make them cross.
    const bool isAtEnds = a.X == c.X || a.X == d.X || b.X == c.X || b.X == d.X;
    if ((this->AtEnds || !isAtEnds) && doCross(a, b, c, d))
    {
      this->Found.push_back({ std::min(i, j), std::max(i, j) });
    }
  }

  // Polls for an abort after about 65536 comparisons, as a poll takes longer than a comparison.
  bool ShouldStop()
  {
    constexpr std::int64_t betweenPolls = std::int64_t{ 1 } << 16;
    if (++this->Compared > betweenPolls)
    {
      this->Compared = 0;
      this->Stopped = this->Stopped || this->Stop.ShouldStop();
    }
    return this->Stopped;
  }

  const Rings& All;
  const bool AtEnds;
  Progress& Stop;
  std::int64_t Compared = 0; // since the last poll
  bool Stopped = false;
  std::array<std::vector<double>, 4> Ends; // x and y of both ends, of the edges to compare
  std::vector<std::int32_t> Gathered;      // edges, by their fans
  std::vector<std::size_t> Others;         // by gathered edges: the first one after its fan
  std::vector<EdgePair> Found;
};

} // namespace

// The last point of a ring leads back to its first.
void Rings::EndRing()
{
  const std::int64_t begin = this->Begins.back();
  const auto ring = static_cast<std::int32_t>(this->Count());
  for (std::int64_t i = begin; i < this->Edges(); ++i)
  {
    this->Nexts.push_back(static_cast<std::int32_t>(i + 1 < this->Edges() ? i + 1 : begin));
    this->Owners.push_back(ring);
  }
  this->Begins.push_back(this->Edges());
}

// Memory is allocated once for all points that are about to be added.
void Rings::Reserve(std::int64_t points)
{
  this->Points.reserve(Index(points));
  this->Nexts.reserve(Index(points));
  this->Owners.reserve(Index(points));
}

// Three edges of one ring are neighbours, which do not cross: four are the fewest.
std::vector<EdgePair> findCrossings(const Rings& rings, Progress& progress, bool atEnds)
{
  if (rings.Edges() < 4)
  {
    return {};
  }
  Box box;
  std::vector<std::int32_t> edges;
  edges.reserve(static_cast<std::size_t>(rings.Edges()));
  for (std::int64_t i = 0; i < rings.Edges(); ++i)
  {
    box.Add(rings.At(i).data());
    edges.push_back(static_cast<std::int32_t>(i));
  }
  CrossingSearch search(rings, progress, atEnds);
  search.Search(edges, box, 0);
  return search.Take();
}

} // namespace RectifiedTransport
