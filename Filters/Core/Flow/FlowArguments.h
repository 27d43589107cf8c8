// SPDX-License-Identifier: BSD-3-Clause
// Checks the arguments of a flow.
#ifndef RectifiedTransport_FlowArguments_h
#define RectifiedTransport_FlowArguments_h

#include "Core/Flow/FlowSeeds.h"
#include "Core/Flow/Particles/LatticeOrder.h"
#include "Core/Geometry/GridSize.h"
#include "Core/Geometry/LatticePart.h"
#include "Core/Messages/PartText.h"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace RectifiedTransport
{

// All throw std::invalid_argument. Times ascend from 0 to 1.
inline void check(const std::vector<double>& times)
{
  if (times.empty())
  {
    throw std::invalid_argument("no times are given, there must be at least one");
  }
  double before = 0.0;
  for (const double time : times)
  {
    if (!(time >= before && time <= 1.0))
    {
      throw std::invalid_argument("time " + std::to_string(time) + " is given after " +
        std::to_string(before) + ", times must ascend and be from 0 to 1");
    }
    before = time;
  }
}

// Memory for exactly the positions that are expected; a double holds counts that may exceed 64
// bits.
inline void checkCount(std::int64_t positions, double expected)
{
  if (static_cast<double>(positions) != expected)
  {
    throw std::invalid_argument("there is memory for " + std::to_string(positions) +
      " positions, there must be " + describeCount(expected));
  }
}

// A grid's cells along each axis are from 1 to 2^30, so that sums of integers stay exact.
template <int Dimension>
void check(const GridSize<Dimension>& size, const char* what)
{
  for (const std::int64_t cells : size)
  {
    if (cells < 1 || cells > MaximumResolution)
    {
      throw std::invalid_argument(std::string(what) + " has " + std::to_string(cells) +
        " cells along an axis, it must have from 1 to 2^30");
    }
  }
}

// A part of a lattice is inside of it, and its positions are within the memory.
template <int Dimension>
void check(const LatticeParts<Dimension>& parts, const LatticePart<Dimension>& part,
  const GridSize<Dimension>& lattice, std::int64_t positions)
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    if (part.Low[axis] < 0 || part.Cells[axis] < 0 ||
      part.Cells[axis] > lattice[axis] - part.Low[axis])
    {
      throw std::invalid_argument("a part of a lattice has the cells from " +
        std::to_string(part.Low[axis]) + " to " +
        std::to_string(part.Low[axis] + part.Cells[axis] - 1) + " along an axis, there are " +
        std::to_string(lattice[axis]));
    }
  }
  if (part.Count() == 0)
  {
    return;
  }
  // The first and the last cell of a part have its least and greatest place in memory.
  const std::int64_t first = parts.IndexOf(part.Low);
  const std::int64_t last = parts.IndexOf(part.CellOf(part.Count() - 1));
  if (!parts.Within.Contains(part) || first < 0 || last >= positions)
  {
    throw std::invalid_argument("a part of a lattice has positions from number " +
      std::to_string(first) + " to " + std::to_string(last) + ", there is memory for " +
      std::to_string(positions));
  }
}

// Checks the seeds of a lattice and returns the order in which they are advected.
template <int Dimension>
LatticeOrder<Dimension> checkedOrder(
  const FlowSeeds<Dimension>& seeds, const GridSize<Dimension>& size, std::int64_t positions)
{
  const GridSize<Dimension>& lattice = seeds.Cells();
  if (seeds.IsWholeLattice())
  {
    checkCount(positions, numberOfCells<Dimension>(lattice));
  }
  check<Dimension>(lattice, "a lattice");
  for (const LatticePart<Dimension>& part : seeds.Parts().Parts)
  {
    check<Dimension>(seeds.Parts(), part, lattice, positions);
  }
  for (const double coordinate : seeds.Place())
  {
    if (!(coordinate >= 0.0 && coordinate <= 1.0))
    {
      throw std::invalid_argument("a place in a lattice's cells has the coordinate " +
        std::to_string(coordinate) + ", it must be from 0 to 1");
    }
  }
  return LatticeOrder<Dimension>(lattice, seeds.Parts(), size, seeds.Place());
}

} // namespace RectifiedTransport

#endif
