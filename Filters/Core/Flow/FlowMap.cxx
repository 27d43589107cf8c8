// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/FlowMap.h"

#include "Core/Flow/AdvectionJob.h"
#include "Core/Flow/Kernels/LatticePlaces.h"
#include "Core/Flow/NodeAdvance.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/RankShare.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// Marks of a node: it met an empty box (set by the kernels); the edge along axis a bends too much.
constexpr int isUnresolvedNode = 1;
constexpr int isCurved(int axis)
{
  return 2 << axis;
}

// One lattice while it is made: first the records of its nodes, then which of its cells are good.
template <int Dimension>
class LatticeBuild
{
public:
  // Edges may deviate from cubics by `deviation` along each axis.
  LatticeBuild(const FlowJob<Dimension>& job, const FlowMapLevel<Dimension>& level,
    const Point<Dimension>& deviation, const DeviceNodes<Dimension>& onDevice)
    : Job(job)
    , Level(level)
    , OnDevice(onDevice)
  {
    std::int64_t stride = 1;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      this->Nodes[axis] = level.Axes[axis].Cells + 1;
      this->Stride[axis] = stride;
      stride *= this->Nodes[axis];
      this->InverseDeviation[axis] = static_cast<float>(1.0 / deviation[axis]);
      this->Places[axis] = placesOf(level.Axes[axis]);
    }
    this->Marks.resize(static_cast<std::size_t>(stride));
  }

  // Makes the records, each from the finest of the coarser levels that may be interpolated there,
  // else from scratch; each rank some of them, which all get. Returns the number of velocity
  // evaluations here.
  std::int64_t Advance(Progress& progress)
  {
    const auto fill = [this](const std::int64_t* numbers, int count, double* places) {
      for (int i = 0; i < count; ++i)
      {
        std::int64_t node = numbers[i];
        for (int axis = 0; axis < Dimension; ++axis)
        {
          const auto place = static_cast<std::size_t>(node % this->Nodes[axis]);
          places[i * Dimension + axis] = this->Places[axis][place];
          node /= this->Nodes[axis];
        }
      }
    };
    const auto nodes = static_cast<std::int64_t>(this->Marks.size());
    // Equal parts of the nodes, which do not change the bits: a node's record depends on the
    // coarser levels alone.
    const Ranks& ranks = progress.Group();
    const RankShare share(nodes, ranks);
    std::int64_t evaluations = this->OnDevice
      ? this->OnDevice(
          *this->Job.Map, this->Level, share.First, share.Count, this->Marks.data(), progress)
      : -1;
    if (evaluations < 0)
    {
      evaluations =
        NodeAdvance<Dimension>(this->Job, this->Level, progress)
          .Run(share.First, share.Count, this->Job.Map->LevelCount, this->Marks.data(), fill);
    }
    gatherParts(ranks, shareStarts(nodes, this->RecordSize(), ranks), this->Level.Records);
    gatherParts(ranks, shareStarts(nodes, 1, ranks), this->Marks.data());
    return evaluations;
  }

  // Sets to 1 or 0 whether the cells may not be interpolated: a corner met an empty box, or the
  // stencils of an edge, forwards also of the ends of straight lines, deviate too much. Returns the
  // share of those that may not.
  double FindBad(unsigned char* bad, Progress& progress)
  {
    // One axis after the other: the bend of the stencil of four nodes that starts at each node,
    // then the edge from each node to the next.
    std::vector<float> differences(this->Marks.size()); // squared, 1 is the most
    for (int axis = 0; axis < Dimension; ++axis)
    {
      this->ForNodes(axis, progress, [&](std::int64_t node, std::int64_t place) {
        differences[static_cast<std::size_t>(node)] =
          place + 3 < this->Nodes[axis] ? this->SecondDifference(node, this->Stride[axis]) : 0.0f;
      });
      this->ForNodes(axis, progress, [&](std::int64_t node, std::int64_t place) {
        // The stencils of both cells that share the edge's ends, and its own.
        bool isStraight = true;
        for (std::int64_t first = place - 2; first <= place; ++first)
        {
          const std::int64_t inside =
            std::min(std::max(first, std::int64_t{ 0 }), this->Nodes[axis] - 4);
          const std::int64_t start = node + (inside - place) * this->Stride[axis];
          isStraight = isStraight && differences[static_cast<std::size_t>(start)] <= 1.0f;
        }
        unsigned char& mark = this->Marks[static_cast<std::size_t>(node)];
        mark = static_cast<unsigned char>(mark | (isStraight ? 0 : isCurved(axis)));
      });
    }
    return this->MarkCells(bad, progress);
  }

private:
  static constexpr std::int64_t nodeGrain = std::int64_t{ 1 } << 12;

  std::int64_t RecordSize() const
  {
    return this->Job.Backward ? FlowMapLevel<Dimension>::BackwardRecord
                              : FlowMapLevel<Dimension>::ForwardRecord;
  }

  // Calls function(node, its place along the axis) for all nodes.
  template <class Function>
  void ForNodes(int axis, Progress& progress, const Function& function)
  {
    progress.For(static_cast<std::int64_t>(this->Marks.size()), nodeGrain,
      [&](std::int64_t first, std::int64_t last) {
        const std::int64_t stride = this->Stride[axis];
        // Counted along: a division for each node would cost more than the rest.
        std::int64_t place = first / stride % this->Nodes[axis];
        std::int64_t next = first - first % stride + stride;
        for (std::int64_t node = first; node < last; ++node)
        {
          if (node == next)
          {
            place = place + 1 < this->Nodes[axis] ? place + 1 : 0;
            next += stride;
          }
          function(node, place);
        }
      });
  }

  // The squared third difference from a node on, over 16, in deviations that are allowed: about
  // what a cubic leaves out. Of the position x, and forwards also of x + (1 - t) v, where it would
  // end on a straight line: what an error of v does until time 1.
  float SecondDifference(std::int64_t node, std::int64_t stride) const
  {
    const std::int64_t record = this->RecordSize();
    const float* first = this->Level.Records + node * record;
    const auto difference = [&](int entry) {
      const float* r = first + entry;
      const std::int64_t s = stride * record;
      // The third difference r_3 - 3 r_2 + 3 r_1 - r_0 of an entry of the records.
      return ((r[3 * s] - r[0]) + 3.0f * (r[s] - r[2 * s])) *
        this->InverseDeviation[entry % Dimension];
    };
    // Squared lengths, in allowed deviations: `here` is that of x, `ahead` that of x + (1 - t) v.
    float here = 0.0f;
    float ahead = 0.0f;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const float position = difference(axis);
      here += position * position;
      if (!this->Job.Backward)
      {
        const float end = position + this->Level.TimeLeft * difference(Dimension + axis);
        ahead += end * end;
      }
    }
    // 16^2.
    return here >= ahead ? here / 256.0f : ahead / 256.0f;
  }

  // The cells from the marks of their nodes, row by row along axis 0.
  double MarkCells(unsigned char* bad, Progress& progress)
  {
    GridSize<Dimension> cells;
    std::int64_t count = 1;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      cells[axis] = this->Level.Axes[axis].Cells;
      count *= cells[axis];
    }
    const std::int64_t length = cells[0];
    const std::int64_t rows = nodeGrain / length + 1; // a range
    std::atomic<std::int64_t> found{ 0 };
    progress.For(
      count / length, rows,
      [&](std::int64_t first, std::int64_t last) {
        std::int64_t marked = 0;
        for (std::int64_t row = first; row < last; ++row)
        {
          // The node at the low corner of the row's first cell.
          std::int64_t node = 0;
          std::int64_t rest = row;
          for (int axis = 1; axis < Dimension; ++axis)
          {
            node += rest % cells[axis] * this->Stride[axis];
            rest /= cells[axis];
          }
          for (std::int64_t i = 0; i < length; ++i)
          {
            unsigned char& cell = bad[row * length + i];
            cell = this->IsBad(node + i) ? 1 : 0;
            marked += cell;
          }
        }
        found += marked;
      },
      rows);
    return static_cast<double>(found) / static_cast<double>(count);
  }

  // Whether a corner of the cell above a node met an empty box, or an edge of it bends too much.
  bool IsBad(std::int64_t node) const
  {
    int marks = 0;
    for (int corner = 0; corner < (1 << Dimension); ++corner)
    {
      std::int64_t at = node;
      // The edges of the cell that start at this corner are those along axes on whose low side it
      // is.
      int relevant = isUnresolvedNode;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        // An edge along an axis is marked at its lower node.
        const bool upper = (corner >> axis & 1) != 0;
        at += upper ? this->Stride[axis] : 0;
        relevant |= upper ? 0 : isCurved(axis);
      }
      marks |= this->Marks[static_cast<std::size_t>(at)] & relevant;
    }
    return marks != 0;
  }

  const FlowJob<Dimension>& Job;
  const FlowMapLevel<Dimension>& Level;
  const DeviceNodes<Dimension>& OnDevice;
  GridSize<Dimension> Nodes;             // along each axis
  GridSize<Dimension> Stride;            // in nodes
  float InverseDeviation[Dimension];     // 1 / cells
  std::vector<double> Places[Dimension]; // places of nodes along each axis, in cells
  std::vector<unsigned char> Marks;      // one for each node
};

} // namespace

// Makes the coarsest level first: nodes of each level start from those before it, if these are good
// there.
template <int Dimension>
FlowMap<Dimension>::FlowMap(const FlowMapShape<Dimension>& shape, const FlowJob<Dimension>& job,
  const Context& context, const DeviceNodes<Dimension>& onDevice)
{
  Progress progress(context);
  this->Weights = multistepWeightsOf(shape.Steps, shape.Direction);
  this->Map.Steps = shape.Steps;
  this->Map.Weights = this->Weights.data();
  // The job of the nodes: its map has the levels that are made so far. Nodes lie far apart.
  FlowJob<Dimension> nodes = job;
  nodes.Map = &this->Map;
  nodes.Sparse = true;
  std::vector<double> costs;
  for (const typename FlowMapShape<Dimension>::Level& planned : shape.Levels)
  {
    costs.push_back(planned.Cost);
  }
  Parts levels(progress, costs);
  for (const typename FlowMapShape<Dimension>::Level& planned : shape.Levels)
  {
    Stages stages(levels[this->Map.LevelCount], { { "nodes", 9 }, { "cells", 1 } });
    FlowMapLevel<Dimension> level;
    level.HandOver = planned.HandOver;
    level.TimeLeft = static_cast<float>(planned.TimeLeft);
    std::int64_t count = 1;
    std::int64_t cells = 1;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      // A node more than cells, at both ends of [0, S].
      const double size = job.Tables.Size[axis];
      const double length = size + 2.0 * planned.Layers[axis];
      level.Axes[axis] = { size, planned.Layers[axis], length,
        static_cast<double>(planned.Cells[axis]) / length, planned.Cells[axis] };
      cells *= planned.Cells[axis];
      count *= planned.Cells[axis] + 1;
    }
    Lattice lattice{ LargeBuffer<float>(count *
                       (job.Backward ? FlowMapLevel<Dimension>::BackwardRecord
                                     : FlowMapLevel<Dimension>::ForwardRecord)),
      LargeBuffer<unsigned char>(cells) };
    level.Records = lattice.Records.data();
    level.Bad = lattice.Bad.data();

    LatticeBuild<Dimension> build(nodes, level, shape.Deviation, onDevice);
    stopWith(nodes, stages["nodes"]);
    this->Evaluated += build.Advance(stages["nodes"]);
    // What may not start from it takes the whole way after all. Finer ones would be no better.
    // Backwards most of a domain may be empty, and has few particles then.
    const double share = build.FindBad(lattice.Bad.data(), stages["cells"]);
    const double saved = 1.0 - static_cast<double>(planned.HandOver) / shape.NumberOfSteps;
    if (!job.Backward && share > saved)
    {
      break;
    }
    this->Lattices.push_back(std::move(lattice));
    this->Map.Levels[this->Map.LevelCount++] = level;
  }
}

template <int Dimension>
std::int64_t FlowMap<Dimension>::MemorySize() const
{
  std::int64_t bytes = 0;
  for (const Lattice& lattice : this->Lattices)
  {
    bytes += lattice.Records.bytes() + lattice.Bad.bytes();
  }
  return bytes;
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(FlowMap);

} // namespace RectifiedTransport
