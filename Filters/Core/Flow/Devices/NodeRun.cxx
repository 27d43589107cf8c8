// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/Devices/NodeRun.h"

#include "Core/Flow/Kernels/SharedInputs.h"
#include "Core/Flow/LatticePlaces.h"
#include "Core/Flow/NodeAdvance.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// NodeSteps of the kernel.
struct NodeSteps
{
  std::int64_t First;
  std::int64_t Steps;
  double Begin;
  double End;
};

} // namespace

template <int Dimension>
NodeRun<Dimension>::NodeRun(Device& device, const DeviceProgram& program,
  const FlowJob<Dimension>& job, std::shared_ptr<const DeviceTables<Dimension>> tables)
  : IsBackward(job.Backward)
  , Tables(std::move(tables))
  , Advance(program.NewKernel("advanceNodes"))
{
  const FlowInput input = flowInput<Dimension>(job);
  this->Input = upload(device, &input, 1, "a flow map");
}

template <int Dimension>
std::int64_t NodeRun<Dimension>::Run(Device& device, const FlowMapView<Dimension>& map,
  const FlowMapLevel<Dimension>& level, std::int64_t first, std::int64_t count,
  unsigned char* marks, Progress& progress)
{
  const std::int64_t all = map.Steps;
  std::vector<StepWeights> weights;
  std::vector<NodeSteps> steps;
  // Backward times by the steps of particles since time 1, forward by those until then.
  const auto timeOf = [&](
                        std::int64_t step) { return step < all ? 1.0 - grading(step, all) : 0.0; };
  const auto timeBefore = [&](std::int64_t left) {
    return commonStart + (1.0 - commonStart) * grading(all - left, all);
  };
  for (int parent = -1; parent < map.LevelCount; ++parent)
  {
    const std::vector<StepWeights> own =
      nodeWeights<Dimension>(map, this->IsBackward, level.HandOver, parent);
    const std::int64_t to = parent < 0 ? all : map.Levels[parent].HandOver;
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
  const char* const what = "a flow map";
  const auto uploadAll = [&](const auto& values) {
    return upload(device, values.data(), static_cast<std::int64_t>(values.size()), what);
  };
  const DeviceMap<Dimension> coarser(device, map, this->IsBackward);
  const DeviceBuffer ofParticles = upload(device, map.Weights, all, what);
  const DeviceBuffer ofNodes = uploadAll(weights);
  const DeviceBuffer nodeSteps = uploadAll(steps);
  const DeviceBuffer allPlaces = uploadAll(places);

  // Slices of the nodes.
  Progress work(progress.Stage());
  work.BeginStage(1.0, count);
  constexpr std::int64_t fewest = 1024;
  const std::int64_t record = this->IsBackward ? FlowMapLevel<Dimension>::BackwardRecord
                                               : FlowMapLevel<Dimension>::ForwardRecord;
  std::int64_t room = 0;
  DeviceBuffer records;
  DeviceBuffer ofVoids;
  DeviceBuffer status;
  std::vector<std::uint32_t> counts;
  std::int64_t evaluations = 0;
  for (std::int64_t done = 0; done < count;)
  {
    const std::int64_t slice = std::min(count - done, work.NextSlice(fewest));
    const auto nodes = static_cast<std::size_t>(slice);
    if (slice > room)
    {
      records = device.Allocate(nodes * static_cast<std::size_t>(record) * sizeof(float), what);
      ofVoids = device.Allocate(nodes, what);
      status = device.Allocate(nodes * sizeof(std::uint32_t), what);
      counts.resize(nodes);
      room = slice;
    }
    this->Advance.With(this->Input, this->Tables->Fine, this->Tables->Coarse,
      this->Tables->Occupied, cl_long{ all }, cl_long{ map.LevelCount }, coarser.Levels,
      coarser.Records, coarser.Bad, ofParticles, ofNodes, nodeSteps, cl_long{ level.HandOver },
      timeBefore(level.HandOver + 2), timeBefore(level.HandOver + 1), timeBefore(level.HandOver),
      allPlaces, cl_long{ level.Axes[0].Cells + 1 }, cl_long{ level.Axes[1].Cells + 1 },
      cl_long{ first + done }, static_cast<cl_uint>(slice), records, ofVoids, status);
    device.Run(this->Advance, nodes);
    device.Read(records, level.Records + (first + done) * record,
      nodes * static_cast<std::size_t>(record) * sizeof(float));
    device.Read(ofVoids, marks + first + done, nodes);
    device.Read(status, counts.data(), nodes * sizeof(std::uint32_t));
    for (std::size_t i = 0; i < nodes; ++i)
    {
      evaluations += counts[i] / 2;
    }
    done += slice;
    work.EndSlice(slice);
  }
  return evaluations;
}

template class NodeRun<2>;
template class NodeRun<3>;

} // namespace RectifiedTransport
