// SPDX-License-Identifier: BSD-3-Clause
// The images of the corners of a grid's cells with their moves, by rows for the kernels.
#ifndef RectifiedTransport_CornerLattice_h
#define RectifiedTransport_CornerLattice_h

#include "Core/Equalize/Kernels/EqualizeKernels.h"
#include "Core/Geometry/GridSize.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"

#include <array>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Numbers of rows of cells about a row of corners, [offset1 + 2 * offset2]; -1 if there is none.
using RowsAbout = std::array<std::int64_t, 4>;

template <int Dimension>
class CornerLattice
{
public:
  static constexpr int RowsOfCell = Dimension == 2 ? 3 : 9;

  // Moves are not initialised.
  CornerLattice(const GridSize<Dimension>& cells, PointSpan<Dimension> corners);

  const GridSize<Dimension>& Cells() const { return this->CellCounts; }
  std::int64_t CellRows() const { return this->RowCount(0); }
  std::int64_t CornerRows() const { return this->RowCount(1); }
  std::int64_t CornersOfRow() const { return this->CellCounts[0] + 1; }
  // The place of a row along axes 1 and 2; of cells, or of corners (added = 1).
  std::array<std::int64_t, 2> PlaceOf(std::int64_t row, int added) const;
  std::int64_t NumberOf(const std::array<std::int64_t, 2>& place, int added) const;
  RowsAbout CellRowsAbout(std::int64_t cornerRow) const;

  // Runs a kernel over rows, in ranges that depend on the size alone.
  std::int64_t Grain() const;
  std::int64_t FirstSlice() const;
  void ForRows(std::int64_t rows, Progress& progress, RangeKernel kernel) const;

  float* Moves(int axis) { return this->Move[axis].data(); }
  float* NextMoves(int axis) { return this->NextMove[axis].data(); }
  void TakeNextMoves();
  void TakeNextMoves(std::int64_t cornerRow);
  // Corners on a side of the box move along it alone: sets the other moves of a row to zero.
  void KeepOnSides(std::int64_t cornerRow, float* const* moves) const;
  // Adds the moves to the corners of a row, and what they are moved by to `sum`, interleaved, if it
  // is not null.
  void Apply(std::int64_t cornerRow, float* sum);

  // Rows of corners, an array a coordinate, for one thread.
  class Rows
  {
  public:
    // With the corners' moves or without.
    Rows(const CornerLattice& lattice, bool moved);
    // The rows at and after a row of cells; without the next ones, those of offset 2 are not read.
    const CellRow<Dimension>& AtCells(std::int64_t cellRow, bool withNext);
    // The rows about a row of corners.
    const PointRow<Dimension>* AboutCorners(std::int64_t cornerRow);

  private:
    PointRow<Dimension> Load(const std::array<std::int64_t, 2>& place);

    const CornerLattice& Lattice;
    bool Moved;
    std::vector<double> Values;
    std::array<std::int64_t, RowsOfCell> Loaded; // by slot
    CellRow<Dimension> Found;
  };

  static double Memory(const GridSize<Dimension>& cells);

private:
  std::int64_t RowCount(int added) const;
  // Along axes 1 and 2.
  std::array<std::int64_t, 2> LastCorner() const;

  GridSize<Dimension> CellCounts;
  PointSpan<Dimension> Corners;
  LargeBuffer<float> Move[Dimension];
  LargeBuffer<float> NextMove[Dimension];
};

} // namespace RectifiedTransport

#endif
