// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/Devices/FlowPrograms.h"

#include "Core/Flow/AdvectionCounters.h"
#include "Core/Flow/AdvectionRun.h"
#include "Core/Flow/Devices/KernelRun.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/SummedAreaTables.h"

#include <cstring>
#include <memory>
#include <random>

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

[[noreturn]] void refuse(const Device& device, int dimension, const std::string& does)
{
  throw DeviceError("The device '" + device.Description().Name + "' " + does +
    " differently from a processor, in " + std::to_string(dimension) + " dimensions");
}

// Two levels of tables; in one corner there is no mass.
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
        isEmpty = isEmpty && rest % this->Size[axis] < 20;
        rest /= this->Size[axis];
      }
      this->Values[cell] = isEmpty ? 0.0 : this->Values[cell];
    }
    for (double& coordinate : this->Seeds)
    {
      coordinate *= static_cast<double>(this->Size[1]);
    }
  }

  void Compare(Device& device, const DeviceProgram& program)
  {
    const SerialExecutor serial;
    Progress progress(serial);
    const SummedAreaTables<Dimension> tables(
      DensityArray<Dimension, double>(this->Values.data(), this->Size), progress);
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
    FlowOptions options;
    options.NumberOfSteps = FlowOptions::FewestSteps;
    options.Maps = FlowMaps::Off;
    for (const AdvectionKind kind : { AdvectionKind::Forward, AdvectionKind::Backward })
    {
      std::vector<double> right(this->Seeds.size());
      ParticleSource<Dimension> source(
        ConstPointSpan<Dimension>(this->Seeds.data(), count), this->Size, count);
      const AdvectionJob<Dimension> job(tables.View(), kind, options);
      AdvectionRun<Dimension>(job, progress)
        .Advect(source, PointSpan<Dimension>(right.data(), count));
      std::vector<double> found(this->Seeds.size());
      KernelRun<Dimension> run(
        device, program, job, made, nullptr, std::make_shared<DeviceWeights>());
      const KernelReport report =
        run.Run(count, run.FromPoints(this->Seeds.data()), found.data(), progress);
      Counters moved;
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
