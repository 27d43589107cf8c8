// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Solid/SolidLines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace RectifiedTransport
{

// Lines are at the half-integers of axes 1 and 2 in units of squares. First has one entry more than
// there are lines: the end of the last one's crossings.
SolidLines::SolidLines(const TriangleSurface& surface, const TriangleLayers& layers,
  const signed char* weights, const GridSize<3>& cells, const LatticePart<3>& part,
  int supersampling)
  : Surface(surface)
  , Layers(layers)
  , Weights(weights)
  , Squares(supersampling)
  , LinesPerCell(supersampling * supersampling)
  , FirstLine(part.Low[1] * supersampling)
  , EndLine((part.Low[1] + part.Cells[1]) * supersampling)
  , Lines(cells[1] * supersampling)
  , First(part.Cells[1] * this->LinesPerCell + 1)
  , OfRow(cells[0])
{
}

// Counting sort of the crossings by lines: a first pass counts, a second one writes. The cuts are
// computed twice, which costs less than storing them.
void SolidLines::FindCrossings(std::int64_t layer, Progress& progress)
{
  const std::int64_t lines = (this->EndLine - this->FirstLine) * this->Squares;
  std::int64_t* first = this->First.data();
  std::fill_n(first, lines + 1, std::int64_t{ 0 });
  this->ForSegments(layer, progress,
    [this, first](const PlaneSegment&, std::int64_t from, std::int64_t end, std::int64_t row, int) {
      for (std::int64_t j = from; j < end; ++j)
      {
        ++first[this->LineOf(j, row)];
      }
    });
  // From counts to the ends of the lines' crossings; filling backward turns these into beginnings.
  for (std::int64_t line = 1; line <= lines; ++line)
  {
    first[line] += first[line - 1];
  }
  // The memory only grows, as it is used for layer after layer.
  if (first[lines] > this->Crossings.size())
  {
    this->Crossings = LargeBuffer<Crossing>(first[lines]);
  }
  Crossing* crossings = this->Crossings.data();
  this->ForSegments(layer, progress,
    [this, first, crossings](const PlaneSegment& segment, std::int64_t from, std::int64_t end,
      std::int64_t row, int weight) {
      const int side = segment.Side();
      for (std::int64_t j = from; j < end; ++j)
      {
        crossings[--first[this->LineOf(j, row)]] = { segment.At(static_cast<double>(j) + 0.5), side,
          side * weight };
      }
    });
}

// Numbers by rows of cells, then by rows of lines within a cell, then along axis 1.
std::int64_t SolidLines::LineOf(std::int64_t j, std::int64_t row) const
{
  j -= this->FirstLine;
  return j / this->Squares * this->LinesPerCell + row * this->Squares + j % this->Squares;
}

// The first line at or above a coordinate in squares along axis 1: lines are at half-integers.
std::int64_t SolidLines::LineFrom(double coordinate) const
{
  const double line = std::ceil(coordinate - 0.5); // the subtraction is exact where it matters
  return static_cast<std::int64_t>(std::max(0.0, std::min(line, static_cast<double>(this->Lines))));
}

// Calls visit(segment, from, end, row, weight) for the intersections of the triangles with the
// planes of a layer's rows of lines: segments that cross the lines [from, end). In units of
// squares, so that planes and lines are at half-integers.
template <class Visit>
void SolidLines::ForSegments(std::int64_t layer, Progress& progress, const Visit& visit) const
{
  const double squares = static_cast<double>(this->Squares);
  for (std::int64_t at = this->Layers.Begin(layer); at < this->Layers.End(layer); ++at)
  {
    if ((at & 0xfff) == 0xfff && progress.ShouldStop())
    {
      return;
    }
    const std::int64_t triangle = this->Layers.Triangle(at);
    std::array<Corner, 3> corners = cornersOf(this->Surface, triangle);
    for (Corner& corner : corners)
    {
      corner[1] *= squares;
      corner[2] *= squares;
    }
    for (std::int64_t row = 0; row < this->Squares; ++row)
    {
      const double z = static_cast<double>(layer * this->Squares + row) + 0.5;
      cutTriangle(corners, z, [&](const PlanePoint& in, const PlanePoint& out) {
        const std::int64_t from = std::max(this->LineFrom(std::min(in.Y, out.Y)), this->FirstLine);
        const std::int64_t end = std::min(this->LineFrom(std::max(in.Y, out.Y)), this->EndLine);
        if (from < end)
        {
          visit(PlaneSegment(in, out), from, end, row, this->Weights[triangle]);
        }
      });
    }
  }
}

bool SolidLines::HasRow(std::int64_t row) const
{
  const std::int64_t* first = this->First.data() + row * this->LinesPerCell;
  return first[0] != first[this->LinesPerCell];
}

// Looks first whether any interval with a length has weighted windings other than 1 inside and 0
// outside. Nearly all rows have none, and need no lengths.
std::int64_t SolidLines::CorrectRow(std::int64_t row, double* values)
{
  const std::int64_t begin = row * this->LinesPerCell;
  const std::int64_t end = begin + this->LinesPerCell;
  std::int64_t open = 0;
  bool isRight = true;
  for (std::int64_t line = begin; line < end; ++line)
  {
    this->SortCrossings(line);
    const std::int64_t left = this->ForIntervals(
      line, [&isRight](double from, double to, std::int64_t winding, std::int64_t weighted) {
        isRight = isRight && (from == to || weighted == (winding != 0 ? 1 : 0));
      });
    open += left != 0 ? 1 : 0;
  }
  if (!isRight)
  {
    this->OfRow.Clear();
    for (std::int64_t line = begin; line < end; ++line)
    {
      this->ForIntervals(
        line, [this](double from, double to, std::int64_t winding, std::int64_t weighted) {
          this->OfRow.Add(from, to, weighted, winding != 0);
        });
    }
    this->OfRow.Correct(this->LinesPerCell, values);
  }
  return open;
}

void SolidLines::CoverRow(std::int64_t layer, std::int64_t row,
  const std::function<double(const Point<3>&)>& winding, double* values)
{
  const auto squares = static_cast<double>(this->Squares);
  const auto columns = static_cast<double>(this->OfRow.Columns());
  this->OfRow.Clear();
  std::int64_t line = row * this->LinesPerCell;
  for (std::int64_t z = 0; z < this->Squares; ++z)
  {
    for (std::int64_t y = 0; y < this->Squares; ++y, ++line)
    {
      const std::int64_t j = this->FirstLine + row * this->Squares + y;
      const Point<3> place{ 0.0, (static_cast<double>(j) + 0.5) / squares,
        (static_cast<double>(layer * this->Squares + z) + 0.5) / squares };
      const auto isInside = [&](double x) { return winding({ x, place[1], place[2] }) >= 0.5; };
      this->SortCrossings(line);
      double from = 0.0;
      for (std::int64_t i = this->First.data()[line]; i < this->First.data()[line + 1]; ++i)
      {
        const double at = std::clamp(this->Crossings.data()[i].X, 0.0, columns);
        this->CoverInterval(from, at, isInside);
        from = at;
      }
      this->CoverInterval(from, columns, isInside);
    }
  }
  std::fill_n(values, this->OfRow.Columns(), 0.0);
  this->OfRow.Correct(this->LinesPerCell, values);
}

// Between two crossings the winding number is smooth: it passes a half in a hole alone.
void SolidLines::CoverInterval(double from, double to, const std::function<bool(double)>& isInside)
{
  constexpr double widest = 8.0;  // cells between two questions
  constexpr double margin = 1e-3; // the number jumps at the ends
  constexpr int halvings = 8;
  if (!(to > from))
  {
    return;
  }
  const auto parts = static_cast<int>(std::ceil((to - from) / widest));
  const auto place = [&](int i) {
    const double share = static_cast<double>(i) / parts;
    return from + (to - from) * std::clamp(share, margin, 1.0 - margin);
  };
  double begin = from;
  bool is = isInside(place(0));
  for (int i = 1; i <= parts; ++i)
  {
    const bool next = isInside(place(i));
    if (next != is)
    {
      double low = place(i - 1);
      double high = place(i);
      for (int k = 0; k < halvings; ++k)
      {
        const double middle = 0.5 * (low + high);
        (isInside(middle) == is ? low : high) = middle;
      }
      this->OfRow.Add(begin, high, 0, is);
      begin = high;
      is = next;
    }
  }
  this->OfRow.Add(begin, to, 0, is);
}

// Crossings at one place may be in any order: the intervals between them have no length, and the
// sums behind them are the same.
void SolidLines::SortCrossings(std::int64_t line)
{
  const std::int64_t* first = this->First.data() + line;
  std::sort(this->Crossings.data() + first[0], this->Crossings.data() + first[1],
    [](const Crossing& a, const Crossing& b) { return a.X < b.X; });
}

// Calls visit(from, to, winding, weighted) for the intervals between the sorted crossings of a
// line, with the sums of the sides so far. Returns the winding number after the last, 0 if the line
// leaves the solid as often as it enters it.
template <class Visit>
std::int64_t SolidLines::ForIntervals(std::int64_t line, const Visit& visit) const
{
  const Crossing* crossing = this->Crossings.data() + this->First.data()[line];
  const Crossing* end = this->Crossings.data() + this->First.data()[line + 1];
  std::int64_t winding = 0;
  std::int64_t weighted = 0;
  for (; crossing != end; ++crossing)
  {
    winding += crossing->Side;
    weighted += crossing->Weighted;
    if (crossing + 1 != end)
    {
      visit(crossing[0].X, crossing[1].X, winding, weighted);
    }
  }
  return winding;
}

RowLengths::RowLengths(std::int64_t columns)
  : Parts(static_cast<std::size_t>(columns))
  , Whole(static_cast<std::size_t>(columns + 1))
{
}

void RowLengths::Clear()
{
  std::fill(this->Parts.begin(), this->Parts.end(), Lengths{ 0.0, 0.0 });
  std::fill(this->Whole.begin(), this->Whole.end(), Counts{ 0, 0 });
}

// Adds the parts of the first and the last cell as lengths. For the whole cells between, it adds 1
// at the beginning and -1 at the end of a difference array: O(1) for an interval of any length.
void RowLengths::Add(double begin, double end, std::int64_t counted, bool isCovered)
{
  if (counted == 0 && !isCovered)
  {
    return;
  }
  const auto columns = static_cast<std::int64_t>(this->Parts.size());
  const auto length = static_cast<double>(columns);
  // Crossings beyond the grid count as on its border.
  begin = std::max(0.0, std::min(begin, length));
  end = std::max(0.0, std::min(end, length));
  const std::int64_t from = std::min(static_cast<std::int64_t>(begin), columns - 1);
  const std::int64_t to = std::min(static_cast<std::int64_t>(end), columns - 1);
  const auto add = [&](std::int64_t cell, double part) {
    Lengths& lengths = this->Parts[static_cast<std::size_t>(cell)];
    lengths.Counted += static_cast<double>(counted) * part;
    lengths.Covered += isCovered ? part : 0.0;
  };
  if (from == to)
  {
    add(from, end - begin);
    return;
  }
  add(from, static_cast<double>(from + 1) - begin);
  add(to, end - static_cast<double>(to));
  Counts& first = this->Whole[static_cast<std::size_t>(from + 1)];
  Counts& last = this->Whole[static_cast<std::size_t>(to)];
  first.Counted += counted;
  first.Covered += isCovered ? 1 : 0;
  last.Counted -= counted;
  last.Covered -= isCovered ? 1 : 0;
}

// counted = integral of the weighted windings over all lines in the cell, covered = length within
// the solid. If counted > covered, the value is multiplied by covered / counted; else the
// difference, a mean over the lines, is added.
void RowLengths::Correct(std::int64_t lines, double* values) const
{
  // The running sum of the difference array is the number of intervals that cover the whole cell.
  Counts whole{ 0, 0 };
  for (std::size_t i = 0; i < this->Parts.size(); ++i)
  {
    whole.Counted += this->Whole[i].Counted;
    whole.Covered += this->Whole[i].Covered;
    const double counted = static_cast<double>(whole.Counted) + this->Parts[i].Counted;
    const double covered = static_cast<double>(whole.Covered) + this->Parts[i].Covered;
    if (covered < counted)
    {
      values[i] *= covered / counted;
    }
    else
    {
      values[i] += (covered - counted) / static_cast<double>(lines);
    }
  }
}

} // namespace RectifiedTransport
