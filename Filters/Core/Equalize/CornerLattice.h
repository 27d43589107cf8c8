// SPDX-License-Identifier: BSD-3-Clause
// The images of the corners of a grid's cells with their moves, by rows for the kernels.
#ifndef RectifiedTransport_CornerLattice_h
#define RectifiedTransport_CornerLattice_h

#include "Core/Equalize/Kernels/EqualizeKernels.h"
#include "Core/Geometry/GridSize.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

// Numbers of rows of cells about a row of corners, [offset1 + 2 * offset2]; -1 if there is none.
using RowsAbout = std::array<std::int64_t, 4>;

// Images are doubles, interleaved, axis 0 fastest; moves are floats, one array a coordinate, as the
// kernels read them. NextMoves receives what a sweep writes.
template <int Dimension>
class CornerLattice
{
public:
  static constexpr int RowsOfCell = Dimension == 2 ? 3 : 9;

  // Moves are not initialised.
  CornerLattice(const GridSize<Dimension>& cells, PointSpan<Dimension> corners)
    : CellCounts(cells)
    , Corners(corners)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      this->Move[axis] = LargeBuffer<float>(corners.size());
      this->NextMove[axis] = LargeBuffer<float>(corners.size());
    }
  }

  const GridSize<Dimension>& Cells() const { return this->CellCounts; }
  std::int64_t CellRows() const { return this->RowCount(0); }
  std::int64_t CornerRows() const { return this->RowCount(1); }
  std::int64_t CornersOfRow() const { return this->CellCounts[0] + 1; }
  // The place of a row along axes 1 and 2; of cells, or of corners (added = 1).
  std::array<std::int64_t, 2> PlaceOf(std::int64_t row, int added) const
  {
    const std::int64_t rows = this->CellCounts[1] + added;
    return { row % rows, row / rows };
  }

  // The row's number from its place.
  std::int64_t NumberOf(const std::array<std::int64_t, 2>& place, int added) const
  {
    return place[1] * (this->CellCounts[1] + added) + place[0];
  }

  // The rows of cells that touch a row of corners.
  RowsAbout CellRowsAbout(std::int64_t cornerRow) const
  {
    const std::array<std::int64_t, 2> place = this->PlaceOf(cornerRow, 1);
    const std::int64_t slices = Dimension == 3 ? this->CellCounts[Dimension - 1] : 1;
    RowsAbout rows;
    for (int r = 0; r < 4; ++r)
    {
      const std::array<std::int64_t, 2> at{ place[0] - 1 + r % 2,
        Dimension == 3 ? place[1] - 1 + r / 2 : r / 2 };
      const bool exists = at[0] >= 0 && at[0] < this->CellCounts[1] && at[1] >= 0 && at[1] < slices;
      rows[r] = exists ? this->NumberOf(at, 0) : -1;
    }
    return rows;
  }

  // Runs a kernel over rows, in ranges that depend on the size alone.
  void ForRanges(std::int64_t rows, Progress& progress, RangeKernel kernel) const
  {
    constexpr std::int64_t grainCells = 1 << 13;
    constexpr std::int64_t firstCells = 1 << 16; // cells of a slice: a few milliseconds
    const std::int64_t columns = this->CellCounts[0];
    progress.For(rows, std::max<std::int64_t>(grainCells / columns, 1), kernel,
      std::max<std::int64_t>(firstCells / columns, 1));
  }
  // Calls work(row) for each row.
  template <class Work>
  void ForRows(std::int64_t rows, Progress& progress, const Work& work) const
  {
    this->ForRanges(rows, progress, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t row = first; row < last; ++row)
      {
        work(row);
      }
    });
  }

  // The moves of all corners along an axis.
  float* Moves(int axis) { return this->Move[axis].data(); }
  float* NextMoves(int axis) { return this->NextMove[axis].data(); }
  // The next moves become the moves, of all rows or of one.
  void TakeNextMoves()
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      std::swap(this->Move[axis], this->NextMove[axis]);
    }
  }

  void TakeNextMoves(std::int64_t cornerRow)
  {
    const std::int64_t count = this->CornersOfRow();
    for (int axis = 0; axis < Dimension; ++axis)
    {
      std::copy_n(this->NextMove[axis].data() + cornerRow * count, count,
        this->Move[axis].data() + cornerRow * count);
    }
  }

  // Corners on a side of the box move along it alone: sets the other moves of a row to zero.
  void KeepOnSides(std::int64_t cornerRow, float* const* moves) const
  {
    const std::array<std::int64_t, 2> place = this->PlaceOf(cornerRow, 1);
    const std::int64_t count = this->CornersOfRow();
    moves[0][0] = 0.0F;
    moves[0][count - 1] = 0.0F;
    for (int axis = 1; axis < Dimension; ++axis)
    {
      if (place[axis - 1] == 0 || place[axis - 1] == this->CellCounts[axis])
      {
        std::fill_n(moves[axis], count, 0.0F);
      }
    }
  }

  // Adds the moves to the corners of a row, and what they are moved by to `sum`, interleaved, if it
  // is not null.
  void Apply(std::int64_t cornerRow, float* sum)
  {
    const std::int64_t count = this->CornersOfRow();
    double* to = this->Corners[cornerRow * count];
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const float* move = this->Move[axis].data() + cornerRow * count;
      const auto side = static_cast<double>(this->CellCounts[axis]);
      for (std::int64_t i = 0; i < count; ++i)
      {
        double& x = to[Dimension * i + axis];
        const double before = x;
        x = std::min(std::max(x + static_cast<double>(move[i]), 0.0), side);
        if (sum)
        {
          sum[(cornerRow * count + i) * Dimension + axis] += static_cast<float>(x - before);
        }
      }
    }
  }

  // Rows of corners, an array a coordinate, for one thread.
  class Rows
  {
  public:
    // The corners are moved by their moves if `moved`.
    Rows(const CornerLattice& lattice, bool moved)
      : Lattice(lattice)
      , Moved(moved)
      , Values(static_cast<std::size_t>(RowsOfCell * Dimension * lattice.CornersOfRow()))
    {
      this->Loaded.fill(-1);
      this->Found.Cells = lattice.CellCounts[0];
    }

    // The rows at and after a row of cells; without the next ones, those of offset 2 are not read.
    const CellRow<Dimension>& AtCells(std::int64_t cellRow, bool withNext)
    {
      const std::array<std::int64_t, 2> place = this->Lattice.PlaceOf(cellRow, 0);
      const std::array<std::int64_t, 2> last = this->Lattice.LastCorner();
      const int offsets = withNext ? 3 : 2;
      for (int b = 0; b < (Dimension == 3 ? offsets : 1); ++b)
      {
        for (int a = 0; a < offsets; ++a)
        {
          if (a < 2 || b < 2) // no face's neighbours are at both offsets 2
          {
            this->Found.Corners[a + 3 * b] =
              this->Load({ std::min(place[0] + a, last[0]), std::min(place[1] + b, last[1]) });
          }
        }
      }
      return this->Found;
    }

    // The rows about a row of corners.
    const PointRow<Dimension>* AboutCorners(std::int64_t cornerRow)
    {
      const std::array<std::int64_t, 2> place = this->Lattice.PlaceOf(cornerRow, 1);
      const std::array<std::int64_t, 2> last = this->Lattice.LastCorner();
      const auto within = [](std::int64_t at, std::int64_t end) {
        return std::min(std::max(at, std::int64_t{ 0 }), end);
      };
      for (int b = 0; b < (Dimension == 3 ? 3 : 1); ++b)
      {
        for (int a = 0; a < 3; ++a)
        {
          this->Found.Corners[a + 3 * b] =
            this->Load({ within(place[0] + a - 1, last[0]), within(place[1] + b - 1, last[1]) });
        }
      }
      return this->Found.Corners;
    }

  private:
    // A row has a slot, by its place modulo 3 along both axes: the next rows of cells or corners
    // find most of theirs.
    PointRow<Dimension> Load(const std::array<std::int64_t, 2>& place)
    {
      const auto slot =
        static_cast<std::size_t>(place[0] % 3 + (Dimension == 3 ? place[1] % 3 * 3 : 0));
      const std::int64_t cornerRow = this->Lattice.NumberOf(place, 1);
      const bool isNew = this->Loaded[slot] != cornerRow;
      this->Loaded[slot] = cornerRow;
      const std::int64_t count = this->Lattice.CornersOfRow();
      const double* from = this->Lattice.Corners[cornerRow * count];
      PointRow<Dimension> row;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        double* to =
          this->Values.data() + (static_cast<std::int64_t>(slot) * Dimension + axis) * count;
        row.X[axis] = to;
        if (isNew)
        {
          for (std::int64_t i = 0; i < count; ++i)
          {
            to[i] = from[Dimension * i + axis];
          }
        }
        if (isNew && this->Moved)
        {
          const float* move = this->Lattice.Move[axis].data() + cornerRow * count;
          const auto side = static_cast<double>(this->Lattice.CellCounts[axis]);
          for (std::int64_t i = 0; i < count; ++i)
          {
            to[i] = std::min(std::max(to[i] + static_cast<double>(move[i]), 0.0), side);
          }
        }
      }
      return row;
    }

    const CornerLattice& Lattice;
    bool Moved;
    std::vector<double> Values;
    std::array<std::int64_t, RowsOfCell> Loaded; // by slot
    CellRow<Dimension> Found;
  };

  // Two arrays of moves.
  static double Memory(const GridSize<Dimension>& cells)
  {
    return 2.0 * Dimension * numberOfCorners<Dimension>(cells) * sizeof(float);
  }

private:
  // Rows along axis 0 of cells, or of corners (added = 1).
  std::int64_t RowCount(int added) const
  {
    std::int64_t count = 1;
    for (int axis = 1; axis < Dimension; ++axis)
    {
      count *= this->CellCounts[axis] + added;
    }
    return count;
  }

  // The last corner's place along axes 1 and 2.
  std::array<std::int64_t, 2> LastCorner() const
  {
    return { this->CellCounts[1], Dimension == 3 ? this->CellCounts[Dimension - 1] : 0 };
  }

  GridSize<Dimension> CellCounts;
  PointSpan<Dimension> Corners;
  LargeBuffer<float> Move[Dimension];
  LargeBuffer<float> NextMove[Dimension];
};

} // namespace RectifiedTransport

#endif
