// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Blend/MovedInput.h"

#include "Bridge/Density/DensityOnGrid.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Splat/DistributedSplat.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/RankShare.h"
#include "Core/Parallel/Stages.h"

#include "vtkDataObject.h"
#include "vtkDoubleArray.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 12;

// The cells that a rank moves, and where they go.
struct MovedCells
{
  vtkSmartPointer<vtkDoubleArray> Centres;
  std::vector<double> Masses;
  std::vector<std::int64_t> Numbers; // in the grid
};

SplatOptions cloudInCell()
{
  SplatOptions options;
  options.Kernel = SplatKernel::CloudInCell;
  return options;
}

template <int D>
class CellMover
{
public:
  CellMover(const MovedInput& input, const ImageGrid& grid, Progress& progress)
    : Input(input)
    , Grid(grid)
    , Work(progress)
    , Own(OwnTuples(grid, progress.Group()))
  {
  }

  void Add(const TupleBox& wanted, double* density)
  {
    Stages stages(this->Work, { { "input", 1 }, { "moves", 7 }, { "splat", 2 } });
    auto given = newArray<vtkDoubleArray>("Density", 1, this->Own.Count());
    writeInput(this->Input, this->Grid, this->Own, stages["input"], given->GetPointer(0));
    std::vector<vtkSmartPointer<vtkDoubleArray>> moves;
    Parts axes(stages["moves"], D + 1);
    for (int axis = 0; axis <= D; ++axis)
    {
      moves.push_back(this->SumOf(axis, axes[axis]));
    }
    const MovedCells cells = this->Move(given, moves);
    const auto moved = newArray<vtkDoubleArray>("Moved", 1, wanted.Count());
    splatDistributed(cells.Centres, cells.Masses.data(), 0.0, cells.Numbers.data(),
      { this->Grid, cloudInCell(), true }, wanted, stages["splat"], moved);
    const double* values = moved->GetPointer(0);
    std::transform(values, values + wanted.Count(), density, density, std::plus<>());
  }

private:
  // A part of the grid for each rank; no tuple is in two of them.
  static TupleBox OwnTuples(const ImageGrid& grid, const Ranks& ranks)
  {
    const TupleBox all = AllTuples(grid);
    TupleBox own = all;
    const auto longest = std::max_element(all.Cells.begin(), all.Cells.end()) - all.Cells.begin();
    const auto axis = static_cast<std::size_t>(longest);
    const RankShare share(all.Cells[axis], ranks);
    own.Low[axis] += share.First;
    own.Cells[axis] = share.Count;
    return own;
  }
  static TupleBox AllTuples(const ImageGrid& grid)
  {
    return tuplesOf(
      grid.Extent(), grid.IsOnPoints() ? vtkDataObject::POINT : vtkDataObject::CELL, grid.Extent());
  }

  // For each own tuple the sum over the particles in it of their moves along an axis of index
  // space; for the axis D their number.
  vtkSmartPointer<vtkDoubleArray> SumOf(int axis, Progress& progress)
  {
    const std::int64_t count = this->Input.From->GetNumberOfTuples();
    const double* from = this->Input.From->GetPointer(0);
    const double* to = this->Input.To->GetPointer(0);
    LargeBuffer<double> terms(axis < D ? count : 0);
    if (axis < D)
    {
      this->Work.Threads().For(count, grain, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t i = first; i < last; ++i)
        {
          double before[D];
          double after[D];
          this->Grid.template ToIndex<D>(from + 3 * i, before);
          this->Grid.template ToIndex<D>(to + 3 * i, after);
          terms.data()[i] = after[axis] - before[axis];
        }
      });
    }
    auto sums = newArray<vtkDoubleArray>("Moves", 1, this->Own.Count());
    splatDistributed(this->Input.From, axis < D ? terms.data() : nullptr, 1.0, nullptr,
      { this->Grid, cloudInCell(), false }, this->Own, progress, sums);
    return sums;
  }

  MovedCells Move(
    vtkDoubleArray* values, const std::vector<vtkSmartPointer<vtkDoubleArray>>& moves) const
  {
    const double* density = values->GetPointer(0);
    MovedCells cells;
    std::vector<std::int64_t> own;
    for (std::int64_t i = 0; i < this->Own.Count(); ++i)
    {
      if (density[i] > 0.0)
      {
        own.push_back(i);
      }
    }
    const auto count = static_cast<std::int64_t>(own.size());
    cells.Centres = newArray<vtkDoubleArray>("Centres", 3, count);
    cells.Masses.resize(own.size());
    cells.Numbers.resize(own.size());
    const TupleBox all = AllTuples(this->Grid);
    const LatticePart<D> lattice = latticePartOf<D>(this->Own, this->Grid);
    const double measure = this->Grid.CellMeasure();
    this->Work.Threads().For(count, grain, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i)
      {
        const auto n = static_cast<std::size_t>(i);
        const std::int64_t tuple = own[n];
        const GridSize<D> cell = lattice.CellOf(tuple);
        const double particles = moves[D]->GetPointer(0)[tuple];
        double index[D];
        for (int axis = 0; axis < D; ++axis)
        {
          const double sum = moves[static_cast<std::size_t>(axis)]->GetPointer(0)[tuple];
          index[axis] =
            static_cast<double>(cell[axis]) + 0.5 + (particles > 0.0 ? sum / particles : 0.0);
        }
        this->Grid.template ClampToDomain<D>(index);
        this->Grid.template ToPhysical<D>(index, cells.Centres->GetPointer(3 * i));
        cells.Masses[n] = density[tuple] * measure;
        cells.Numbers[n] = all.NumberOf(this->Own.CellOf(tuple));
      }
    });
    this->Work.Check();
    return cells;
  }

  const MovedInput& Input;
  const ImageGrid& Grid;
  Progress& Work;
  const TupleBox Own;
};

template <int D>
void addMoved(const MovedInput& input, const ImageGrid& grid, const TupleBox& wanted,
  Progress& progress, double* density)
{
  CellMover<D>(input, grid, progress).Add(wanted, density);
}

} // namespace

void writeInput(const MovedInput& input, const ImageGrid& grid, const TupleBox& wanted,
  Progress& progress, double* values)
{
  writeDensityOn(grid, input.Density, wanted, progress, values);
  if (input.Mass == input.OwnMass)
  {
    return;
  }
  // In this order no density overflows, however far apart the masses are.
  std::transform(values, values + wanted.Count(), values,
    [&](double value) { return value / input.OwnMass * input.Mass; });
}

void addMovedInput(const MovedInput& input, const ImageGrid& grid, const TupleBox& wanted,
  Progress& progress, double* density)
{
  const double cells = static_cast<double>(wanted.Count());
  const double bytes = 8.0 * (6.0 + grid.Dimension()) * cells +
    8.0 * static_cast<double>(input.From->GetNumberOfTuples());
  withMemory("the cells near an input", bytes, [&]() {
    dispatchDimension(grid.Dimension(), addMoved<1>, addMoved<2>, addMoved<3>)(
      input, grid, wanted, progress, density);
  });
}

} // namespace RectifiedTransport::Bridge
