// SPDX-License-Identifier: BSD-3-Clause
// In place of the other sources of this folder where the headers of OpenCL are missing.
#include "Core/Flow/Devices/DeviceAdvection.h"

namespace RectifiedTransport
{

template <int Dimension>
class DeviceFlow<Dimension>::Implementation
{
};

template <int Dimension>
DeviceFlow<Dimension>::DeviceFlow() = default;

template <int Dimension>
DeviceFlow<Dimension>::~DeviceFlow() = default;

template <int Dimension>
void DeviceFlow<Dimension>::MakeTables(
  DeviceUse&, const DensitySource<Dimension>&, const SummedAreaTables<Dimension>&, Progress&)
{
}

template <int Dimension>
bool DeviceFlow<Dimension>::Serves(AdvectionKind, const FlowOptions&)
{
  return false;
}

template <int Dimension>
std::unique_ptr<DeviceAdvection<Dimension>> DeviceFlow<Dimension>::Begin(
  DeviceUse&, const AdvectionJob<Dimension>&, std::shared_ptr<const FlowMap<Dimension>>, Progress&)
{
  return nullptr;
}

template <int Dimension>
DeviceNodes<Dimension> DeviceFlow<Dimension>::BeginNodes(DeviceUse&, const AdvectionJob<Dimension>&)
{
  return {};
}

template class DeviceFlow<1>;
template class DeviceFlow<2>;
template class DeviceFlow<3>;

} // namespace RectifiedTransport
