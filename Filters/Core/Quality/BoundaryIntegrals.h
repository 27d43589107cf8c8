// SPDX-License-Identifier: BSD-3-Clause
// Integrals over pieces of a boundary that add up, over a closed boundary, to the measure inside it
// or to the density's mass there: those of the field (F, 0, ...) across it, where F is the measure
// or the mass, along axis 0, below a point (Gauss's theorem).
#ifndef RectifiedTransport_BoundaryIntegrals_h
#define RectifiedTransport_BoundaryIntegrals_h

#include "Core/Geometry/GridSize.h"
#include "Core/Geometry/Points.h"
#include "Core/Quality/DensityRows.h"

#include <algorithm>
#include <cstdint>

namespace RectifiedTransport
{

// A triangle in space that is cut at the faces of grid cells: a convex polygon. It has at most two
// more corners after the cuts along each axis.
struct SpacePolygon
{
  static constexpr int MostCorners = 9;

  int Count = 0;
  double Corners[MostCorners][3];

  void Add(const double* x) { std::copy_n(x, 3, this->Corners[this->Count++]); }
};

// Divides a polygon at the plane x[axis] = place. Corners on the plane are in both parts.
inline void cut(
  const SpacePolygon& all, int axis, double place, SpacePolygon& below, SpacePolygon& above)
{
  below.Count = 0;
  above.Count = 0;
  const double* last = all.Corners[all.Count - 1];
  for (int i = 0; i < all.Count; ++i)
  {
    const double* next = all.Corners[i];
    const double from = last[axis] - place;
    const double to = next[axis] - place;
    if ((from < 0.0 && to > 0.0) || (from > 0.0 && to < 0.0))
    {
      const double part = from / (from - to);
      double x[3];
      for (int a = 0; a < 3; ++a)
      {
        x[a] = last[a] + part * (next[a] - last[a]);
      }
      // The cut is on the plane exactly, so that pieces of neighbouring cells match.
      x[axis] = place;
      below.Add(x);
      above.Add(x);
    }
    if (to <= 0.0)
    {
      below.Add(next);
    }
    if (to >= 0.0)
    {
      above.Add(next);
    }
    last = next;
  }
}

// Calls visit(polygon, cell) for the parts of a polygon in the cells of a grid, axis by axis from
// `Axis` down to 0.
template <int Axis, class Visit>
void visitCells(
  const SpacePolygon& polygon, const GridSize<3>& size, GridSize<3>& cell, const Visit& visit)
{
  double low = polygon.Corners[0][Axis];
  double high = low;
  for (int i = 1; i < polygon.Count; ++i)
  {
    low = std::min(low, polygon.Corners[i][Axis]);
    high = std::max(high, polygon.Corners[i][Axis]);
  }
  const auto enter = [&](const SpacePolygon& part, std::int64_t place) {
    cell[Axis] = place;
    if constexpr (Axis == 0)
    {
      visit(part, cell);
    }
    else
    {
      visitCells<Axis - 1>(part, size, cell, visit);
    }
  };
  std::int64_t place = std::min(static_cast<std::int64_t>(low), size[Axis] - 1);
  const SpacePolygon* rest = &polygon;
  SpacePolygon parts[2];
  SpacePolygon below;
  for (int next = 0; static_cast<double>(place + 1) < high; ++place, next = 1 - next)
  {
    cut(*rest, Axis, static_cast<double>(place + 1), below, parts[next]);
    // Fewer than three corners have no area.
    if (below.Count > 2)
    {
      enter(below, place);
    }
    rest = &parts[next];
  }
  if (rest->Count > 2)
  {
    enter(*rest, place);
  }
}

// A triangle in space, anticlockwise from outside.
using TriangleCorners = const double* const (&)[3];

// Returns twice the signed area of the triangle's projection along axis 0.
inline double twiceShadow(TriangleCorners x)
{
  return (x[1][1] - x[0][1]) * (x[2][2] - x[0][2]) - (x[1][2] - x[0][2]) * (x[2][1] - x[0][1]);
}

// Integrals of (x_0, 0, ...), which add up to lengths, areas and volumes.
class MeasureIntegral
{
public:
  // The field at a point of a line.
  double Point(const double* x) const { return x[0]; }
  // Along an edge with the inside on its left: the trapezoid rule, which is exact.
  double Edge(const double* a, const double* b) const
  {
    return 0.5 * (a[0] + b[0]) * (b[1] - a[1]);
  }
  double Triangle(TriangleCorners x) const
  {
    // The mean of x_0 over the triangle times its projected area.
    return (x[0][0] + x[1][0] + x[2][0]) / 6.0 * twiceShadow(x);
  }
};

// How the mass below a triangle is found.
enum class TriangleRule
{
  Centroid, // fast: by one point
  Exact     // by the parts in the grid's cells
};

// Integrals of the mass below a point, in the cells of some rows of a density and in its scaled
// units. Pieces outside these cells do not count. All are exact, except the first rule.
template <int Dimension>
class MassIntegral
{
public:
  // In 3D sums of rows begin at x = `start`: sums of neighbouring rows differ the more, and with
  // them the errors of triangles, the farther they go.
  explicit MassIntegral(const DensityRows<Dimension>& rows, double start = 0.0,
    TriangleRule rule = TriangleRule::Centroid)
    : Rows(rows)
    , Cells(rows.Cells())
    , Start(start)
    , Rule(rule)
  {
  }

  double Point(const double* x) const
  {
    const double inside = std::clamp(
      x[0], static_cast<double>(this->Cells.Low[0]), static_cast<double>(this->Cells.End(0)));
    return this->Rows.Before(this->Rows.Row(this->Cells.Low), inside);
  }

  // Row by row: the mass below is piecewise quadratic along an edge, so that its mean over the
  // piece in each cell is exact.
  double Edge(const double* a, const double* b) const
  {
    const bool rises = a[1] < b[1];
    const double* low = rises ? a : b;
    const double* high = rises ? b : a;
    const double end = std::min(high[1], static_cast<double>(this->Cells.End(1)));
    double y = std::max(low[1], static_cast<double>(this->Cells.Low[1]));
    if (!(y < end))
    {
      return 0.0;
    }
    const double width = high[0] - low[0];
    const double height = high[1] - low[1];
    const auto at = [&](double place) {
      // The end itself keeps its coordinate to the last bit: neighbouring edges then close.
      return place == high[1] ? high[0] : low[0] + width * ((place - low[1]) / height);
    };
    double x = y == low[1] ? low[0] : at(y);
    double sum = 0.0;
    for (auto row = static_cast<std::int64_t>(y); y < end; ++row)
    {
      const double nextY = std::min(end, static_cast<double>(row + 1));
      const double nextX = at(nextY);
      GridSize<Dimension> cell{};
      cell[Last] = row;
      sum += (nextY - y) * this->MeanBefore(this->Rows.Row(cell), x, nextX);
      y = nextY;
      x = nextX;
    }
    return rises ? sum : -sum;
  }

  double Triangle(TriangleCorners x) const
  {
    return this->Rule == TriangleRule::Exact ? this->ExactTriangle(x) : this->TriangleByCentroid(x);
  }

private:
  static constexpr int Last = Dimension - 1;

  // Returns the mean of the mass below, over the places between two of a row.
  double MeanBefore(const double* row, double from, double to) const
  {
    const double low = std::min(from, to);
    const double high = std::max(from, to);
    const std::int64_t end = this->Cells.End(0) - 1;
    const std::int64_t first = std::min(static_cast<std::int64_t>(low), end);
    const std::int64_t last = std::min(static_cast<std::int64_t>(high), end);
    if (first == last)
    {
      // Within one cell the mass below is linear, and its mean is the value in the middle.
      return this->Rows.Before(row, first, 0.5 * (low + high));
    }
    double sum = 0.0;
    double x = low;
    for (std::int64_t cell = first; cell <= last; ++cell)
    {
      const double next = cell == last ? high : static_cast<double>(cell + 1);
      sum += (next - x) * this->Rows.Before(row, cell, 0.5 * (x + next));
      x = next;
    }
    return sum / (high - low);
  }

  // One-point quadrature: the mass below the centroid times the projected area.
  double TriangleByCentroid(TriangleCorners x) const
  {
    constexpr double third = 1.0 / 3.0;
    double centroid[3];
    for (int a = 0; a < 3; ++a)
    {
      centroid[a] = third * (x[0][a] + x[1][a] + x[2][a]);
    }
    GridSize<Dimension> cell{};
    for (int a = 1; a < Dimension; ++a)
    {
      cell[a] = std::min(static_cast<std::int64_t>(centroid[a]), this->Rows.Size()[a] - 1);
    }
    if (!this->HasLayer(cell[Last]))
    {
      return 0.0;
    }
    const double* row = this->Rows.Row(cell);
    const double below = this->Rows.Before(row, centroid[0]) - this->Rows.Before(row, this->Start);
    return 0.5 * below * twiceShadow(x);
  }

  double ExactTriangle(TriangleCorners x) const
  {
    SpacePolygon triangle;
    for (const double* corner : x)
    {
      triangle.Add(corner);
    }
    double sum = 0.0;
    GridSize<3> cell{};
    visitCells<2>(triangle, this->Rows.Size(), cell,
      [&](const SpacePolygon& part, const GridSize<3>& at) { sum += this->BelowPart(part, at); });
    return sum;
  }

  // Within a cell, the mass below is linear along axis 0, so area and moment of the projection
  // integrate it exactly.
  double BelowPart(const SpacePolygon& part, const GridSize<3>& cell) const
  {
    if (!this->HasLayer(cell[Last]))
    {
      return 0.0;
    }
    double area = 0.0; // area of the projection
    double moment = 0.0;
    const auto floor = static_cast<double>(cell[0]);
    for (int i = 2; i < part.Count; ++i)
    {
      const auto& x = part.Corners;
      const double shadow = 0.5 * twiceShadow({ x[0], x[i - 1], x[i] });
      area += shadow;
      // The moment about the cell's lower face: mean of the three corners times area.
      moment += shadow * ((x[0][0] - floor) + (x[i - 1][0] - floor) + (x[i][0] - floor)) / 3.0;
    }
    const double* row = this->Rows.Row(cell);
    return area * (row[cell[0]] - this->Rows.Before(row, this->Start)) +
      moment * (row[cell[0] + 1] - row[cell[0]]);
  }

  bool HasLayer(std::int64_t layer) const
  {
    return layer >= this->Cells.Low[Last] && layer < this->Cells.End(Last);
  }

  const DensityRows<Dimension>& Rows;
  const LatticePart<Dimension> Cells;
  const double Start;
  const TriangleRule Rule;
};

} // namespace RectifiedTransport

#endif
