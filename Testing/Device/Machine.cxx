// SPDX-License-Identifier: BSD-3-Clause
#include "Machine.h"

#include "Core/Parallel/Executor.h"
#include "Core/Parallel/InstructionSet.h"
#include "Devices/Device.h"
#include "Devices/DeviceCheck.h"

#include <cstdio>
#include <fstream>
#include <string>
#include <thread>

namespace RectifiedTransport
{

namespace
{

std::string processorName()
{
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
  {
    const std::size_t colon = line.find(':');
    if (line.rfind("model name", 0) == 0 && colon + 2 < line.size())
    {
      return line.substr(colon + 2);
    }
  }
  return "unknown processor";
}

template <class T>
T numberOf(const FoundDevice& found, cl_device_info what)
{
  T number = 0;
  OpenCL::Loaded()->clGetDeviceInfo(found.Id, what, sizeof(T), &number, nullptr);
  return number;
}

const char* kindOf(const FoundDevice& found)
{
  return (found.Type & CL_DEVICE_TYPE_GPU) != 0 ? "GPU"
    : (found.Type & CL_DEVICE_TYPE_CPU) != 0    ? "the processor itself"
                                                : "another kind of device";
}

std::string stateOf(const FoundDevice& found)
{
  if (!found.Description.Lacks.empty())
  {
    return "cannot be used: it " + found.Description.Lacks;
  }
  try
  {
    const auto device = std::make_shared<Device>(found);
    checkDevice(*device);
    return "has what is needed, and passes the self-test";
  }
  catch (const DeviceError& error)
  {
    return std::string("cannot be used: ") + error.what();
  }
}

} // namespace

void printMachine()
{
  std::printf("MACHINE\n  %s, %u hardware threads, %d used\n  %s kernels, compiler %s\n",
    processorName().c_str(), std::thread::hardware_concurrency(), OpenMPExecutor().Concurrency(),
    nameOf(instructionSet()), __VERSION__);
}

void printDevices()
{
  std::printf("\nDEVICES\n");
  if (!OpenCL::Loaded())
  {
    std::printf("  none: no libOpenCL.so.1, the loader of OpenCL\n");
    return;
  }
  const std::vector<FoundDevice> all = findDevices();
  if (all.empty())
  {
    std::printf("  none: no driver of OpenCL is installed (/etc/OpenCL/vendors names none)\n");
  }
  for (const FoundDevice& found : all)
  {
    constexpr double megabyte = 1e6;
    std::printf("  '%s'\n    %s, %u units at %u MHz, %.0f MB, at most %.0f MB a buffer\n"
                "    %s\n    %s\n",
      found.Description.Name.c_str(), kindOf(found),
      numberOf<cl_uint>(found, CL_DEVICE_MAX_COMPUTE_UNITS),
      numberOf<cl_uint>(found, CL_DEVICE_MAX_CLOCK_FREQUENCY),
      static_cast<double>(found.Description.Memory) / megabyte,
      static_cast<double>(numberOf<cl_ulong>(found, CL_DEVICE_MAX_MEM_ALLOC_SIZE)) / megabyte,
      found.Description.Driver.c_str(), stateOf(found).c_str());
  }
}

bool isGpu(const Device& device)
{
  for (const FoundDevice& found : findDevices())
  {
    if (found.Description.Name == device.Description().Name)
    {
      return (found.Type & CL_DEVICE_TYPE_GPU) != 0;
    }
  }
  return false;
}

} // namespace RectifiedTransport
