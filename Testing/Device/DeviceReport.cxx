// SPDX-License-Identifier: BSD-3-Clause
// Whether an OpenCL device computes the processor's bits, and how fast: a report to send.
#include "Bits.h"
#include "BitsTable.h"
#include "Machine.h"
#include "Times.h"

#include "Core/Flow/RectifiedFlow.h"
#include "Devices/Device.h"
#include "Devices/FlowPrograms.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <string>

namespace
{

using namespace RectifiedTransport;

constexpr const char* usage =
  "usage: RectifiedTransportDeviceReport [--device NAME] [--bits | --times [--csv]] [--quick]\n"
  "                                      [--large]\n"
  "  Prints whether an OpenCL device computes the processor's bits, and times of both.\n"
  "  --device NAME  the first device whose name contains it; else the first that can be used\n"
  "  --bits         the comparison of bits alone\n"
  "  --times        the times alone\n"
  "  --csv          only the name of the device and the times, separated by commas\n"
  "  --quick        small cases, each once\n"
  "  --large        times of 256^3, too: 1.1 GB on the device, 2 GB here (without it on GPUs that\n"
  "                 have the memory)\n"
  "  Ends with 0; 1: bits differ, or the device fails; 2: wrong arguments; 77: no device.\n";

struct Choice
{
  std::string Device;
  bool HasBits = true;
  bool HasTimes = true;
  TimesChoice Times;
};

std::optional<Choice> read(int count, char** arguments)
{
  Choice choice;
  for (int i = 1; i < count; ++i)
  {
    const std::string argument = arguments[i];
    if (argument == "--device" && i + 1 < count)
    {
      choice.Device = arguments[++i];
    }
    else if (argument == "--bits")
    {
      choice.HasTimes = false;
    }
    else if (argument == "--times")
    {
      choice.HasBits = false;
    }
    else if (argument == "--csv")
    {
      choice.Times.Form = TimesForm::CommaSeparated;
    }
    else if (argument == "--quick")
    {
      choice.Times.IsQuick = true;
    }
    else if (argument == "--large")
    {
      choice.Times.HasLarge = true;
    }
    else
    {
      return std::nullopt;
    }
  }
  const bool isRight = (choice.HasBits || choice.HasTimes) &&
    !(choice.HasBits && choice.Times.Form == TimesForm::CommaSeparated);
  return isRight ? std::optional<Choice>(choice) : std::nullopt;
}

// Tables, maps and positions of 256^3, and as much again for what else is on the device.
bool hasMemoryForLarge(const Device& device)
{
  const double bytes = RectifiedFlow<3>::MemoryFor({ 256, 256, 256 });
  return 4.0 * bytes < static_cast<double>(device.MemoryLeft()) &&
    bytes < static_cast<double>(device.LargestAllocation());
}

// Compiles and tests them, so that neither is timed later. One that fails its test is used
// nevertheless: where its bits differ is what the report is for. Returns whether none does.
bool makePrograms(Device& device, bool isText)
{
  if (isText)
  {
    std::printf(
      "\nPROGRAMS, made once a process and tested (drivers may keep what they compile)\n");
  }
  bool isRight = true;
  for (const int dimension : { 2, 3 })
  {
    const auto start = std::chrono::steady_clock::now();
    std::string fault;
    try
    {
      flowProgram(device, dimension);
    }
    catch (const DeviceError& error)
    {
      fault = std::string(", FAILED: ") + error.what();
      isRight = false;
      untestedFlowProgram(device, dimension);
    }
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    if (isText)
    {
      std::printf("  %dD: %.0f ms%s\n", dimension, time.count(), fault.c_str());
    }
  }
  return isRight;
}

int report(Choice choice)
{
  const bool isText = choice.Times.Form == TimesForm::Text;
  if (isText)
  {
    printMachine();
    printDevices();
  }
  std::shared_ptr<Device> device;
  try
  {
    device = std::static_pointer_cast<Device>(openDevice(choice.Device));
  }
  catch (const DeviceError& error)
  {
    // Where a device has to be, its lack is no reason to skip.
    const bool isFault = std::getenv("RT_OPENCL") != nullptr || !choice.Device.empty();
    std::printf("\n%s: %s\n", isFault ? "FAILED" : "SKIPPED", error.what());
    return isFault ? EXIT_FAILURE : 77;
  }
  std::printf(isText ? "\nTAKEN\n  '%s'\n" : "%s\n", device->Description().Name.c_str());
  const bool isTested = makePrograms(*device, isText);
  BitsTable table;
  if (choice.HasBits)
  {
    BitsTable::PrintHead("CONTROLS: that a difference is found");
    compareWrong(device);
    BitsTable::PrintHead("BITS");
    compareCompaction(device, choice.Times.IsQuick, table);
    compareTables(device, choice.Times.IsQuick, table);
    compareNodes(device, choice.Times.IsQuick, table);
    compareParticles(device, choice.Times.IsQuick, table);
  }
  if (choice.HasTimes)
  {
    choice.Times.HasLarge = choice.Times.HasLarge ||
      (!choice.Times.IsQuick && isGpu(*device) && hasMemoryForLarge(*device));
    measureTimes(device, choice.Times, table);
  }
  const bool isRight = isTested && table.IsRight();
  if (isText)
  {
    std::printf("\n%s\n",
      !isRight           ? "BITS DIFFER, or the device failed: see above"
        : choice.HasBits ? ("All " + grouped(table.Compared()) + " have the same bits").c_str()
                         : "All positions have the same bits");
  }
  return isRight ? EXIT_SUCCESS : EXIT_FAILURE;
}

} // namespace

int main(int count, char** arguments)
{
  const std::optional<Choice> choice = read(count, arguments);
  if (!choice)
  {
    std::fputs(usage, stderr);
    return 2;
  }
  try
  {
    return report(*choice);
  }
  catch (const std::exception& error)
  {
    std::printf("\nFAILED: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
