// SPDX-License-Identifier: BSD-3-Clause
// Properties and inputs that several kinds of filters share.
#ifndef Campaign_DrawnInputs_h
#define Campaign_DrawnInputs_h

#include "FilterKind.h"

#include "vtkTransportAlgorithm.h"

#include <limits>
#include <string>

namespace Campaign
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();

template <class T>
void drawThreading(Settings& settings)
{
  settings.Draw<T, int>("Threading", &T::SetThreading, { 0, 1, 2, 3 }, { -1, 4 });
}

template <class T>
void drawFlowSettings(Settings& settings)
{
  settings.Draw<T, int>("Integrator", &T::SetIntegrator, { 0, 1, 2, 3 }, { -1, 4 });
  settings.Draw<T, int>("NumberOfSteps", &T::SetNumberOfSteps,
    { 0, 1, 2, 3, 8, 16, 31, 33, 127, 128, 200 },
    { -1, -5, 10001, std::numeric_limits<int>::max() });
  // Only the default limits the steps; with .005 they took minutes on a processor as a device.
  settings.Draw<T, double>("AreaTolerance", &T::SetAreaTolerance, { 0.1, 1.0, 0.05 },
    { 0.0, -1.0, 1.5, NaN, Infinity }, 0.2);
  settings.Draw<T, double>("Tolerance", &T::SetTolerance, { 0.1, 1.0, 1e-4, 1e300, 1e-305 },
    { 0.0, -1.0, NaN, Infinity }, 0.3);
  settings.Draw<T, int>("FlowMaps", &T::SetFlowMaps, { 0, 1, 2 }, { -1, 3 }, 0.5);
  settings.Draw<T, int>("TableLookup", &T::SetTableLookup, { 0, 1 }, { -1, 2 }, 0.3);
  drawThreading<T>(settings);
}

template <class T>
void drawTables(Settings& settings)
{
  settings.Draw<T, int>("Tables", &T::SetTables, { 0, 1, 2 }, { -1, 3 }, 0.5);
}

// Whether runs take the processor where a device is drawn, as the reference that others have.
bool isOnProcessor();

// The flow is computed on a device, and as reference on the processor: it must not matter. By
// choices that leave those of other settings as they are; some machines have a device of each name
// but the last.
template <class T>
void drawDevice(Settings& settings)
{
  RandomSource before = settings.GetRandom();
  RandomSource random(before.Next());
  const bool inRange = !random.Chance(0.015);
  const int device = inRange ? random.Of({ 0, 1, 1, 1, 1, 1, 1, 1 }) : random.Of({ -1, 2 });
  const std::string name = random.Of({ "", "", "", "", "", "", "", "", "", "", "pthread", "none" });
  settings.Add(
    "Device", std::to_string(device),
    [device](vtkAlgorithm* filter) {
      const bool replaces = device == T::DEVICE_OPENCL && isOnProcessor();
      static_cast<T*>(filter)->SetDevice(replaces ? T::DEVICE_CPU : device);
    },
    inRange);
  settings.Add("DeviceName", name,
    [name](vtkAlgorithm* filter) { static_cast<T*>(filter)->SetDeviceName(name.c_str()); });
}

// By choices that leave those of other settings as they are.
template <class T>
void drawMethod(Settings& settings)
{
  RandomSource before = settings.GetRandom();
  RandomSource random(before.Next() + 1);
  const int method = random.Chance(0.003) ? random.Of({ -1, 2 }) : random.Chance(0.1) ? 1 : 0;
  settings.Add(
    "Method", std::to_string(method),
    [method](vtkAlgorithm* filter) { static_cast<T*>(filter)->SetMethod(method); },
    method == T::RECTIFIED_FLOW || method == T::OPTIMAL);
  const bool certifies = random.Chance(0.05);
  settings.Add("Certify", certifies ? "1" : "0",
    [certifies](vtkAlgorithm* filter) { static_cast<T*>(filter)->SetCertify(certifies); });
  const bool inRange = !random.Chance(0.003);
  const double tolerance =
    inRange ? random.Of({ 0.001, 0.001, 0.5, 1e-5 }) : random.Of({ 0.0, 1.0, -1.0, NaN });
  settings.Add(
    "OptimalityTolerance", std::to_string(tolerance),
    [tolerance](
      vtkAlgorithm* filter) { static_cast<T*>(filter)->SetOptimalityTolerance(tolerance); },
    inRange);
}

void drawDensitySettings(Settings& settings);
void drawValidRange(Settings& settings, bool mayBeOut);

// What empty cells count as.
template <class T>
void drawEmptySettings(Settings& settings)
{
  settings.Draw<T, int>("EmptyCells", &T::SetEmptyCells, { 0, 1, 2, 3 }, { -1, 4 }, 0.4);
  settings.Draw<T, double>(
    "EmptyValue", &T::SetEmptyValue, { 0.0, 0.5, 3.0 }, { -1.0, NaN, Infinity }, 0.3);
}

// Large cases have enough cells for the work to be cut in parts.
inline ImageRules rulesOf(const Settings& settings)
{
  ImageRules rules;
  rules.LargestAxis = settings.IsLarge() ? 140 : 40;
  return rules;
}

// An image as the density of input array `index` on a port, chosen somehow.
Input drawDensityOn(RandomSource& random, Settings& settings, int port, int index = 0);

// How the density is chosen that another input has, too.
void drawChoice(RandomSource& random, Settings& settings, int port, int index, Input& input);

// An image of the geometry of another, of other values, or another image.
Input drawPartner(RandomSource& random, const Input& first, const Settings& settings);

} // namespace Campaign

#endif
