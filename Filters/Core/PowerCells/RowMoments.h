// SPDX-License-Identifier: BSD-3-Clause
// Integrals of a piecewise-constant density over polygons, exact: by the divergence theorem they
// are sums over the polygon's sides, of integrals of the moments along the rows of the grid.
#ifndef RectifiedTransport_RowMoments_h
#define RectifiedTransport_RowMoments_h

#include "Core/Geometry/GridSize.h"
#include "Core/Geometry/Points.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Tables/Density.h"

#include <cstdint>

namespace RectifiedTransport
{

class Progress;

// Of a polygon, its sides counter-clockwise; a side contributes a part, which has no meaning alone.
struct PolygonMoments
{
  double Mass = 0.0;
  Point<2> First{};    // of the coordinates
  double Second = 0.0; // of the squared distance from the origin
};

// The moments along each row of the grid, up to each of its cells. The grid lies in the plane with
// its corner at the origin; the sides of its cells have the lengths `scale`, and the masses of all
// cells add up to `total`.
class RowMoments
{
public:
  // As the work of the current stage of the progress. Takes 32 bytes a cell. Throws InvalidDensity,
  // std::bad_alloc and Cancelled.
  RowMoments(
    const DensitySource<2>& density, const Point<2>& scale, double total, Progress& progress);

  // The lengths of the domain's sides.
  Point<2> Lengths() const;
  // The nearest point of a cell that has mass, distances in cells along each axis; points of the
  // domain that are in such a cell stay.
  Point<2> NearestMass(const Point<2>& point) const;
  // Whether a cell has no mass.
  bool HasEmptyCells() const { return this->Empty; }
  // Spreads this share of the mass evenly over the domain, in place of as much of the density's:
  // above 0 no part of the domain is empty.
  void SetEvenShare(double share) { this->EvenShare = share; }

  // Adds the part of the side from `from` to `to` of a polygon in the domain.
  void AddSide(const Point<2>& from, const Point<2>& to, PolygonMoments& moments) const;
  // The same for the mass alone. Returns the integral of the density along the side.
  double AddSideMass(const Point<2>& from, const Point<2>& to, double& mass) const;

private:
  // Of a cell: its mass, and that of the cells of the row before it.
  struct Masses
  {
    double Before;
    double Own;
  };
  // Integrals over the cells of the row before one of x and x^2 (x in cells) times density.
  struct Moments
  {
    double First;
    double Second;
  };

  struct Way;

  std::int64_t WordsPerRow() const { return (this->Size[0] + 63) / 64; }
  DensitySummary ReadValues(const DensityValues& values, Progress& progress);
  void Accumulate(double total, const DensitySummary& found, Progress& progress);
  Masses MassesAt(std::int64_t column, std::int64_t row) const;
  Moments MomentsAt(std::int64_t column, std::int64_t row) const;
  // Calls visit(column, row, from, to, part) for the part of a side in each cell, in their order,
  // which is from `from` to `to` in cells and makes up `part` of the side.
  template <class Visit>
  void VisitCells(const Point<2>& from, const Point<2>& to, const Visit& visit) const;

  GridSize<2> Size;
  Point<2> Scale;
  double MeanMass = 0.0; // of a cell
  double EvenShare = 0.0;
  bool Empty = false;
  LargeBuffer<Masses> CellMasses;
  LargeBuffer<Moments> CellMoments;
  LargeBuffer<std::uint64_t> Occupied; // a bit a cell, rows of whole words
};

} // namespace RectifiedTransport

#endif
