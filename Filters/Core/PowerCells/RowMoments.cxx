// SPDX-License-Identifier: BSD-3-Clause
#include "Core/PowerCells/RowMoments.h"

#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Reduction.h"
#include "Core/Tables/DensityInspection.h"
#include "Core/Tables/NearestMass.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace RectifiedTransport
{

RowMoments::RowMoments(
  const DensitySource<2>& density, const Point<2>& scale, double total, Progress& progress)
  : Size(density.Size)
  , Scale(scale)
  , MeanMass(total / numberOfCells<2>(density.Size))
  , CellMasses(density.Size[0] * density.Size[1])
  , Blocks(BlocksPerRow() * density.Size[1])
  , Occupied(WordsPerRow() * density.Size[1])
{
  const DensitySummary found = this->ReadValues(*density.Whole(), progress);
  requireDensity(found);
  this->Accumulate(total, found, progress);
}

Point<2> RowMoments::Lengths() const
{
  return { this->Scale[0] * static_cast<double>(this->Size[0]),
    this->Scale[1] * static_cast<double>(this->Size[1]) };
}

DensitySummary RowMoments::ReadValues(const DensityValues& values, Progress& progress)
{
  const std::int64_t columns = this->Size[0];
  struct Part
  {
    DensitySummary Summary;
    bool Empty = false;
  };
  const auto read = [&](std::int64_t first, std::int64_t last) {
    Part part;
    std::vector<double> row(static_cast<std::size_t>(columns));
    for (std::int64_t j = first; j < last; ++j)
    {
      values.Read(j * columns, columns, row.data());
      const RowInspection inspection = inspectCells(row.data(), columns, j * columns,
        this->Occupied.data() + j * this->WordsPerRow(), part.Summary);
      part.Summary.Total += inspection.Sum;
      part.Empty = part.Empty || !(inspection.Smallest > 0.0);
      Masses* masses = this->RowAt(j);
      for (std::int64_t i = 0; i < columns; ++i)
      {
        masses[i].Own = row[static_cast<std::size_t>(i)];
      }
    }
    return part;
  };
  const auto combine = [](Part all, const Part& part) {
    merge(part.Summary, all.Summary);
    all.Empty = all.Empty || part.Empty;
    return all;
  };
  const Part all =
    reduceChunks(progress, this->Size[1], 1, Part(), read, combine, this->RowsOfSlice());
  this->Empty = all.Empty;
  return all.Summary;
}

void RowMoments::Accumulate(double total, const DensitySummary& found, Progress& progress)
{
  // Values scaled by a power of two to at most 1 neither overflow nor lose bits in the sums.
  const double unit = std::ldexp(1.0, -std::clamp(std::ilogb(found.Maximum), -1000, 1000));
  const std::int64_t columns = this->Size[0];
  const auto sum = [&](std::int64_t first, std::int64_t last) {
    double mass = 0.0;
    for (std::int64_t i = first * columns; i < last * columns; ++i)
    {
      mass += this->CellMasses.data()[i].Own * unit;
    }
    return mass;
  };
  const double all = reduceChunks(
    progress, this->Size[1], 1, 0.0, sum, [](double a, double b) { return a + b; },
    this->RowsOfSlice());
  // From scaled values to masses that sum to `total`.
  const double scale = total / all;
  // Each row gets the prefix sums of its cells' masses, and the moments of blocks of 16 cells about
  // their first cell.
  const auto accumulate = [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t j = first; j < last; ++j)
    {
      // Prefix sums begin anew in every row: along a row, a polygon's integral is a difference of
      // two of them.
      double before = 0.0;
      Masses* masses = this->RowAt(j);
      Moments* blocks = this->Blocks.data() + j * this->BlocksPerRow();
      std::fill_n(blocks, this->BlocksPerRow(), Moments{});
      for (std::int64_t i = 0; i < columns; ++i)
      {
        const double own = masses[i].Own * unit * scale;
        masses[i] = { before, own };
        before += own;
        // Each cell's mass at its beginning, in cells from the block's first one. Cells become
        // constant densities by Spread() later.
        blocks[i / cellsOfBlock].Add(own, static_cast<double>(i % cellsOfBlock));
      }
    }
  };
  progress.For(this->Size[1], 1, accumulate, this->RowsOfSlice());
}

// Returns how many rows take some milliseconds, however long rows are; the time counts the first
// touch of new memory, too.
std::int64_t RowMoments::RowsOfSlice() const
{
  constexpr std::int64_t cells = std::int64_t{ 1 } << 17;
  return std::max<std::int64_t>(1, cells / this->Size[0]);
}

TableView<2> RowMoments::Occupation() const
{
  TableView<2> cells{};
  cells.Occupied = this->Empty ? this->Occupied.data() : nullptr;
  cells.WordsPerRow = this->WordsPerRow();
  cells.Cells[0] = this->Size[0];
  cells.Cells[1] = this->Size[1];
  return cells;
}

bool RowMoments::HasMass(const Point<2>& point) const
{
  return hasMass<2>(this->Occupation(), this->ToIndex(point));
}

Point<2> RowMoments::NearestMass(const Point<2>& point) const
{
  if (this->HasMass(point))
  {
    return point;
  }
  const Point<2> nearest = nearestMass<2>(this->Occupation(), this->ToIndex(point), this->Scale);
  return { nearest[0] * this->Scale[0], nearest[1] * this->Scale[1] };
}

// The way of a side through the cells along one axis, as in Amanatides and Woo's traversal of a
// grid. Whether the next face is one of x or one of y is unpredictable, so that no branch depends
// on it.
struct RowMoments::Traversal
{
  // From `start` to `end`, in cells; there are `count` of them.
  Traversal(double start, double end, std::int64_t count)
  {
    // An end on a face belongs to the cell that the side passes through there; a side along a face
    // may belong to the cells on either side of it.
    const auto cellOf = [count](double x, bool below) {
      const auto cell = static_cast<std::int64_t>(x);
      const bool isFace = x == static_cast<double>(cell);
      return std::clamp<std::int64_t>(cell - (below && isFace ? 1 : 0), 0, count - 1);
    };
    const double length = end - start;
    this->Cell = cellOf(start, length < 0.0);
    this->Faces = std::abs(cellOf(end, length > 0.0) - this->Cell);
    this->Direction = length < 0.0 ? -1 : 1;
    if (this->Faces > 0)
    {
      this->Steps[1] = 1.0 / std::abs(length);
      this->Next = (static_cast<double>(this->Cell + (length < 0.0 ? 0 : 1)) - start) / length;
    }
  }

  // Crosses the next face, or none.
  void Cross(bool isCrossed)
  {
    const std::int64_t crossed = isCrossed ? 1 : 0;
    const bool isLast = this->Faces <= 1;
    this->Cell += crossed * this->Direction;
    this->Faces -= crossed;
    this->Next += this->Steps[crossed << static_cast<int>(isLast)];
  }

  // A part beyond the end of the side (1): no face is left.
  static constexpr double never = 2.0;
  std::int64_t Cell;
  std::int64_t Direction;
  std::int64_t Faces;  // that are left to cross
  double Next = never; // the part of the side before the next face
  // What the crossing adds to Next: nothing (no crossing), the distance of two faces, or `never`
  // after the last one.
  double Steps[3] = { 0.0, 0.0, never };
};

template <class Visit>
void RowMoments::VisitCells(const Point<2>& from, const Point<2>& to, const Visit& visit) const
{
  // The side in cells of the grid.
  const Point<2> start = { from[0] / this->Scale[0], from[1] / this->Scale[1] };
  const Point<2> end = { to[0] / this->Scale[0], to[1] / this->Scale[1] };
  Traversal x(start[0], end[0], this->Size[0]);
  Traversal y(start[1], end[1], this->Size[1]);
  double done = 0.0;
  Point<2> at = start;
  for (std::int64_t faces = x.Faces + y.Faces; faces > 0; --faces)
  {
    // The next face along the side, and its part of the length. Clamping makes the parts
    // monotonous.
    // The nearer face is crossed next: one of y if `isRow`.
    const bool isRow = y.Next < x.Next;
    const double part = std::clamp(std::min(x.Next, y.Next), done, 1.0);
    const Point<2> face = { start[0] + part * (end[0] - start[0]),
      start[1] + part * (end[1] - start[1]) };
    visit(x.Cell, y.Cell, at, face, part - done);
    x.Cross(!isRow);
    y.Cross(isRow);
    at = face;
    done = part;
  }
  visit(x.Cell, y.Cell, at, end, 1.0 - done);
}

void RowMoments::Prefetch(const Point<2>& low, const Point<2>& high) const
{
  constexpr std::int64_t cellsOfLine = 64 / sizeof(Masses);
  constexpr std::int64_t mostLines = 256; // a part of the first-level cache
  const GridSize<2> first = this->CellAt(low);
  const GridSize<2> last = this->CellAt(high);
  // Cache lines in a row of the box, of which the last one may be partly used.
  const std::int64_t lines = (last[0] - first[0]) / cellsOfLine + 2;
  if (lines * (last[1] - first[1] + 1) > mostLines)
  {
    return;
  }
  for (std::int64_t row = first[1]; row <= last[1]; ++row)
  {
    const Masses* cells = this->RowAt(row);
    for (std::int64_t column = first[0]; column < last[0]; column += cellsOfLine)
    {
      __builtin_prefetch(cells + column);
    }
    __builtin_prefetch(cells + last[0]);
  }
}

GridSize<2> RowMoments::CellAt(const Point<2>& point) const
{
  GridSize<2> cell;
  for (std::size_t a = 0; a < 2; ++a)
  {
    const auto last = static_cast<double>(this->Size[a] - 1);
    cell[a] = static_cast<std::int64_t>(std::clamp(point[a] / this->Scale[a], 0.0, last));
  }
  return cell;
}

Point<2> RowMoments::CornerOf(const GridSize<2>& cell) const
{
  return { this->Scale[0] * static_cast<double>(cell[0]),
    this->Scale[1] * static_cast<double>(cell[1]) };
}

// Integrals over a row from the column `origin` up to that of a point which moves from cell to
// cell. Columns before the origin count negatively.
class RowMoments::RowIntegral
{
public:
  RowIntegral(const RowMoments& rows, std::int64_t origin)
    : Rows(rows)
    , Origin(origin)
  {
  }

  Moments To(std::int64_t column, std::int64_t row)
  {
    if (row != this->Row)
    {
      this->Row = row;
      this->Cells = this->Rows.RowAt(row);
      this->Sum = {};
      const double sign = column < this->Origin ? -1.0 : 1.0;
      this->AddCells(std::min(column, this->Origin), std::max(column, this->Origin));
      this->Sum = { sign * this->Sum.Mass, sign * this->Sum.First, sign * this->Sum.Second };
    }
    else if (column > this->Column)
    {
      // A step to a neighbouring column adds or removes one cell; only a new row needs a sum over
      // blocks.
      this->Sum.Add(this->Cells[this->Column].Own, this->Offset(this->Column));
    }
    else if (column < this->Column)
    {
      this->Sum.Add(-this->Cells[column].Own, this->Offset(column));
    }
    this->Column = column;
    // The moments of masses at the beginnings of cells become those of constant cells, and the even
    // share adds a uniform density: integrals of 1, x and x^2 over the width.
    const Moments spread = this->Sum.Spread();
    const double width = this->Offset(column);
    return { this->Rows.WithEven(spread.Mass, width),
      this->Rows.WithEven(spread.First, width * width / 2.0),
      this->Rows.WithEven(spread.Second, width * width * width / 3.0) };
  }
  // Returns the mass of the point's cell.
  double Own() const { return this->Rows.WithEven(this->Cells[this->Column].Own, 1.0); }

private:
  void AddCells(std::int64_t first, std::int64_t last)
  {
    const Moments* blocks = this->Rows.Blocks.data() + this->Row * this->Rows.BlocksPerRow();
    while (first < last)
    {
      if (first % cellsOfBlock == 0 && first + cellsOfBlock <= last)
      {
        this->Sum.Add(blocks[first / cellsOfBlock], this->Offset(first));
        first += cellsOfBlock;
        continue;
      }
      this->Sum.Add(this->Cells[first].Own, this->Offset(first));
      ++first;
    }
  }
  double Offset(std::int64_t column) const { return static_cast<double>(column - this->Origin); }

  const RowMoments& Rows;
  const std::int64_t Origin;
  const Masses* Cells = nullptr; // masses of the row
  std::int64_t Row = -1;
  std::int64_t Column = 0;
  Moments Sum{}; // moments of masses at the beginnings of the cells
};

void RowMoments::AddSide(const Point<2>& from, const Point<2>& to, const GridSize<2>& origin,
  PolygonMoments& moments) const
{
  // The moments along the row are cubic in the parameter of the side, so two-point Gauss quadrature
  // integrates them exactly in y.
  constexpr double place = 0.57735026918962576451; // sqrt(1/3)
  double mass = 0.0;
  double first[2] = { 0.0, 0.0 };
  double second[2] = { 0.0, 0.0 };
  RowIntegral integral(*this, origin[0]);
  const auto zero = static_cast<double>(origin[1]);
  this->VisitCells(from, to,
    [&](std::int64_t column, std::int64_t row, const Point<2>& a, const Point<2>& b, double) {
      // The moments from the origin's column to the cell's lower face; what remains is the part
      // within the cell, up to u.
      const Moments before = integral.To(column, row);
      const double own = integral.Own();
      const auto low = static_cast<double>(column - origin[0]);
      const double half = (b[1] - a[1]) / 2.0;
      for (const double side : { -place, place })
      {
        const double x = (a[0] + b[0]) / 2.0 + side * (b[0] - a[0]) / 2.0;
        const double y = (a[1] + b[1]) / 2.0 - zero + side * half;
        // By the divergence theorem, the integral of f x^k y^l over the polygon is the sum over its
        // sides of the integral of M_k(x, y) y^l dy, where M_k(x, y) is the integral of f s^k from
        // the origin to x along the row.
        const double u = x - static_cast<double>(column);
        // The Gauss weight of both points is 1 on [-1, 1], so half the height multiplies each
        // value.
        const double m = half * (before.Mass + own * u);
        mass += m;
        first[0] += half * (before.First + own * u * (low + u / 2.0));
        first[1] += m * y;
        second[0] += half * (before.Second + own * u * (low * low + low * u + u * u / 3.0));
        second[1] += m * y * y;
      }
    });
  moments.Mass += mass;
  for (int a = 0; a < 2; ++a)
  {
    moments.First[a] += first[a] * this->Scale[a];
    moments.Second += second[a] * this->Scale[a] * this->Scale[a];
  }
}

// The mass alone is linear along the piece of a side in a cell: the midpoint rule is exact.
double RowMoments::AddSideMass(const Point<2>& from, const Point<2>& to, double& mass) const
{
  double along = 0.0;
  double below = 0.0;
  this->VisitCells(from, to,
    [&](std::int64_t column, std::int64_t row, const Point<2>& a, const Point<2>& b, double part) {
      // The cumulative mass up to the middle of the piece, times its height, is the integral: the
      // trapezoid beside the side.
      const Masses& masses = this->RowAt(row)[column];
      const auto begin = static_cast<double>(column);
      const double own = this->WithEven(masses.Own, 1.0);
      const double u = (a[0] + b[0]) / 2.0 - begin;
      below += (b[1] - a[1]) * (this->WithEven(masses.Before, begin) + own * u);
      along += part * own;
    });
  mass += below;
  const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
  return along * length / (this->Scale[0] * this->Scale[1]);
}

} // namespace RectifiedTransport
