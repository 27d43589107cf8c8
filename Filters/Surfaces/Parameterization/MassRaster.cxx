// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Parameterization/MassRaster.h"

#include "Core/Geometry/Trees/Bins.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t bandRows = 16; // rows of the grid that one thread fills

// A convex polygon in the grid: a triangle and what is left of it within a cell. Every cut adds at
// most one corner, and there are four; the rest is for what rounding makes of very thin ones.
struct Polygon
{
  std::array<Point<2>, 12> Corners;
  std::size_t Count = 0;

  void Add(const Point<2>& corner)
  {
    if (this->Count < this->Corners.size())
    {
      this->Corners[this->Count++] = corner;
    }
  }

  // The shoelace formula as a fan about the first corner: differences keep its accuracy far from
  // the origin.
  double Area() const
  {
    double sum = 0.0;
    const Point<2>& a = this->Corners[0];
    for (std::size_t i = 2; i < this->Count; ++i)
    {
      const Point<2>& b = this->Corners[i - 1];
      const Point<2>& c = this->Corners[i];
      sum += (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    }
    return 0.5 * std::abs(sum);
  }

  // The cells of an axis from that of its least coordinate to that of its largest.
  std::array<std::int64_t, 2> Cells(std::size_t axis, std::int64_t size) const
  {
    double low = this->Corners[0][axis];
    double high = low;
    for (std::size_t i = 1; i < this->Count; ++i)
    {
      low = std::min(low, this->Corners[i][axis]);
      high = std::max(high, this->Corners[i][axis]);
    }
    // The last plane of the grid belongs to the last cell.
    const auto cell = [size](double x) { return std::min(static_cast<std::int64_t>(x), size - 1); };
    return { cell(low), cell(high) };
  }
};

// Cuts a polygon by a plane across an axis (Sutherland and Hodgman) into its parts below and above.
// Corners on the plane go to both parts.
void cut(const Polygon& polygon, std::size_t axis, double plane, Polygon& below, Polygon& above)
{
  below.Count = 0;
  above.Count = 0;
  for (std::size_t i = 0; i < polygon.Count; ++i)
  {
    const Point<2>& a = polygon.Corners[i];
    const Point<2>& b = polygon.Corners[i + 1 < polygon.Count ? i + 1 : 0];
    const double da = a[axis] - plane;
    const double db = b[axis] - plane;
    if (da <= 0.0)
    {
      below.Add(a);
    }
    if (da >= 0.0)
    {
      above.Add(a);
    }
    if ((da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0))
    {
      // Both parts get the same crossing, on the plane exactly: their areas sum to the polygon's.
      const double part = da / (da - db);
      Point<2> crossing;
      crossing[axis] = plane;
      crossing[1 - axis] = a[1 - axis] + (b[1 - axis] - a[1 - axis]) * part;
      below.Add(crossing);
      above.Add(crossing);
    }
  }
}

// Each triangle is cut into rows, each row into cells: the exact overlap areas. Bands of rows are
// independent, so that threads never write to the same cell.
class RasterRun
{
public:
  RasterRun(const PlaneTriangles& triangles, const GridSize<2>& size, double* masses)
    : Triangles(triangles)
    , Size(size)
    , Masses(masses)
    , Bands((size[1] + bandRows - 1) / bandRows)
  {
  }

  // Lists first: a band then visits only its own triangles, in their order.
  void Run(Progress& progress)
  {
    Stages stages(progress, { { "lists", 3 }, { "bands", 7 } });
    this->ListTriangles();
    stages["lists"].Check();
    stages["bands"].ForEach(
      this->Bands, 1, [this](std::int64_t band) { this->FillBand(band); }, 4);
  }

private:
  // The triangle in index space, where cells have the width 1.
  Polygon PolygonOf(std::int64_t triangle) const
  {
    Polygon polygon;
    for (int i = 0; i < 3; ++i)
    {
      const double* position =
        this->Triangles.Positions[this->Triangles.Triangles[3 * triangle + i]];
      polygon.Add({ position[0] * static_cast<double>(this->Size[0]),
        position[1] * static_cast<double>(this->Size[1]) });
    }
    return polygon;
  }

  // The bands that a triangle is in. One without area is in that of its centre.
  std::array<std::int64_t, 2> BandsOf(std::int64_t triangle) const
  {
    const Polygon polygon = this->PolygonOf(triangle);
    const auto rows = (this->HasArea(polygon) ? polygon : pointOf(polygon)).Cells(1, this->Size[1]);
    return { rows[0] / bandRows, rows[1] / bandRows };
  }

  // Whether the triangle is wide enough for what rounding does to the areas of its parts: about
  // 1e-16 times its length and the size of the grid.
  bool HasArea(const Polygon& polygon) const
  {
    // 1e-10 leaves the areas of parts six digits above rounding.
    constexpr double accuracy = 1e-10;
    double length = 0.0;
    for (std::size_t i = 1; i < polygon.Count; ++i)
    {
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        length = std::max(length, std::abs(polygon.Corners[i][axis] - polygon.Corners[0][axis]));
      }
    }
    const auto cells = static_cast<double>(std::max(this->Size[0], this->Size[1]));
    return polygon.Area() > accuracy * cells * length;
  }

  // The centre of a triangle.
  static Polygon pointOf(const Polygon& polygon)
  {
    Polygon point;
    const Point<2>& a = polygon.Corners[0];
    const Point<2>& b = polygon.Corners[1];
    const Point<2>& c = polygon.Corners[2];
    point.Add({ (a[0] + b[0] + c[0]) / 3.0, (a[1] + b[1] + c[1]) / 3.0 });
    return point;
  }

  // In each band triangles keep their order, so that the sums of a cell do: masses have the same
  // bits for any number of threads.
  void ListTriangles()
  {
    this->Listed.Fill(static_cast<std::size_t>(this->Bands), [this](const auto& add) {
      for (std::int64_t triangle = 0; triangle < this->Triangles.NumberOfTriangles; ++triangle)
      {
        const auto bands = this->BandsOf(triangle);
        for (std::int64_t band = bands[0]; band <= bands[1]; ++band)
        {
          add(static_cast<std::size_t>(band), triangle);
        }
      }
    });
  }

  // Clears the band's rows and adds the triangles to them; no other thread writes there.
  void FillBand(std::int64_t band) const
  {
    const std::int64_t firstRow = band * bandRows;
    const std::int64_t endRow = std::min(firstRow + bandRows, this->Size[1]);
    std::fill(this->Masses + firstRow * this->Size[0], this->Masses + endRow * this->Size[0], 0.0);
    for (const std::int64_t triangle : this->Listed[static_cast<std::size_t>(band)])
    {
      this->AddTriangle(triangle, firstRow, endRow);
    }
  }

  // The parts of a triangle in rows [firstRow, endRow).
  void AddTriangle(std::int64_t triangle, std::int64_t firstRow, std::int64_t endRow) const
  {
    const double mass = this->Triangles.Masses[triangle];
    Polygon rest = this->PolygonOf(triangle);
    if (!this->HasArea(rest))
    {
      const Polygon centre = pointOf(rest);
      this->MassAt(centre.Cells(0, this->Size[0])[0], centre.Cells(1, this->Size[1])[0]) += mass;
      return;
    }
    // These are the columns and rows of the triangle's bounds, also outside of this band.
    const auto columns = rest.Cells(0, this->Size[0]);
    auto rows = rest.Cells(1, this->Size[1]);
    // Most triangles of fine meshes are in one cell: no cuts, and the exact mass.
    if (columns[0] == columns[1] && rows[0] == rows[1])
    {
      this->MassAt(columns[0], rows[0]) += mass;
      return;
    }
    const double density = mass / rest.Area();
    Polygon part;
    Polygon other;
    // The rows below belong to other bands.
    if (rows[0] < firstRow)
    {
      rows[0] = firstRow;
      cut(rest, 1, static_cast<double>(firstRow), part, other);
      rest = other;
    }
    rows[1] = std::min(rows[1], endRow - 1);
    for (std::int64_t row = rows[0]; row <= rows[1] && rest.Count >= 3; ++row)
    {
      cut(rest, 1, static_cast<double>(row + 1), part, other);
      this->AddRow(part, row, density);
      rest = other;
    }
  }

  // Cuts the part of a triangle in one row at each column's plane, and adds density times area to
  // each cell. The last cell gets what is left.
  void AddRow(Polygon& rest, std::int64_t row, double density) const
  {
    if (rest.Count < 3)
    {
      return;
    }
    const auto columns = rest.Cells(0, this->Size[0]);
    Polygon part;
    Polygon other;
    for (std::int64_t column = columns[0]; column < columns[1]; ++column)
    {
      cut(rest, 0, static_cast<double>(column + 1), part, other);
      this->MassAt(column, row) += density * part.Area();
      rest = other;
    }
    this->MassAt(columns[1], row) += density * rest.Area();
  }

  // Cells are numbered with axis 0 fastest.
  double& MassAt(std::int64_t column, std::int64_t row) const
  {
    return this->Masses[row * this->Size[0] + column];
  }

  const PlaneTriangles& Triangles;
  const GridSize<2> Size;
  double* const Masses;
  const std::int64_t Bands;
  Bins<std::int64_t> Listed; // by bands
};

} // namespace

void rasterizeMass(
  const PlaneTriangles& triangles, const GridSize<2>& size, double* masses, const Context& context)
{
  Progress progress(context);
  RasterRun(triangles, size, masses).Run(progress);
}

} // namespace RectifiedTransport
