// SPDX-License-Identifier: BSD-3-Clause
// An open device: its memory, its programs and its queues: kernels are done in order, and so are
// transfers beside them. One thread at a time.
#ifndef RectifiedTransport_Device_h
#define RectifiedTransport_Device_h

#include "Core/Device/DeviceError.h"
#include "Core/Device/FlowDevice.h"
#include "Devices/DeviceList.h"
#include "Devices/OpenCL.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

namespace RectifiedTransport
{

struct FoundDevice
{
  cl_platform_id Platform;
  cl_device_id Id;
  cl_device_type Type; // which may be a processor
  DeviceDescription Description;
};
// All devices of all platforms, in the order of listDevices.
std::vector<FoundDevice> findDevices();

class Device;

// Gives back what the driver has made for a device, which must outlive it.
struct DeviceRelease
{
  Device* Owner = nullptr;
  std::size_t Bytes = 0; // if it is memory

  void operator()(cl_mem memory) const;
  void operator()(cl_event event) const; // waits until its end
  void operator()(cl_kernel kernel) const;
  void operator()(cl_program program) const;
};
template <class Handle>
using DeviceHandle = std::unique_ptr<std::remove_pointer_t<Handle>, DeviceRelease>;

// Memory of a device.
class DeviceBuffer
{
public:
  std::size_t Size() const { return this->Memory.get_deleter().Bytes; }

private:
  friend class Device;
  friend class DeviceKernel;
  DeviceHandle<cl_mem> Memory;
};

// A transfer that is under way, beside the kernels: the memory must not be used before its end. It
// ends before this object does.
class DeviceTransfer
{
public:
  // Waits for its end. Throws DeviceError.
  void Wait();

private:
  friend class Device;
  DeviceHandle<cl_event> Event; // null: none
};

// A kernel with its arguments, of one thread. The program may go before it.
class DeviceKernel
{
public:
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
  void Set(cl_uint number, const DeviceBuffer& buffer);
  template <class T>
  void Set(cl_uint number, const T& value)
  {
    this->SetBytes(number, sizeof(T), &value);
  }
  void SetBytes(cl_uint number, std::size_t bytes, const void* value);

  DeviceHandle<cl_kernel> Kernel;
  std::string Name;
};

class DeviceProgram
{
public:
  DeviceKernel NewKernel(const std::string& name) const;

private:
  friend class Device;
  DeviceHandle<cl_program> Program;
};

// What a device has done.
struct DeviceWork
{
  std::uint64_t Kernels = 0; // runs of them
  std::uint64_t BytesTo = 0; // transferred
  std::uint64_t BytesFrom = 0;
};

// All functions throw DeviceError.
class Device final : public FlowDevice
{
public:
  explicit Device(const FoundDevice& found);
  ~Device() override;

  const DeviceDescription& Description() const { return this->Found.Description; }
  bool Is(const FoundDevice& found) const { return found.Id == this->Found.Id; }
  const std::string& Name() const override { return this->Description().Name; }
  bool IsLost() const override { return FlowDevice::IsLost() || OpenCL::IsOfParent(); }
  void Find(const void* owner, std::shared_ptr<DeviceFlow<2>>& flow) override;
  void Find(const void* owner, std::shared_ptr<DeviceFlow<3>>& flow) override;
  void Forget(const void* owner) override;
  bool IsGpu() const { return (this->Found.Type & CL_DEVICE_TYPE_GPU) != 0; }
  const DeviceWork& Work() const { return this->Done; }
  std::uint64_t LargestAllocation() const { return this->LargestBuffer; } // bytes
  // What buffers of this object may still take.
  std::uint64_t MemoryLeft() const { return this->Found.Description.Memory - this->Taken; }

  // One after the other. Drivers keep what they compile in files of their own.
  DeviceProgram Build(const std::vector<std::string>& sources, const std::string& options = "");
  // The program of a name, which make() builds when it is first asked for.
  const DeviceProgram& Program(const std::string& name, const std::function<DeviceProgram()>& make);
  // `what` is for messages. The memory is not set.
  DeviceBuffer Allocate(std::size_t bytes, const std::string& what);

  // Both wait for the end of the transfer.
  void Write(const DeviceBuffer& to, const void* from, std::size_t bytes, std::size_t offset = 0);
  void Read(const DeviceBuffer& from, void* to, std::size_t bytes, std::size_t offset = 0);
  // These begin the same transfers, which run beside the kernels and one after the other.
  DeviceTransfer StartWrite(const DeviceBuffer& to, const void* from, std::size_t bytes);
  DeviceTransfer StartRead(const DeviceBuffer& from, void* to, std::size_t bytes);
  // Runs whole groups of a number of items, at least as many as `items`, without waiting.
  void Run(const DeviceKernel& kernel, std::size_t items, std::size_t group = 64);
  // The same for a grid of items: whole groups along its first axis.
  void RunGrid(
    const DeviceKernel& kernel, std::array<std::size_t, 3> items, std::size_t group = 64);
  void Start(); // what waits to be run
  void Finish();

private:
  friend class DeviceKernel;
  friend class DeviceProgram;
  friend struct DeviceRelease;
  friend class DeviceTransfer;
  void Require(cl_int code, const std::string& what) const;
  // The same for its work: a device that fails there is lost, unless it lacks memory.
  void RequireWork(cl_int code, const std::string& what) const;
  // What the driver of a parent has made is left to it.
  template <class Handle>
  void Release(cl_int(CL_API_CALL* release)(Handle), Handle handle) const
  {
    if (handle && !OpenCL::IsOfParent())
    {
      release(handle);
    }
  }
  template <int Dimension>
  std::shared_ptr<DeviceFlow<Dimension>> FlowOf(const void* owner);
  DeviceTransfer Begun(cl_event event);
  void Close();
  void RequireMemoryToCompile() const;

  const OpenCL& Cl;
  const FoundDevice Found;
  std::uint64_t LargestBuffer = 0;
  std::atomic<std::uint64_t> Taken{ 0 };
  DeviceWork Done;
  cl_context Context = nullptr;
  cl_command_queue Queue = nullptr;
  cl_command_queue Transfers = nullptr;
  std::map<std::string, DeviceProgram> Programs;
  std::mutex FlowsMutex; // guards Flows; no other mutex is locked within
  std::map<const void*, std::shared_ptr<void>> Flows; // by their owners
  std::set<std::string> Started;                      // names of kernels
};

} // namespace RectifiedTransport

#endif
