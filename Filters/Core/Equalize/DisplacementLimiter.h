// SPDX-License-Identifier: BSD-3-Clause
// Cells that the moves of a pass would fold, and what is done about them.
#ifndef RectifiedTransport_DisplacementLimiter_h
#define RectifiedTransport_DisplacementLimiter_h

#include "Core/Equalize/AreaProjection.h"
#include "Core/Parallel/Stages.h"
#include "Core/Tables/Density.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Sums over cells, whose masses have the mean one.
struct AreaSums
{
  double Missing = 0.0;    // mass - area
  double Error = 0.0;      // sum of squared relative errors, each at most one
  std::int64_t Folded = 0; // with mass, but without a positive area
  std::int64_t Failed = 0; // cells that lose too much of their area by a move
};

inline AreaSums operator+(const AreaSums& a, const AreaSums& b)
{
  return { a.Missing + b.Missing, a.Error + b.Error, a.Folded + b.Folded, a.Failed + b.Failed };
}

template <int Dimension>
class DisplacementLimiter
{
public:
  DisplacementLimiter(CornerLattice<Dimension>& lattice, AreaProjection<Dimension>& projection)
    : Lattice(lattice)
    , Projection(projection)
    , Kernels(equalizeKernels<Dimension>())
    , States(lattice.CellRows() * lattice.Cells()[0])
    , Least(this->States.size())
    , RowSums(static_cast<std::size_t>(lattice.CellRows()))
  {
    this->Active.OfCells.resize(this->RowSums.size());
    this->Active.OfCorners.resize(static_cast<std::size_t>(lattice.CornerRows()));
  }

  // Before the moves, for each row of cells: writes what area each shall keep, and the row's sums.
  void Guard(std::int64_t cellRow, const float* targets, const double* areas)
  {
    const std::int64_t cells = this->Lattice.Cells()[0];
    unsigned char* states = this->States.data() + cellRow * cells;
    float* least = this->Least.data() + cellRow * cells;
    AreaSums sums;
    for (std::int64_t i = 0; i < cells; ++i)
    {
      const auto mass = static_cast<double>(targets[i]);
      sums = sums + sumsOf(mass, areas[i]);
      states[i] = mass > 0.0 && areas[i] > 0.0 ? Guarded : 0;
      least[i] = static_cast<float>(leastPart * std::min(mass, areas[i]));
    }
    this->RowSums[static_cast<std::size_t>(cellRow)] = sums;
  }

  // In the order of rows, so that the bits do not depend on threads.
  AreaSums SumOfRows() const
  {
    AreaSums sum;
    for (const AreaSums& row : this->RowSums)
    {
      sum = sum + row;
    }
    return sum;
  }

  // Changes the moves until every cell keeps enough, or no more than `folded` cells are folded.
  // Failed cells are projected first, which moves their neighbours as well; then their corners'
  // moves are halved, and at last set to zero. `targets` are those of all cells. Returns the sums
  // over the moved cells; `limited` becomes at least the number of those that needed it.
  AreaSums Apply(
    const float* targets, std::int64_t folded, std::int64_t& limited, Progress& progress)
  {
    Rounds rounds(progress, usualRounds);
    std::fill(
      this->Active.OfCells.begin(), this->Active.OfCells.end(), static_cast<unsigned char>(1));
    for (int round = 0;; ++round)
    {
      // It measures, and it sweeps.
      Progress& part = rounds.Next().Expect(4 * this->Lattice.CornerRows());
      this->Measure(targets, part);
      const AreaSums moved = this->SumOfRows();
      limited = std::max(limited, moved.Failed);
      // Cells that failed without folding may stay so once projections have not helped.
      const bool mayStay = round >= projections && moved.Folded <= folded;
      if (moved.Failed == 0 || mayStay || round == mostRounds)
      {
        return moved;
      }
      this->ActivateRows();
      if (round < projections)
      {
        this->Projection.Sweep(this->States.data(), Failed, this->Active, part);
      }
      else
      {
        this->Shorten(round < projections + halvings ? 0.5F : 0.0F, part);
      }
    }
  }

  // A shorter step of the pass along the same moves.
  void HalveDisplacements(Progress& progress)
  {
    const std::int64_t count = this->Lattice.CornersOfRow();
    this->Lattice.ForRanges(
      this->Lattice.CornerRows(), progress, [&](std::int64_t first, std::int64_t last) {
        for (int axis = 0; axis < Dimension; ++axis)
        {
          float* moves = this->Lattice.Moves(axis);
          std::transform(moves + first * count, moves + last * count, moves + first * count,
            [](float move) { return 0.5F * move; });
        }
      });
  }

  // A state and a float for each cell, and the sums of rows.
  static double Memory(const GridSize<Dimension>& size)
  {
    return numberOfCells<Dimension>(size) * (sizeof(unsigned char) + sizeof(float)) +
      numberOfCells<Dimension>(size) / static_cast<double>(size[0]) * sizeof(AreaSums);
  }

private:
  // A cell with mass shall keep more than this part of its area or of its mass, whichever is less.
  static constexpr double leastPart = 0.1;
  // Cells that do not: they are projected in so many rounds, then their corners' moves are halved,
  // then set to zero.
  static constexpr int projections = 10;
  static constexpr int halvings = 6;
  static constexpr int mostRounds = 30;
  static constexpr int usualRounds = 3;

  enum CellState : unsigned char
  {
    Guarded = 1, // has mass and a positive area
    Failed = 2   // does not keep the least part of it
  };

  // The squared relative error of an area, with a floor for the mass of thin cells, and at most
  // one, so that a few folded cells do not hide the others.
  static AreaSums sumsOf(double mass, double area)
  {
    const double error = (mass - area) / std::max(mass, leastOfMean);
    const double square = mass > 0.0 ? std::min(error * error, 1.0) : 0.0;
    return { mass - area, square, mass > 0.0 && !(area > 0.0) ? 1 : 0, 0 };
  }

  // Measures active rows of cells, after the moves.
  void Measure(const float* targets, Progress& progress)
  {
    this->Lattice.ForRanges(
      this->Lattice.CellRows(), progress, [&](std::int64_t first, std::int64_t last) {
        const std::int64_t cells = this->Lattice.Cells()[0];
        typename CornerLattice<Dimension>::Rows rows(this->Lattice, true);
        std::vector<double> areas(static_cast<std::size_t>(cells));
        for (std::int64_t row = first; row < last; ++row)
        {
          if (this->Active.OfCells[static_cast<std::size_t>(row)])
          {
            this->Kernels.Areas(rows.AtCells(row, false), areas.data());
            this->RowSums[static_cast<std::size_t>(row)] =
              this->Evaluate(row, targets + row * cells, areas.data());
          }
        }
      });
  }

  // A row's cells: which of the guarded ones fail, and the sums.
  AreaSums Evaluate(std::int64_t cellRow, const float* targets, const double* areas)
  {
    const std::int64_t cells = this->Lattice.Cells()[0];
    unsigned char* states = this->States.data() + cellRow * cells;
    const float* least = this->Least.data() + cellRow * cells;
    AreaSums sums;
    for (std::int64_t i = 0; i < cells; ++i)
    {
      const bool isGuarded = (states[i] & Guarded) != 0;
      const bool hasFailed = isGuarded && !(areas[i] > static_cast<double>(least[i]));
      states[i] = static_cast<unsigned char>((isGuarded ? Guarded : 0) | (hasFailed ? Failed : 0));
      sums = sums + sumsOf(static_cast<double>(targets[i]), areas[i]);
      sums.Failed += hasFailed ? 1 : 0;
    }
    return sums;
  }

  // Marks the rows of corners of failed cells, and the rows of cells about them: nothing else can
  // change.
  void ActivateRows()
  {
    std::fill(
      this->Active.OfCells.begin(), this->Active.OfCells.end(), static_cast<unsigned char>(0));
    for (std::int64_t row = 0; row < this->Lattice.CornerRows(); ++row)
    {
      const RowsAbout about = this->Lattice.CellRowsAbout(row);
      const bool isActive = std::any_of(about.begin(), about.end(), [&](std::int64_t cellRow) {
        return cellRow >= 0 && this->RowSums[static_cast<std::size_t>(cellRow)].Failed > 0;
      });
      this->Active.OfCorners[static_cast<std::size_t>(row)] = isActive;
      for (const std::int64_t cellRow : about)
      {
        if (isActive && cellRow >= 0)
        {
          this->Active.OfCells[static_cast<std::size_t>(cellRow)] = 1;
        }
      }
    }
  }

  // Scales the moves of the corners of failed cells.
  void Shorten(float factor, Progress& progress)
  {
    this->Lattice.ForRows(this->Lattice.CornerRows(), progress, [&](std::int64_t row) {
      if (this->Active.OfCorners[static_cast<std::size_t>(row)])
      {
        this->ShortenRow(row, factor);
      }
    });
  }

  // A corner of any failed cell is shortened.
  void ShortenRow(std::int64_t cornerRow, float factor)
  {
    const std::int64_t cells = this->Lattice.Cells()[0];
    std::vector<unsigned char> isFailed(static_cast<std::size_t>(cells + 1), 0);
    for (const std::int64_t cellRow : this->Lattice.CellRowsAbout(cornerRow))
    {
      for (std::int64_t i = 0; cellRow >= 0 && i < cells; ++i)
      {
        const unsigned char state = this->States.data()[cellRow * cells + i] & Failed;
        isFailed[static_cast<std::size_t>(i)] |= state;
        isFailed[static_cast<std::size_t>(i + 1)] |= state;
      }
    }
    for (int axis = 0; axis < Dimension; ++axis)
    {
      float* moves = this->Lattice.Moves(axis) + cornerRow * (cells + 1);
      for (std::int64_t i = 0; i <= cells; ++i)
      {
        moves[i] *= isFailed[static_cast<std::size_t>(i)] ? factor : 1.0F;
      }
    }
  }

  CornerLattice<Dimension>& Lattice;
  AreaProjection<Dimension>& Projection;
  const EqualizeKernels<Dimension> Kernels;
  LargeBuffer<unsigned char> States;
  LargeBuffer<float> Least; // area that a guarded cell shall keep
  std::vector<AreaSums> RowSums;
  ActiveRows Active;
};

} // namespace RectifiedTransport

#endif
