// SPDX-License-Identifier: BSD-3-Clause
// Flows on a device: the bits of the processor, whatever the density, the options and the
// particles.
#include "OfADevice.h"

#include "TestFlow.h"

#include "Core/Device/DeviceUse.h"
#include "Core/Parallel/Progress.h"
#include "Core/Tables/SummedAreaTables.h"
#include "Devices/DeviceTables.h"
#include "Devices/FlowPrograms.h"
#include "Devices/KernelRun.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <thread>
#include <utility>

namespace RectifiedTransport
{
namespace
{

class FlowOfADevice : public OfADevice
{
protected:
  // Both ways, with and without the device, which must have done the work.
  template <int Dimension>
  void ExpectSame(const TestDensity<Dimension>& density, const FlowOptions& options,
    const FlowSeeds<Dimension>& seeds, const std::string& what = "")
  {
    DeviceUse use(this->Opened);
    Context context;
    context.Device = &use;
    const RectifiedFlow<Dimension> flow = makeFlow<Dimension>(density);
    // With tables that the device has made.
    const RectifiedFlow<Dimension> other(density.Source(), context);
    for (const bool back : { false, true })
    {
      const std::string how = what + (back ? ", backward" : ", forward");
      const auto run = [&](const RectifiedFlow<Dimension>& by, const Context& on) {
        Points<Dimension> positions(static_cast<std::size_t>(seeds.Count()));
        const FlowReport report = back ? by.Backward(seeds, positions, options, on)
                                       : by.Forward(seeds, positions, options, on);
        return std::make_pair(positions, report);
      };
      const auto [right, rightReport] = run(flow, Context());
      const std::uint64_t before = this->Opened->Work().Kernels;
      for (const char* which :
        { " with copied tables", " with kept tables", " with its own tables" })
      {
        const bool isOwn = std::strstr(which, "own") != nullptr;
        const auto [found, report] = run(isOwn ? other : flow, context);
        EXPECT_EQ(use.Fault(), "");
        EXPECT_TRUE(sameBits<Dimension>(found, right)) << how << which;
        EXPECT_EQ(report.Redone, rightReport.Redone) << how << which;
        EXPECT_EQ(report.MovedToMass, rightReport.MovedToMass) << how << which;
        EXPECT_GT(report.Evaluations, 0) << how;
      }
      EXPECT_GE(this->Opened->Work().Kernels, before + 2) << how;
    }
  }

  template <int Dimension>
  void ExpectSame(const TestDensity<Dimension>& density, const FlowOptions& options = steps(32))
  {
    const Points<Dimension> seeds = randomPoints<Dimension>(density.Size, 1500);
    for (const FlowMaps maps : { FlowMaps::Off, FlowMaps::On })
    {
      this->ExpectSame<Dimension>(
        density, with(maps, options), seeds, maps == FlowMaps::On ? "with maps" : "without maps");
    }
  }
};

TEST_F(FlowOfADevice, OfManyValues)
{
  this->ExpectSame<2>(randomCells<2>({ 385, 450 }));
  this->ExpectSame<2>(randomCells<2>({ 385, 450 }), steps(64));
  this->ExpectSame<2>(randomCells<2>({ 9, 300 }), steps(128));
  this->ExpectSame<2>(randomCells<2>({ 2, 70000 })); // a long axis: its tables are copied
  this->ExpectSame<3>(twoGaussians<3>({ 96, 115, 100 }));
  this->ExpectSame<3>(randomCells<3>({ 20, 31, 66 }), steps(48));
}

// Particles that meet empty boxes are redone with up to 32 times the steps, and those that end in
// empty cells even then are moved.
TEST_F(FlowOfADevice, OfEmptyCells)
{
  this->ExpectSame<2>(discWithHole<2>({ 448, 448 }));
  this->ExpectSame<2>(dirac<2>({ 64, 64 }, { 20, 41 }));
  this->ExpectSame<2>(checker<2>({ 128, 96 }, 4));
  this->ExpectSame<3>(discWithHole<3>({ 96, 96, 96 }));
  this->ExpectSame<3>(dirac<3>({ 32, 32, 32 }, { 20, 4, 30 }));
}

// So many that kernels take them in pieces.
TEST_F(FlowOfADevice, InManySteps)
{
  const TestDensity<2> density = discWithHole<2>({ 64, 64 });
  const Points<2> seeds = randomPoints<2>(density.Size, 100);
  this->ExpectSame<2>(density, with(FlowMaps::Off, steps(1025)), seeds);
  this->ExpectSame<2>(density, with(FlowMaps::Off, steps(100)), seeds); // 3,200 in the last pass
}

TEST_F(FlowOfADevice, OfALattice)
{
  const TestDensity<2> density = randomCells<2>({ 300, 200 });
  this->ExpectSame<2>(density, {}, FlowSeeds<2>::Lattice({ 60, 50 }));
  this->ExpectSame<2>(density, {}, FlowSeeds<2>::Lattice({ 61, 33 }, { 0.0, 1.0 }));
  const TestDensity<3> volume = discWithHole<3>({ 64, 64, 64 });
  this->ExpectSame<3>(volume, {}, FlowSeeds<3>::Lattice({ 12, 11, 14 }));
}

// In parts, between whose kernels and transfers nothing is mixed up.
template <int Dimension>
void expectSameInParts(Device& device, const TestDensity<Dimension>& density)
{
  Progress progress{ Context() };
  const SummedAreaTables<Dimension> tables(density.Source(), progress);
  const auto copied = std::make_shared<const DeviceTables<Dimension>>(device, tables.View());
  const Points<Dimension> seeds = randomPoints<Dimension>(density.Size, 1000);
  for (const AdvectionKind kind : { AdvectionKind::Forward, AdvectionKind::Backward })
  {
    const AdvectionJob<Dimension> job(tables.View(), kind, steps(32));
    Points<Dimension> found[2] = { seeds, seeds };
    KernelReport reports[2];
    for (const int i : { 0, 1 })
    {
      KernelRun<Dimension> run(device, flowProgram(device, Dimension), job, copied, nullptr,
        std::make_shared<DeviceWeights>(), i == 0 ? 1000 : 130);
      reports[i] =
        run.Run(1000, run.FromPoints(seeds.data()->data()), found[i].data()->data(), progress);
    }
    EXPECT_TRUE(sameBits<Dimension>(found[0], found[1]));
    EXPECT_EQ(reports[0].Unresolved, reports[1].Unresolved);
    EXPECT_EQ(reports[0].Evaluations, reports[1].Evaluations);
    EXPECT_EQ(reports[0].Redone, reports[1].Redone);
  }
}

TEST_F(FlowOfADevice, InParts)
{
  expectSameInParts<2>(*this->Opened, dirac<2>({ 64, 64 }, { 20, 41 }));
  expectSameInParts<3>(*this->Opened, discWithHole<3>({ 32, 40, 32 }));
}

TEST_F(FlowOfADevice, OfNoParticles)
{
  DeviceUse use(this->Opened);
  Context context;
  context.Device = &use;
  const RectifiedFlow<2> flow = makeFlow<2>(randomCells<2>({ 30, 20 }));
  EXPECT_TRUE(runForward<2>(flow, {}, {}, context).empty());
  EXPECT_EQ(use.Fault(), "");
}

// After any number of polls; the device serves again after it.
TEST_F(FlowOfADevice, CanBeCancelled)
{
  const TestDensity<2> density = discWithHole<2>({ 256, 256 });
  const RectifiedFlow<2> flow = makeFlow<2>(density);
  const Points<2> seeds = randomPoints<2>(density.Size, 10000);
  const Points<2> right = runForward<2>(flow, seeds);
  int cancelled = 0;
  for (int most = 0; most < 6; ++most)
  {
    DeviceUse use(this->Opened);
    const SerialExecutor serial;
    int polls = 0;
    Context context(serial, {}, [&]() { return ++polls > most; });
    context.Device = &use;
    Points<2> positions(seeds.size());
    try
    {
      flow.Forward(seeds, positions, {}, context);
    }
    catch (const Cancelled&)
    {
      ++cancelled;
    }
    EXPECT_EQ(use.Fault(), "");
    context.IsCancelled = {};
    EXPECT_TRUE(sameBits<2>(runForward<2>(flow, seeds, {}, context), right));
  }
  EXPECT_GT(cancelled, 2);
}

// Also while another thread has the device, which is not to blame.
TEST_F(FlowOfADevice, CanBeCancelledWhileItWaits)
{
  const TestDensity<2> density = randomCells<2>({ 300, 260 });
  const RectifiedFlow<2> flow = makeFlow<2>(density);
  const Points<2> seeds = randomPoints<2>(density.Size, 1000);
  for (const FlowMaps maps : { FlowMaps::Off, FlowMaps::On })
  {
    DeviceUse use(this->Opened);
    bool isCancelled = false;
    std::unique_lock<std::timed_mutex> lock(this->Opened->Mutex());
    std::thread other([&]() {
      const SerialExecutor serial;
      Context context(serial, {}, []() { return true; });
      context.Device = &use;
      Points<2> positions(seeds.size());
      try
      {
        flow.Forward(seeds, positions, with(maps, steps(32)), context);
      }
      catch (const Cancelled&)
      {
        isCancelled = true;
      }
    });
    other.join();
    EXPECT_TRUE(isCancelled);
    EXPECT_EQ(use.Fault(), "");
    EXPECT_FALSE(this->Opened->IsLost());
  }
}

// What devices do not do, the processor does.
TEST_F(FlowOfADevice, OtherMethodsAreTheProcessors)
{
  const TestDensity<2> density = randomCells<2>({ 64, 48 });
  const RectifiedFlow<2> flow = makeFlow<2>(density);
  const Points<2> seeds = randomPoints<2>(density.Size, 500);
  DeviceUse use(this->Opened);
  Context context;
  context.Device = &use;
  const std::uint64_t before = this->Opened->Work().Kernels;
  for (const Integrator method :
    { Integrator::RungeKutta4, Integrator::Euler, Integrator::Adaptive })
  {
    EXPECT_TRUE(sameBits<2>(runForward<2>(flow, seeds, steps(32, method), context),
      runForward<2>(flow, seeds, steps(32, method))));
  }
  EXPECT_EQ(this->Opened->Work().Kernels, before);
  EXPECT_EQ(use.Fault(), "");
}

TEST_F(FlowOfADevice, InTheMemoryOfTheSeeds)
{
  const TestDensity<2> density = randomCells<2>({ 64, 48 });
  const RectifiedFlow<2> flow = makeFlow<2>(density);
  const Points<2> seeds = randomPoints<2>(density.Size, 5000);
  DeviceUse use(this->Opened);
  Context context;
  context.Device = &use;
  Points<2> points = seeds;
  flow.Forward(points, points, {}, context);
  EXPECT_TRUE(sameBits<2>(points, runForward<2>(flow, seeds)));
}

// Memory that is too small for the tables, or for the particles after them: the processor does it.
TEST_F(FlowOfADevice, WithTooLittleMemory)
{
  const TestDensity<2> density = randomCells<2>({ 256, 256 });
  const RectifiedFlow<2> flow = makeFlow<2>(density);
  const Points<2> seeds = randomPoints<2>(density.Size, 20000);
  const Points<2> right = runForward<2>(flow, seeds);
  const Points<2> places = latticePoints<2>(density.Size, { 150, 130 });
  const Points<2> rightPlaces = runForward<2>(flow, places);
  for (const std::uint64_t bytes : { std::uint64_t{ 1 } << 20, std::uint64_t{ 5 } << 19 })
  {
    std::vector<DeviceBuffer> others; // they leave that much
    while (this->Opened->MemoryLeft() > bytes)
    {
      others.push_back(this->Opened->Allocate(
        std::min(this->Opened->MemoryLeft() - bytes, this->Opened->LargestAllocation()), "a test"));
    }
    DeviceUse use(this->Opened);
    Context context;
    context.Device = &use;
    EXPECT_TRUE(sameBits<2>(runForward<2>(flow, seeds, {}, context), right));
    EXPECT_NE(use.Fault().find("has too little memory for"), std::string::npos) << use.Fault();
    // The device takes a lattice in another order.
    DeviceUse another(this->Opened);
    context.Device = &another;
    Points<2> positions(places.size());
    flow.Forward(FlowSeeds<2>::Lattice({ 150, 130 }), positions, {}, context);
    EXPECT_TRUE(sameBits<2>(positions, rightPlaces));
    EXPECT_NE(another.Fault(), "");
  }
}

TEST_F(FlowOfADevice, OnTwoThreads)
{
  const TestDensity<2> density = discWithHole<2>({ 256, 256 });
  const RectifiedFlow<2> flow = makeFlow<2>(density);
  const Points<2> seeds = randomPoints<2>(density.Size, 5000);
  const Points<2> right = runForward<2>(flow, seeds);
  bool same[2] = {};
  const auto run = [&](bool& isSame) {
    DeviceUse use(this->Opened);
    const SerialExecutor serial;
    Context context(serial);
    context.Device = &use;
    isSame = sameBits<2>(runForward<2>(flow, seeds, {}, context), right) && use.Fault().empty();
  };
  std::thread other(run, std::ref(same[0]));
  run(same[1]);
  other.join();
  EXPECT_TRUE(same[0]);
  EXPECT_TRUE(same[1]);
}

// Tables that the device makes, node by node.
template <int Dimension>
void expectSameTables(Device& device, const TestDensity<Dimension>& density)
{
  Progress progress{ Context() };
  const SummedAreaTables<Dimension> tables(density.Source(), progress);
  const TableView<Dimension>& view = tables.View();
  const DeviceTables<Dimension> made(device, flowProgram(device, Dimension), view,
    upload(
      device, density.Values.data(), static_cast<std::int64_t>(density.Values.size()), "a test"));
  const double* coarse = view.LevelCount > 1 ? view.Levels[1].Nodes : endOfNodes<Dimension>(view);
  std::vector<double> fine(static_cast<std::size_t>(coarse - view.Levels[0].Nodes));
  std::vector<double> others(static_cast<std::size_t>(endOfNodes<Dimension>(view) - coarse));
  device.Read(made.Fine, fine.data(), fine.size() * sizeof(double));
  device.Read(made.Coarse, others.data(), others.size() * sizeof(double));
  for (int level = 0; level < view.LevelCount; ++level)
  {
    const double* found =
      level == 0 ? fine.data() : others.data() + (view.Levels[level].Nodes - coarse);
    GridSize<Dimension> nodes;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      nodes[axis] = ((density.Size[axis] - 1) >> (level * levelShift)) + 2;
    }
    std::int64_t differing = 0;
    const auto count = static_cast<std::int64_t>(cellCount<Dimension>(nodes));
    for (std::int64_t i = 0; i < count; ++i)
    {
      const GridSize<Dimension> node = cellAt<Dimension>(i, nodes);
      std::int64_t at = 0;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        at += node[axis] * view.Levels[level].Stride[axis];
      }
      differing +=
        std::memcmp(found + at, view.Levels[level].Nodes + at, 4 * sizeof(double)) == 0 ? 0 : 1;
    }
    EXPECT_EQ(differing, 0) << "level " << level;
  }
}

TEST_F(FlowOfADevice, MakesTables)
{
  expectSameTables<2>(*this->Opened, randomCells<2>({ 601, 270 }));
  expectSameTables<2>(*this->Opened, randomCells<2>({ 7, 5 }));
  expectSameTables<2>(*this->Opened, randomCells<2>({ 256, 1024 }));
  expectSameTables<3>(*this->Opened, randomCells<3>({ 70, 131, 66 }));
  expectSameTables<3>(*this->Opened, discWithHole<3>({ 64, 64, 64 }));
  expectSameTables<3>(*this->Opened, randomCells<3>({ 3, 33, 2 }));
}

// Programs that are wrong are found by their particles, or do not compile.
TEST_F(FlowOfADevice, WrongProgramsAreRefused)
{
  const auto errorOfProgram = [this](const std::string& from, const std::string& to) {
    std::vector<std::string> texts = flowProgramTexts();
    bool found = false;
    for (std::string& text : texts)
    {
      const std::size_t place = text.find(from);
      if (place != std::string::npos && !found)
      {
        text.replace(place, from.size(), to);
        found = true;
      }
    }
    EXPECT_TRUE(found) << from;
    return errorOf([&]() {
      for (const int dimension : { 2, 3 })
      {
        const DeviceProgram program =
          this->Opened->Build(texts, "-cl-std=CL1.2 -D RT_D=" + std::to_string(dimension));
        checkFlowProgram(*this->Opened, program, dimension);
      }
    });
  };
  const std::string otherBits = "moves particles differently from a processor";
  EXPECT_EQ(errorOfProgram("a < b ? a : b", "a < b ? a : b"), "");
  EXPECT_TRUE(contains(errorOfProgram("FP_CONTRACT OFF", "FP_CONTRACT ON"), otherBits));
  EXPECT_TRUE(contains(
    errorOfProgram("RT_ENTRY(linear, 1) + RT_ENTRY(linear, 3)", "RT_ENTRY(linear, 3)"), otherBits));
  EXPECT_TRUE(
    contains(errorOfProgram("a0 * first + a1 * second", "a1 * second + a2 * third"), otherBits));
  EXPECT_TRUE(
    contains(errorOfProgram("get_global_id(0)", "get_global_id(0) no"), "does not compile"));
}

} // namespace
} // namespace RectifiedTransport
