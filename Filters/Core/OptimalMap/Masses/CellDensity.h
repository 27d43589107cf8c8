// SPDX-License-Identifier: BSD-3-Clause
// The shares of a density's cells in its mass, and which of them have none.
#ifndef RectifiedTransport_CellDensity_h
#define RectifiedTransport_CellDensity_h

#include "Core/Geometry/GridSize.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Tables/Density.h"

#include <cstdint>

namespace RectifiedTransport
{

class Progress;

// Points are in the index space of the density, cell i covers [i, i+1].
template <int Dimension>
class CellDensity
{
public:
  // The uniform measure on such a grid. It keeps no values.
  explicit CellDensity(const GridSize<Dimension>& size);
  // Reads a density as the work of the current stage. Collective, for a density on ranks. Throws
  // InvalidDensity, std::bad_alloc and Cancelled.
  CellDensity(const DensitySource<Dimension>& density, Progress& progress);

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
  // Moves a point into the nearest cell with mass of the box of cells [low, high), which has some,
  // to where it is in its own cell, which keeps neighbours apart. Cells have the sides `sides`.
  void MoveToMass(double* point, const GridSize<Dimension>& low, const GridSize<Dimension>& high,
    const Point<Dimension>& sides) const;

private:
  GridSize<Dimension> Cells;
  std::int64_t Count;
  double UniformShare;
  bool Voids = false;
  LargeBuffer<double> Shares;
};

} // namespace RectifiedTransport

#endif
