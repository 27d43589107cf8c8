// SPDX-License-Identifier: BSD-3-Clause
// The images of blocks of cells under the way back of a flow.
#ifndef RectifiedTransport_BlockAreas_h
#define RectifiedTransport_BlockAreas_h

#include "Core/Geometry/ImageMeasure.h"

#include "TestFlow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Blocks of 4 cells along each axis, axis 0 fastest, and what their cells are.
template <int Dimension>
struct BlockAreas
{
  std::vector<double> Area; // of the image
  std::vector<double> Mass; // in cells of the mean density
  std::vector<bool> Counts; // all cells have more than 5 % of the mean
  std::int64_t Folded = 0;  // cells whose images have no positive area

  // Of the blocks that count: the error that 99.9 % of them keep.
  double Error(const std::vector<double>& exact) const
  {
    std::vector<double> errors;
    for (std::size_t i = 0; i < this->Area.size(); ++i)
    {
      if (this->Counts[i])
      {
        errors.push_back(std::abs(this->Area[i] - exact[i]) / this->Mass[i]);
      }
    }
    std::sort(errors.begin(), errors.end());
    return errors[std::min(errors.size() - 1, errors.size() * 999 / 1000)];
  }
};

template <int Dimension>
BlockAreas<Dimension> blockAreas(const TestDensity<Dimension>& density,
  const RectifiedFlow<Dimension>& flow, const FlowOptions& options)
{
  constexpr std::int64_t side = 4;
  GridSize<Dimension> corners = density.Size;
  GridSize<Dimension> blocks = density.Size;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    corners[axis] += 1;
    blocks[axis] /= side;
  }
  Points<Dimension> lattice(static_cast<std::size_t>(cellCount<Dimension>(corners)));
  for (std::size_t i = 0; i < lattice.size(); ++i)
  {
    const auto place = cellAt<Dimension>(static_cast<std::int64_t>(i), corners);
    std::copy(place.begin(), place.end(), lattice[i].begin());
  }
  const Points<Dimension> images = runBackward(flow, lattice, options);
  const double mean = flow.Total() / static_cast<double>(density.Values.size());
  const auto count = static_cast<std::size_t>(cellCount<Dimension>(blocks));
  BlockAreas<Dimension> found{ std::vector<double>(count), std::vector<double>(count),
    std::vector<bool>(count, true), 0 };
  for (std::size_t index = 0; index < density.Values.size(); ++index)
  {
    const auto cell = cellAt<Dimension>(static_cast<std::int64_t>(index), density.Size);
    std::array<Point<Dimension>, 1 << Dimension> of;
    for (std::size_t corner = 0; corner < of.size(); ++corner)
    {
      GridSize<Dimension> at = cell;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        at[axis] += static_cast<std::int64_t>(corner >> axis & 1);
      }
      of[corner] = images[static_cast<std::size_t>(cellIndex<Dimension>(at, corners))];
    }
    GridSize<Dimension> block = cell;
    bool isInside = true;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      block[axis] /= side;
      isInside = isInside && block[axis] < blocks[axis];
    }
    const double area = imageMeasure<Dimension>(of.data());
    found.Folded += area <= 0.0 ? 1 : 0;
    if (isInside)
    {
      const auto number = static_cast<std::size_t>(cellIndex<Dimension>(block, blocks));
      const double mass = density.Values[index] / mean;
      found.Area[number] += area;
      found.Mass[number] += mass;
      found.Counts[number] = found.Counts[number] && mass > 0.05;
    }
  }
  return found;
}

} // namespace RectifiedTransport

#endif
