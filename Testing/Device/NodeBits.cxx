// SPDX-License-Identifier: BSD-3-Clause
// The kernel that makes the nodes of flow maps.
#include "Bits.h"
#include "ReportInputs.h"

#include "Core/Device/DeviceUse.h"
#include "Core/Flow/AdvectionJob.h"
#include "Core/Flow/Devices/FlowOnDevices.h"
#include "Core/Flow/FlowMap.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/SummedAreaTables.h"
#include "Devices/Device.h"

namespace RectifiedTransport
{

namespace
{

template <int Dimension>
void compareLevels(const FlowMapView<Dimension>& device, const FlowMapView<Dimension>& processor,
  bool backward, BitsCount& nodes, BitsCount& cells)
{
  constexpr int position = Dimension;
  const int entries = backward ? position : 4 * position; // that are used, of a record
  const int record =
    backward ? FlowMapLevel<Dimension>::BackwardRecord : FlowMapLevel<Dimension>::ForwardRecord;
  for (int level = 0; level < std::min(device.LevelCount, processor.LevelCount); ++level)
  {
    const FlowMapLevel<Dimension>& of = device.Levels[level];
    const FlowMapLevel<Dimension>& right = processor.Levels[level];
    std::int64_t nodeCount = 1;
    std::int64_t cellCount = 1;
    for (const LatticeAxis& axis : right.Axes)
    {
      nodeCount *= axis.Cells + 1;
      cellCount *= axis.Cells;
    }
    const std::string where = "level " + std::to_string(level) + ", ";
    for (std::int64_t node = 0; node < nodeCount; ++node)
    {
      const float* const a = of.Records + node * record;
      const float* const b = right.Records + node * record;
      nodes.Add(std::memcmp(a, b, static_cast<std::size_t>(entries) * sizeof(float)) == 0, [&]() {
        int entry = 0;
        while (std::memcmp(a + entry, b + entry, sizeof(float)) == 0)
        {
          ++entry;
        }
        return bothValues(
          where + "node " + std::to_string(node) + ", entry " + std::to_string(entry),
          exactly(a[entry]), exactly(b[entry]));
      });
    }
    for (std::int64_t cell = 0; cell < cellCount; ++cell)
    {
      cells.Add(of.Bad[cell] == right.Bad[cell], [&]() {
        return bothValues(where + "cell " + std::to_string(cell),
          std::string(of.Bad[cell] ? "bad" : "good"),
          std::string(right.Bad[cell] ? "bad" : "good"));
      });
    }
  }
  cells.Add(device.LevelCount == processor.LevelCount, [&]() {
    return bothValues(
      "number of levels", std::to_string(device.LevelCount), std::to_string(processor.LevelCount));
  });
}

template <int Dimension>
void compareMaps(const std::shared_ptr<Device>& device, BitsTable& table, const std::string& name,
  const TestDensity<Dimension>& density, int steps)
{
  Progress work{ Context() };
  const SummedAreaTables<Dimension> tables(density.Source(), work);
  FlowOnDevices<Dimension> devices;
  for (const AdvectionKind kind : { AdvectionKind::Forward, AdvectionKind::Backward })
  {
    const bool backward = kind == AdvectionKind::Backward;
    const FlowMapShape<Dimension> shape(density.Size, steps, directionOf(kind));
    if (shape.Levels.empty())
    {
      continue;
    }
    const std::string what = name + " " + nameOf<Dimension>(density.Size) + ", " +
      std::to_string(steps) + " steps, " + (backward ? "backward" : "forward");
    const AdvectionJob<Dimension> job(tables.View(), kind, withSteps(steps, FlowMaps::On));
    const FlowMap<Dimension> right(shape, job.Job, Context());
    DeviceUse use(device);
    const std::uint64_t before = device->Work().Kernels;
    const auto flow = devices.On(&use);
    const auto nodes = flow->BeginNodes(use, job);
    const FlowMap<Dimension> found(shape, job.Job, Context(), nodes);
    if (!use.Serves() || device->Work().Kernels == before)
    {
      table.AddFault("advanceNodes", what, use.Fault());
      continue;
    }
    BitsCount ofNodes;
    BitsCount ofCells;
    compareLevels<Dimension>(found.View(), right.View(), backward, ofNodes, ofCells);
    table.Add("advanceNodes", what + ", nodes", ofNodes);
    table.Add("advanceNodes", what + ", bad cells", ofCells);
  }
}

} // namespace

void compareNodes(const std::shared_ptr<Device>& device, bool isQuick, BitsTable& table)
{
  compareMaps<2>(device, table, "random", randomCells<2>({ 385, 450 }), 32);
  compareMaps<2>(device, table, "disc with a hole", discWithHole<2>({ 448, 448 }), 32);
  if (!isQuick)
  {
    compareMaps<2>(device, table, "photograph-like", photographLike<2>({ 1024, 1024 }), 32);
    compareMaps<2>(device, table, "photograph-like", photographLike<2>({ 1024, 1024 }), 64);
    compareMaps<2>(device, table, "photograph-like", photographLike<2>({ 1000, 701 }), 128);
    compareMaps<3>(device, table, "photograph-like", photographLike<3>({ 128, 128, 128 }), 32);
    compareMaps<3>(device, table, "two Gaussians", twoGaussians<3>({ 150, 131, 97 }), 32);
    compareMaps<3>(device, table, "disc with a hole", discWithHole<3>({ 96, 96, 96 }), 24);
  }
  compareMaps<3>(device, table, "disc with a hole", discWithHole<3>({ 64, 64, 64 }), 20);
}

} // namespace RectifiedTransport
