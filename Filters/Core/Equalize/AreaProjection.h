// SPDX-License-Identifier: BSD-3-Clause
// Cimmino's simultaneous projections: every cell moves its corners along the gradient of its area
// to its target, and each corner takes the sum. Corrects errors on the scale of cells.
#ifndef RectifiedTransport_AreaProjection_h
#define RectifiedTransport_AreaProjection_h

#include "Core/Equalize/CornerLattice.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Rows of cells and of corners that take part in a sweep.
struct ActiveRows
{
  std::vector<unsigned char> OfCells;
  std::vector<unsigned char> OfCorners;
};

template <int Dimension>
class AreaProjection
{
public:
  explicit AreaProjection(CornerLattice<Dimension>& lattice)
    : Lattice(lattice)
    , Kernels(equalizeKernels<Dimension>())
    , Mobility(lattice.CornerRows() * lattice.CornersOfRow())
    , Multipliers(lattice.CellRows() * lattice.Cells()[0])
  {
  }

  // To be called before the sweeps: `targets` are the areas that the cells shall have.
  void SetTargets(const float* targets, Progress& progress)
  {
    this->Targets = targets;
    this->Lattice.ForRows(
      this->Lattice.CornerRows(), progress, [this](std::int64_t row) { this->FindMobility(row); });
  }

  // A sweep over all cells, which changes the moves of the lattice. Units of progress: twice the
  // rows of corners, with states three times.
  void Sweep(Progress& progress)
  {
    this->SweepRows(nullptr, nullptr, 0, progress);
    this->Lattice.TakeNextMoves();
  }

  // A sweep only over the cells that have this bit in their states, in active rows.
  void Sweep(
    const unsigned char* states, unsigned char bit, const ActiveRows& active, Progress& progress)
  {
    this->SweepRows(&active, states, bit, progress);
    this->Lattice.ForRows(this->Lattice.CornerRows(), progress, [&](std::int64_t row) {
      if (active.OfCorners[static_cast<std::size_t>(row)])
      {
        this->Lattice.TakeNextMoves(row);
      }
    });
  }

  static double Memory(const GridSize<Dimension>& size)
  {
    return (numberOfCells<Dimension>(size) + numberOfCorners<Dimension>(size)) * sizeof(float);
  }

private:
  // A corner's mobility m is the least target of its cells: a move that suits a large cell could
  // fold a small one beside it. Hence small cells' corners move less.
  void FindMobility(std::int64_t cornerRow)
  {
    constexpr float leastMobility = 1e-6F;
    const std::int64_t cells = this->Lattice.Cells()[0];
    float* mobility = this->Mobility.data() + cornerRow * (cells + 1);
    std::fill_n(mobility, cells + 1, static_cast<float>(cells)); // more than a cell's share
    const RowsAbout about = this->Lattice.CellRowsAbout(cornerRow);
    for (int r = 0; r < 4; ++r)
    {
      if (about[r] < 0)
      {
        continue;
      }
      const float* targets = this->Targets + about[r] * cells;
      for (std::int64_t i = 0; i < cells; ++i)
      {
        mobility[i] = std::min(mobility[i], targets[i]);
      }
      for (std::int64_t i = 0; i < cells; ++i)
      {
        mobility[i + 1] = std::min(mobility[i + 1], targets[i]);
      }
    }
    for (std::int64_t i = 0; i <= cells; ++i)
    {
      mobility[i] = std::max(mobility[i], leastMobility);
    }
  }

  // Multipliers of a row of cells, from their areas with the present moves.
  void FindMultipliers(
    std::int64_t cellRow, typename CornerLattice<Dimension>::Rows& rows, std::vector<double>& areas)
  {
    const std::int64_t cells = this->Lattice.Cells()[0];
    const CellRow<Dimension>& corners = rows.AtCells(cellRow, false);
    const std::array<std::int64_t, 2> place = this->Lattice.PlaceOf(cellRow, 0);
    const float* mobilities[4];
    for (int r = 0; r < (Dimension == 3 ? 4 : 2); ++r)
    {
      mobilities[r] = this->Mobility.data() +
        this->Lattice.NumberOf({ place[0] + r % 2, place[1] + r / 2 }, 1) * (cells + 1);
    }
    this->Kernels.Areas(corners, areas.data());
    this->Kernels.Multipliers(corners, mobilities, areas.data(), this->Targets + cellRow * cells,
      this->Multipliers.data() + cellRow * cells);
  }

  // The next moves of a row of corners. Corners on a side of the box stay on it.
  void Project(
    std::int64_t cornerRow, typename CornerLattice<Dimension>::Rows& rows, const float* none)
  {
    const std::int64_t cells = this->Lattice.Cells()[0];
    const std::int64_t first = cornerRow * (cells + 1);
    ProjectedRow<Dimension> row;
    std::copy_n(rows.AboutCorners(cornerRow), CornerLattice<Dimension>::RowsOfCell, row.Corners);
    row.Cells = cells;
    const RowsAbout about = this->Lattice.CellRowsAbout(cornerRow);
    for (int r = 0; r < (Dimension == 3 ? 4 : 2); ++r)
    {
      row.Multipliers[r] = about[r] < 0 ? none : this->Multipliers.data() + about[r] * cells;
    }
    row.Mobility = this->Mobility.data() + first;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      row.Before[axis] = this->Lattice.Moves(axis) + first;
      row.After[axis] = this->Lattice.NextMoves(axis) + first;
    }
    this->Kernels.Project(row);
    this->Lattice.KeepOnSides(cornerRow, row.After);
  }

  // Two loops with a barrier between them: multipliers of all cells first, then the moves of
  // corners, which read their cells'. `active` null: all rows, and all of their cells.
  void SweepRows(
    const ActiveRows* active, const unsigned char* states, unsigned char bit, Progress& progress)
  {
    using Rows = typename CornerLattice<Dimension>::Rows;
    const std::int64_t cells = this->Lattice.Cells()[0];
    // Rows about an active row of corners are read, too.
    this->Lattice.ForRanges(
      this->Lattice.CellRows(), progress, [&](std::int64_t first, std::int64_t last) {
        Rows rows(this->Lattice, true);
        std::vector<double> areas(static_cast<std::size_t>(cells));
        for (std::int64_t row = first; row < last; ++row)
        {
          float* multipliers = this->Multipliers.data() + row * cells;
          if (active && !active->OfCells[static_cast<std::size_t>(row)])
          {
            std::fill_n(multipliers, cells, 0.0F);
            continue;
          }
          this->FindMultipliers(row, rows, areas);
          for (std::int64_t i = 0; active && i < cells; ++i)
          {
            multipliers[i] = (states[row * cells + i] & bit) != 0 ? multipliers[i] : 0.0F;
          }
        }
      });
    this->Lattice.ForRanges(
      this->Lattice.CornerRows(), progress, [&](std::int64_t first, std::int64_t last) {
        Rows rows(this->Lattice, true);
        const std::vector<float> none(static_cast<std::size_t>(cells), 0.0F);
        for (std::int64_t row = first; row < last; ++row)
        {
          if (!active || active->OfCorners[static_cast<std::size_t>(row)])
          {
            this->Project(row, rows, none.data());
          }
        }
      });
  }

  CornerLattice<Dimension>& Lattice;
  const EqualizeKernels<Dimension> Kernels;
  const float* Targets = nullptr;
  LargeBuffer<float> Mobility;    // mobility of the corners
  LargeBuffer<float> Multipliers; // multipliers of the cells
};

} // namespace RectifiedTransport

#endif
