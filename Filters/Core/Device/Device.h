// SPDX-License-Identifier: BSD-3-Clause
// An open device: its memory, its programs and its queue, in which work is done in order. One
// thread at a time.
#ifndef RectifiedTransport_Device_h
#define RectifiedTransport_Device_h

#include "Core/Device/DeviceError.h"
#include "Core/Device/DeviceList.h"
#include "Core/Device/OpenCL.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

struct FoundDevice
{
  cl_platform_id Platform;
  cl_device_id Id;
  DeviceDescription Description;
};
// As listDevices.
std::vector<FoundDevice> findDevices();

class Device;

// Memory of a device, which must outlive it. Movable.
class DeviceBuffer
{
public:
  DeviceBuffer() = default;
  DeviceBuffer(DeviceBuffer&& other) noexcept { this->Swap(other); }
  DeviceBuffer& operator=(DeviceBuffer&& other) noexcept
  {
    DeviceBuffer old(std::move(*this));
    this->Swap(other);
    return *this;
  }
  ~DeviceBuffer();

  std::size_t Size() const { return this->Bytes; }

private:
  friend class Device;
  friend class DeviceKernel;
  void Swap(DeviceBuffer& other) noexcept
  {
    std::swap(this->Owner, other.Owner);
    std::swap(this->Memory, other.Memory);
    std::swap(this->Bytes, other.Bytes);
  }

  Device* Owner = nullptr;
  cl_mem Memory = nullptr;
  std::size_t Bytes = 0;
};

// A kernel with its arguments, of one thread. The program may go before it.
class DeviceKernel
{
public:
  DeviceKernel(DeviceKernel&& other) noexcept
    : Owner(other.Owner)
    , Kernel(std::exchange(other.Kernel, nullptr))
    , Name(std::move(other.Name))
  {
  }
  DeviceKernel& operator=(DeviceKernel&&) = delete;
  ~DeviceKernel();

  // Sets all arguments, in their order: buffers, and numbers by their values.
  template <class... Values>
  DeviceKernel& With(const Values&... values)
  {
    cl_uint next = 0;
    (this->Set(next++, values), ...);
    return *this;
  }

private:
  friend class Device;
  friend class DeviceProgram;
  DeviceKernel(Device& owner, cl_kernel kernel, std::string name)
    : Owner(&owner)
    , Kernel(kernel)
    , Name(std::move(name))
  {
  }
  void Set(cl_uint number, const DeviceBuffer& buffer);
  template <class T>
  void Set(cl_uint number, const T& value)
  {
    this->SetBytes(number, sizeof(T), &value);
  }
  void SetBytes(cl_uint number, std::size_t bytes, const void* value);

  Device* Owner;
  cl_kernel Kernel;
  std::string Name;
};

class DeviceProgram
{
public:
  DeviceProgram(DeviceProgram&& other) noexcept
    : Owner(other.Owner)
    , Program(std::exchange(other.Program, nullptr))
  {
  }
  DeviceProgram& operator=(DeviceProgram&&) = delete;
  ~DeviceProgram();

  DeviceKernel NewKernel(const std::string& name) const;

private:
  friend class Device;
  DeviceProgram(Device& owner, cl_program program)
    : Owner(&owner)
    , Program(program)
  {
  }

  Device* Owner;
  cl_program Program;
};

// All functions throw DeviceError.
class Device
{
public:
  explicit Device(const FoundDevice& found);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const DeviceDescription& Description() const { return this->Found.Description; }
  // What buffers of this object may still take.
  std::uint64_t MemoryLeft() const { return this->Found.Description.Memory - this->Taken; }

  // One after the other. Drivers keep what they compile in files of their own.
  DeviceProgram Build(const std::vector<std::string>& sources, const std::string& options = "");
  // `what` is for messages. The memory is not set.
  DeviceBuffer Allocate(std::size_t bytes, const std::string& what);

  // They wait until it is done.
  void Write(const DeviceBuffer& to, const void* from, std::size_t bytes, std::size_t offset = 0);
  void Read(const DeviceBuffer& from, void* to, std::size_t bytes, std::size_t offset = 0);
  // Whole groups of a number of items, at least as many as `items`; does not wait.
  void Run(const DeviceKernel& kernel, std::size_t items, std::size_t group = 64);
  void Finish();

private:
  friend class DeviceBuffer;
  friend class DeviceKernel;
  friend class DeviceProgram;
  void Require(cl_int code, const std::string& what) const;

  const OpenCL& Cl;
  const FoundDevice Found;
  std::uint64_t LargestBuffer = 0;
  std::uint64_t Taken = 0;
  cl_context Context = nullptr;
  cl_command_queue Queue = nullptr;
};

} // namespace RectifiedTransport

#endif
