// SPDX-License-Identifier: BSD-3-Clause
// A piecewise constant density on another grid along the same axes: its mean over each cell of that
// grid, by the exact overlaps of cells.
#ifndef RectifiedTransport_CellMeans_h
#define RectifiedTransport_CellMeans_h

#include "../Geometry/LatticePart.h"
#include "../Geometry/Points.h"
#include "Density.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// Where the cells of a density are, in cells of another grid.
template <int Dimension>
struct PlacedCells
{
  GridSize<Dimension> Size;
  Point<Dimension> Low;   // low corner of the first cell
  Point<Dimension> Sides; // sides of each cell; above 0
};

template <int Dimension>
class CellMeans
{
public:
  // Computes the overlaps for a part of a grid of `size` cells, which covers the density. The cells
  // at the border take what rounding puts beyond it, so that no mass is lost.
  CellMeans(const PlacedCells<Dimension>& density, const GridSize<Dimension>& size,
    const LatticePart<Dimension>& part);

  // The density's cells from Low up to High have values in the part.
  const GridSize<Dimension>& Low() const { return this->First; }
  const GridSize<Dimension>& High() const { return this->Last; }

  // Writes the means, axis 0 fastest; the density is 0 outside its cells. If cells of both grids
  // are the same, these are its values, to the bit. The same bits for every part and number of
  // threads. Throws Cancelled.
  void Write(const DensityValues& density, Progress& progress, double* means) const;

private:
  // The cells of the density that a cell of the other grid overlaps along an axis: `Shares` of
  // its length, from the cell `First` on.
  struct Overlap
  {
    std::int64_t First = 0;
    std::vector<double> Shares;

    std::int64_t Count() const { return static_cast<std::int64_t>(this->Shares.size()); }
  };

  // Writes one row of means; `buffer` has room for High(0) - Low(0) values of the density.
  void WriteRow(
    std::int64_t row, const DensityValues& density, double* buffer, double* means) const;

  const GridSize<Dimension> Cells; // size of the density's grid
  const LatticePart<Dimension> Part;
  // For each axis, an overlap for each cell of the part; and the density's cells that they use.
  std::vector<Overlap> Axes[Dimension];
  GridSize<Dimension> First{};
  GridSize<Dimension> Last{};
};

} // namespace RectifiedTransport

#endif
