// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Resampling/RegionRows.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace RectifiedTransport
{

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

// The point of ab that is nearest to x, as a part of its length: (x - a) . (b - a) / |b - a|^2,
// clamped to [0, 1].
double partNearest(const Point<2>& a, const Point<2>& b, const Point<2>& x)
{
  const double dx = b[0] - a[0];
  const double dy = b[1] - a[1];
  const double part = ((x[0] - a[0]) * dx + (x[1] - a[1]) * dy) / (dx * dx + dy * dy);
  return std::isfinite(part) ? std::clamp(part, 0.0, 1.0) : 0.0;
}

// The squared distance of x to the point a + part (b - a).
double squaredDistance(const Point<2>& a, const Point<2>& b, double part, const Point<2>& x)
{
  const double dx = a[0] + part * (b[0] - a[0]) - x[0];
  const double dy = a[1] + part * (b[1] - a[1]) - x[1];
  return dx * dx + dy * dy;
}

} // namespace

RegionRows::RegionRows(
  const RegionBatch& batch, const Edges& edges, std::int64_t low, std::int64_t high)
  : Batch(batch)
{
  for (const RegionBatch::Edge& number : edges)
  {
    const OutlineEdge& edge = batch.At(number);
    this->Box.Add(edge.From.data());
    this->Box.Add(edge.To.data());
  }
  // Rows within one of the places: FindNearest() looks that far.
  this->FirstRow = std::max(low - 1, static_cast<std::int64_t>(std::floor(this->Box.Low[1])));
  this->LastRow = std::max(
    this->FirstRow, std::min(high, static_cast<std::int64_t>(std::floor(this->Box.High[1]))));
  const auto rows = static_cast<std::size_t>(this->LastRow - this->FirstRow) + 1;
  this->Rows.Fill(rows, [&](const auto& add) {
    for (const RegionBatch::Edge& number : edges)
    {
      const OutlineEdge& edge = batch.At(number);
      // An edge is in all rows from its lower to its upper end.
      const std::size_t end = this->RowOf(std::max(edge.From[1], edge.To[1]));
      for (std::size_t row = this->RowOf(std::min(edge.From[1], edge.To[1])); row <= end; ++row)
      {
        add(row, number);
      }
    }
  });
}

// Rows count from FirstRow; those beyond are clamped.
std::size_t RegionRows::RowOf(double y) const
{
  return static_cast<std::size_t>(
    std::clamp(static_cast<std::int64_t>(std::floor(y)), this->FirstRow, this->LastRow) -
    this->FirstRow);
}

// Sets two of the points of a place: the ends of the input's edge that a piece belongs to, with
// weights that sum to `weight`. The piece's ends may be crossings, so that its point is projected
// on the edge.
void RegionRows::SetEnds(
  const RegionBatch::Edge& edge, double part, double weight, int at, MeshLocation& found) const
{
  const RegionShape& shape = this->Batch.ShapeOf(edge);
  const OutlineEdge& piece = this->Batch.At(edge);
  const std::int64_t begin = piece.Edge;
  const Point<2>& a = shape.Outline.At(begin);
  const Point<2>& b = shape.Outline.At(shape.Outline.Next(begin));
  const Point<2> x{ piece.From[0] + part * (piece.To[0] - piece.From[0]),
    piece.From[1] + part * (piece.To[1] - piece.From[1]) };
  // The weights of the edge's ends are 1 - along and along.
  const double along = partNearest(a, b, x);
  found.Set = shape.Set;
  found.Cell = shape.Cells[static_cast<std::size_t>(piece.Ring)];
  found.Points[at] = shape.Points[static_cast<std::size_t>(begin)];
  found.Points[at + 1] = shape.Points[static_cast<std::size_t>(shape.Outline.Next(begin))];
  found.Weights[at] = weight * (1.0 - along);
  found.Weights[at + 1] = weight * along;
}

// Even-odd rule along the horizontal line through x: inside if an odd number of edges is to its
// left. The value is linear between the nearest edges to the left and to the right.
bool RegionRows::FindInside(const Point<2>& x, MeshLocation& found) const
{
  if (x[1] < this->Box.Low[1] || x[1] > this->Box.High[1])
  {
    return false;
  }
  struct Side
  {
    double Distance = infinity;
    RegionBatch::Edge Edge{ 0, 0 };
    double Part = 0.0;
  };
  Side left;
  Side right;
  bool isInside = false;
  for (const RegionBatch::Edge& number : this->Rows[this->RowOf(x[1])])
  {
    const OutlineEdge& edge = this->Batch.At(number);
    // Half-open in y: a line through a corner meets one of its two edges.
    if ((edge.From[1] > x[1]) == (edge.To[1] > x[1]))
    {
      continue;
    }
    const double part = (x[1] - edge.From[1]) / (edge.To[1] - edge.From[1]);
    // Where the edge crosses the line, relative to x.
    const double off = edge.From[0] + part * (edge.To[0] - edge.From[0]) - x[0];
    isInside = off <= 0.0 ? !isInside : isInside;
    Side& side = off <= 0.0 ? left : right;
    if (std::abs(off) < side.Distance)
    {
      side = { std::abs(off), number, part };
    }
  }
  if (!isInside || left.Distance == infinity || right.Distance == infinity)
  {
    return false;
  }
  const double width = left.Distance + right.Distance;
  // Linear between the two crossings: the nearer one weighs more.
  const double toLeft = width > 0.0 ? right.Distance / width : 1.0;
  found.Distance = 0.0;
  this->SetEnds(left.Edge, left.Part, toLeft, 0, found);
  this->SetEnds(right.Edge, right.Part, 1.0 - toLeft, 2, found);
  return true;
}

// Edges in the rows of y - 1 to y + 1: no others are within a grid cell of x.
void RegionRows::FindNearest(const Point<2>& x, MeshLocation& found) const
{
  RegionBatch::Edge nearest{ -1, 0 };
  double best = 2.0 + 1e-9; // squared diagonal of a grid cell
  double bestPart = 0.0;
  for (const RegionBatch::Edge& number :
    this->Rows.Of(this->RowOf(x[1] - 1.0), this->RowOf(x[1] + 1.0)))
  {
    const OutlineEdge& edge = this->Batch.At(number);
    const double part = partNearest(edge.From, edge.To, x);
    // Squared, in grid cells.
    const double distance = squaredDistance(edge.From, edge.To, part, x);
    if (distance < best)
    {
      best = distance;
      bestPart = part;
      nearest = number;
    }
  }
  if (nearest.Shape >= 0)
  {
    // 0 is that of places inside.
    found.Distance = std::max(best, std::numeric_limits<double>::min());
    this->SetEnds(nearest, bestPart, 1.0, 0, found);
    std::fill(found.Points + 2, found.Points + 4, found.Points[0]);
    std::fill(found.Weights + 2, found.Weights + 4, 0.0);
  }
}

MeshLocation RegionRows::Find(const Point<2>& x) const
{
  MeshLocation found{};
  found.Distance = infinity;
  if (!this->FindInside(x, found))
  {
    this->FindNearest(x, found);
  }
  return found;
}

} // namespace RectifiedTransport
