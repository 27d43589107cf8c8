// SPDX-License-Identifier: BSD-3-Clause
// Takes nodes from their places to the time of a level of a flow map: those of its lattice, and
// particles that no lattice covers.
#ifndef RectifiedTransport_NodeAdvance_h
#define RectifiedTransport_NodeAdvance_h

#include "Core/Flow/Kernels/FlowKernels.h"
#include "Core/Flow/Particles/Compaction.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace RectifiedTransport
{

// Those of the nodes of a level with this hand-over that start from the level `parent` of the map,
// or from scratch (-1); empty where they take the steps of particles.
template <int Dimension>
std::vector<StepWeights> nodeWeights(
  const FlowMapView<Dimension>& map, bool backward, int handOver, int parent)
{
  std::vector<StepWeights> weights;
  if (backward)
  {
    const std::int64_t to = parent < 0 ? map.Steps : map.Levels[parent].HandOver;
    const std::int64_t count = nodeSteps(handOver, to);
    // Short steps at first, as no velocities are behind, and before time 0.
    const std::int64_t steps = parent < 0 ? count : 2 * count;
    const double begin = grading(handOver, map.Steps); // what is left until time 1
    const double length = grading(to, map.Steps) - begin;
    for (std::int64_t step = 0; step < count; ++step)
    {
      const double part = grading(step + 1, steps) / grading(count, steps);
      weights.push_back(stretchedWeights(
        step, count, steps, predictorFor(FlowDirection::Backward, begin + part * length)));
    }
  }
  else if (parent < 0)
  {
    const std::int64_t count = startSteps(map.Steps, handOver);
    for (std::int64_t step = 0; step < count; ++step)
    {
      weights.push_back(stretchedWeights(step, count, latticeSteps * map.Steps));
    }
  }
  return weights;
}

template <int Dimension>
class NodeAdvance
{
public:
  // The level's records are those of the nodes, by their number.
  NodeAdvance(
    const FlowJob<Dimension>& job, const FlowMapLevel<Dimension>& level, Progress& progress)
    : Job(job)
    , Level(level)
    , Work(progress)
  {
  }

  // Makes the records of the nodes [first, first + count). Each starts from the finest of the first
  // `parents` levels of the job's map that may be interpolated there, else from scratch.
  // fill(numbers, count, places) gives the places of at most BlockSize nodes. Sets the marks of
  // nodes that met an empty box to 1, others to 0. Returns the number of velocity evaluations.
  // Throws Cancelled.
  template <class Fill>
  std::int64_t Run(
    std::int64_t first, std::int64_t count, int parents, unsigned char* marks, const Fill& fill)
  {
    std::vector<std::int64_t> left(static_cast<std::size_t>(count));
    std::iota(left.begin(), left.end(), first);
    std::int64_t evaluations = 0;
    for (int parent = parents - 1; parent >= -1 && !left.empty(); --parent)
    {
      evaluations += this->RunFrom(parent, left, marks, fill);
    }
    return evaluations;
  }

private:
  static constexpr std::int64_t blocks = 4; // a range

  template <class Fill>
  std::int64_t RunFrom(
    int parent, std::vector<std::int64_t>& left, unsigned char* marks, const Fill& fill)
  {
    const AdvanceNodes<Dimension> advance = flowKernels<Dimension>().Advance;
    std::vector<unsigned char> deferred(left.size());
    const std::vector<StepWeights> weights =
      nodeWeights<Dimension>(*this->Job.Map, this->Job.Backward, this->Level.HandOver, parent);
    std::atomic<std::int64_t> evaluations{ 0 };
    this->Work.For(
      static_cast<std::int64_t>(left.size()), blocks * BlockSize,
      [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t first = begin; first < end && !this->Work.ShouldStop();
             first += BlockSize)
        {
          const auto count = static_cast<int>(std::min<std::int64_t>(BlockSize, end - first));
          double places[BlockSize * Dimension];
          fill(left.data() + first, count, places);
          evaluations += advance(this->Job, this->Level, parent,
            { places, left.data() + first, count, weights.data(), deferred.data() + first, marks });
        }
      },
      blocks * BlockSize);
    left.resize(compact(
      left.size(), [&](std::size_t i) { return deferred[i] != 0; },
      [&](std::size_t i, std::size_t place) { left[place] = left[i]; }));
    return evaluations;
  }

  const FlowJob<Dimension>& Job;
  const FlowMapLevel<Dimension>& Level;
  Progress& Work;
};

} // namespace RectifiedTransport

#endif
