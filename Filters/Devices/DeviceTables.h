// SPDX-License-Identifier: BSD-3-Clause
// The summed-area tables of a density on a device.
#ifndef RectifiedTransport_DeviceTables_h
#define RectifiedTransport_DeviceTables_h

#include "Core/Tables/TableView.h"
#include "Devices/Device.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// A buffer of `count` values, at least one, with those of `values`.
template <class T>
DeviceBuffer upload(Device& device, const T* values, std::int64_t count, const char* what)
{
  DeviceBuffer buffer =
    device.Allocate(static_cast<std::size_t>(std::max<std::int64_t>(count, 1)) * sizeof(T), what);
  device.Write(buffer, values, static_cast<std::size_t>(count) * sizeof(T));
  return buffer;
}

template <class T>
DeviceBuffer upload(Device& device, const std::vector<T>& values, const char* what)
{
  return upload(device, values.data(), static_cast<std::int64_t>(values.size()), what);
}

template <int Dimension>
class DeviceTables
{
public:
  // Copies those of the processor. Throws DeviceError.
  DeviceTables(Device& device, const TableView<Dimension>& tables);
  // Makes them of the values of the cells, doubles with axis 0 fastest, with the same bits. Of
  // `tables` all is read but the nodes. Throws DeviceError.
  DeviceTables(Device& device, const DeviceProgram& program, const TableView<Dimension>& tables,
    const DeviceBuffer& values);

  DeviceBuffer Fine;
  DeviceBuffer Coarse;   // the other levels
  DeviceBuffer Occupied; // the bits of cells

private:
  void Sum(Device& device, const DeviceProgram& program, const TableView<Dimension>& tables,
    const DeviceBuffer& values);
};

// The end of the nodes of all levels, which lie one after the other.
template <int Dimension>
const double* endOfNodes(const TableView<Dimension>& tables);

} // namespace RectifiedTransport

#endif
