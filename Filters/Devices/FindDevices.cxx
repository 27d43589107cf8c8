// SPDX-License-Identifier: BSD-3-Clause
#include "Devices/Device.h"

namespace RectifiedTransport
{

namespace
{

// A number that OpenCL reports about a device; 0 if the driver does not know the question.
template <class T>
T numberOf(const OpenCL& cl, cl_device_id device, cl_device_info what)
{
  T number = 0;
  cl.clGetDeviceInfo(device, what, sizeof(T), &number, nullptr);
  return number;
}

std::string textOf(const OpenCL& cl, cl_device_id device, cl_device_info what)
{
  return infoText([&](std::size_t size, void* text, std::size_t* needed) {
    return cl.clGetDeviceInfo(device, what, size, text, needed);
  });
}

// What OpenCL leaves to devices and equal bits need: doubles and floats that round to nearest, with
// infinities, NaN and subnormal numbers. Empty if the device lacks nothing.
std::string lacksOf(const OpenCL& cl, cl_device_id device)
{
  constexpr cl_device_fp_config exact = CL_FP_ROUND_TO_NEAREST | CL_FP_INF_NAN | CL_FP_DENORM;
  const auto isExact = [&](cl_device_info what) {
    return (numberOf<cl_device_fp_config>(cl, device, what) & exact) == exact;
  };
  if (!numberOf<cl_bool>(cl, device, CL_DEVICE_AVAILABLE))
  {
    return "is not available";
  }
  if (!numberOf<cl_bool>(cl, device, CL_DEVICE_COMPILER_AVAILABLE))
  {
    return "has no compiler";
  }
  if (!numberOf<cl_bool>(cl, device, CL_DEVICE_ENDIAN_LITTLE))
  {
    return "has its bytes in another order";
  }
  if (!isExact(CL_DEVICE_DOUBLE_FP_CONFIG))
  {
    return "has no double precision";
  }
  if (!isExact(CL_DEVICE_SINGLE_FP_CONFIG))
  {
    return "takes small floats for 0, which flow maps need";
  }
  return "";
}

// Asks the driver for all that a user sees and a choice needs.
FoundDevice describe(const OpenCL& cl, cl_platform_id platform, cl_device_id device)
{
  const std::string version = infoText([&](std::size_t size, void* text, std::size_t* needed) {
    return cl.clGetPlatformInfo(platform, CL_PLATFORM_VERSION, size, text, needed);
  });
  return { platform, device, numberOf<cl_device_type>(cl, device, CL_DEVICE_TYPE),
    { textOf(cl, device, CL_DEVICE_NAME), version + ", " + textOf(cl, device, CL_DRIVER_VERSION),
      numberOf<cl_ulong>(cl, device, CL_DEVICE_GLOBAL_MEM_SIZE), lacksOf(cl, device) } };
}

} // namespace

std::vector<FoundDevice> findDevices()
{
  std::vector<FoundDevice> found;
  const OpenCL* const cl = OpenCL::Loaded();
  cl_uint platformCount = 0;
  // Without any driver this is an error of the loader.
  if (!cl || cl->clGetPlatformIDs(0, nullptr, &platformCount) != CL_SUCCESS)
  {
    return found;
  }
  std::vector<cl_platform_id> platforms(platformCount);
  // Two calls of each list: the count first, then the entries.
  cl->clGetPlatformIDs(platformCount, platforms.data(), nullptr);
  for (const cl_platform_id platform : platforms)
  {
    cl_uint count = 0;
    if (cl->clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 0, nullptr, &count) != CL_SUCCESS)
    {
      continue; // it has none
    }
    std::vector<cl_device_id> devices(count);
    cl->clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, count, devices.data(), nullptr);
    for (const cl_device_id device : devices)
    {
      found.push_back(describe(*cl, platform, device));
    }
  }
  return found;
}

std::vector<DeviceDescription> listDevices()
{
  std::vector<DeviceDescription> descriptions;
  for (FoundDevice& found : findDevices())
  {
    descriptions.push_back(std::move(found.Description));
  }
  return descriptions;
}

} // namespace RectifiedTransport
