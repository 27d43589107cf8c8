// SPDX-License-Identifier: BSD-3-Clause
// What the shared kernels are given (Shared/FlowTypes.h), from the jobs and maps of processors.
#ifndef RectifiedTransport_SharedInputs_h
#define RectifiedTransport_SharedInputs_h

#include "Core/Flow/Kernels/FlowKernels.h"

#include <algorithm>
#include <cstdint>

namespace RectifiedTransport
{

static_assert(sizeof(StepWeights) == 8 * sizeof(double), "the kernels' StepWeights has no gaps");

// The input of kernels that read whole tables. The levels but the finest lie one after the other,
// as in the tables.
template <int Dimension>
FlowInput flowInput(const FlowJob<Dimension>& job)
{
  const TableView<Dimension>& tables = job.Tables;
  FlowInput input = {};
  input.LevelCount = tables.LevelCount;
  for (int level = 0; level < tables.LevelCount; ++level)
  {
    input.Offset[level] =
      level > 0 ? tables.Levels[level].Nodes - tables.Levels[1].Nodes : std::int64_t{ 0 };
    std::copy_n(tables.Levels[level].Stride, Dimension, input.Stride[level]);
  }
  for (int axis = 0; axis < Dimension; ++axis)
  {
    input.Cells[axis] = tables.Cells[axis];
    input.EvenLevels[axis] = tables.EvenLevels[axis] ? 1 : 0;
    input.Size[axis] = tables.Size[axis];
    input.Centroid[axis] = tables.Centroid[axis];
  }
  input.WordsPerRow = tables.WordsPerRow;
  input.HasEmptyCells = tables.Occupied ? 1 : 0;
  input.Backward = job.Backward ? 1 : 0;
  input.VoidMass = tables.VoidMass;
  input.Largest = tables.Largest;
  input.InverseRatio = 1.0 / job.CoarseRatio;
  input.Widest = static_cast<double>(std::int64_t{ 1 } << ((tables.LevelCount - 1) * levelShift));
  return input;
}

template <int Dimension>
MapLevelInput mapLevelInput(
  const FlowMapLevel<Dimension>& level, std::int64_t firstRecord, std::int64_t firstCell)
{
  MapLevelInput input = {};
  input.HandOver = level.HandOver;
  input.FirstRecord = firstRecord;
  input.FirstCell = firstCell;
  input.TimeLeft = static_cast<double>(level.TimeLeft);
  for (int axis = 0; axis < Dimension; ++axis)
  {
    input.Cells[axis] = level.Axes[axis].Cells;
    input.Size[axis] = level.Axes[axis].Size;
    input.Layer[axis] = level.Axes[axis].Layer;
    input.Length[axis] = level.Axes[axis].Length;
    input.InverseSpacing[axis] = level.Axes[axis].InverseSpacing;
  }
  return input;
}

} // namespace RectifiedTransport

#endif
