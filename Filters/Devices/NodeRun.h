// SPDX-License-Identifier: BSD-3-Clause
// The kernel that makes the nodes of a level of a flow map, with its arguments.
#ifndef RectifiedTransport_NodeRun_h
#define RectifiedTransport_NodeRun_h

#include "Core/Flow/Kernels/LatticePlaces.h"
#include "Core/Flow/Kernels/SharedInputs.h"
#include "Core/Flow/NodeAdvance.h"
#include "Devices/Device.h"
#include "Devices/KernelRun.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

template <int Dimension>
class NodeRun
{
public:
  // Copies the levels that the map has so far. Throws DeviceError.
  NodeRun(Device& device, const DeviceProgram& program, const FlowJob<Dimension>& job,
    std::shared_ptr<const DeviceTables<Dimension>> tables, const FlowMapView<Dimension>& map,
    const FlowMapLevel<Dimension>& level)
    : Owner(device)
    , Level(level)
    , Steps(map.Steps)
    , LevelCount(map.LevelCount)
    , Record(job.Backward ? FlowMapLevel<Dimension>::BackwardRecord
                          : FlowMapLevel<Dimension>::ForwardRecord)
    , Tables(std::move(tables))
    , Coarser(device, map, job.Backward)
    , Advance(program.NewKernel("advanceNodes"))
  {
    const FlowInput input = flowInput<Dimension>(job);
    this->Input = upload(device, &input, 1, what);
    // Backward, times fall from 1 - G(step) to 0.
    const auto timeOf = [&](std::int64_t step) {
      return step < map.Steps ? 1.0 - grading(step, map.Steps) : 0.0;
    };
    std::vector<StepWeights> weights;
    std::vector<NodeSteps> steps;
    // A node starts from the finest earlier level with a good cell at its seed, or from the seed
    // (-1). Each has weights of its own.
    for (int parent = -1; parent < map.LevelCount; ++parent)
    {
      const std::vector<StepWeights> own =
        nodeWeights<Dimension>(map, job.Backward, level.HandOver, parent);
      const std::int64_t to = parent < 0 ? map.Steps : map.Levels[parent].HandOver;
      steps.push_back({ static_cast<std::int64_t>(weights.size()),
        static_cast<std::int64_t>(own.size()), timeOf(level.HandOver), timeOf(to) });
      weights.insert(weights.end(), own.begin(), own.end());
    }
    std::vector<double> places;
    for (const LatticeAxis& axis : level.Axes)
    {
      const std::vector<double> own = placesOf(axis);
      places.insert(places.end(), own.begin(), own.end());
    }
    this->OfParticles = upload(device, map.Weights, map.Steps, what);
    this->OfNodes = upload(device, weights, what);
    this->StepsOfNodes = upload(device, steps, what);
    this->Places = upload(device, places, what);
    // A node takes all steps in one run: so few that they are not too many.
    constexpr std::int64_t few = 64;
    constexpr std::int64_t many = 1024;
    const std::int64_t most = std::max<std::int64_t>(steps.front().Steps, 1);
    this->Fewest = std::clamp(few * stepsAtOnce(device, few) / most / few * few, few, many);
  }

  // The fewest nodes of a run.
  std::int64_t FewestNodes() const { return this->Fewest; }
  // Makes the records of the nodes [first, first + count) of the level, and their marks. Returns
  // the number of velocity evaluations. Throws DeviceError.
  std::int64_t Run(std::int64_t first, std::int64_t count, unsigned char* marks)
  {
    const auto nodes = static_cast<std::size_t>(count);
    const std::size_t floats = nodes * static_cast<std::size_t>(this->Record);
    if (count > this->Room)
    {
      this->Records = this->Owner.Allocate(floats * sizeof(float), what);
      this->Marks = this->Owner.Allocate(nodes, what);
      this->Status = this->Owner.Allocate(nodes * sizeof(std::uint32_t), what);
      this->Counts.resize(nodes);
      this->Room = count;
    }
    // The common times of particles that hand over, by the number of steps that are left.
    const auto timeBefore = [&](std::int64_t left) {
      return commonStart + (1.0 - commonStart) * grading(this->Steps - left, this->Steps);
    };
    const std::int64_t handOver = this->Level.HandOver;
    this->Advance.With(this->Input, this->Tables->Fine, this->Tables->Coarse,
      this->Tables->Occupied, cl_long{ this->Steps }, cl_long{ this->LevelCount },
      this->Coarser.Levels, this->Coarser.Records, this->Coarser.Bad, this->OfParticles,
      this->OfNodes, this->StepsOfNodes, cl_long{ handOver }, timeBefore(handOver + 2),
      timeBefore(handOver + 1), timeBefore(handOver), this->Places,
      cl_long{ this->Level.Axes[0].Cells + 1 }, cl_long{ this->Level.Axes[1].Cells + 1 },
      cl_long{ first }, static_cast<cl_uint>(count), this->Records, this->Marks, this->Status);
    this->Owner.Run(this->Advance, nodes);
    this->Owner.Read(
      this->Records, this->Level.Records + first * this->Record, floats * sizeof(float));
    this->Owner.Read(this->Marks, marks + first, nodes);
    this->Owner.Read(this->Status, this->Counts.data(), nodes * sizeof(std::uint32_t));
    std::int64_t evaluations = 0;
    for (std::size_t i = 0; i < nodes; ++i)
    {
      // A status holds twice the evaluations, and whether the node is bad.
      evaluations += this->Counts[i] / 2;
    }
    return evaluations;
  }

private:
  static constexpr const char* what = "a flow map";

  Device& Owner;
  const FlowMapLevel<Dimension> Level;
  const std::int64_t Steps; // the number of steps of particles
  const int LevelCount;
  const std::int64_t Record; // floats
  const std::shared_ptr<const DeviceTables<Dimension>> Tables;
  const DeviceMap<Dimension> Coarser;
  DeviceKernel Advance;
  DeviceBuffer Input;
  DeviceBuffer OfParticles; // weights
  DeviceBuffer OfNodes;
  DeviceBuffer StepsOfNodes;
  DeviceBuffer Places;
  std::int64_t Fewest = 0;
  // Buffers for the nodes of a run.
  std::int64_t Room = 0;
  DeviceBuffer Records;
  DeviceBuffer Marks;
  DeviceBuffer Status;
  std::vector<std::uint32_t> Counts;
};

} // namespace RectifiedTransport

#endif
