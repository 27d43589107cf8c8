// SPDX-License-Identifier: BSD-3-Clause
// The properties Device and DeviceName: the same bits as the processor's on any machine, one
// warning if there is no such device, and one open device for all filters.
#include "../../MemoryLimit.h"
#include "BlendTest.h"

#include "Bridge/Run/AlgorithmProgress.h"
#include "Core/Device/DeviceError.h"
#include "Core/Device/FlowDevice.h"
#include "Core/Flow/FlowOptions.h"
#include "Devices/SharedDevices.h"

#include "vtkDensityEqualizingWarp.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStringArray.h"
#include "vtkTransportMap.h"

#include <cstdlib>
#include <memory>
#include <set>
#include <thread>

namespace
{

using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;

constexpr const char* nowhere = "no such device";
constexpr const char* instead = "; the processor did the work, with the same result";

// Every kind of filter that has a device.
std::vector<vtkSmartPointer<vtkTransportAlgorithm>> makeFilters()
{
  const auto image = makeImage(14, 11, 1, true, bumpy);
  const auto other = makeImage(14, 11, 1, true, otherDensity(13, 10));
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  sampler->SetNumberOfParticles(200);
  vtkNew<vtkTransportMap> map;
  map->SetInputData(image);
  map->SetDirectionToDensityToUniform();
  vtkNew<vtkDensityEqualizingWarp> warp;
  warp->SetInputData(makePoints({ 1.0, 2.0, 0.0, 7.5, 3.0, 0.0, 12.0, 9.0, 0.0 }));
  warp->SetInputData(1, image);
  return { sampler.Get(), map.Get(), warp.Get(), makeMorph(image, other),
    makeBarycenter({ image, other }) };
}

Values valuesOf(vtkTransportAlgorithm* filter)
{
  Values all;
  for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
  {
    vtkDataObject* output = filter->GetOutputDataObject(port);
    if (auto* points = vtkPointSet::SafeDownCast(output))
    {
      const Values places = coordinates(points);
      all.insert(all.end(), places.begin(), places.end());
    }
    for (const int kind : { vtkDataObject::POINT, vtkDataObject::CELL, vtkDataObject::FIELD })
    {
      vtkFieldData* arrays = output->GetAttributesAsFieldData(kind);
      for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
      {
        for (const double value : arrayValues(arrays->GetArray(i)))
        {
          all.push_back(std::isnan(value) ? -1.0 : value); // equal to itself
        }
      }
    }
  }
  return all;
}

void checkProperties(Checks& checks)
{
  for (const auto& filter : makeFilters())
  {
    ErrorTest test(checks, filter);
    CHECK(checks, filter->GetDevice() == vtkTransportAlgorithm::DEVICE_CPU);
    CHECK(checks, std::string(filter->GetDeviceName()).empty());
    for (const int device : { -1, 2 })
    {
      filter->SetDevice(device);
      CHECK(checks, std::string(filter->GetDeviceAsString()) == "Unknown");
      test.Expect(
        "Device is " + std::to_string(device) + "; it must be 0 (CPU) or 1 (OpenCL)", __LINE__);
    }
    filter->SetDeviceToOpenCL();
    CHECK(checks, std::string(filter->GetDeviceAsString()) == "OpenCL");
    filter->SetDeviceToCPU();
    CHECK(checks, std::string(filter->GetDeviceAsString()) == "CPU");

    vtkMTimeType time = filter->GetMTime();
    filter->SetDeviceName("a");
    CHECK(checks, std::string(filter->GetDeviceName()) == "a" && filter->GetMTime() > time);
    time = filter->GetMTime();
    filter->SetDeviceName("a");
    CHECK(checks, filter->GetMTime() == time);
    filter->SetDeviceName(nullptr);
    CHECK(checks, std::string(filter->GetDeviceName()).empty() && filter->GetMTime() > time);
  }
}

void checkNoDevice(Checks& checks)
{
  for (const auto& filter : makeFilters())
  {
    const std::string name = filter->GetClassName();
    filter->Update();
    const Values expected = valuesOf(filter);
    CHECK(checks, expected.size() > 6);
    const vtkMTimeType built = filter->GetTableBuildTime();
    Messages messages(filter);
    filter->SetDeviceName(nowhere); // of no effect
    filter->Update();
    checks.That(messages.Warnings.empty(), "no warning with CPU", __LINE__, name);
    filter->SetDeviceToOpenCL();
    for (const char* unknown : { nowhere, "nor this one" })
    {
      filter->SetDeviceName(unknown);
      messages.Clear();
      filter->Update();
      checks.That(valuesOf(filter) == expected, "the same bits", __LINE__, name);
      checks.That(
        messages.Errors.empty() && messages.Warnings.size() == 1, "one warning", __LINE__, name);
      const std::string text = messages.Warnings.empty() ? "" : messages.Warnings[0];
      checks.That(contains(text, instead), "says what was done", __LINE__, text);
      checks.That(contains(text, "No OpenCL device is named '" + std::string(unknown) + "'") ||
          contains(text, "OpenCL has no device on this machine") ||
          contains(text, "no OpenCL on this machine") || contains(text, "without OpenCL"),
        "says why", __LINE__, text);
    }
    checks.That(filter->GetTableBuildTime() == built, "tables are kept", __LINE__, name);
    filter->SetDeviceToCPU();
    messages.Clear();
    filter->Update();
    checks.That(messages.Warnings.empty(), "no warning again", __LINE__, name);
  }
}

// Nothing was computed, so that there is nothing to warn of.
void checkEmptyInput(Checks& checks)
{
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(vtkSmartPointer<vtkImageData>::New());
  sampler->SetDeviceToOpenCL();
  sampler->SetDeviceName(nowhere);
  Messages messages(sampler);
  sampler->Update();
  CHECK(checks, messages.Warnings.empty() && messages.Errors.empty());
}

// Whether there is a device. Where RT_OPENCL says so, there has to be one.
bool hasDevice(Checks& checks)
{
  CachedDevice kept;
  const DeviceUse use = kept.Begin("", 0);
  checks.That(use.Serves() || !std::getenv("RT_OPENCL"), "a device", __LINE__, use.Fault());
  return use.Serves();
}

void checkDevice(Checks& checks)
{
  if (!hasDevice(checks))
  {
    return;
  }
  for (const auto& filter : makeFilters())
  {
    const std::string name = filter->GetClassName();
    filter->Update();
    const Values expected = valuesOf(filter);
    Messages messages(filter);
    filter->SetDeviceToOpenCL();
    filter->Update();
    checks.That(valuesOf(filter) == expected, "the same bits", __LINE__, name);
    checks.That(messages.Warnings.empty() && messages.Errors.empty(), "no warning", __LINE__,
      messages.Warnings.empty() ? name : messages.Warnings[0]);
  }
}

void checkSharing(Checks& checks)
{
  if (!hasDevice(checks))
  {
    return;
  }
  CachedDevice one;
  CachedDevice other;
  CHECK(checks, one.Begin("", 0).Serves());
  const std::weak_ptr<const FlowDevice> opened = one.Get();
  const auto is = [&opened](const CachedDevice& kept) {
    return !opened.expired() && kept.Get() == opened.lock();
  };
  CHECK(checks, is(one));
  CHECK(checks, one.Begin("", 0).Serves() && is(one));
  CHECK(checks, other.Begin(deviceNames().front(), 0).Serves() && is(other));

  // What it cannot do once does not close it.
  {
    DeviceUse small = one.Begin("", 0);
    CHECK(checks, !small.Run([]() { throw DeviceError("too little memory"); }));
    CHECK(checks, small.Fault() == "too little memory" && !small.Serves());
  }
  CHECK(checks, one.Begin("", 0).Serves() && is(one));
  one.Release();
  CHECK(checks, one.Get() == nullptr && is(other));
  CHECK(checks, one.Begin("", 0).Serves() && is(one));

  // One that is lost is opened anew, by all who have it.
  {
    DeviceUse lost = one.Begin("", 0);
    CHECK(checks, !lost.Run([]() { throw LostDevice("lost"); }) && lost.Fault() == "lost");
  }
  CHECK(checks, opened.lock()->IsLost());
  CHECK(checks, one.Begin("", 0).Serves() && !is(one) && is(other));
  CHECK(checks, other.Begin("", 0).Serves() && other.Get() == one.Get());
  CHECK(checks, opened.expired());
  one.Release();

  // A name that fits none: not what was open before, and the next run tries again.
  CHECK(checks, contains(other.Begin(nowhere, 0).Fault(), nowhere) && other.Get() == nullptr);
  const DeviceUse again = other.Begin("", 0);
  CHECK(checks, again.Serves() && again.Fault().empty() && other.Get() != nullptr);
}

#ifdef HAS_MEMORY_LIMIT
// Drivers would end the program.
void checkLittleMemory(Checks& checks)
{
  CachedDevice kept;
  std::string fault;
  fault.reserve(200);
  {
    const MemoryLimit limit(1 << 20);
    fault = kept.Begin("", 0).Fault();
  }
  checks.That(contains(fault, "too little memory to open an OpenCL device") ||
      contains(fault, "without OpenCL"),
    "says so", __LINE__, fault);
  CHECK(checks, kept.Begin("", 0).Serves() == hasDevice(checks));
}
#endif

// Between runs a filter keeps what it has opened, until it is set to CPU or deleted.
void checkKeeping(Checks& checks)
{
  if (!hasDevice(checks))
  {
    return;
  }
  for (const bool isDeleted : { false, true })
  {
    auto sampler = vtkSmartPointer<vtkTransportSampler>::New();
    sampler->SetInputData(makeImage(6, 5, 1, true, bumpy));
    sampler->SetNumberOfParticles(50);
    sampler->SetDeviceToOpenCL();
    sampler->Update();
    std::weak_ptr<const FlowDevice> opened;
    {
      CachedDevice same;
      CHECK(checks, same.Begin("", 0).Serves());
      opened = same.Get();
    }
    CHECK(checks, !opened.expired());
    sampler->SetRandomSeed(2);
    sampler->Update();
    CHECK(checks, !opened.expired());
    if (isDeleted)
    {
      sampler = nullptr;
    }
    else
    {
      sampler->SetDeviceToCPU();
      sampler->Update();
    }
    CHECK(checks, opened.expired());
  }
}

// Threads that ask at the same time get one device.
void checkThreads(Checks& checks)
{
  if (!hasDevice(checks))
  {
    return;
  }
  std::vector<CachedDevice> kept(4);
  std::vector<std::thread> threads;
  threads.reserve(kept.size());
  for (CachedDevice& each : kept)
  {
    threads.emplace_back([&each]() { each.Begin("", 0); });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  for (const CachedDevice& each : kept)
  {
    CHECK(checks, each.Get() != nullptr && each.Get() == kept.front().Get());
  }
}

// A filter whose device fails in each run, and in what is given to the core.
class FailingFilter final : public vtkTransportAlgorithm
{
public:
  static FailingFilter* New();
  vtkTypeMacro(FailingFilter, vtkTransportAlgorithm);

  int Runs = 0; // on the device
  bool IsHandedOn = true;

protected:
  FailingFilter()
  {
    this->SetNumberOfInputPorts(0);
    this->SetNumberOfOutputPorts(1);
  }

  int FillOutputPortInformation(int, vtkInformation* info) override
  {
    info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
    return 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override
  {
    this->GetFlowOptions();
    DeviceUse device = this->BeginDevice();
    {
      AlgorithmProgress progress(this, this->Threading, this->GetRanks(), &device);
      this->IsHandedOn = this->IsHandedOn && progress.Device() == &device &&
        RectifiedTransport::Context(progress).Device == &device;
      for (int i = 0; i < 2; ++i) // the second time it does not serve any more
      {
        progress.Device()->Run([this]() {
          ++this->Runs;
          throw LostDevice("The device 'x' is lost");
        });
      }
    }
    this->EndDevice(device);
    return 1;
  }
};
vtkStandardNewMacro(FailingFilter);

void checkFailure(Checks& checks)
{
  vtkNew<FailingFilter> filter;
  Messages messages(filter);
  filter->Update();
  CHECK(checks, filter->Runs == 0 && filter->IsHandedOn);
  CHECK(checks, messages.Warnings.empty());
  if (!hasDevice(checks))
  {
    return;
  }
  filter->SetDeviceToOpenCL();
  for (int run = 1; run <= 3; ++run)
  {
    messages.Clear();
    filter->Modified();
    filter->Update();
    CHECK(checks, filter->Runs == run && filter->IsHandedOn);
    CHECK(checks, messages.Errors.empty() && messages.Warnings.size() == 1);
    CHECK(checks,
      !messages.Warnings.empty() &&
        contains(messages.Warnings[0], std::string("The device 'x' is lost") + instead));
  }
}

void checkNames(Checks& checks)
{
  vtkNew<vtkTransportSampler> sampler;
  vtkStringArray* names = sampler->GetDeviceNames();
  CHECK(checks, names->GetNumberOfValues() == 1 && names->GetValue(0).empty());
  sampler->SetDeviceToOpenCL();
  names = sampler->GetDeviceNames();
  CHECK(checks, names->GetNumberOfValues() > (hasDevice(checks) ? 1 : 0));
  std::set<std::string> different;
  for (vtkIdType i = 0; i < names->GetNumberOfValues(); ++i)
  {
    CHECK(checks, names->GetValue(i).empty() == (i == 0));
    different.insert(names->GetValue(i));
  }
  CHECK(checks, different.size() == static_cast<std::size_t>(names->GetNumberOfValues()));
  sampler->SetDeviceToCPU();
  CHECK(checks, sampler->GetDeviceNames()->GetNumberOfValues() == 1);
}

} // namespace

int TestDevice(int, char*[])
{
  return runChecks({ checkProperties, checkNoDevice, checkEmptyInput, checkDevice, checkSharing,
    checkKeeping, checkThreads, checkFailure, checkNames,
#ifdef HAS_MEMORY_LIMIT
    checkLittleMemory
#endif
  });
}
