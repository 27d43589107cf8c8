// SPDX-License-Identifier: BSD-3-Clause
#include "Devices/Device.h"

#include "Devices/DeviceCheck.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace RectifiedTransport
{

namespace
{

// OpenCL's names have no common use of capitals.
std::string lowerCase(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

// For messages: the names in quotes.
std::string namesOf(const std::vector<FoundDevice>& devices)
{
  std::string names;
  for (const FoundDevice& device : devices)
  {
    names += (names.empty() ? "'" : ", '") + device.Description.Name + "'";
  }
  return names;
}

// Compilers of drivers end the program when memory runs out, so 256 MiB must be free before one is
// called.
bool hasMemoryToCompile()
{
  constexpr std::size_t enough = std::size_t{ 1 } << 28;
  void* volatile block = std::malloc(enough); // volatile, or it would be optimized away
  const bool fits = block != nullptr;
  std::free(block);
  return fits;
}

} // namespace

// See DeviceList.h: devices of the name that lack nothing are tried in order, from `number` on,
// until one passes its self-test. The first fault is the one that is reported.
std::shared_ptr<FlowDevice> openDevice(
  const std::string& name, int number, const std::vector<std::shared_ptr<FlowDevice>>& open)
{
  if (!hasMemoryToCompile())
  {
    throw DeviceError("There is too little memory to open an OpenCL device");
  }
  if (OpenCL::IsOfParent())
  {
    throw DeviceError("A child that fork() made cannot use its parent's OpenCL devices");
  }
  if (!OpenCL::Loaded())
  {
    throw DeviceError("There is no OpenCL on this machine (libOpenCL.so.1, of a driver's package)");
  }
  // Drivers may come and go, so the devices are listed at each call.
  const std::vector<FoundDevice> devices = findDevices();
  if (devices.empty())
  {
    throw DeviceError("OpenCL has no device on this machine; its driver may be missing");
  }
  std::string reason;
  std::vector<FoundDevice> complete;
  for (const FoundDevice& found : devices)
  {
    const DeviceDescription& description = found.Description;
    if (lowerCase(description.Name).find(lowerCase(name)) == std::string::npos)
    {
      continue;
    }
    if (description.Lacks.empty())
    {
      complete.push_back(found);
    }
    else if (reason.empty())
    {
      reason = "The device '" + description.Name + "' " + description.Lacks;
    }
  }
  // Processors come last and are not counted beside others: a GPU is what users mean by a device.
  const auto processors = std::stable_partition(complete.begin(), complete.end(),
    [](const FoundDevice& found) { return (found.Type & CL_DEVICE_TYPE_CPU) == 0; });
  const auto others = static_cast<std::size_t>(processors - complete.begin());
  const std::size_t counted = others > 0 ? others : complete.size();
  for (std::size_t i = 0; i < complete.size(); ++i)
  {
    const FoundDevice& found =
      complete[i < counted ? (static_cast<std::size_t>(number) + i) % counted : i];
    // A device stays open for all runs, as opening and testing it takes a second or so.
    const auto known =
      std::find_if(open.begin(), open.end(), [&found](const std::shared_ptr<FlowDevice>& device) {
        return static_cast<const Device&>(*device).Is(found) && !device->IsLost();
      });
    if (known != open.end())
    {
      return *known;
    }
    try
    {
      // A device is used only if its arithmetic has the bits of the processor's.
      auto device = std::make_shared<Device>(found);
      checkDevice(*device);
      return device;
    }
    catch (const DeviceError& error)
    {
      reason = reason.empty() ? error.what() : reason;
    }
  }
  throw DeviceError(reason.empty()
      ? "No OpenCL device is named '" + name + "'; there are " + namesOf(devices)
      : reason);
}

DeviceUse useDevice(const std::string& name)
{
  try
  {
    return DeviceUse(openDevice(name));
  }
  catch (const DeviceError& error)
  {
    return DeviceUse(std::string(error.what()));
  }
}

// Memory counts as taken until the driver has it back.
void DeviceRelease::operator()(cl_mem memory) const
{
  this->Owner->Release(this->Owner->Cl.clReleaseMemObject, memory);
  this->Owner->Taken -= this->Bytes;
}

// An event's end must be waited for: its transfer uses the host's memory.
void DeviceRelease::operator()(cl_event event) const
{
  this->Owner->Cl.clWaitForEvents(1, &event);
  this->Owner->Cl.clReleaseEvent(event);
}

void DeviceRelease::operator()(cl_kernel kernel) const
{
  this->Owner->Release(this->Owner->Cl.clReleaseKernel, kernel);
}

void DeviceRelease::operator()(cl_program program) const
{
  this->Owner->Release(this->Owner->Cl.clReleaseProgram, program);
}

// Waits and takes the event's status, so that a fault of the transfer is not lost.
void DeviceTransfer::Wait()
{
  if (this->Event)
  {
    const Device& owner = *this->Event.get_deleter().Owner;
    const cl_event event = this->Event.release();
    const cl_int waited = owner.Cl.clWaitForEvents(1, &event);
    owner.Cl.clReleaseEvent(event);
    owner.RequireWork(waited, "did not finish a transfer");
  }
}

// A buffer's argument is its handle.
void DeviceKernel::Set(cl_uint number, const DeviceBuffer& buffer)
{
  const cl_mem memory = buffer.Memory.get();
  this->SetBytes(number, sizeof(cl_mem), &memory);
}

void DeviceKernel::SetBytes(cl_uint number, std::size_t bytes, const void* value)
{
  const Device& owner = *this->Kernel.get_deleter().Owner;
  owner.Require(owner.Cl.clSetKernelArg(this->Kernel.get(), number, bytes, value),
    "takes no argument " + std::to_string(number) + " of the kernel " + this->Name);
}

// Each run makes its own kernels: arguments belong to the kernel object, which is not safe for
// several threads.
DeviceKernel DeviceProgram::NewKernel(const std::string& name) const
{
  Device* const owner = this->Program.get_deleter().Owner;
  cl_int code = CL_SUCCESS;
  DeviceKernel kernel;
  kernel.Kernel = DeviceHandle<cl_kernel>(
    owner->Cl.clCreateKernel(this->Program.get(), name.c_str(), &code), { owner });
  kernel.Name = name;
  owner->Require(code, "does not make the kernel " + name);
  return kernel;
}

// Two queues: kernels, and transfers beside them. Each runs in order.
Device::Device(const FoundDevice& found)
  : Cl(*OpenCL::Loaded())
  , Found(found)
{
  this->Cl.clGetDeviceInfo(found.Id, CL_DEVICE_MAX_MEM_ALLOC_SIZE, sizeof(this->LargestBuffer),
    &this->LargestBuffer, nullptr);
  // A context of this platform and this device alone.
  const cl_context_properties ofPlatform[] = { CL_CONTEXT_PLATFORM,
    reinterpret_cast<cl_context_properties>(found.Platform), 0 };
  cl_int code = CL_SUCCESS;
  this->Context = this->Cl.clCreateContext(ofPlatform, 1, &found.Id, nullptr, nullptr, &code);
  this->Require(code, "cannot be opened");
  for (cl_command_queue* queue : { &this->Queue, &this->Transfers })
  {
    *queue = this->Cl.clCreateCommandQueue(this->Context, found.Id, 0, &code);
    // The destructor does not run for an object whose constructor throws.
    if (code != CL_SUCCESS)
    {
      this->Close();
    }
    this->Require(code, "gives no queue");
  }
}

// Flows hold buffers of this device, so they go before the context does.
Device::~Device()
{
  this->Flows.clear();
  this->Programs.clear();
  this->Close();
}

// Queues are released before the context that they belong to.
void Device::Close()
{
  for (cl_command_queue queue : { this->Queue, this->Transfers })
  {
    this->Release(this->Cl.clReleaseCommandQueue, queue);
  }
  this->Release(this->Cl.clReleaseContext, this->Context);
}

void Device::Forget(const void* owner)
{
  std::shared_ptr<void> flow; // destroyed after the lock: that may take a while
  const std::lock_guard<std::mutex> lock(this->FlowsMutex);
  const auto found = this->Flows.find(owner);
  if (found != this->Flows.end())
  {
    flow = std::move(found->second);
    this->Flows.erase(found);
  }
}

// Errors of running work mean that the context is unusable from now on, except for a lack of
// memory.
void Device::RequireWork(cl_int code, const std::string& what) const
{
  if (code != CL_SUCCESS && code != CL_MEM_OBJECT_ALLOCATION_FAILURE &&
    code != CL_OUT_OF_HOST_MEMORY)
  {
    throw LostDevice("The device '" + this->Description().Name + "' " + what + " (OpenCL's error " +
      std::to_string(code) + ")");
  }
  this->Require(code, what);
}

// An error of a call, with OpenCL's number, as texts for them are not part of OpenCL.
void Device::Require(cl_int code, const std::string& what) const
{
  if (code != CL_SUCCESS)
  {
    throw DeviceError("The device '" + this->Description().Name + "' " + what +
      " (OpenCL's error " + std::to_string(code) + ")");
  }
}

void Device::RequireMemoryToCompile() const
{
  if (!hasMemoryToCompile())
  {
    throw DeviceError(
      "There is too little memory to compile for the device '" + this->Description().Name + "'");
  }
}

// The first line of the compiler's log goes into the message.
DeviceProgram Device::Build(const std::vector<std::string>& sources, const std::string& options)
{
  this->RequireMemoryToCompile();
  std::vector<const char*> texts;
  for (const std::string& source : sources)
  {
    texts.push_back(source.c_str());
  }
  cl_int code = CL_SUCCESS;
  cl_program made = this->Cl.clCreateProgramWithSource(
    this->Context, static_cast<cl_uint>(texts.size()), texts.data(), nullptr, &code);
  this->Require(code, "takes no program");
  DeviceProgram program;
  program.Program = DeviceHandle<cl_program>(made, { this });
  code = this->Cl.clBuildProgram(made, 1, &this->Found.Id, options.c_str(), nullptr, nullptr);
  if (code != CL_SUCCESS)
  {
    // The compiler's log names what it did not accept.
    const std::string log = infoText([&](std::size_t size, void* text, std::size_t* needed) {
      return this->Cl.clGetProgramBuildInfo(
        made, this->Found.Id, CL_PROGRAM_BUILD_LOG, size, text, needed);
    });
    this->Require(code, "does not compile a program: " + log.substr(0, log.find('\n')));
  }
  return program;
}

// Callers hold Mutex(), so the programs need no lock of their own.
const DeviceProgram& Device::Program(
  const std::string& name, const std::function<DeviceProgram()>& make)
{
  auto found = this->Programs.find(name);
  if (found == this->Programs.end())
  {
    // An exception of make() keeps nothing, and the next caller tries again.
    found = this->Programs.emplace(name, make()).first;
  }
  return found->second;
}

// Drivers promise more memory than they have, and fail later: what is asked for is compared with
// what is left first.
DeviceBuffer Device::Allocate(std::size_t bytes, const std::string& what)
{
  // One buffer may be limited to a quarter of the memory.
  const std::uint64_t most = std::min(this->LargestBuffer, this->MemoryLeft());
  if (bytes > most)
  {
    throw DeviceError("The device '" + this->Description().Name + "' has too little memory for " +
      what + ": " + std::to_string(bytes) + " bytes, of " + std::to_string(most) + " left");
  }
  DeviceBuffer buffer;
  cl_int code = CL_SUCCESS;
  // OpenCL has no buffers of 0 bytes.
  const cl_mem memory = this->Cl.clCreateBuffer(
    this->Context, CL_MEM_READ_WRITE, std::max<std::size_t>(bytes, 1), nullptr, &code);
  this->Require(code, "has too little memory for " + what);
  buffer.Memory = DeviceHandle<cl_mem>(memory, { this, bytes });
  this->Taken += bytes;
  return buffer;
}

// Blocking, in the queue of the kernels: after those before it.
void Device::Write(const DeviceBuffer& to, const void* from, std::size_t bytes, std::size_t offset)
{
  if (bytes > 0)
  {
    this->RequireWork(this->Cl.clEnqueueWriteBuffer(this->Queue, to.Memory.get(), CL_TRUE, offset,
                        bytes, from, 0, nullptr, nullptr),
      "takes no data");
    this->Done.BytesTo += bytes;
  }
}

// Blocking, too: the memory of the host is complete on return.
void Device::Read(const DeviceBuffer& from, void* to, std::size_t bytes, std::size_t offset)
{
  if (bytes > 0)
  {
    this->RequireWork(this->Cl.clEnqueueReadBuffer(this->Queue, from.Memory.get(), CL_TRUE, offset,
                        bytes, to, 0, nullptr, nullptr),
      "gives no data back");
    this->Done.BytesFrom += bytes;
  }
}

// Not blocking, in the queue of transfers: it overlaps with kernels.
DeviceTransfer Device::StartWrite(const DeviceBuffer& to, const void* from, std::size_t bytes)
{
  cl_event event = nullptr;
  this->RequireWork(this->Cl.clEnqueueWriteBuffer(this->Transfers, to.Memory.get(), CL_FALSE, 0,
                      bytes, from, 0, nullptr, &event),
    "takes no data");
  this->Done.BytesTo += bytes;
  return this->Begun(event);
}

DeviceTransfer Device::StartRead(const DeviceBuffer& from, void* to, std::size_t bytes)
{
  cl_event event = nullptr;
  this->RequireWork(this->Cl.clEnqueueReadBuffer(this->Transfers, from.Memory.get(), CL_FALSE, 0,
                      bytes, to, 0, nullptr, &event),
    "gives no data back");
  this->Done.BytesFrom += bytes;
  return this->Begun(event);
}

// A transfer starts when its queue is flushed, not when it is enqueued.
DeviceTransfer Device::Begun(cl_event event)
{
  DeviceTransfer transfer;
  transfer.Event = DeviceHandle<cl_event>(event, { this });
  this->RequireWork(this->Cl.clFlush(this->Transfers), "starts no transfer");
  return transfer;
}

// Begins to run what is enqueued, without waiting.
void Device::Start()
{
  this->RequireWork(this->Cl.clFlush(this->Queue), "does not start its work");
}

// A single row of work items.
void Device::Run(const DeviceKernel& kernel, std::size_t items, std::size_t group)
{
  this->RunGrid(kernel, { items, 1, 1 }, group);
}

// Work items are filled up to whole groups along the first axis; kernels compare their number with
// the count.
void Device::RunGrid(
  const DeviceKernel& kernel, std::array<std::size_t, 3> items, std::size_t group)
{
  items[0] = (items[0] + group - 1) / group * group;
  if (items[0] * items[1] * items[2] == 0)
  {
    return;
  }
  // Drivers may compile a kernel when it runs for the first time, too.
  if (this->Started.count(kernel.Name) == 0)
  {
    this->RequireMemoryToCompile();
    this->Started.insert(kernel.Name);
  }
  // Groups are rows of items along the first axis.
  const std::size_t groups[3] = { group, 1, 1 };
  this->RequireWork(this->Cl.clEnqueueNDRangeKernel(this->Queue, kernel.Kernel.get(), 3, nullptr,
                      items.data(), groups, 0, nullptr, nullptr),
    "does not start the kernel " + kernel.Name);
  ++this->Done.Kernels;
}

// Waits for all kernels.
void Device::Finish()
{
  this->RequireWork(this->Cl.clFinish(this->Queue), "did not finish its work");
}

} // namespace RectifiedTransport
