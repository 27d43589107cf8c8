// SPDX-License-Identifier: BSD-3-Clause
#include "Core/SiteCells/SiteCellPolygons.h"

#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t none = -1; // the label of no site, and a node without a point

// The sides of a pixel are 0 (below), 1 (right), 2 (above) and 3 (left). An edge is a side of a
// pixel that ends its site cell, directed so that the pixel is on its left.
struct Edge
{
  std::int64_t X;
  std::int64_t Y;
  int Side;

  bool operator==(const Edge& other) const
  {
    return this->X == other.X && this->Y == other.Y && this->Side == other.Side;
  }
};

// A grid point between pixels.
struct Node
{
  std::int64_t X;
  std::int64_t Y;
};

// Returns the next side of the same pixel, counter-clockwise.
Edge turnedLeft(const Edge& edge)
{
  return { edge.X, edge.Y, (edge.Side + 1) % 4 };
}

// Returns the same side of the pixel beyond another side.
Edge across(const Edge& edge, int side)
{
  constexpr std::int64_t steps[4][2] = { { 0, -1 }, { 1, 0 }, { 0, 1 }, { -1, 0 } };
  return { edge.X + steps[side][0], edge.Y + steps[side][1], edge.Side };
}

// Returns the node at the end of an edge.
Node headOf(const Edge& edge)
{
  return { edge.X + (edge.Side < 2 ? 1 : 0), edge.Y + (edge.Side == 1 || edge.Side == 2 ? 1 : 0) };
}

// Traces the borders of site cells as rings of pixels' sides, counter-clockwise around pixels. Cuts
// along rows join holes to the rings around them, as polygons have one ring each.
class Polygons
{
public:
  Polygons(const ImageGrid& grid, const std::int64_t* labels)
    : Grid(grid)
    , Size(grid.Size<2>())
    , Labels(labels)
  {
  }

  // Call it once. Throws Cancelled.
  SiteCellPolygons Find(Progress& progress)
  {
    Stages stages(progress, { { "rings", 5 }, { "cut rings", 2 }, { "corners", 3 } });
    // Rings around holes have a negative area. Cuts join each hole to the ring around it, and a
    // second pass finds rings without holes.
    this->FindRings(stages["rings"]);
    if (!this->Holes.empty())
    {
      this->Cuts.resize(static_cast<std::size_t>(this->Size[0] * this->Size[1]), false);
      for (const Hole& hole : this->Holes)
      {
        this->CutFrom(hole);
      }
      this->FindRings(stages["cut rings"]);
    }
    std::stable_sort(this->Outer.begin(), this->Outer.end(),
      [this](const Edge& a, const Edge& b) { return this->LabelAt(a) < this->LabelAt(b); });
    this->PointIds = LargeBuffer<std::int64_t>((this->Size[0] + 1) * (this->Size[1] + 1));
    std::fill_n(this->PointIds.data(), this->PointIds.size(), none);
    const auto count = static_cast<std::int64_t>(this->Outer.size());
    stages["corners"].ForEachInOrder(
      count, 1, [this](std::int64_t i) { this->Append(this->Outer[static_cast<std::size_t>(i)]); },
      1 + count / 64);
    this->Found.First.push_back(static_cast<std::int64_t>(this->Found.CornerIds.size()));
    return std::move(this->Found);
  }

private:
  // The lowest of its leftmost nodes and the lowest of its rightmost nodes, where the cuts begin.
  struct Hole
  {
    std::int64_t Label; // the label around it
    Node Left;
    Node Right;
  };

  std::int64_t LabelAt(std::int64_t x, std::int64_t y) const
  {
    return x < 0 || y < 0 || x >= this->Size[0] || y >= this->Size[1]
      ? none
      : this->Labels[y * this->Size[0] + x];
  }
  std::int64_t LabelAt(const Edge& edge) const { return this->LabelAt(edge.X, edge.Y); }

  std::size_t PixelOf(std::int64_t x, std::int64_t y) const
  {
    return static_cast<std::size_t>(y * this->Size[0] + x);
  }

  // Returns whether the side of a pixel ends its polygon: the label changes, or a cut runs along
  // it.
  bool IsBorder(const Edge& side) const
  {
    const Edge beyond = across(side, side.Side);
    if (this->LabelAt(side) != this->LabelAt(beyond))
    {
      return true;
    }
    return side.Side % 2 == 0 && !this->Cuts.empty() && this->LabelAt(side) != none &&
      this->Cuts[this->PixelOf(side.X, std::max(side.Y, beyond.Y))];
  }

  // Returns the next edge of the ring. It turns left if possible, so that pixels that meet in a
  // corner only are not connected.
  Edge After(const Edge& edge) const
  {
    const Edge left = turnedLeft(edge);
    if (this->IsBorder(left))
    {
      return left;
    }
    const Edge ahead = across(edge, left.Side);
    if (this->IsBorder(ahead))
    {
      return ahead;
    }
    const Edge right = across(ahead, edge.Side);
    return { right.X, right.Y, (right.Side + 3) % 4 };
  }

  // Finds all rings; each has an edge below a pixel, where it begins.
  void FindRings(Progress& progress)
  {
    this->Outer.clear();
    // Every ring has an edge below a pixel, so one bit for each pixel marks the rings that are
    // found.
    this->Seen.assign(static_cast<std::size_t>(this->Size[0] * this->Size[1]), false);
    const std::int64_t rows = std::max<std::int64_t>(1, pixelsOfStep / this->Size[0]);
    progress.ForEachInOrder(
      this->Size[1], 1,
      [this](std::int64_t y) {
        for (std::int64_t x = 0; x < this->Size[0]; ++x)
        {
          const Edge edge{ x, y, 0 };
          if (this->LabelAt(edge) != none && !this->Seen[this->PixelOf(x, y)] &&
            this->IsBorder(edge))
          {
            this->FindRing(edge);
          }
        }
      },
      rows);
  }

  // Walks around one ring from an edge below a pixel back to it, and decides whether it is a hole.
  void FindRing(const Edge& begin)
  {
    // The signed area is the integral of x dy around the ring.
    std::int64_t area = 0; // signed
    Hole hole{ this->LabelAt(begin), headOf(begin), headOf(begin) };
    Edge edge = begin;
    do
    {
      if (edge.Side == 0)
      {
        this->Seen[this->PixelOf(edge.X, edge.Y)] = true;
      }
      const Node node = headOf(edge);
      area += edge.Side == 1 ? node.X : (edge.Side == 3 ? -node.X : 0);
      if (node.X < hole.Left.X || (node.X == hole.Left.X && node.Y < hole.Left.Y))
      {
        hole.Left = node;
      }
      if (node.X > hole.Right.X || (node.X == hole.Right.X && node.Y < hole.Right.Y))
      {
        hole.Right = node;
      }
      edge = this->After(edge);
    } while (!(edge == begin));
    if (area > 0)
    {
      this->Outer.push_back(begin);
    }
    else
    {
      this->Holes.push_back(hole);
    }
  }

  // Cuts along the sides of pixels, to the left and to the right of the hole, up to the next
  // ring of the polygon.
  void CutFrom(const Hole& hole)
  {
    const auto cut = [&](std::int64_t x, std::int64_t y) {
      // A cut runs between two pixels of the polygon; it ends at the next ring.
      const bool isInside =
        this->LabelAt(x, y) == hole.Label && this->LabelAt(x, y - 1) == hole.Label;
      if (isInside)
      {
        this->Cuts[this->PixelOf(x, y)] = true;
      }
      return isInside;
    };
    for (std::int64_t x = hole.Left.X - 1; cut(x, hole.Left.Y); --x)
    {
    }
    for (std::int64_t x = hole.Right.X; cut(x, hole.Right.Y); ++x)
    {
    }
  }

  // Adds a polygon with corners where its ring turns or where other polygons meet it.
  void Append(const Edge& outer)
  {
    this->Found.First.push_back(static_cast<std::int64_t>(this->Found.CornerIds.size()));
    this->Found.SiteIds.push_back(this->LabelAt(outer));
    Edge edge = outer;
    do
    {
      const Edge next = this->After(edge);
      if (next.Side != edge.Side || this->IsShared(headOf(edge)))
      {
        this->AddCorner(headOf(edge));
      }
      edge = next;
    } while (!(edge == outer));
  }

  // Returns whether a node needs a corner although the polygon goes straight on: another polygon
  // ends there.
  bool IsShared(const Node& node) const
  {
    // The four sides of pixels that meet in the node.
    const Edge sides[4] = { { node.X, node.Y, 3 }, { node.X - 1, node.Y, 0 },
      { node.X - 1, node.Y - 1, 1 }, { node.X, node.Y - 1, 2 } };
    return std::count_if(std::begin(sides), std::end(sides),
             [this](const Edge& side) { return this->IsBorder(side); }) > 2;
  }

  // Polygons share the point of a node, which is made when the first one has a corner there.
  void AddCorner(const Node& node)
  {
    std::int64_t& point = this->PointIds.data()[node.Y * (this->Size[0] + 1) + node.X];
    if (point == none)
    {
      const double index[2] = { static_cast<double>(node.X), static_cast<double>(node.Y) };
      Point<3> x;
      this->Grid.ToPhysical<2>(index, x.data());
      point = static_cast<std::int64_t>(this->Found.Points.size());
      this->Found.Points.push_back(x);
    }
    this->Found.CornerIds.push_back(point);
  }

  static constexpr std::int64_t pixelsOfStep = std::int64_t{ 1 } << 16;

  const ImageGrid& Grid;
  const GridSize<2> Size;
  const std::int64_t* Labels;
  std::vector<bool> Seen;  // edges below pixels that a ring has passed
  std::vector<Edge> Outer; // one of each ring around pixels
  std::vector<Hole> Holes;
  std::vector<bool> Cuts;             // cuts below pixels; empty without holes
  LargeBuffer<std::int64_t> PointIds; // number of each node's point
  SiteCellPolygons Found;
};

} // namespace

SiteCellPolygons polygonsOfSiteCells(
  const ImageGrid& grid, const std::int64_t* labels, const Context& context)
{
  Progress progress(context);
  return Polygons(grid, labels).Find(progress);
}

} // namespace RectifiedTransport
