// SPDX-License-Identifier: BSD-3-Clause
// The kernels that make the tables of a density.
#include "Bits.h"
#include "ReportInputs.h"

#include "Core/Device/DeviceUse.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/SummedAreaTables.h"
#include "Devices/Device.h"
#include "Devices/DeviceTables.h"
#include "Devices/FlowPrograms.h"

namespace RectifiedTransport
{

namespace
{

template <int Dimension>
BitsCount compareLevel(
  const TableView<Dimension>& tables, int level, const double* device, std::int64_t& at)
{
  const auto& right = tables.Levels[level];
  GridSize<Dimension> nodes;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    nodes[axis] = ((tables.Cells[axis] - 1) >> (level * levelShift)) + 2;
  }
  constexpr int record = TableView<Dimension>::Record;
  BitsCount count;
  for (std::int64_t i = 0; i < cellCount<Dimension>(nodes); ++i)
  {
    const GridSize<Dimension> node = cellAt<Dimension>(i, nodes);
    std::int64_t place = 0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      place += node[axis] * right.Stride[axis];
    }
    const double* const a = device + at + place;
    const double* const b = right.Nodes + place;
    count.Add(std::memcmp(a, b, record * sizeof(double)) == 0, [&]() {
      int entry = 0;
      while (std::memcmp(a + entry, b + entry, sizeof(double)) == 0)
      {
        ++entry;
      }
      return bothValues("node " + nameOf<Dimension>(node) + ", entry " + std::to_string(entry),
        exactly(a[entry]), exactly(b[entry]));
    });
  }
  at += right.Stride[Dimension - 1] * nodes[Dimension - 1];
  return count;
}

template <int Dimension>
void compareTablesOf(const std::shared_ptr<Device>& device, BitsTable& table,
  const std::string& name, const TestDensity<Dimension>& density)
{
  Progress work{ Context() };
  const SummedAreaTables<Dimension> right(density.Source(), work);
  const TableView<Dimension>& view = right.View();
  const auto count = endOfNodes<Dimension>(view) - view.Levels[0].Nodes;
  std::vector<double> found(static_cast<std::size_t>(count));
  const std::string what = name + " " + nameOf<Dimension>(density.Size);
  DeviceUse use(device);
  const bool isDone = use.Run([&]() {
    const DeviceTables<Dimension> made(*device, flowProgram(*device, Dimension), view,
      upload(*device, density.Values.data(), static_cast<std::int64_t>(density.Values.size()),
        "the values"));
    const double* const coarse =
      view.LevelCount > 1 ? view.Levels[1].Nodes : endOfNodes<Dimension>(view);
    const auto fine = static_cast<std::size_t>(coarse - view.Levels[0].Nodes);
    device->Read(made.Fine, found.data(), fine * sizeof(double));
    device->Read(made.Coarse, found.data() + fine, (found.size() - fine) * sizeof(double));
  });
  if (!isDone)
  {
    table.AddFault("tables", what, use.Fault());
    return;
  }
  std::int64_t at = 0;
  for (int level = 0; level < view.LevelCount; ++level)
  {
    table.Add("tables", what + ", level " + std::to_string(level),
      compareLevel<Dimension>(view, level, found.data(), at));
  }
}

} // namespace

void compareTables(const std::shared_ptr<Device>& device, bool isQuick, BitsTable& table)
{
  compareTablesOf<2>(device, table, "random", randomCells<2>({ 601, 270 }));
  compareTablesOf<2>(device, table, "random", randomCells<2>({ 7, 5 }));
  compareTablesOf<3>(device, table, "disc with a hole", discWithHole<3>({ 64, 64, 64 }));
  compareTablesOf<3>(device, table, "random", randomCells<3>({ 3, 33, 2 }));
  if (!isQuick)
  {
    compareTablesOf<2>(device, table, "photograph-like", photographLike<2>({ 1024, 1024 }));
    compareTablesOf<2>(device, table, "random", randomCells<2>({ 256, 5000 }));
    compareTablesOf<3>(device, table, "random", randomCells<3>({ 70, 131, 66 }));
    compareTablesOf<3>(device, table, "random", randomCells<3>({ 600, 40, 50 }));
    compareTablesOf<3>(device, table, "photograph-like", photographLike<3>({ 128, 128, 128 }));
  }
}

} // namespace RectifiedTransport
