// SPDX-License-Identifier: BSD-3-Clause
// The shares of a density's cells in its mass, and which of them have none.
#ifndef RectifiedTransport_CellDensity_h
#define RectifiedTransport_CellDensity_h

#include "Core/Geometry/GridSize.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Tables/Density.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace RectifiedTransport
{

class Progress;

// Where a point is in its cell of the box of cells [low, high), the one that holds it or is nearest
// to it. A point that moves to another cell keeps its place in it, so that neighbours stay apart.
template <int Dimension>
struct PlaceInCell
{
  static constexpr double Inside = 0x1p-20; // the least distance from a cell's sides, in cells

  PlaceInCell(const double* point, const GridSize<Dimension>& low, const GridSize<Dimension>& high)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double cell = std::clamp(std::floor(point[axis]), static_cast<double>(low[axis]),
        static_cast<double>(high[axis] - 1));
      this->Cell[axis] = static_cast<std::int64_t>(cell);
      this->Place[axis] = std::clamp(point[axis] - cell, Inside, 1.0 - Inside);
    }
  }
  void MoveTo(const GridSize<Dimension>& cell, double* point) const
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      point[axis] = static_cast<double>(cell[axis]) + this->Place[axis];
    }
  }

  GridSize<Dimension> Cell;
  Point<Dimension> Place;
};

// Points are in the index space of the density, cell i covers [i, i+1].
template <int Dimension>
class CellDensity
{
public:
  // The uniform measure on such a grid. It keeps no values.
  explicit CellDensity(const GridSize<Dimension>& size);
  // Reads a density. Collective, for a density on ranks. Throws InvalidDensity, std::bad_alloc and
  // Cancelled.
  CellDensity(const DensitySource<Dimension>& density, Progress& progress);

  // Takes the shares of another density on the same cells if they differ by rounding alone, as
  // those of a density and of three times it.
  void TakeIfSame(const CellDensity& other, Progress& progress);

  const GridSize<Dimension>& Size() const { return this->Cells; }
  std::int64_t NumberOfCells() const { return this->Count; }
  bool IsUniform() const { return this->Shares.size() == 0; }
  bool HasVoids() const { return this->Voids; }
  // The share of a cell, axis 0 fastest; all sum to 1.
  double Share(std::int64_t cell) const
  {
    return this->IsUniform() ? this->UniformShare : this->Shares.data()[cell];
  }
  // The shares of all cells; null if uniform.
  const double* data() const { return this->Shares.data(); }

  // The cell that holds a point, which is moved to the border if it is outside.
  std::int64_t CellOf(const double* point) const;
  bool HasMass(const double* point) const
  {
    return !this->Voids || this->Shares.data()[this->CellOf(point)] > 0.0;
  }
  // Moves a point into the nearest cell with mass, as PlaceInCell does. Cells have the sides
  // `sides`.
  void MoveToMass(double* point, const Point<Dimension>& sides) const;

private:
  GridSize<Dimension> Cells;
  std::int64_t Count;
  double UniformShare;
  bool Voids = false;
  LargeBuffer<double> Shares;
};

} // namespace RectifiedTransport

#endif
