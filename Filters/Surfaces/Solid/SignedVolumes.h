// SPDX-License-Identifier: BSD-3-Clause
// The volumes that a closed surface encloses in the cells of a grid, exactly, each place multiplied
// by its winding number.
#ifndef RectifiedTransport_SignedVolumes_h
#define RectifiedTransport_SignedVolumes_h

#include "Core/Geometry/GridSize.h"
#include "Core/Geometry/LatticePart.h"
#include "Surfaces/Solid/SurfaceCuts.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace RectifiedTransport
{

// A sum of doubles up to about 1 that does not depend on their order: each is rounded to a
// multiple of 2^-72, and these are added as integers. A value is split into high 2^-36 + low 2^-72.
// Valid for at least 2^27 values. ReproducibleSum{} is 0.
class ReproducibleSum
{
public:
  void Add(double value)
  {
    const double scaled = value * Unit;
    const auto high = static_cast<std::int64_t>(scaled);
    this->High += high;
    this->Low += static_cast<std::int64_t>((scaled - static_cast<double>(high)) * Unit);
  }
  void Add(const ReproducibleSum& other)
  {
    this->High += other.High;
    this->Low += other.Low;
  }
  double Value() const
  {
    return (static_cast<double>(this->High) + static_cast<double>(this->Low) / Unit) / Unit;
  }

private:
  static constexpr double Unit = 0x1p36; // 63 bits of an integer hold 2^27 values below 2^36
  std::int64_t High;                     // in 2^-36
  std::int64_t Low;                      // in 2^-72
};

// The volumes in a layer of cells, by the divergence theorem. Over a piece of a triangle within one
// cell stands a prism along axis 0, up to the end of the row. Its volume in the piece's own cell is
// the piece's area, projected along axis 0, times its mean distance from the cell's end; in each
// later cell of the row it is the area. With the sign of the piece's side, these sum to the
// enclosed volume. The error is that of rounding, about 1e-15 of a cell, for parts of any
// thickness.
class SignedVolumes
{
public:
  // For the rows of a part; each row has all cells along axis 0.
  SignedVolumes(const GridSize<3>& cells, const LatticePart<3>& part);

  // Clears everything; then the layer is `layer`.
  void Begin(std::int64_t layer);
  // Adds `weight` times the volume in front of the outward side of a triangle. Triangles beyond the
  // grid along axis 0 count as on its border; their parts beyond it along the other axes are
  // ignored.
  void Add(const std::array<Corner, 3>& triangle, int weight);

  // Whether a triangle has a part in a row, counted from the part's first row.
  bool HasRow(std::int64_t row) const { return this->Used[static_cast<std::size_t>(row)] != 0; }
  // Writes the volumes of all cells of such a row. Values that differ from 0 or 1 by at most
  // `rounding` times the areas before a cell's end become 0 or 1.
  void WriteRow(std::int64_t row, double rounding, double* volumes) const;

private:
  // The sums of one cell of a row.
  struct CellSums
  {
    ReproducibleSum Own;    // volumes of prisms that begin in the cell
    ReproducibleSum Beyond; // areas of prisms that begin in the cell before
    std::int64_t Areas;     // absolute areas of prisms that begin in the cell, in AreaUnit
  };

  static constexpr double AreaUnit = 0x1p-40; // in faces of a cell

  void AddToRow(std::int64_t row, const CutPolygon& polygon, double weight);
  CellSums* RowOf(std::int64_t row);

  std::int64_t Columns;
  std::int64_t Rows; // rows of the grid along axis 1
  std::int64_t FirstRow;
  std::int64_t NumberOfRows; // rows of the part
  double Layer = 0.0;
  std::vector<unsigned char> Used;  // by rows of the part: 1 if a triangle has a part there
  std::unique_ptr<CellSums[]> Sums; // Columns + 1 a row; valid where Used is 1
};

} // namespace RectifiedTransport

#endif
