// SPDX-License-Identifier: BSD-3-Clause
// A flow runs on any device that it is given, whatever library made it.
#include "TestFlow.h"

#include "Core/Device/DeviceError.h"
#include "Core/Device/DeviceUse.h"
#include "Core/Device/FlowDevice.h"
#include "Core/Flow/Devices/DeviceFlow.h"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <optional>
#include <string>

namespace RectifiedTransport
{
namespace
{

// A device that places all particles at a corner of the box, or is lost at once.
class CornerDevice final : public FlowDevice
{
public:
  class CornerFlow final : public DeviceFlow<2>
  {
  public:
    explicit CornerFlow(CornerDevice& device)
      : Owner(device)
    {
    }

    bool Serves(AdvectionKind kind, const FlowOptions& /*options*/) const override
    {
      return kind == AdvectionKind::Forward;
    }
    void MakeTables(DeviceUse& /*use*/, const DensitySource<2>& /*density*/,
      const SummedAreaTables<2>& /*tables*/, Progress& /*progress*/) override
    {
      ++this->Owner.Tables;
    }
    std::unique_ptr<DeviceAdvection<2>> Begin(DeviceUse& use, const AdvectionJob<2>& /*job*/,
      std::shared_ptr<const FlowMap<2>> /*map*/, Progress& /*progress*/) override
    {
      return std::make_unique<Advection>(this->Owner, use);
    }
    DeviceNodes<2> BeginNodes(DeviceUse& /*use*/, const AdvectionJob<2>& /*job*/) override
    {
      return {};
    }

  private:
    struct Advection final : DeviceAdvection<2>
    {
      Advection(CornerDevice& device, DeviceUse& use)
        : Owner(device)
        , Use(use)
      {
      }
      std::int64_t FewestParticles() const override { return 100; }
      bool Run(const ParticleSource<2>& source, std::int64_t first, std::int64_t count,
        double* positions, FlowReport& /*counts*/, Progress& /*progress*/) override
      {
        return this->Use.Run([&]() {
          if (this->Owner.IsFailing)
          {
            throw LostDevice("It fails");
          }
          for (std::int64_t i = first; i < first + count; ++i)
          {
            std::int64_t index = 0;
            double seed[2];
            source.Fill(i, 1, &index, seed);
            positions[2 * index] = positions[2 * index + 1] = 0.0;
          }
        });
      }

      CornerDevice& Owner;
      DeviceUse& Use;
    };

    CornerDevice& Owner;
  };

  const std::string& Name() const override { return this->Text; }
  void Find(const void* owner, std::shared_ptr<DeviceFlow<2>>& flow) override
  {
    std::shared_ptr<CornerFlow>& kept = this->Flows[owner];
    kept = kept ? kept : std::make_shared<CornerFlow>(*this);
    flow = kept;
  }
  void Find(const void* /*owner*/, std::shared_ptr<DeviceFlow<3>>& /*flow*/) override {}
  void Forget(const void* owner) override { this->Flows.erase(owner); }

  int Tables = 0;
  bool IsFailing = false;
  std::map<const void*, std::shared_ptr<CornerFlow>> Flows;

private:
  const std::string Text = "corner";
};

Context contextOf(DeviceUse& use)
{
  Context context;
  context.Device = &use;
  return context;
}

TEST(FlowDevice, RunsWhatItServes)
{
  const TestDensity<2> density = randomCells<2>({ 30, 20 });
  const Points<2> seeds = randomPoints<2>(density.Size, 500);
  const auto device = std::make_shared<CornerDevice>();
  DeviceUse use(device);
  const Context context = contextOf(use);
  const RectifiedFlow<2> flow(density.Source(), context);
  EXPECT_EQ(device->Tables, 1);
  EXPECT_EQ(runForward<2>(flow, seeds, {}, context), Points<2>(500, Point<2>{ 0.0, 0.0 }));
  EXPECT_EQ(use.Fault(), "");
  // The other direction is the processor's.
  Points<2> back(seeds.size());
  Points<2> right(seeds.size());
  flow.Backward(seeds, back, {}, context);
  flow.Backward(seeds, right);
  EXPECT_TRUE(sameBits<2>(back, right));
  // It has nothing in 3D.
  const TestDensity<3> volume = randomCells<3>({ 8, 9, 7 });
  const Points<3> places = randomPoints<3>(volume.Size, 100);
  const RectifiedFlow<3> other(volume.Source(), context);
  EXPECT_TRUE(sameBits<3>(
    runForward<3>(other, places, {}, context), runForward<3>(makeFlow<3>(volume), places)));
}

TEST(FlowDevice, IsReplacedWhenItFails)
{
  const TestDensity<2> density = randomCells<2>({ 30, 20 });
  const Points<2> seeds = randomPoints<2>(density.Size, 500);
  const RectifiedFlow<2> flow = makeFlow<2>(density);
  const auto device = std::make_shared<CornerDevice>();
  device->IsFailing = true;
  for (const char* fault : { "It fails", "The device 'corner' was lost" })
  {
    DeviceUse use(device);
    EXPECT_TRUE(
      sameBits<2>(runForward<2>(flow, seeds, {}, contextOf(use)), runForward<2>(flow, seeds)));
    EXPECT_EQ(use.Fault(), fault);
    EXPECT_TRUE(!use.Serves() && !use.Device() && device->IsLost());
  }
}

TEST(FlowDevice, KeepsAFlowUntilItLeaves)
{
  const TestDensity<2> density = randomCells<2>({ 30, 20 });
  const Points<2> seeds = randomPoints<2>(density.Size, 10);
  auto first = std::make_shared<CornerDevice>();
  const auto second = std::make_shared<CornerDevice>();
  DeviceUse use(second);
  std::optional<RectifiedFlow<2>> flow(std::in_place, density.Source());
  const std::weak_ptr<CornerDevice> watched = first;
  {
    DeviceUse before(first);
    runForward<2>(*flow, seeds, {}, contextOf(before));
    runForward<2>(*flow, seeds, {}, contextOf(before));
    EXPECT_EQ(first->Flows.size(), 1U);
    runForward<2>(*flow, seeds, {}, contextOf(use));
    EXPECT_TRUE(first->Flows.empty());
    EXPECT_EQ(second->Flows.size(), 1U);
    runForward<2>(*flow, seeds, {}, contextOf(before));
    EXPECT_TRUE(second->Flows.empty());
  }
  first.reset();
  EXPECT_TRUE(watched.expired()); // the flow does not hold it open
  runForward<2>(*flow, seeds, {}, contextOf(use));
  flow.reset();
  EXPECT_TRUE(second->Flows.empty());
}

} // namespace
} // namespace RectifiedTransport
