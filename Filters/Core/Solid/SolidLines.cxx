// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Solid/SolidLines.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{

SolidLines::SolidLines(const TriangleSurface& surface, const TriangleLayers& layers,
  const signed char* weights, const GridSize<3>& cells, const LatticePart<3>& part,
  int supersampling)
  : Surface(surface)
  , Layers(layers)
  , Weights(weights)
  , Columns(cells[0])
  , Squares(supersampling)
  , LinesPerCell(supersampling * supersampling)
  , FirstLine(part.Low[1] * supersampling)
  , EndLine((part.Low[1] + part.Cells[1]) * supersampling)
  , Lines(cells[1] * supersampling)
{
  this->First.Reserve(part.Cells[1] * this->LinesPerCell + 1);
  this->Parts.Reserve(this->Columns + 1);
  this->Whole.Reserve(this->Columns + 1);
}

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
  // From counts to the ends of the lines' crossings; filling them backward makes these beginnings.
  for (std::int64_t line = 1; line <= lines; ++line)
  {
    first[line] += first[line - 1];
  }
  this->Crossings.Reserve(first[lines]);
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

std::int64_t SolidLines::LineOf(std::int64_t j, std::int64_t row) const
{
  j -= this->FirstLine;
  return j / this->Squares * this->LinesPerCell + row * this->Squares + j % this->Squares;
}

// Lines are at the half-integers of coordinates in squares.
std::int64_t SolidLines::LineFrom(double coordinate) const
{
  const double line = std::ceil(coordinate - 0.5); // the subtraction is exact where it matters
  return static_cast<std::int64_t>(std::max(0.0, std::min(line, static_cast<double>(this->Lines))));
}

// Calls visit(segment, from, end, row, weight) for the intersections of the planes of a layer's
// rows with the triangles: segments that cross lines [from, end).
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

std::int64_t SolidLines::CorrectRow(std::int64_t row, double* values)
{
  const std::int64_t* first = this->First.data();
  const std::int64_t begin = row * this->LinesPerCell;
  std::int64_t open = 0;
  bool isCorrected = false;
  for (std::int64_t line = begin; line < begin + this->LinesPerCell; ++line)
  {
    const bool isClosed = this->CorrectLine(
      this->Crossings.data() + first[line], first[line + 1] - first[line], isCorrected);
    open += isClosed ? 0 : 1;
  }
  if (isCorrected)
  {
    this->WriteCorrection(values);
  }
  return open;
}

bool SolidLines::CorrectLine(Crossing* crossings, std::int64_t count, bool& isCorrected)
{
  std::sort(
    crossings, crossings + count, [](const Crossing& a, const Crossing& b) { return a.X < b.X; });
  std::int64_t winding = 0;
  std::int64_t weighted = 0;
  for (std::int64_t i = 0; i < count; ++i)
  {
    winding += crossings[i].Side;
    weighted += crossings[i].Weighted;
    const auto missing = static_cast<int>((winding != 0 ? 1 : 0) - weighted);
    if (missing != 0 && i + 1 < count && crossings[i].X < crossings[i + 1].X)
    {
      if (!isCorrected)
      {
        isCorrected = true;
        std::fill_n(this->Parts.data(), this->Columns + 1, 0.0);
        std::fill_n(this->Whole.data(), this->Columns + 1, 0);
      }
      this->AddInterval(crossings[i].X, crossings[i + 1].X, missing);
    }
  }
  return winding == 0;
}

void SolidLines::AddInterval(double begin, double end, int times)
{
  const auto length = static_cast<double>(this->Columns);
  begin = std::max(0.0, std::min(begin, length));
  end = std::max(0.0, std::min(end, length));
  const std::int64_t from = std::min(static_cast<std::int64_t>(begin), this->Columns - 1);
  const std::int64_t to = std::min(static_cast<std::int64_t>(end), this->Columns - 1);
  double* parts = this->Parts.data();
  if (from == to)
  {
    parts[from] += times * (end - begin);
    return;
  }
  parts[from] += times * (static_cast<double>(from + 1) - begin);
  parts[to] += times * (end - static_cast<double>(to));
  this->Whole.data()[from + 1] += times;
  this->Whole.data()[to] -= times;
}

void SolidLines::WriteCorrection(double* values)
{
  int* whole = this->Whole.data();
  for (std::int64_t i = 1; i < this->Columns; ++i)
  {
    whole[i] += whole[i - 1];
  }
  const auto lines = static_cast<double>(this->LinesPerCell);
  for (std::int64_t i = 0; i < this->Columns; ++i)
  {
    values[i] += (static_cast<double>(whole[i]) + this->Parts.data()[i]) / lines;
  }
}

} // namespace RectifiedTransport
