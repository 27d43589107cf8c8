// SPDX-License-Identifier: BSD-3-Clause
#include "Devices/DeviceCheck.h"

#include "Devices/Device.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// The operations that flows use, by the fault that other bits of them mean. resultsOf computes the
// same on the processor, in the same order as the kernel below.
constexpr std::array<const char*, 6> ofDoubles = { "rounds a * b + c once instead of twice",
  "divides inexactly", "takes square roots inexactly", "converts doubles to integers otherwise",
  "converts doubles to floats otherwise", "rounds doubles down otherwise" };
constexpr std::array<const char*, 2> ofFloats = { "rounds a * b + c of floats once",
  "takes small floats for 0" };

constexpr const char* program = R"(
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#ifndef WITH_CONTRACTION
#pragma OPENCL FP_CONTRACT OFF
#endif

__kernel void ofDoubles(__global const double* numbers, __global double* results, long count)
{
  const long i = get_global_id(0);
  if (i < count)
  {
    const double a = numbers[3 * i];
    const double b = numbers[3 * i + 1];
    const double c = numbers[3 * i + 2];
    __global double* to = results + 6 * i;
    to[0] = a * b + c;
    to[1] = a / b;
    to[2] = sqrt(fabs(a));
    to[3] = (double)(long)(1000.0 * a);
    to[4] = (double)(float)a;
    to[5] = floor(a * 64.0);
  }
}

__kernel void ofFloats(__global const float* numbers, __global float* results, long count)
{
  const long i = get_global_id(0);
  if (i < count)
  {
    const float a = numbers[3 * i];
    const float b = numbers[3 * i + 1];
    const float c = numbers[3 * i + 2];
    results[2 * i] = a * b + c;
    results[2 * i + 1] = a * 1e-30f * b * 1e-10f;
  }
}
)";

// Triples of operands: any unit that rounds otherwise shows in some of them.
constexpr std::size_t count = 1024;

// Three operands a, b and c.
template <class T>
struct Numbers
{
  T Of[3];
};

// The operands of all comparisons, from -1 to 1, the same on every machine.
template <class T>
std::vector<Numbers<T>> someNumbers()
{
  std::mt19937_64 random(1);
  std::vector<Numbers<T>> numbers(count);
  const auto next = [&random]() {
    return static_cast<T>(random() >> 12) / static_cast<T>(1LL << 51) - static_cast<T>(1.0);
  };
  for (Numbers<T>& each : numbers)
  {
    each.Of[0] = next();
    each.Of[1] = next();
    // Half of the sums a b + c are 0 if the product is rounded, and its rounding error if the
    // device contracts them to a fused multiply-add.
    each.Of[2] = random() % 2 == 0 ? next() : -(each.Of[0] * each.Of[1]);
  }
  return numbers;
}

// The right results: the standard demands them of every IEEE 754 processor without contraction.
std::array<double, 6> resultsOf(const Numbers<double>& numbers)
{
  const auto [a, b, c] = numbers.Of;
  return { a * b + c, a / b, std::sqrt(std::abs(a)),
    static_cast<double>(static_cast<std::int64_t>(1000.0 * a)),
    static_cast<double>(static_cast<float>(a)), std::floor(a * 64.0) };
}

std::array<float, 2> resultsOf(const Numbers<float>& numbers)
{
  const auto [a, b, c] = numbers.Of;
  return { a * b + c, a * 1e-30F * b * 1e-10F };
}

// Runs a kernel on all operands and compares every bit; a fault names the first operation that
// differs.
template <class T, std::size_t N>
void compare(Device& device, const DeviceProgram& built, const std::string& kernel,
  const std::array<const char*, N>& faults)
{
  const std::vector<Numbers<T>> numbers = someNumbers<T>();
  std::vector<std::array<T, N>> found(count);
  const DeviceBuffer from = device.Allocate(count * sizeof(numbers[0]), "a test");
  const DeviceBuffer to = device.Allocate(count * sizeof(found[0]), "a test");
  device.Write(from, numbers.data(), from.Size());
  DeviceKernel run = built.NewKernel(kernel);
  device.Run(run.With(from, to, static_cast<cl_long>(count)), count);
  device.Read(to, found.data(), to.Size());
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::array<T, N> right = resultsOf(numbers[i]);
    for (std::size_t k = 0; k < N; ++k)
    {
      // Bits, not values: 0 and -0 differ, and NaN equals itself.
      if (std::memcmp(&right[k], &found[i][k], sizeof(T)) != 0)
      {
        throw DeviceError("The device '" + device.Description().Name + "' " + faults[k] +
          ", so that its results would differ from a processor's");
      }
    }
  }
}

} // namespace

// `before` stands in front of the program, so that a test can break the device's arithmetic.
void checkDevice(Device& device, const std::string& before)
{
  const DeviceProgram built = device.Build({ before, program });
  compare<double>(device, built, "ofDoubles", ofDoubles);
  compare<float>(device, built, "ofFloats", ofFloats);
}

} // namespace RectifiedTransport
