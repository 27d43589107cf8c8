// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Solid/SignedVolumes.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{

namespace
{

// The integrals of a polygon projected along axis 0.
struct Projection
{
  double Area;   // with the sign of its side
  double Moment; // integral of the distance to `end` along axis 0 over that area
};

// A fan of triangles; the integral of a linear function is the area times the mean at the corners.
Projection project(const CutPolygon& polygon, double end)
{
  Projection sum{ 0.0, 0.0 };
  const Corner& a = polygon[0];
  for (int i = 2; i < polygon.Size; ++i)
  {
    const Corner& b = polygon[i - 1];
    const Corner& c = polygon[i];
    const double area = 0.5 * ((b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]));
    sum.Area += area;
    sum.Moment += area * (((end - a[0]) + (end - b[0]) + (end - c[0])) / 3.0);
  }
  return sum;
}

} // namespace

SignedVolumes::SignedVolumes(const GridSize<3>& cells, const LatticePart<3>& part)
  : Columns(cells[0])
  , Rows(cells[1])
  , FirstRow(part.Low[1])
  , NumberOfRows(part.Cells[1])
  , Used(static_cast<std::size_t>(part.Cells[1]))
  , Sums(new CellSums[static_cast<std::size_t>((cells[0] + 1) * part.Cells[1])])
{
}

// A row's sums are cleared when the row is first used, as most layers touch few rows.
void SignedVolumes::Begin(std::int64_t layer)
{
  this->Layer = static_cast<double>(layer);
  std::fill(this->Used.begin(), this->Used.end(), static_cast<unsigned char>(0));
}

// Cuts the triangle by the layer's planes, then by rows. The sign: a triangle whose projection is
// positive has its outward side towards +x, and the solid before it.
void SignedVolumes::Add(const std::array<Corner, 3>& triangle, int weight)
{
  const CutPolygon whole(triangle);
  std::array<CutPolygon, 2> parts;
  const CutPolygon& polygon = slabOf<2>(whole, this->Layer, parts);
  forSlabs<1>(polygon, this->Rows, [this, weight](std::int64_t row, const CutPolygon& part) {
    if (row >= this->FirstRow && row < this->FirstRow + this->NumberOfRows)
    {
      this->AddToRow(row - this->FirstRow, part, static_cast<double>(-weight));
    }
  });
}

// Cuts the part in a row by columns. A piece adds its prism's volume to its own cell, and its area
// to the difference at the next one: the running sum in WriteRow() then has it in all cells beyond.
void SignedVolumes::AddToRow(std::int64_t row, const CutPolygon& polygon, double weight)
{
  CellSums* sums = this->RowOf(row);
  forSlabs<0>(polygon, this->Columns, [=](std::int64_t column, const CutPolygon& part) {
    const Projection piece = project(part, static_cast<double>(column + 1));
    if (column >= 0)
    {
      sums[column].Own.Add(weight * piece.Moment);
      // Sums of absolute areas in units of 2^-40: integers, so that the order does not matter.
      sums[column].Areas += 1 + static_cast<std::int64_t>(std::abs(piece.Area) / AreaUnit);
    }
    sums[column + 1].Beyond.Add(weight * piece.Area);
  });
}

SignedVolumes::CellSums* SignedVolumes::RowOf(std::int64_t row)
{
  CellSums* sums = this->Sums.get() + row * (this->Columns + 1);
  if (this->Used[static_cast<std::size_t>(row)] == 0)
  {
    this->Used[static_cast<std::size_t>(row)] = 1;
    std::fill_n(sums, this->Columns + 1, CellSums{});
  }
  return sums;
}

// V_i = sum of the areas of prisms that begin before cell i, plus the volumes of those within it.
void SignedVolumes::WriteRow(std::int64_t row, double rounding, double* volumes) const
{
  const CellSums* sums = this->Sums.get() + row * (this->Columns + 1);
  ReproducibleSum before{};
  std::int64_t areas = 0;
  for (std::int64_t i = 0; i < this->Columns; ++i)
  {
    before.Add(sums[i].Beyond);
    ReproducibleSum volume = before;
    volume.Add(sums[i].Own);
    areas += sums[i].Areas;
    const double value = volume.Value();
    // The error of a sum is bounded by the areas that went into it. Values within it of 0 or 1 are
    // those.
    const double error = rounding * (static_cast<double>(areas) * AreaUnit);
    const double whole = std::abs(value - 1.0) < error ? 1.0 : value;
    volumes[i] = std::abs(value) < error ? 0.0 : whole;
  }
}

} // namespace RectifiedTransport
