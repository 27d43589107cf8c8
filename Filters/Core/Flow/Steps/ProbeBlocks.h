// SPDX-License-Identifier: BSD-3-Clause
// Blocks of cells, spread over a density, by whose images the error of a flow is measured.
#ifndef RectifiedTransport_ProbeBlocks_h
#define RectifiedTransport_ProbeBlocks_h

#include "Core/Flow/FlowEngine.h"
#include "Core/Flow/FlowOptions.h"
#include "Core/Geometry/LowDiscrepancy.h"
#include "Core/Geometry/Points.h"
#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Parallel/Progress.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Place `number` of an even sequence in the unit box.
template <int Dimension>
Point<Dimension> evenPlace(std::int64_t number)
{
  constexpr std::uint64_t middle = std::uint64_t{ 1 } << 63;
  Point<Dimension> place;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    place[axis] =
      unitReal(middle + static_cast<std::uint64_t>(number) * lowDiscrepancyStep<Dimension>(axis));
  }
  return place;
}

// The part of a block that is measured. Masses are in cells of the mean density.
template <int Dimension>
struct ProbeBlock
{
  Point<Dimension> Low{};
  Point<Dimension> High{};
  double Mass = 0.0;
  // Of the first blocks, forward, if all cells of the block have mass: the largest ratio of mean
  // densities in a box about the block and in one of half the width, and that of the densest cell
  // to the block.
  double Contrast = 0.0;
  double FineContrast = 0.0;
  bool Counts = true; // no cell of it is thin; backward only
};

template <int Dimension>
class ProbeBlocks
{
public:
  // Backward only blocks that count. Collective. Throws Cancelled.
  ProbeBlocks(FlowEngine<Dimension>& engine, FlowDirection direction, Progress& progress);

  // How many blocks there shall be.
  std::int64_t WantedBlocks() const;
  // Backward: adds blocks about places that count, until there are as many as wanted. Collective.
  void AddAbout(const std::vector<Point<Dimension>>& places, Progress& progress);

  const std::vector<ProbeBlock<Dimension>>& Blocks() const { return this->Found; }
  const GridSize<Dimension>& Grid() const { return this->Size; }
  // The measure of a whole block, in cells.
  double Volume() const { return this->Measure; }
  // In mean densities; of a graded table interpolated. A box that is not empty.
  double MeanIn(const Point<Dimension>& low, const Point<Dimension>& high) const;
  // Whether no cell at the corners of an image, or halfway between them, is thin.
  bool IsDense(const Point<Dimension>* corners) const;
  // Whether densities about blocks hardly differ from scale to scale, as in photographs.
  bool HaveLittleContrast() const;

private:
  // function(low, high) of each cell of a box of whole cells.
  template <class Function>
  void ForCells(
    const Point<Dimension>& low, const Point<Dimension>& high, const Function& function) const
  {
    for (Point<Dimension> from = low; from[Dimension - 1] < high[Dimension - 1];)
    {
      Point<Dimension> to = from;
      for (double& coordinate : to)
      {
        coordinate += 1.0;
      }
      function(from, to);
      for (int axis = 0; axis < Dimension; ++axis)
      {
        from[axis] += 1.0;
        if (from[axis] < high[axis] || axis + 1 == Dimension)
        {
          break;
        }
        from[axis] = low[axis];
      }
    }
  }

  // Blocks of numbers [1, count], each rank every so many-th, until as many count as are wanted.
  template <class MakeBlock>
  void Draw(std::int64_t count, const MakeBlock& makeBlock, Progress& progress);
  ProbeBlock<Dimension> BlockOf(std::int64_t number) const;
  ProbeBlock<Dimension> BlockAt(const Point<Dimension>& low) const;
  void Examine(std::int64_t number, bool isOfFirst, ProbeBlock<Dimension>& block);
  bool HasMassIn(const ProbeBlock<Dimension>& block) const;
  void ExamineCells(ProbeBlock<Dimension>& block);
  void PrepareShares(const Point<Dimension>& low, const Point<Dimension>& high) const;
  bool NearlyAllAreBelow(double most, double ProbeBlock<Dimension>::*contrast) const;
  double FineContrastOf(const ProbeBlock<Dimension>& block) const;
  double ContrastAbout(const ProbeBlock<Dimension>& block) const;

  FlowEngine<Dimension>& Engine;
  const bool IsBackward;
  GridSize<Dimension> Size{};
  GridSize<Dimension> Side{}; // of a block
  double Cells = 1.0;
  double Measure = 1.0;
  std::vector<ProbeBlock<Dimension>> Found;
};

} // namespace RectifiedTransport

#endif
