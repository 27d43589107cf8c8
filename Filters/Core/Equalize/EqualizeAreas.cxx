// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Equalize/EqualizeAreas.h"

#include "Core/Equalize/DisplacementLimiter.h"
#include "Core/Grid/FaceSystem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// Cells a chunk of parallel loops.
constexpr std::int64_t grainCells = 1 << 13;
// Conjugate gradients stop by the tolerance after some iterations; this bounds them for degenerate
// images.
constexpr int mostIterations = 50;
constexpr int sweeps = 2; // projections after each linear system

// The moves of a pass that does not reduce the errors are halved up to mostHalvings times. Then
// sweepsAlone sweeps of projections take their place: beside thin cells the equation may move all
// corners too far.
constexpr int mostHalvings = 3;
constexpr int sweepsAlone = 8;

// The passes of the correction in 2D and 3D. Arrays of cells are floats, axis 0 fastest; the mean
// mass and area of a cell are 1.
template <int Dimension>
class Equalization
{
public:
  Equalization(const DensityValues& density, const GridSize<Dimension>& size, double total,
    PointSpan<Dimension> corners, const Context& context)
    : Density(density)
    , PerMass(numberOfCells<Dimension>(size) / total)
    , Size(size)
    , Lattice(size, corners)
    , System(size)
    , Projection(this->Lattice)
    , Limits(this->Lattice, this->Projection)
    , Targets(this->Lattice.CellRows() * size[0])
    , Kernels(equalizeKernels<Dimension>())
    , Work(context)
  {
  }

  // A pass: find the areas that are missing, solve -div grad p = mass - area on the images of
  // cells, fit the corners' moves to the fluxes, project them on the cells' areas, and limit them
  // so that no cell folds. It is applied only if it lowers the error without folding further cells.
  EqualizeReport Run(const EqualizeOptions& options, float* moves)
  {
    EqualizeReport report;
    const std::int64_t cells = this->Targets.size();
    Parts passes(this->Work, options.Passes);
    for (int pass = 0; pass < options.Passes; ++pass)
    {
      Stages stages(passes[pass],
        { { "areas", 10 }, { "levels", 10 }, { "potential", 50 }, { "moves", 5 },
          { "projections", 10 }, { "limits", 10 }, { "corners", 5 } });
      // Areas before the pass, and the sums that the pass must improve.
      // The masses are read in the first pass alone; areas change with the corners.
      const AreaSums found = this->Measure(pass == 0, stages["areas"]);
      if (pass == 0)
      {
        report.FoldedBefore = found.Folded;
        report.FoldedAfter = found.Folded;
      }
      stages["levels"].Expect(3 * cells);
      // The potential p of the missing areas, to a residual within the tolerance.
      this->Center(found.Missing, stages["levels"]);
      this->System.Prepare(stages["levels"]);
      const FaceSolution solution =
        this->System.Solve(options.Tolerance, mostIterations, stages["potential"]);
      report.Iterations += solution.Iterations;
      report.Residual = std::max(report.Residual, solution.Residual);
      // Moves of the order of the wavelengths that the equation resolves, then projections for what
      // is left on the scale of cells.
      this->FindMoves(stages["moves"]);
      Progress& projections =
        stages["projections"].Expect((2 * sweeps + 1) * this->Lattice.CornerRows());
      this->Projection.SetTargets(this->Targets.data(), projections);
      this->Sweep(sweeps, projections);
      // A pass must lower the sum of squared errors and must not fold further cells.
      const auto isBetter = [&found](const AreaSums& moved) {
        return moved.Folded <= found.Folded && moved.Error < found.Error;
      };
      // Limits change the moves, so each trial starts from the moves that the last one left.
      Rounds trials(stages["limits"], 1);
      const auto apply = [&]() {
        return this->Limits.Apply(
          this->Targets.data(), found.Folded, report.Limited, trials.Next());
      };
      AreaSums moved = apply();
      for (int halving = 1; halving <= mostHalvings && !isBetter(moved); ++halving)
      {
        this->Limits.HalveDisplacements(trials.Next());
        moved = apply();
      }
      if (!isBetter(moved))
      {
        Progress& alone = trials.Next().Expect((2 * sweepsAlone + 1) * this->Lattice.CornerRows());
        this->ClearMoves(alone);
        this->Sweep(sweepsAlone, alone);
        moved = apply();
      }
      if (!isBetter(moved))
      {
        break;
      }
      this->Lattice.ForRows(this->Lattice.CornerRows(), stages["corners"],
        [&](std::int64_t row) { this->Lattice.Apply(row, moves); });
      report.FoldedAfter = moved.Folded;
      ++report.Passes;
    }
    this->Work.EndSlice(1);
    return report;
  }

private:
  // Cimmino's projections on the areas of all cells.
  void Sweep(int count, Progress& progress)
  {
    for (int sweep = 0; sweep < count; ++sweep)
    {
      this->Projection.Sweep(progress);
    }
  }

  // Projections alone start from no moves.
  void ClearMoves(Progress& progress)
  {
    const std::int64_t count = this->Lattice.CornersOfRow();
    this->Lattice.ForRows(this->Lattice.CornerRows(), progress, [&](std::int64_t row) {
      for (int axis = 0; axis < Dimension; ++axis)
      {
        std::fill_n(this->Lattice.Moves(axis) + row * count, count, 0.0F);
      }
    });
  }

  // Computes areas, the weights of faces, and the right-hand side: area - mass, minus the missing
  // area. Returns the sums over rows.
  AreaSums Measure(bool isFirst, Progress& progress)
  {
    this->Lattice.ForRanges(
      this->Lattice.CellRows(), progress, [&](std::int64_t first, std::int64_t last) {
        typename CornerLattice<Dimension>::Rows rows(this->Lattice, false);
        std::vector<double> masses(static_cast<std::size_t>(this->Size[0]));
        std::vector<double> areas(masses.size());
        for (std::int64_t row = first; row < last; ++row)
        {
          const CellRow<Dimension>& corners = rows.AtCells(row, true);
          this->Kernels.Areas(corners, areas.data());
          this->WriteWeights(row, corners);
          if (isFirst)
          {
            this->ReadTargets(row, masses);
          }
          this->WriteRow(row, areas.data());
        }
      });
    return this->Limits.SumOfRows();
  }

  // Masses in units in which the mean of a cell is one. A float keeps an area to 1e-7, more than
  // the correction reaches, and at least the fact that a cell has mass.
  void ReadTargets(std::int64_t row, std::vector<double>& masses)
  {
    constexpr double least = std::numeric_limits<float>::min();
    this->Density.Read(row * this->Size[0], this->Size[0], masses.data());
    float* targets = this->Targets.data() + row * this->Size[0];
    for (std::size_t i = 0; i < masses.size(); ++i)
    {
      const double mass = masses[i] * this->PerMass;
      targets[i] = static_cast<float>(mass > 0.0 ? std::max(mass, least) : 0.0);
    }
  }

  // Keeps each cell's state before the moves, and writes its right-hand side.
  void WriteRow(std::int64_t row, const double* areas)
  {
    const std::int64_t from = row * this->Size[0];
    const float* targets = this->Targets.data() + from;
    float* right = this->System.RightHandSide() + from;
    this->Limits.Guard(row, targets, areas);
    for (std::int64_t i = 0; i < this->Size[0]; ++i)
    {
      right[i] = static_cast<float>(areas[i] - static_cast<double>(targets[i]));
    }
  }

  // The weights |face| / |distance of centres| of the cells' upper faces, 0 on the box's sides.
  void WriteWeights(std::int64_t row, const CellRow<Dimension>& corners)
  {
    float* weights[Dimension];
    for (int axis = 0; axis < Dimension; ++axis)
    {
      weights[axis] = this->System.Weights(axis) + row * this->Size[0];
    }
    // The kernel writes the weights of the upper faces of a row of cells along all axes.
    this->Kernels.Weights(corners, weights);
    const std::array<std::int64_t, 2> place = this->Lattice.PlaceOf(row, 0);
    for (int axis = 1; axis < Dimension; ++axis)
    {
      if (place[axis - 1] + 1 == this->Size[axis])
      {
        std::fill_n(weights[axis], this->Size[0], 0.0F);
      }
    }
  }

  // Makes the sum of the right-hand side 0, as a system without flux at the border needs: images
  // fill the box but for rounding, so the mean that is taken away is small.
  void Center(double missing, Progress& progress)
  {
    const std::int64_t cells = this->Targets.size();
    const auto mean = static_cast<float>(missing / static_cast<double>(cells));
    float* right = this->System.RightHandSide();
    progress.ForEach(cells, grainCells, [&](std::int64_t q) { right[q] += mean; });
  }

  // The corners' moves, from the fluxes w (p_q - p_r) through the faces about each.
  void FindMoves(Progress& progress)
  {
    this->Lattice.ForRanges(
      this->Lattice.CornerRows(), progress, [&](std::int64_t first, std::int64_t last) {
        typename CornerLattice<Dimension>::Rows rows(this->Lattice, false);
        for (std::int64_t row = first; row < last; ++row)
        {
          this->FindMovesOf(row, rows.AboutCorners(row));
        }
      });
  }

  // The rows of corners, weights and potential about a row of corners, for the kernel.
  void FindMovesOf(std::int64_t cornerRow, const PointRow<Dimension>* corners)
  {
    const std::int64_t cell =
      this->Lattice.NumberOf(this->Lattice.PlaceOf(cornerRow, 1), 0) * this->Size[0];
    CornerRow<Dimension> row;
    std::copy_n(corners, CornerLattice<Dimension>::RowsOfCell, row.Corners);
    row.Cells = this->Size[0];
    // Pointers at the cell of which the row's first corner is the low one; margins of zeros allow
    // reading beyond the border.
    row.Potential = this->System.Solution() + cell;
    std::int64_t stride = 1;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      row.Weights[axis] = this->System.Weights(axis) + cell;
      row.Stride[axis] = stride;
      stride *= this->Size[axis];
      row.Moves[axis] = this->Lattice.Moves(axis) + cornerRow * this->Lattice.CornersOfRow();
    }
    this->Kernels.Moves(row);
    this->Lattice.KeepOnSides(cornerRow, row.Moves);
  }

  const DensityValues& Density;
  const double PerMass;
  const GridSize<Dimension> Size;
  CornerLattice<Dimension> Lattice;
  FaceSystem<Dimension> System;
  AreaProjection<Dimension> Projection;
  DisplacementLimiter<Dimension> Limits;
  LargeBuffer<float> Targets;
  const EqualizeKernels<Dimension> Kernels;
  Progress Work;
};

// In 1D the exact map is monotone: the images of corners are the sums of the masses before them,
// x_i = cells / total sum_{j < i} f_j.
EqualizeReport sumMasses(const DensityValues& density, std::int64_t cells, double total,
  PointSpan<1> corners, const Context& context, float* moves)
{
  const auto place = [&](std::int64_t corner, double x) {
    double& at = corners.data()[corner];
    if (moves)
    {
      moves[corner] += static_cast<float>(x - at);
    }
    at = x;
  };
  EqualizeReport report;
  report.Passes = 1;
  Progress progress(context);
  progress.Expect(cells);
  // A chunk of masses at a time, as a density may be read from elsewhere.
  std::vector<double> masses(static_cast<std::size_t>(std::min(cells, grainCells)));
  const double perMass = static_cast<double>(cells) / total;
  double before = 0.0;
  place(0, 0.0);
  progress.ForInOrder(cells, grainCells, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t begin = first; begin < last; begin += grainCells)
    {
      const std::int64_t count = std::min(grainCells, last - begin);
      density.Read(begin, count, masses.data());
      for (std::int64_t i = 0; i < count; ++i)
      {
        before += perMass * masses[static_cast<std::size_t>(i)];
        // The last corner is the box's end, whatever rounding made of the sum.
        const bool isLast = begin + i + 1 == cells;
        const auto side = static_cast<double>(cells);
        place(begin + i + 1, isLast ? side : std::min(before, side));
      }
    }
  });
  return report;
}

} // namespace

// Arguments are checked before arrays of the size of the grid are allocated.
template <int Dimension>
EqualizeReport equalizeAreas(const DensityValues& density, const GridSize<Dimension>& size,
  double total, PointSpan<Dimension> corners, const EqualizeOptions& options,
  const Context& context, float* moves)
{
  if (options.Passes < 0)
  {
    throw std::invalid_argument(
      "Passes is " + std::to_string(options.Passes) + "; it must be at least 0");
  }
  if (!(options.Tolerance > 0.0 && options.Tolerance < 1.0))
  {
    throw std::invalid_argument(
      "Tolerance is " + std::to_string(options.Tolerance) + "; it must be between 0 and 1");
  }
  if (static_cast<double>(corners.size()) != numberOfCorners<Dimension>(size))
  {
    throw std::invalid_argument("there are " + std::to_string(corners.size()) +
      " points; the cells have " +
      std::to_string(static_cast<std::int64_t>(numberOfCorners<Dimension>(size))) + " corners");
  }
  if (!(total > 0.0) || !std::isfinite(total))
  {
    throw std::invalid_argument(
      "the total of the density is " + std::to_string(total) + "; it must be positive and finite");
  }
  if constexpr (Dimension == 1)
  {
    return options.Passes > 0 ? sumMasses(density, size[0], total, corners, context, moves)
                              : EqualizeReport();
  }
  else
  {
    return Equalization<Dimension>(density, size, total, corners, context).Run(options, moves);
  }
}

// In 1D a chunk of masses is all. Otherwise each part says what it takes, and the masses are
// floats.
template <int Dimension>
double equalizeAreasMemory(const GridSize<Dimension>& size)
{
  if constexpr (Dimension == 1)
  {
    return static_cast<double>(grainCells) * sizeof(double);
  }
  else
  {
    return CornerLattice<Dimension>::Memory(size) + FaceSystem<Dimension>::Memory(size) +
      AreaProjection<Dimension>::Memory(size) + DisplacementLimiter<Dimension>::Memory(size) +
      numberOfCells<Dimension>(size) * sizeof(float);
  }
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(equalizeAreas);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(equalizeAreasMemory);

} // namespace RectifiedTransport
