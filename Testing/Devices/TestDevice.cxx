// SPDX-License-Identifier: BSD-3-Clause
// Devices: their list, their self-test, memory, programs, and what they say when something fails.
#include "OfADevice.h"

#include "Devices/DeviceCheck.h"

#include <gtest/gtest.h>

#include <numeric>
#include <string>
#include <thread>
#include <vector>

namespace RectifiedTransport
{
namespace
{

TEST(DeviceList, NamesWhatThereIs)
{
  for (const DeviceDescription& device : listDevices())
  {
    EXPECT_FALSE(device.Name.empty());
    EXPECT_TRUE(contains(device.Driver, "OpenCL ")) << device.Driver;
    EXPECT_GT(device.Memory, 0U);
  }
}

TEST_F(OfADevice, ByAPartOfItsName)
{
  const std::string name = this->Opened->Description().Name;
  EXPECT_EQ(openDevice(name.substr(1))->Name(), name);
  const std::string text = errorOf([]() { openDevice("no such thing"); });
  EXPECT_TRUE(contains(text, "No OpenCL device is named 'no such thing'; there are '")) << text;
  EXPECT_TRUE(contains(text, name)) << text;
}

// Numbers go on from the first after the last; what is open already is not opened again.
TEST_F(OfADevice, ByItsNumber)
{
  std::vector<std::string> complete;
  for (const DeviceDescription& device : listDevices())
  {
    if (device.Lacks.empty())
    {
      complete.push_back(device.Name);
    }
  }
  const int count = static_cast<int>(complete.size());
  for (int number = 0; number < 2 * count + 1; ++number)
  {
    EXPECT_EQ(openDevice("", number)->Name(), complete[static_cast<std::size_t>(number % count)]);
  }
  EXPECT_NE(openDevice(""), this->Opened);
  EXPECT_EQ(openDevice("", 0, { this->Opened }), this->Opened);
  EXPECT_EQ(openDevice("", count, { this->Opened }), this->Opened);
  EXPECT_EQ(openDevice(this->Opened->Description().Name, 0, { this->Opened }), this->Opened);
}

TEST_F(OfADevice, WithContractionIsRefused)
{
  const std::string text =
    errorOf([this]() { checkDevice(*this->Opened, "#define WITH_CONTRACTION 1\n"); });
  EXPECT_TRUE(contains(text, "rounds a * b + c once")) << text;
  EXPECT_EQ(errorOf([this]() { checkDevice(*this->Opened); }), "");
}

constexpr const char* doubling = R"(
__kernel void twice(__global int* numbers, long count, int add)
{
  const long i = get_global_id(0);
  if (i < count)
  {
    numbers[i] = 2 * numbers[i] + add;
  }
}
)";

std::vector<int> doubled(Device& device, int count, int add)
{
  const DeviceProgram program = device.Build({ doubling });
  DeviceKernel kernel = program.NewKernel("twice");
  std::vector<int> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  const DeviceBuffer buffer = device.Allocate(numbers.size() * sizeof(int), "numbers");
  device.Write(buffer, numbers.data(), buffer.Size());
  device.Run(kernel.With(buffer, static_cast<cl_long>(count), cl_int{ add }), numbers.size());
  device.Finish();
  device.Read(buffer, numbers.data(), buffer.Size());
  return numbers;
}

TEST_F(OfADevice, RunsKernels)
{
  const std::vector<int> numbers = doubled(*this->Opened, 1000, 3); // no whole number of groups
  for (int i = 0; i < 1000; ++i)
  {
    EXPECT_EQ(numbers[static_cast<std::size_t>(i)], 2 * i + 3);
  }
  EXPECT_TRUE(doubled(*this->Opened, 0, 3).empty());
}

TEST_F(OfADevice, TransfersParts)
{
  const std::vector<int> numbers{ 1, 2, 3, 4, 5 };
  DeviceBuffer buffer = this->Opened->Allocate(5 * sizeof(int), "numbers");
  this->Opened->Write(buffer, numbers.data(), 5 * sizeof(int));
  this->Opened->Write(buffer, numbers.data(), 2 * sizeof(int), 3 * sizeof(int));
  const DeviceBuffer moved = std::move(buffer);
  std::vector<int> found(4);
  this->Opened->Read(moved, found.data(), 4 * sizeof(int), sizeof(int));
  EXPECT_EQ(found, (std::vector<int>{ 2, 3, 1, 2 }));
}

TEST_F(OfADevice, MemoryIsCounted)
{
  const std::uint64_t before = this->Opened->MemoryLeft();
  {
    const DeviceBuffer buffer = this->Opened->Allocate(1 << 20, "something");
    EXPECT_EQ(this->Opened->MemoryLeft(), before - (1 << 20));
  }
  EXPECT_EQ(this->Opened->MemoryLeft(), before);
  const std::string text =
    errorOf([&]() { this->Opened->Allocate(static_cast<std::size_t>(before) + 1, "tables"); });
  EXPECT_TRUE(contains(text, "has too little memory for tables: ")) << text;
  EXPECT_EQ(this->Opened->MemoryLeft(), before);
}

TEST_F(OfADevice, WrongProgramsAreErrors)
{
  std::string text = errorOf([this]() { this->Opened->Build({ "__kernel void broken( {" }); });
  EXPECT_TRUE(contains(text, "does not compile a program: ")) << text;
  const DeviceProgram program = this->Opened->Build({ doubling });
  text = errorOf([&]() { program.NewKernel("thrice"); });
  EXPECT_TRUE(contains(text, "does not make the kernel thrice (OpenCL's error ")) << text;
  DeviceKernel kernel = program.NewKernel("twice");
  text = errorOf([&]() { kernel.With(cl_int{ 1 }, cl_int{ 2 }, cl_int{ 3 }, cl_int{ 4 }); });
  EXPECT_TRUE(contains(text, "takes no argument ")) << text;
}

TEST_F(OfADevice, SeveralAtOnce)
{
  std::vector<std::vector<int>> found(2);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    threads.emplace_back([&found, i]() {
      const auto own = std::static_pointer_cast<Device>(openDevice(""));
      for (int repeat = 0; repeat < 5; ++repeat)
      {
        found[i] = doubled(*own, 10000, static_cast<int>(i));
      }
    });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    ASSERT_EQ(found[i].size(), 10000U);
    for (int k = 0; k < 10000; ++k)
    {
      ASSERT_EQ(found[i][static_cast<std::size_t>(k)], 2 * k + static_cast<int>(i));
    }
  }
}

} // namespace
} // namespace RectifiedTransport
