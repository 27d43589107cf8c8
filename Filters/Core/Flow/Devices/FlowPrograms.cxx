// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/Devices/FlowPrograms.h"

#include "Core/Flow/AdvectionRun.h"
#include "Core/Flow/Devices/KernelRun.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/SummedAreaTables.h"

#include <cstring>
#include <memory>
#include <random>
#include <utility>

namespace RectifiedTransport
{

namespace
{

std::string nameOfProgram(int dimension)
{
  return "flow in " + std::to_string(dimension) + "D";
}

// Random numbers from 0 to 1, the same everywhere.
std::vector<double> someNumbers(std::int64_t count)
{
  std::mt19937_64 random(1);
  std::vector<double> numbers;
  for (std::int64_t i = 0; i < count; ++i)
  {
    numbers.push_back(static_cast<double>(random() >> 12) / static_cast<double>(1LL << 52));
  }
  return numbers;
}

template <int Dimension>
void compareParticles(Device& device, const DeviceProgram& program)
{
  constexpr std::int64_t count = 256;
  GridSize<Dimension> size;
  size.fill(64); // two levels of tables
  size[0] = 67;
  const auto cells = static_cast<std::int64_t>(numberOfCells<Dimension>(size));
  const std::vector<double> values = someNumbers(cells);
  const SerialExecutor serial;
  const Context context(serial);
  Progress progress(context);
  const SummedAreaTables<Dimension> tables(
    DensityArray<Dimension, double>(values.data(), size), progress);
  const auto onDevice = std::make_shared<const DeviceTables<Dimension>>(device, tables.View());
  FlowOptions options;
  options.NumberOfSteps = FlowOptions::FewestSteps;
  options.Maps = FlowMaps::Off;
  std::vector<double> seeds = someNumbers(count * Dimension);
  for (double& coordinate : seeds)
  {
    coordinate *= static_cast<double>(size[1]);
  }
  for (const AdvectionKind kind : { AdvectionKind::Forward, AdvectionKind::Backward })
  {
    std::vector<double> right(seeds.size());
    ParticleSource<Dimension> source(ConstPointSpan<Dimension>(seeds.data(), count), size, count);
    AdvectionRun<Dimension>(tables.View(), kind, options, context)
      .Advect(source, PointSpan<Dimension>(right.data(), count));
    std::vector<double> found(seeds.size());
    const AdvectionJob<Dimension> job(tables.View(), kind, options);
    KernelRun<Dimension> run(device, program, job, onDevice, nullptr);
    run.Run(device, count, run.FromPoints(device, seeds.data()), found.data(), progress);
    if (std::memcmp(found.data(), right.data(), right.size() * sizeof(double)) != 0)
    {
      throw DeviceError("The device '" + device.Description().Name +
        "' moves particles otherwise than a processor does, in " + std::to_string(Dimension) +
        " dimensions");
    }
  }
}

} // namespace

void checkFlowProgram(Device& device, const DeviceProgram& program, int dimension)
{
  if (dimension == 2)
  {
    compareParticles<2>(device, program);
    return;
  }
  compareParticles<3>(device, program);
}

DeviceProgram buildFlowProgram(Device& device, int dimension, const std::string& options)
{
  return device.Build(
    flowProgramTexts(), "-cl-std=CL1.2 -D RT_D=" + std::to_string(dimension) + " " + options);
}

const DeviceProgram& flowProgram(Device& device, int dimension)
{
  return device.Program(nameOfProgram(dimension), [&]() {
    DeviceProgram program = buildFlowProgram(device, dimension);
    checkFlowProgram(device, program, dimension);
    return program;
  });
}

const DeviceProgram& untestedFlowProgram(Device& device, int dimension)
{
  return device.Program(
    nameOfProgram(dimension), [&]() { return buildFlowProgram(device, dimension); });
}

} // namespace RectifiedTransport
