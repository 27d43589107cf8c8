// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Blend/MovedInput.h"

#include "Bridge/Density/PlainDensity.h"
#include "Bridge/Run/Memory.h"
#include "Core/Blend/BlendWeights.h"
#include "Core/Blend/MovedCells.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/RankShare.h"
#include "Core/Parallel/Stages.h"

#include "vtkDataObject.h"
#include "vtkDoubleArray.h"

#include <algorithm>
#include <cstddef>

namespace RectifiedTransport::Bridge
{

namespace
{

// A part of the grid for each rank; no tuple is in two of them.
TupleBox ownTuples(const ImageGrid& grid, const Ranks& ranks)
{
  TupleBox own = tuplesOf(
    grid.Extent(), grid.IsOnPoints() ? vtkDataObject::POINT : vtkDataObject::CELL, grid.Extent());
  const auto longest = std::max_element(own.Cells.begin(), own.Cells.end()) - own.Cells.begin();
  const auto axis = static_cast<std::size_t>(longest);
  const RankShare share(own.Cells[axis], ranks);
  own.Low[axis] += share.First;
  own.Cells[axis] = share.Count;
  return own;
}

ConstPointSpan<3> spanOf(vtkDoubleArray* points)
{
  return { points->GetPointer(0), points->GetNumberOfTuples() };
}

template <int D>
void addMoved(const MovedInput& input, const ImageGrid& grid, const TupleBox& wanted,
  Progress& progress, double* density)
{
  Stages stages(progress, { { "input", 1 }, { "cells", 9 } });
  const TupleBox own = ownTuples(grid, progress.Group());
  LargeBuffer<double> given(own.Count());
  writeInput(input, grid, own, stages["input"], given.data());
  const MovedCells<D> cells{ grid, latticePartOf<D>(own, grid), given.data(), spanOf(input.From),
    spanOf(input.To) };
  addMovedCells<D>(cells, latticePartOf<D>(wanted, grid), stages["cells"], density);
}

} // namespace

void writeInput(const MovedInput& input, const ImageGrid& grid, const TupleBox& wanted,
  Progress& progress, double* values)
{
  writeDensityOn(grid, input.Density, wanted, progress, values);
  rescaleMass(input.OwnMass, input.Mass, values, wanted.Count());
}

void addMovedInput(const MovedInput& input, const ImageGrid& grid, const TupleBox& wanted,
  Progress& progress, double* density)
{
  const double cells = static_cast<double>(wanted.Count());
  const double bytes = 8.0 * (6.0 + grid.Dimension()) * cells +
    8.0 * static_cast<double>(input.From->GetNumberOfTuples());
  withMemory({ "the cells near an input", bytes }, [&]() {
    dispatchDimension(grid.Dimension(), addMoved<1>, addMoved<2>, addMoved<3>)(
      input, grid, wanted, progress, density);
  });
}

} // namespace RectifiedTransport::Bridge
