// SPDX-License-Identifier: BSD-3-Clause
#include "Devices/FlowPrograms.h"

#include "Core/Flow/AdvectionCounters.h"
#include "Core/Flow/AdvectionRun.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/SummedAreaTables.h"
#include "Devices/KernelRun.h"

#include <cstring>
#include <memory>
#include <random>

namespace RectifiedTransport
{

namespace
{

// One program for each dimension, under this name in the device.
std::string nameOfProgram(int dimension)
{
  return "flow in " + std::to_string(dimension) + "D";
}

// Random numbers from 0 to 1, the same on every machine: 52 bits are exact in a double.
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

// The fault: a device whose bits differ is not used at all.
[[noreturn]] void refuse(const Device& device, int dimension, const std::string& does)
{
  throw DeviceError("The device '" + device.Description().Name + "' " + does +
    " differently from a processor, in " + std::to_string(dimension) + " dimensions");
}

// The self-test of a flow program: tables and particles of a small density, whose bits must be
// those of the processor. The density has two levels of tables, sides that differ, and a void in
// one corner.
template <int Dimension>
class TestFlow
{
public:
  TestFlow()
    : Values(someNumbers(static_cast<std::int64_t>(numberOfCells<Dimension>(this->Size))))
    , Seeds(someNumbers(count * Dimension))
  {
    for (std::size_t cell = 0; cell < this->Values.size(); ++cell)
    {
      auto rest = static_cast<std::int64_t>(cell);
      bool isEmpty = true;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        // 20 of 64 cells along each axis are empty.
        isEmpty = isEmpty && rest % this->Size[axis] < 20;
        rest /= this->Size[axis];
      }
      this->Values[cell] = isEmpty ? 0.0 : this->Values[cell];
    }
    // Seeds in the box of the cells along axis 1, the shorter side.
    for (double& coordinate : this->Seeds)
    {
      coordinate *= static_cast<double>(this->Size[1]);
    }
  }

  void Compare(Device& device, const DeviceProgram& program)
  {
    // The processor's result, on this thread alone.
    const SerialExecutor serial;
    Progress progress(serial);
    const SummedAreaTables<Dimension> tables(
      DensityArray<Dimension, double>(this->Values.data(), this->Size), progress);
    // The last node's record is the end of all chains of sums: any other bit before it shows there.
    const auto made = std::make_shared<const DeviceTables<Dimension>>(
      device, program, tables.View(), upload(device, this->Values, "a test"));
    std::vector<double> last(4);
    const std::int64_t place = this->LastNode(tables.View());
    device.Read(made->Fine, last.data(), last.size() * sizeof(double),
      static_cast<std::size_t>(place) * sizeof(double));
    if (std::memcmp(
          last.data(), tables.View().Levels[0].Nodes + place, last.size() * sizeof(double)) != 0)
    {
      refuse(device, Dimension, "sums tables");
    }
    // The fewest steps that users get, all of them from the seeds.
    FlowOptions options;
    options.NumberOfSteps = FlowOptions::FewestSteps;
    options.Maps = FlowMaps::Off;
    for (const AdvectionKind kind : { AdvectionKind::Forward, AdvectionKind::Backward })
    {
      // What the processor computes is right by definition.
      std::vector<double> right(this->Seeds.size());
      ParticleSource<Dimension> source(
        ConstPointSpan<Dimension>(this->Seeds.data(), count), this->Size, count);
      // The same job for the processor and for the device.
      const AdvectionJob<Dimension> job(tables.View(), kind, options);
      AdvectionRun<Dimension>(job, progress)
        .Advect(source, PointSpan<Dimension>(right.data(), count));
      std::vector<double> found(this->Seeds.size());
      KernelRun<Dimension> run(
        device, program, job, made, nullptr, std::make_shared<DeviceWeights>());
      const KernelReport report =
        run.Run(count, run.FromPoints(this->Seeds.data()), found.data(), progress);
      Counters moved;
      // Particles that the device leaves unresolved go to the nearest mass, as in a run.
      for (const std::uint32_t particle : report.Unresolved)
      {
        moveToMass<Dimension>(tables.View(), found.data() + particle * Dimension, moved);
      }
      if (std::memcmp(found.data(), right.data(), right.size() * sizeof(double)) != 0)
      {
        refuse(device, Dimension, "moves particles");
      }
    }
  }

private:
  static constexpr std::int64_t count = 256;

  // 67 is no multiple of 4, the ratio of two levels: the last cell of the coarse level is narrower
  // along that axis.
  static GridSize<Dimension> SizeOf()
  {
    GridSize<Dimension> size;
    size.fill(64);
    size[0] = 67;
    return size;
  }

  std::int64_t LastNode(const TableView<Dimension>& tables) const
  {
    std::int64_t place = 0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      place += this->Size[axis] * tables.Levels[0].Stride[axis];
    }
    return place;
  }

  const GridSize<Dimension> Size = SizeOf();
  std::vector<double> Values;
  std::vector<double> Seeds;
};

// The size of a particle's state must be what the host allocates; then both sides are compared.
template <int Dimension>
void checkProgram(Device& device, const DeviceProgram& program)
{
  const DeviceBuffer size = device.Allocate(64 * sizeof(cl_ulong), "a test");
  DeviceKernel sizeOfState = program.NewKernel("sizeOfState");
  device.Run(sizeOfState.With(size), 64);
  cl_ulong found = 0;
  device.Read(size, &found, sizeof(found));
  if (found != stateSize<Dimension>)
  {
    refuse(device, Dimension, "lays out a particle");
  }
  TestFlow<Dimension>().Compare(device, program);
}

} // namespace

void checkFlowProgram(Device& device, const DeviceProgram& program, int dimension)
{
  if (dimension == 2)
  {
    checkProgram<2>(device, program);
    return;
  }
  checkProgram<3>(device, program);
}

// The program is compiled from the sources that the processor's kernels include, with the dimension
// as a macro.
DeviceProgram buildFlowProgram(Device& device, int dimension, const std::string& options)
{
  return device.Build(
    flowProgramTexts(), "-cl-std=CL1.2 -D RT_D=" + std::to_string(dimension) + " " + options);
}

// The program of this device, built and tested when it is first asked for.
const DeviceProgram& flowProgram(Device& device, int dimension)
{
  return device.Program(nameOfProgram(dimension), [&]() {
    DeviceProgram program = buildFlowProgram(device, dimension);
    checkFlowProgram(device, program, dimension);
    return program;
  });
}

// For tests and measurements: the same without the self-test.
const DeviceProgram& untestedFlowProgram(Device& device, int dimension)
{
  return device.Program(
    nameOfProgram(dimension), [&]() { return buildFlowProgram(device, dimension); });
}

} // namespace RectifiedTransport
