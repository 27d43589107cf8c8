// SPDX-License-Identifier: BSD-3-Clause
// Exact integrals of a piecewise-constant density over polygons. By the divergence theorem they are
// sums over the polygon's sides of integrals of the moments along the rows of the grid.
#ifndef RectifiedTransport_RowMoments_h
#define RectifiedTransport_RowMoments_h

#include "Core/Geometry/GridSize.h"
#include "Core/Geometry/Points.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Tables/Density.h"
#include "Core/Tables/TableView.h"

#include <cstdint>

namespace RectifiedTransport
{

class Progress;

// The moments of a polygon with counter-clockwise sides. Each side contributes a part, which has no
// meaning on its own.
struct PolygonMoments
{
  // The moments of the polygon after a translation.
  PolygonMoments Translated(const Point<2>& offset) const
  {
    const Point<2>& x = this->First;
    return { this->Mass, { x[0] + offset[0] * this->Mass, x[1] + offset[1] * this->Mass },
      this->Second + 2.0 * (offset[0] * x[0] + offset[1] * x[1]) +
        (offset[0] * offset[0] + offset[1] * offset[1]) * this->Mass };
  }

  double Mass = 0.0;
  Point<2> First{};    // integral of the coordinates
  double Second = 0.0; // integral of the squared distance from the origin
};

// The cumulative masses along each row of the grid. The grid lies in the plane with its corner at
// the origin. The sides of its cells have the lengths `scale`, and the masses of all cells sum to
// `total`.
class RowMoments
{
public:
  // Takes 16 bytes a cell and 24 for 16 cells of a row. Throws InvalidDensity, std::bad_alloc and
  // Cancelled.
  RowMoments(
    const DensitySource<2>& density, const Point<2>& scale, double total, Progress& progress);

  // The lengths of the domain's sides.
  Point<2> Lengths() const;
  // The nearest point of a cell that has mass; points of the domain that are in such a cell stay.
  Point<2> NearestMass(const Point<2>& point) const;
  bool HasMass(const Point<2>& point) const;
  // Whether a cell has no mass.
  bool HasEmptyCells() const { return this->Empty; }
  // Spreads this share of the mass evenly over the domain and reduces the density by the same
  // share. Above 0, no part of the domain is empty.
  void SetEvenShare(double share) { this->EvenShare = share; }

  // Prefetches the memory of the cells of a box, if it fits into the caches.
  void Prefetch(const Point<2>& low, const Point<2>& high) const;
  // The cell of the grid that contains a point, or one next to it.
  GridSize<2> CellAt(const Point<2>& point) const;
  // The corner of a cell nearest to the origin.
  Point<2> CornerOf(const GridSize<2>& cell) const;
  // Adds the part of the side from `from` to `to` of a polygon in the domain. The moments are
  // relative to the corner of the cell `origin`, the same for all sides. If it is near the polygon,
  // they keep their digits on grids of any size.
  void AddSide(const Point<2>& from, const Point<2>& to, const GridSize<2>& origin,
    PolygonMoments& moments) const;
  // Adds only to the mass, with sums from the beginning of the rows: a part does not depend on the
  // polygon. Returns the integral of the density along the side.
  double AddSideMass(const Point<2>& from, const Point<2>& to, double& mass) const;

private:
  // The mass of a cell, and the mass of the cells before it in its row.
  struct Masses
  {
    double Before;
    double Own;
  };
  // Sums or integrals over cells of a row of their masses times 1, x and x^2 (x in cells).
  struct Moments
  {
    void Add(double mass, double x)
    {
      const double first = x * mass;
      this->Mass += mass;
      this->First += first;
      this->Second += x * first;
    }
    // Adds the moments of `part`, whose x begin at `offset`.
    void Add(const Moments& part, double offset)
    {
      this->Second += part.Second + offset * (2.0 * part.First + offset * part.Mass);
      this->First += part.First + offset * part.Mass;
      this->Mass += part.Mass;
    }
    // Converts masses at the beginnings of cells to masses spread evenly over cells.
    Moments Spread() const
    {
      return { this->Mass, this->First + this->Mass / 2.0,
        this->Second + this->First + this->Mass / 3.0 };
    }

    double Mass;
    double First;
    double Second;
  };

  struct Traversal;
  class RowIntegral;

  static constexpr std::int64_t cellsOfBlock = 16;
  std::int64_t BlocksPerRow() const { return (this->Size[0] + cellsOfBlock - 1) / cellsOfBlock; }

  TableView<2> Occupation() const;
  Point<2> ToIndex(const Point<2>& point) const
  {
    return { point[0] / this->Scale[0], point[1] / this->Scale[1] };
  }
  std::int64_t WordsPerRow() const { return (this->Size[0] + 63) / 64; }
  std::int64_t RowsOfSlice() const;
  DensitySummary ReadValues(const DensityValues& values, Progress& progress);
  void Accumulate(double total, const DensitySummary& found, Progress& progress);
  const Masses* RowAt(std::int64_t row) const
  {
    return this->CellMasses.data() + row * this->Size[0];
  }
  Masses* RowAt(std::int64_t row) { return this->CellMasses.data() + row * this->Size[0]; }
  // Mixes a mass with the even share: (1 - e) mass + e * mean mass * cells.
  double WithEven(double mass, double evenMasses) const
  {
    return (1.0 - this->EvenShare) * mass + this->EvenShare * this->MeanMass * evenMasses;
  }
  // Calls visit(column, row, from, to, part), in order, for the piece of a side in each cell; it
  // goes from `from` to `to` in cells and is the fraction `part` of the side.
  template <class Visit>
  void VisitCells(const Point<2>& from, const Point<2>& to, const Visit& visit) const;

  GridSize<2> Size;
  Point<2> Scale;
  double MeanMass = 0.0; // mean mass of a cell
  double EvenShare = 0.0;
  bool Empty = false;
  LargeBuffer<Masses> CellMasses;
  // The moments of masses at the beginnings of cells, relative to the block's first cell.
  LargeBuffer<Moments> Blocks;
  LargeBuffer<std::uint64_t> Occupied; // a bit a cell, rows of whole words
};

} // namespace RectifiedTransport

#endif
