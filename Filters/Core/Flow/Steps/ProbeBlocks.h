// SPDX-License-Identifier: BSD-3-Clause
// Blocks of cells, spread over a density, by whose images the error of a flow is measured.
#ifndef RectifiedTransport_ProbeBlocks_h
#define RectifiedTransport_ProbeBlocks_h

#include "Core/Flow/FlowEngine.h"
#include "Core/Flow/FlowOptions.h"
#include "Core/Flow/Steps/ProbePlan.h"
#include "Core/Geometry/Points.h"
#include "Core/Parallel/Progress.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// The part of a block that is measured.
template <int Dimension>
struct ProbeBlock
{
  Point<Dimension> Low{};
  Point<Dimension> High{};
  double Weight = 1.0; // what errors are relative to, in cells of the mean density
  bool Counts = true;  // backward its corners touch mass
};

template <int Dimension>
class ProbeBlocks
{
public:
  // Backward only blocks that count. Collective. Throws Cancelled.
  ProbeBlocks(FlowEngine<Dimension>& engine, FlowDirection direction,
    const ProbePlan<Dimension>& plan, Progress& progress);

  // How many blocks there shall be.
  std::int64_t WantedBlocks() const { return this->Plan.Blocks; }
  // Backward: adds blocks about places that count, until there are as many as wanted. Collective.
  void AddAbout(const std::vector<Point<Dimension>>& places, Progress& progress);

  const std::vector<ProbeBlock<Dimension>>& Blocks() const { return this->Found; }

private:
  // Blocks of numbers [0, count), each rank every so many-th, until as many count as are wanted.
  template <class MakeBlock>
  void Draw(std::int64_t count, const MakeBlock& makeBlock, Progress& progress);
  ProbeBlock<Dimension> BlockAt(const Point<Dimension>& low) const;
  void Examine(ProbeBlock<Dimension>& block) const;
  void ExamineCells(ProbeBlock<Dimension>& block) const;
  void LeaveOutBorders(ProbeBlock<Dimension>& block) const;

  FlowEngine<Dimension>& Engine;
  const bool IsBackward;
  const ProbePlan<Dimension> Plan;
  GridSize<Dimension> Size{};
  std::vector<ProbeBlock<Dimension>> Found;
};

} // namespace RectifiedTransport

#endif
