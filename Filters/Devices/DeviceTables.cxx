// SPDX-License-Identifier: BSD-3-Clause
#include "Devices/DeviceTables.h"

#include "Core/Flow/Kernels/SharedInputs.h"

#include <array>

namespace RectifiedTransport
{

namespace
{

// Names the arrays in messages about too little memory.
constexpr const char* tablesText = "the tables";

// At least one number, as OpenCL has no empty buffers.
std::size_t bytesOf(std::int64_t doubles)
{
  return static_cast<std::size_t>(std::max<std::int64_t>(doubles, 1)) * sizeof(double);
}

// Every (2^(level levelShift))-th node, and the last one: (cells - 1) / spacing + 2 along an axis,
// with the division rounded down.
template <int Dimension>
std::int64_t nodesAlong(const TableView<Dimension>& tables, int level, int axis)
{
  return ((tables.Cells[axis] - 1) >> (level * levelShift)) + 2;
}

// The bits of rows of cells with mass, by 64 in a word; empty if there are no voids.
template <int Dimension>
DeviceBuffer uploadOccupied(Device& device, const TableView<Dimension>& tables)
{
  std::int64_t words = tables.Occupied ? tables.WordsPerRow : 0;
  for (int axis = 1; axis < Dimension; ++axis)
  {
    words *= tables.Cells[axis];
  }
  return upload(device, tables.Occupied, words, tablesText);
}

// Where the coarse levels begin: after the finest one, in the same array.
template <int Dimension>
const double* coarseNodes(const TableView<Dimension>& tables)
{
  return tables.LevelCount > 1 ? tables.Levels[1].Nodes : endOfNodes<Dimension>(tables);
}

} // namespace

// The end of the last level's nodes.
template <int Dimension>
const double* endOfNodes(const TableView<Dimension>& tables)
{
  constexpr int last = Dimension - 1;
  const int level = tables.LevelCount - 1;
  return tables.Levels[level].Nodes +
    tables.Levels[level].Stride[last] * nodesAlong<Dimension>(tables, level, last);
}

// Copies the tables of the processor; the levels are two buffers, as one buffer may be limited to a
// quarter of the device's memory.
template <int Dimension>
DeviceTables<Dimension>::DeviceTables(Device& device, const TableView<Dimension>& tables)
{
  const double* fine = tables.Levels[0].Nodes;
  const double* coarse = coarseNodes<Dimension>(tables);
  this->Fine = upload(device, fine, coarse - fine, tablesText);
  this->Coarse = upload(device, coarse, endOfNodes<Dimension>(tables) - coarse, tablesText);
  this->Occupied = uploadOccupied<Dimension>(device, tables);
}

// Sums the tables on the device from the cells' values, which are far less to transfer than tables:
// one number a cell in place of four doubles a node.
template <int Dimension>
DeviceTables<Dimension>::DeviceTables(Device& device, const DeviceProgram& program,
  const TableView<Dimension>& tables, const DeviceBuffer& values)
{
  const double* coarse = coarseNodes<Dimension>(tables);
  this->Fine = device.Allocate(bytesOf(coarse - tables.Levels[0].Nodes), tablesText);
  this->Coarse = device.Allocate(bytesOf(endOfNodes<Dimension>(tables) - coarse), tablesText);
  this->Occupied = uploadOccupied<Dimension>(device, tables);
  this->Sum(device, program, tables, values);
}

// Prefix sums in the order of the processor's loops, so that each addition has the same operands
// and the bits agree. Chains of sums are independent of each other; each work item follows one.
template <int Dimension>
void DeviceTables<Dimension>::Sum(Device& device, const DeviceProgram& program,
  const TableView<Dimension>& tables, const DeviceBuffer& values)
{
  // The grid is cut into strips, whose sums give each strip's start before it is summed.
  TableShape shape{};
  std::copy_n(tables.Cells, Dimension, shape.Cells);
  shape.Stride1 = tables.Levels[0].Stride[1];
  shape.Stride2 = Dimension == 3 ? tables.Levels[0].Stride[Dimension - 1] : 0;
  shape.Strips = Dimension == 2 ? (shape.Cells[0] + RT_STRIP_CELLS - 1) / RT_STRIP_CELLS
                                : (shape.Cells[1] + RT_STRIP_ROWS - 1) / RT_STRIP_ROWS;
  const auto columns = static_cast<std::size_t>(shape.Cells[0]);
  const auto rows = static_cast<std::size_t>(shape.Cells[1]);
  const auto slices = static_cast<std::size_t>(shape.Cells[2]);
  const auto strips = static_cast<std::size_t>(shape.Strips);
  const auto run = [&](const char* name, std::array<std::size_t, 3> items, const auto&... buffers) {
    DeviceKernel kernel = program.NewKernel(name);
    device.RunGrid(kernel.With(shape, buffers...), items);
  };
  if constexpr (Dimension == 2)
  {
    // In 2D: the sums of each strip of each row, their prefix along the row, the rows with both
    // moments, then columns.
    const DeviceBuffer sums = device.Allocate(rows * strips * 2 * sizeof(double), tablesText);
    run("sumStrips", { rows, strips, 1 }, values, sums);
    run("sumBefore", { rows, 1, 1 }, sums);
    run("sumRows", { rows, strips, 1 }, values, sums, this->Fine);
    run("sumColumns", { columns + 1, 1, 1 }, this->Fine);
    device.Finish(); // before its buffers go
  }
  else
  {
    // In 3D: the same with four sums a column of a strip (mass and three moments), then along axis
    // 2.
    const DeviceBuffer before =
      device.Allocate(slices * strips * columns * 4 * sizeof(double), tablesText);
    run("sumStrips", { columns, strips, slices }, values, before);
    run("sumAlong", { slices, strips, 1 }, before);
    run("sumBefore", { columns, slices, 1 }, before);
    run("sumRows", { rows, slices, 1 }, values, this->Fine);
    run("sumColumns", { columns, strips, slices }, before, this->Fine);
    run("sumSlices", { columns + 1, rows + 1, 1 }, this->Fine);
    device.Finish(); // the buffers of sums must not go while kernels read them
  }
  // Coarse levels are copies of the finest level's nodes: their sums are exact.
  DeviceKernel copy = program.NewKernel("copyLevel");
  for (int level = 1; level < tables.LevelCount; ++level)
  {
    std::array<std::size_t, 3> nodes = { 1, 1, 1 };
    for (int axis = 0; axis < Dimension; ++axis)
    {
      nodes[static_cast<std::size_t>(axis)] =
        static_cast<std::size_t>(nodesAlong<Dimension>(tables, level, axis));
    }
    const auto& at = tables.Levels[level];
    device.RunGrid(
      copy.With(shape, this->Fine, this->Coarse, std::int64_t{ at.Nodes - tables.Levels[1].Nodes },
        at.Stride[1], Dimension == 3 ? at.Stride[Dimension - 1] : std::int64_t{ 0 },
        cl_int{ level * levelShift }),
      nodes);
  }
  device.Finish();
}

template class DeviceTables<2>;
template class DeviceTables<3>;
template const double* endOfNodes<2>(const TableView<2>&);
template const double* endOfNodes<3>(const TableView<3>&);

} // namespace RectifiedTransport
