// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportAlgorithm.h"

#include "Bridge/Plan/DensityPlan.h"
#include "Bridge/Run/MpiController.h"
#include "Bridge/Run/Settings/TransportSettings.h"
#include "Core/Parallel/RankExchange.h"
#include "Devices/SharedDevices.h"

#include "vtkNew.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;

namespace
{
const char* const DeviceTexts[] = { "CPU", "OpenCL" };
} // namespace

struct vtkTransportAlgorithm::vtkDevice
{
  std::string Name;
  CachedDevice Cached;
  vtkNew<vtkStringArray> Names; // that were asked for last
};

//------------------------------------------------------------------------------
vtkTransportAlgorithm::vtkTransportAlgorithm(int densityPort)
  : vtkFlowAlgorithm(densityPort)
  , OwnDevice(new vtkDevice)
{
}

//------------------------------------------------------------------------------
vtkTransportAlgorithm::~vtkTransportAlgorithm() = default;

//------------------------------------------------------------------------------
const char* vtkTransportAlgorithm::GetMethodAsString()
{
  return choiceText(MethodTexts, this->Method);
}

//------------------------------------------------------------------------------
const char* vtkTransportAlgorithm::GetTablesAsString()
{
  return choiceText(TablesTexts, this->Tables);
}

//------------------------------------------------------------------------------
const char* vtkTransportAlgorithm::GetDeviceAsString()
{
  return choiceText(DeviceTexts, this->Device);
}

//------------------------------------------------------------------------------
void vtkTransportAlgorithm::SetDeviceName(const char* name)
{
  const std::string given = name ? name : "";
  if (given != this->OwnDevice->Name)
  {
    this->OwnDevice->Name = given;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
const char* vtkTransportAlgorithm::GetDeviceName()
{
  return this->OwnDevice->Name.c_str();
}

//------------------------------------------------------------------------------
vtkStringArray* vtkTransportAlgorithm::GetDeviceNames()
{
  vtkStringArray* names = this->OwnDevice->Names;
  names->Reset();
  names->InsertNextValue("");
  if (this->Device == DEVICE_OPENCL)
  {
    for (const std::string& name : deviceNames())
    {
      names->InsertNextValue(name);
    }
  }
  return names;
}

//------------------------------------------------------------------------------
DeviceUse vtkTransportAlgorithm::BeginDevice()
{
  // Devices do nothing of other methods.
  const bool serves = this->Method == RECTIFIED_FLOW && this->Integrator == MULTISTEP &&
    this->TableLookup == INTERPOLATED;
  if (this->Device != DEVICE_OPENCL || !serves)
  {
    this->OwnDevice->Cached.Release();
    return DeviceUse(std::shared_ptr<FlowDevice>());
  }
  // Ranks that run by themselves cannot ask each other for their machines.
  const Ranks& ranks = this->GetRanks();
  const int number =
    ranks.AreSeveral() ? placeOnMachine(ranks, machineOfRank()) : pieceOfRank().Number;
  return this->OwnDevice->Cached.Begin(this->OwnDevice->Name, number);
}

//------------------------------------------------------------------------------
void vtkTransportAlgorithm::EndDevice(const DeviceUse& device)
{
  if (this->Device != DEVICE_OPENCL)
  {
    return;
  }
  const std::string& fault = device.Fault();
  const std::vector<std::string> all = gatherTexts(this->GetRanks(), fault);
  const auto first =
    std::find_if(all.begin(), all.end(), [](const std::string& there) { return !there.empty(); });
  if (first != all.end())
  {
    const auto rank = first - all.begin();
    this->WarnOnFirstRank((rank > 0 ? "Rank " + std::to_string(rank) + ": " : "") + *first +
      "; the processor did the work, with the same result");
  }
}

//------------------------------------------------------------------------------
TransportSettings vtkTransportAlgorithm::GetTransportSettings()
{
  requireChoice("Method", this->Method, MethodTexts);
  requireThat(this->OptimalityTolerance > 0.0 && this->OptimalityTolerance < 1.0,
    "OptimalityTolerance", this->OptimalityTolerance, "above 0 and below 1");
  requireChoice("Device", this->Device, DeviceTexts);
  return { this->GetFlowOptions(), tableSetting(this->Tables),
    { this->Method == OPTIMAL, this->OptimalityTolerance, this->Certify != 0 } };
}

//------------------------------------------------------------------------------
void vtkTransportAlgorithm::WarnOfAreas()
{
  this->WarnOnFirstRank(
    "EqualizeAreas changed nothing: every pass made errors larger or folds more "
    "numerous (less contrast helps, for example a part of the mean added with "
    "Calculator)");
}

//------------------------------------------------------------------------------
void vtkTransportAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << this->GetMethodAsString() << "\n";
  os << indent << "OptimalityTolerance: " << this->OptimalityTolerance << "\n";
  os << indent << "Certify: " << (this->Certify ? "On" : "Off") << "\n";
  os << indent << "Tables: " << this->GetTablesAsString() << "\n";
  os << indent << "Device: " << this->GetDeviceAsString() << "\n";
  os << indent << "DeviceName: " << this->OwnDevice->Name << "\n";
}
VTK_ABI_NAMESPACE_END
